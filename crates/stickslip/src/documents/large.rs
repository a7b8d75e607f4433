//! Reading of the documents that may be large, compiled and optimised here.

use crate::{RasterDocument, RunDocument, SweepDocument, Unusable, read_from};
use std::io::Read;

/// Reads a document of `stickslip run`.
///
/// # Errors
/// As [`read_from`].
pub fn read_run(source: &mut dyn Read) -> Result<RunDocument, Unusable> {
    read_from(source, RunDocument::FORMAT)
}

/// Reads a document of `stickslip raster`.
///
/// # Errors
/// As [`read_from`].
pub fn read_raster(source: &mut dyn Read) -> Result<RasterDocument, Unusable> {
    read_from(source, RasterDocument::FORMAT)
}

/// Reads a document of `stickslip sweep`.
///
/// # Errors
/// As [`read_from`].
pub fn read_sweep(source: &mut dyn Read) -> Result<SweepDocument, Unusable> {
    read_from(source, SweepDocument::FORMAT)
}
