//! Documents that have a figure, of a kind that is known at run time.

use crate::Saved;
use std::io::Read;
use stickslip::{
    BoundaryDocument, CompareDocument, ContinueDocument, CycleDocument, FigureDocument,
    FitDocument, FitImageDocument, FrictionDocument, LoadMapDocument, MeasuredTipDocument,
    RasterBoundaryDocument, RasterCompareDocument, RasterDocument, RasterStabilityDocument,
    RasterSurfaceDocument, RasterSweepDocument, ResponseDocument, RunDocument,
    SnakingBoundaryDocument, StabilityDocument, SurfaceDocument, SweepDocument, Tabular, Unusable,
    WalkerDocument, WalkingDocument, identified,
};
use stickslip_figures::Drawn;

/// A function of a document whose type is determined at run time.
pub trait Taker {
    /// Result of the function.
    type Taken;

    /// Applies the function to the document.
    fn take<D: Drawn + Tabular + Saved>(self, document: D) -> Self::Taken;
}

/// The document in a stream, of any kind that has a figure. Of another document, only the beginning is read.
///
/// # Errors
/// The stream is not JSON, is a document without a figure, or is damaged.
pub fn drawn(source: impl Read) -> Result<Box<dyn Drawn>, Unusable> {
    drawn_as(source, Boxed)
}

macro_rules! by_format {
    ($($document:ident),+ $(,)?) => {
        /// Applies a function to the document in a stream, with the type of this document.
        ///
        /// # Errors
        /// As [`drawn`].
        pub fn drawn_as<T: Taker>(source: impl Read, taker: T) -> Result<T::Taken, Unusable> {
            let (kind, mut source) = identified(source, "stickslip/COMMAND")?;
            let format = kind.format.unwrap_or_default();
            match format.as_str() {
                $($document::FORMAT => Ok(taker.take($document::read(&mut source)?)),)+
                _ => Err(Unusable::new(format_args!(
                    "format is {}; pictures are available for {}",
                    if format.is_empty() { "missing" } else { &format },
                    [$($document::FORMAT),+].join(", ")
                ))),
            }
        }
    };
}

by_format! {
    RunDocument, SurfaceDocument, StabilityDocument, BoundaryDocument, CycleDocument,
    ContinueDocument, SweepDocument, RasterSweepDocument, ResponseDocument, CompareDocument,
    RasterDocument, RasterCompareDocument, RasterSurfaceDocument, RasterStabilityDocument,
    RasterBoundaryDocument, SnakingBoundaryDocument, LoadMapDocument, WalkingDocument,
    WalkerDocument, MeasuredTipDocument, FitDocument, FitImageDocument, FrictionDocument,
    FigureDocument,
}

/// Keeps a document as a trait object with its figure.
struct Boxed;

impl Taker for Boxed {
    type Taken = Box<dyn Drawn>;

    fn take<D: Drawn + Tabular + Saved>(self, document: D) -> Box<dyn Drawn> {
        Box::new(document)
    }
}
