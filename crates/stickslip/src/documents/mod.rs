//! Input and output: documents field by field, their schemas, and conversions to and from the types of the other
//! crates.

pub(crate) mod checkpoint;
pub(crate) mod compare;
pub(crate) mod figure;
pub(crate) mod history;
pub(crate) mod in_units;
pub(crate) mod large;
pub(crate) mod outcome;
pub(crate) mod physical;
pub(crate) mod raster;
pub(crate) mod read;
pub(crate) mod reproduction;
pub(crate) mod run_lines;
pub(crate) mod schemas;
pub(crate) mod software;
pub(crate) mod stability;
pub(crate) mod surface;
pub(crate) mod sweep;
pub(crate) mod table;
pub(crate) mod verification;
pub(crate) mod verify;
pub(crate) mod work;
pub(crate) mod write;
