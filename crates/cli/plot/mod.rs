//! Figures of runs, surfaces, roots and stability boundaries, as SVG or PNG.
//!
//! Numbers in, document out: nothing here knows of models or files. A figure ([`run`], [`cycle`], [`bifurcations`], [`phases`], [`surface`],
//! [`roots`], [`boundary`], [`onset`], [`lines`]) describes panels of curves; a [`panel`] fits its axes and
//! thins its curves; a [`sheet`] stacks the panels into one SVG; [`encode`] makes the bytes of a
//! file of it. The same input gives the same bytes.

mod axis;
mod bifurcation;
mod boundary;
mod curve;
mod cycle;
mod drawing;
mod encode;
mod error;
#[cfg(feature = "png")]
mod font;
mod format;
mod legend;
mod lines;
mod map;
mod number;
mod onset;
mod panel;
mod phases;
mod phases_over;
mod picture;
mod plots;
#[cfg(feature = "png")]
mod raster;
mod roots;
mod run;
mod sheet;
mod style;
mod surface;
mod thin;

pub(crate) use bifurcation::{BifurcationFigure, BranchCurve, SpecialMark, bifurcations};
pub(crate) use boundary::boundary;
pub(crate) use cycle::{CycleFigure, cycle};
pub(crate) use drawing::{DrawnCurve, DrawnPanel, Style, drawing};
pub(crate) use encode::encode;
pub(crate) use format::PlotFormat;
pub(crate) use lines::lines;
pub(crate) use map::{Colours, Map, maps};
pub(crate) use number::seven_digits;
pub(crate) use onset::onset;
pub(crate) use phases::{Phase, PhaseFigure, phases};
pub(crate) use phases_over::{PhasesOver, phases_over};
pub(crate) use roots::roots;
pub(crate) use run::{RunFigure, run};
pub(crate) use surface::{SurfaceFigure, surface};
