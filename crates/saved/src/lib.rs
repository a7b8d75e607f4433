//! Documents, read back and handed on whatever their kind.
//!
//! The code that reads documents is a third of the compiled code of a program of all commands; most of it runs once
//! per file. It is compiled here, once. A release build does not optimise this crate; the documents that may be large are
//! read by code of `stickslip`, which it does.

mod drawn;

pub use drawn::{Taker, drawn, drawn_as};

use std::io::Read;
use stickslip::{
    BoundaryDocument, CompareDocument, ContinueDocument, CycleDocument, FigureDocument,
    FitDocument, FitImageDocument, FrictionDocument, LoadMapDocument, MeasuredTipDocument,
    RasterBoundaryDocument, RasterCompareDocument, RasterDocument, RasterStabilityDocument,
    RasterSurfaceDocument, RasterSweepDocument, ResponseDocument, RunDocument,
    SnakingBoundaryDocument, StabilityDocument, SurfaceDocument, SweepDocument, UnitsDocument,
    Unusable, VerifyDocument, WalkerDocument, WalkingDocument, read_from, read_raster, read_run,
    read_sweep,
};

/// A document that commands write and read.
pub trait Saved: Clone + Send + Sync + 'static {
    /// Value of the field `format`, such as "stickslip/run".
    const FORMAT: &'static str;

    /// Reads a document from a stream.
    ///
    /// # Errors
    /// The stream is not JSON, is a document of another format or version, is damaged, or fails.
    fn read(source: &mut dyn Read) -> Result<Self, Unusable>;

    /// The document for a serializer of any type.
    fn serialized(&self) -> &dyn erased_serde::Serialize;
}

macro_rules! saved {
    ($($document:ident: $read:expr),+ $(,)?) => {
        $(impl Saved for $document {
            const FORMAT: &'static str = $document::FORMAT;

            fn read(source: &mut dyn Read) -> Result<Self, Unusable> {
                $read(source)
            }

            fn serialized(&self) -> &dyn erased_serde::Serialize {
                self
            }
        })+
    };
    ($($document:ident),+ $(,)?) => {
        saved!($($document: |source| read_from(source, $document::FORMAT)),+);
    };
}

saved! { RunDocument: read_run, RasterDocument: read_raster, SweepDocument: read_sweep }

saved! {
    BoundaryDocument, CompareDocument, ContinueDocument, CycleDocument, FigureDocument,
    FitDocument, FitImageDocument, FrictionDocument, LoadMapDocument, MeasuredTipDocument,
    RasterBoundaryDocument, RasterCompareDocument, RasterStabilityDocument, RasterSurfaceDocument,
    RasterSweepDocument, ResponseDocument, SnakingBoundaryDocument, StabilityDocument,
    SurfaceDocument, UnitsDocument, VerifyDocument, WalkerDocument, WalkingDocument,
}
