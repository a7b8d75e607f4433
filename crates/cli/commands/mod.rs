//! One file per command.

pub(crate) mod model;
pub(crate) mod run;
pub(crate) mod schema;
pub(crate) mod surface;

mod progress;
