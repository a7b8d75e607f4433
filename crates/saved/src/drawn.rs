//! Documents of a kind that is known at run time.

use crate::{Saved, Writable};
use std::any::Any;
use std::io::Read;
use stickslip::{
    BoundaryDocument, CompareDocument, ContinueDocument, CycleDocument, FigureDocument,
    FitDocument, FitImageDocument, FrictionDocument, LoadMapDocument, MeasuredTipDocument,
    RasterBoundaryDocument, RasterCompareDocument, RasterDocument, RasterStabilityDocument,
    RasterSurfaceDocument, RasterSweepDocument, ResponseDocument, RunDocument,
    SnakingBoundaryDocument, StabilityDocument, SurfaceDocument, SweepDocument, Unusable,
    WalkerDocument, WalkingDocument, identified,
};
use stickslip_figures::Drawn;

/// A document whose type is not known at compile time.
pub trait Document: Writable + Any + Send + Sync {
    /// The document as a table and as a picture.
    fn drawn(&self) -> &dyn Drawn;
    /// A copy of the document.
    fn copy(&self) -> Box<dyn Document>;
}

impl<D: Saved + Drawn> Document for D {
    fn drawn(&self) -> &dyn Drawn {
        self
    }

    fn copy(&self) -> Box<dyn Document> {
        Box::new(self.clone())
    }
}

macro_rules! by_format {
    ($($document:ident),+ $(,)?) => {
        /// The document in a stream, of any kind that has a figure. Of another document, only the beginning is read.
        ///
        /// # Errors
        /// The stream is not JSON, is a document without a figure, or is damaged.
        pub fn drawn(source: Box<dyn Read + '_>) -> Result<Box<dyn Document>, Unusable> {
            let (kind, mut source) = identified(source, "stickslip/COMMAND")?;
            let format = kind.format.unwrap_or_default();
            match format.as_str() {
                $($document::FORMAT => Ok(Box::new($document::read(&mut source)?)),)+
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
