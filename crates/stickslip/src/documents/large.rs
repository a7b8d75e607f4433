//! Reading and writing of documents that may be large: this code is compiled here, with optimisation.

use crate::{
    List, RasterDocument, RasterFound, RasterSurfaceDocument, RasterSweepDocument, RunDocument,
    SurfaceDocument, SweepDocument, Unusable, read_from, write, write_lists,
};
use std::io::{self, Read, Write};

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

macro_rules! written {
    ($($name:ident: $document:ident, $of:literal;)+) => {$(
        #[doc = concat!("Writes a document of ", $of, " as JSON.")]
        ///
        /// # Errors
        /// As [`write`].
        pub fn $name(out: &mut dyn Write, document: &$document) -> io::Result<()> {
            write(out, document)
        }
    )+};
}

written! {
    write_run: RunDocument, "a run";
    write_sweep: SweepDocument, "a sweep";
    write_surface: SurfaceDocument, "a surface";
    write_raster_sweep: RasterSweepDocument, "a sweep of rasters";
    write_raster_surface: RasterSurfaceDocument, "the surface of a raster";
}

/// Writes a document of any kind as JSON, more slowly, by code that is compiled once for all kinds.
///
/// # Errors
/// As [`write`].
pub fn write_any(out: &mut dyn Write, document: &dyn erased_serde::Serialize) -> io::Result<()> {
    write(out, &document)
}

/// Writes a document of a raster as JSON, by this number of threads.
///
/// # Errors
/// As [`write`].
pub fn write_raster(
    out: &mut dyn Write,
    document: &RasterDocument,
    threads: usize,
) -> io::Result<()> {
    if threads < 2 {
        return write(out, document);
    }
    let frame = document.without_lines();
    let RasterFound { lines, history, .. } = &document.answer;
    let lists = [List::of(lines), List::of(&history.lines)];
    write_lists(out, &frame, ("lines", &lists), threads)
}
