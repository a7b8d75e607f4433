//! Why a figure cannot be drawn as asked.

use thiserror::Error;

/// A figure that could not be drawn or stored.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum FigureError {
    /// The name of the file does not say how to store it.
    #[error("the extension chooses the format: end the name in .svg, .png or .pdf")]
    Extension,
    /// Built without the feature of that name.
    #[error("this build writes no {0}: name the figure .svg, or build with --features {1}")]
    Missing(&'static str, &'static str),
    /// Not a width; the narrowest and the widest in millimetres and in pixels.
    #[error(
        "say the width and its unit, such as 85mm or 600px: from {0:.0}mm to {1:.0}mm, {2}px to {3}px"
    )]
    Width(f64, f64, f64, f64),
    /// Not a resolution; the least and the most.
    #[error("the pixels in an inch may be {0} to {1}")]
    Resolution(f64, f64),
    /// A document that has nothing to draw.
    #[error("{0}")]
    Nothing(String),
    /// What the document holds cannot be computed with.
    #[error("the document is damaged: {0}")]
    Damaged(String),
    /// The SVG cannot be read.
    #[error("the SVG is unreadable: {0}")]
    Svg(String),
    /// The picture is too large, in pixels.
    #[error("{0} by {1} pixels are too many: choose a smaller width or fewer pixels to the inch")]
    Pixels(u64, u64),
    /// The picture cannot be packed.
    #[error("the pixels cannot be packed: {0}")]
    Png(String),
}
