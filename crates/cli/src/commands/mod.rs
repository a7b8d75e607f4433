//! One file per command.

mod ask;
pub(crate) mod boundary;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod continuation;
pub(crate) mod cycle;
pub(crate) mod figures;
pub(crate) mod fit;
pub(crate) mod friction;
pub(crate) mod model;
pub(crate) mod plot;
pub(crate) mod quantities;
pub(crate) mod raster;
pub(crate) mod response;
pub(crate) mod run;
pub(crate) mod schema;
pub(crate) mod stability;
pub(crate) mod surface;
pub(crate) mod sweep;
pub(crate) mod tip;
pub(crate) mod units;
pub(crate) mod verify;

pub(crate) mod fields;
mod figure;
mod finished;
mod fit_image;
mod in_units;
mod job;
mod judged;
mod progress;
mod summary;
