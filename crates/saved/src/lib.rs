//! Documents of any kind: reading, writing and passing on.
//!
//! The code that reads and writes documents is a third of what a program of all commands compiles. Most of it runs once
//! for a file, so that it is compiled here, once. A release build does not optimise this crate; the documents that may
//! be large are read and written by code of `stickslip`, which is optimised.

mod drawn;

pub use drawn::{Document, drawn};

use std::io::{self, Read, Write};
use stickslip::{
    BoundaryDocument, CompareDocument, ContinueDocument, CycleDocument, FigureDocument,
    FitDocument, FitImageDocument, FrictionDocument, LoadMapDocument, MeasuredTipDocument,
    RasterBoundaryDocument, RasterCompareDocument, RasterDocument, RasterStabilityDocument,
    RasterSurfaceDocument, RasterSweepDocument, ReproductionDocument, ResponseDocument,
    RunDocument, SnakingBoundaryDocument, StabilityDocument, SurfaceDocument, SweepDocument,
    UnitsDocument, Unusable, VerifyDocument, WalkerDocument, WalkingDocument, read_from,
    read_raster, read_run, read_sweep, write_any, write_raster, write_raster_surface,
    write_raster_sweep, write_run, write_surface, write_sweep,
};

/// A document that commands write and read.
pub trait Saved: Writable + Clone + Send + Sync + 'static {
    /// Value of the field `format`, such as "stickslip/run".
    const FORMAT: &'static str;

    /// Reads a document from a stream.
    ///
    /// # Errors
    /// The stream is not JSON, is a document of another format or version, is damaged, or fails.
    fn read(source: &mut dyn Read) -> Result<Self, Unusable>;
}

/// A document as it is written.
pub trait Writable {
    /// Writes the document as JSON, by this number of threads if its kind may be large enough for several.
    ///
    /// # Errors
    /// The output fails.
    fn write(&self, out: &mut dyn Write, threads: usize) -> io::Result<()>;

    /// The document for a serializer of any type.
    fn serialized(&self) -> &dyn erased_serde::Serialize;
}

macro_rules! saved {
    ($($document:ident: $read:expr, $write:expr;)+) => {
        $(impl Saved for $document {
            const FORMAT: &'static str = $document::FORMAT;

            fn read(source: &mut dyn Read) -> Result<Self, Unusable> {
                $read(source)
            }
        }

        impl Writable for $document {
            fn write(&self, out: &mut dyn Write, threads: usize) -> io::Result<()> {
                $write(out, self, threads)
            }

            fn serialized(&self) -> &dyn erased_serde::Serialize {
                self
            }
        })+
    };
    ($($document:ident,)+) => {
        saved! { $(
            $document: |source| read_from(source, $document::FORMAT),
                |out, document, _| write_any(out, document);
        )+ }
    };
}

saved! {
    RunDocument: read_run, |out, document, _| write_run(out, document);
    SweepDocument: read_sweep, |out, document, _| write_sweep(out, document);
    RasterDocument: read_raster, write_raster;
    SurfaceDocument: |source| read_from(source, SurfaceDocument::FORMAT),
        |out, document, _| write_surface(out, document);
    RasterSweepDocument: |source| read_from(source, RasterSweepDocument::FORMAT),
        |out, document, _| write_raster_sweep(out, document);
    RasterSurfaceDocument: |source| read_from(source, RasterSurfaceDocument::FORMAT),
        |out, document, _| write_raster_surface(out, document);
}

saved! {
    BoundaryDocument, CompareDocument, ContinueDocument, CycleDocument, FigureDocument,
    FitDocument, FitImageDocument, FrictionDocument, LoadMapDocument, MeasuredTipDocument,
    RasterBoundaryDocument, RasterCompareDocument, RasterStabilityDocument, ReproductionDocument,
    ResponseDocument, SnakingBoundaryDocument, StabilityDocument, UnitsDocument, VerifyDocument,
    WalkerDocument, WalkingDocument,
}
