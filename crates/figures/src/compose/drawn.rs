//! Documents that have a figure, and options of a figure.

use crate::error::FigureError;
#[cfg(feature = "animation")]
use crate::scene::{Scene, Shot};
use stickslip::{FigureDocument, KnownScales, Tabular, UnitsDocument, VerifyDocument};

/// Options of a figure, in addition to its document.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct View {
    /// First and last abscissa of the first panel, and of all panels with the same axis label.
    pub x_range: Option<[f64; 2]>,
    /// First and last ordinate of the first panel, and of all panels with the same axis label.
    pub y_range: Option<[f64; 2]>,
    /// Units of the two ranges, such as nm; without one a range is in the unit of its axis.
    pub range_units: [Option<&'static str>; 2],
    /// Scales for axes in nm, s and nN; by default those of the document, if it has any.
    pub scales: Option<KnownScales>,
}

/// A document that has a figure.
pub trait Drawn: Tabular {
    /// The figure, with the resolution that `view.x_range` requires as far as the document permits.
    ///
    /// # Errors
    /// The document is damaged, or contains nothing to draw.
    fn figure(&self, view: &View) -> Result<FigureDocument, FigureError>;

    /// The motion that an animation shows, in the model's units.
    ///
    /// # Errors
    /// Nothing moves in a document of this kind, or the document is damaged.
    #[cfg(feature = "animation")]
    fn scene(&self, _: &Shot) -> Result<Box<dyn Scene>, FigureError> {
        let why = "animations show the motion of a saved run or raster: name this picture .svg, .png or .pdf";
        Err(FigureError::Still(why.into()))
    }
}

impl Drawn for UnitsDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        Err(no_picture())
    }
}

impl Drawn for VerifyDocument {
    fn figure(&self, _: &View) -> Result<FigureDocument, FigureError> {
        Err(no_picture())
    }
}

fn no_picture() -> FigureError {
    FigureError::Nothing("there is no picture of it".into())
}
