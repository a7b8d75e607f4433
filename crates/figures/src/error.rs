//! Errors of drawing.

use std::fmt::Display;
use thiserror::Error;

/// A figure that could not be drawn or stored.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FigureError {
    /// The file name has no extension of a known format.
    #[error(
        "the extension gives the format: .svg, .png or .pdf; `stickslip plot` of a run or a raster also writes animations, .gif, .webp or .apng"
    )]
    Extension,
    /// The program was built without this feature.
    #[error("this build cannot write {0}: name the figure .svg, or build with --features {1}")]
    Missing(&'static str, &'static str),
    /// An invalid width; the valid range in millimetres and in pixels.
    #[error(
        "must be a width with its unit, such as 85mm or 600px: from {0:.0}mm to {1:.0}mm, or {2}px to {3}px"
    )]
    Width(f64, f64, f64, f64),
    /// An invalid resolution; the smallest and the largest one.
    #[error("the number of pixels per inch must be {0} to {1}")]
    Resolution(f64, f64),
    /// The document has nothing to draw.
    #[error("{0}")]
    Nothing(String),
    /// A range whose unit is not that of its axis; the unit, and the label of the axis.
    #[error(
        "a range in {0} does not fit the axis {1}: give it in the unit of the axis, or the scales by --units or --sigma"
    )]
    Unit(&'static str, String),
    /// Nothing moves in the document, or nothing at the requested times.
    #[error("{0}")]
    Still(String),
    /// The file name of an animation where a picture is drawn.
    #[error(
        "an animation is made of a saved run or raster: name the picture .svg, .png or .pdf, save the document by -o RUN.json and use stickslip plot RUN.json -o {0}"
    )]
    Animated(String),
    /// An option of an animation that is out of range: the quantity, the smallest and the largest value.
    #[error("the {0} may be {1} to {2}")]
    Film(&'static str, f64, f64),
    /// The document contains invalid data.
    #[error("the document is damaged: {0}")]
    Damaged(String),
    /// The picture is too large, in pixels.
    #[error("{0} by {1} pixels are too many: choose a smaller width or fewer pixels per inch")]
    Pixels(u64, u64),
    /// The picture cannot be compressed.
    #[error("the pixels cannot be packed: {0}")]
    Png(String),
}

/// The error for pixels that cannot be packed.
pub(crate) fn unpacked(error: impl Display) -> FigureError {
    FigureError::Png(error.to_string())
}

/// The error for a document from which something cannot be computed.
pub(crate) fn damaged(error: impl Display) -> FigureError {
    FigureError::Damaged(error.to_string())
}
