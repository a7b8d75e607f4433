//! Figures: from a document to a figure as data, and from a figure to SVG, PNG and PDF.
//!
//! [`of`] makes the figure of any saved document, a `FigureDocument`: panels of curves, maps and cells with their
//! axes, which can be saved and drawn later. [`draw`] returns the bytes of a file, [`svg`] an SVG document. The crate
//! uses no files and no arguments. Equal documents give equal bytes.
//!
//! `animate` returns an animation of a run or a raster, made of a `Scene`: axes that stay, and their content at any time.
//!
//! Features: `png` paints pixels, `pdf` writes vector graphics, `animation` writes GIF, WebP and APNG. Their texts are outlines of
//! the font DejaVu Sans; an SVG file only names this font, and the viewer supplies it.

#[cfg(feature = "animation")]
mod animation;
mod axis;
mod cells;
mod colours;
mod compose;
mod curve;
mod drawing;
mod encode;
mod error;
mod format;
mod legend;
#[cfg(any(feature = "png", feature = "pdf"))]
mod letters;
mod map;
mod number;
mod panel;
#[cfg(feature = "pdf")]
mod pdf;
mod picture;
#[cfg(feature = "png")]
mod raster;
#[cfg(feature = "animation")]
mod scene;
mod sheet;
mod size;
mod style;
mod svg;
#[cfg(test)]
mod tests;
mod text;
mod thin;
mod ticks;

#[cfg(feature = "animation")]
pub use animation::{Film, animate};
pub use axis::can_be_drawn;
#[cfg(feature = "animation")]
pub use compose::scene_of;
pub use compose::{Drawn, View, judge_sweep, of, onset_of};
pub use encode::{draw, svg};
pub use error::FigureError;
pub use format::{AnimationFormat, FigureFormat};
#[cfg(feature = "animation")]
pub use scene::{Moment, Scene, Shot};
pub use size::{Size, Width};
