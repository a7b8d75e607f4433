//! Files that come in and go out.

pub(crate) mod beside;
pub(crate) mod columns;
pub(crate) mod distinct;
pub(crate) mod gsf;
mod in_model_units;
pub(crate) mod input;
pub(crate) mod journal;
pub(crate) mod lines;
mod lock;
pub(crate) mod measured;
pub(crate) mod output;
pub(crate) mod paths;
pub(crate) mod place;
mod replace;
pub(crate) mod rows;
mod special;
pub(crate) mod stream;
pub(crate) mod table;
mod temporary;
pub(crate) mod text;
pub(crate) mod within;
