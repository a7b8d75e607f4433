//! Why a figure cannot be stored as asked.

use thiserror::Error;

/// A figure that could not be stored.
#[derive(Debug, Error)]
pub(crate) enum PlotError {
    /// The file name does not say how.
    #[error("the extension chooses the format: end the name in .svg or .png")]
    Extension,
    /// Built without the feature `png`.
    #[cfg(not(feature = "png"))]
    #[error("this build writes no PNG: name the figure .svg, or build with --features png")]
    NoPng,
    /// The SVG cannot be read.
    #[cfg(feature = "png")]
    #[error("the SVG is unreadable: {0}")]
    Svg(#[from] resvg::usvg::Error),
    /// The picture is too large for memory, in pixels.
    #[cfg(feature = "png")]
    #[error("{0} by {1} pixels do not fit into memory")]
    Size(u32, u32),
    /// The picture cannot be packed.
    #[error("the pixels cannot be packed: {0}")]
    Png(String),
}
