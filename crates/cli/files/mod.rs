//! Files that come in and go out.

pub(crate) mod apart;
pub(crate) mod gsf;
pub(crate) mod input;
pub(crate) mod journal;
pub(crate) mod lines;
pub(crate) mod npz;
pub(crate) mod output;
pub(crate) mod stream;
mod temporary;
