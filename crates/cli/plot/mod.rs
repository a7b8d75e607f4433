//! Figures of runs, surfaces, roots and stability boundaries, as SVG or PNG.
//!
//! Numbers in, document out: nothing here knows of models or files. A figure ([`run`], [`surface`],
//! [`roots`], [`boundary`], [`lines`]) describes panels of curves; a [`panel`] fits its axes and
//! thins its curves; a [`sheet`] stacks the panels into one SVG; [`encode`] makes the bytes of a
//! file of it. The same input gives the same bytes.

mod axis;
// Nobody calls boundary, lines and roots yet: drop `allow` with the first command that does.
#[allow(dead_code)]
mod boundary;
mod curve;
mod encode;
mod error;
#[cfg(feature = "png")]
mod font;
mod format;
mod legend;
#[allow(dead_code)]
mod lines;
mod panel;
#[cfg(feature = "png")]
mod raster;
#[allow(dead_code)]
mod roots;
mod run;
mod sheet;
mod style;
mod surface;
mod thin;

pub(crate) use encode::encode;
pub(crate) use format::PlotFormat;
pub(crate) use run::{RunFigure, run};
pub(crate) use surface::{SurfaceFigure, surface};
#[allow(unused_imports)]
pub(crate) use {boundary::boundary, lines::Series, lines::lines, roots::roots};
