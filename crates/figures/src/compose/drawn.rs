//! What has a figure, and what may be asked of it.

use crate::error::FigureError;
use stickslip::{FigureDocument, KnownScales, Tabular};

/// What is asked of a figure beyond what its document says.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct View {
    /// First and last abscissa of the first panel, and of those with the same axis label.
    pub x_range: Option<[f64; 2]>,
    /// First and last ordinate of the first panel, and of those with the same axis label.
    pub y_range: Option<[f64; 2]>,
    /// Of axes in nm, s and nN, in place of those that the document may have.
    pub scales: Option<KnownScales>,
}

/// A document that has a figure.
pub trait Drawn: Tabular {
    /// The figure; within `view.x_range` as fine as the document allows.
    ///
    /// # Errors
    /// The document is damaged, or holds nothing that could be drawn.
    fn figure(&self, view: &View) -> Result<FigureDocument, FigureError>;
}
