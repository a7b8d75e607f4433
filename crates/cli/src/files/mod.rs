//! Input and output files.

pub(crate) mod beside;
pub(crate) mod columns;
pub(crate) mod decode;
mod dialect;
pub(crate) mod distinct;
pub(crate) mod gsf;
pub(crate) mod heading;
pub(crate) mod input;
pub(crate) mod journal;
pub(crate) mod lines;
mod lock;
pub(crate) mod measured;
mod npz;
pub(crate) mod output;
pub(crate) mod paths;
pub(crate) mod place;
mod replace;
pub(crate) mod sheet;
mod special;
pub(crate) mod stream;
pub(crate) mod table;
pub(crate) mod temporary;
pub(crate) mod text;
