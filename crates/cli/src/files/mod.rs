//! Input and output files.

pub(crate) mod beside;
pub(crate) mod columns;
pub(crate) mod distinct;
pub(crate) mod input;
pub(crate) mod journal;
pub(crate) mod lines;
mod lock;
pub(crate) mod measured;
pub(crate) mod output;
pub(crate) mod paths;
pub(crate) mod place;
mod replace;
mod special;
pub(crate) mod stream;
pub(crate) mod table;
pub(crate) mod temporary;
pub(crate) mod text;
