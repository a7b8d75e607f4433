//! The figure of surfaces at some times.

use super::lines::{Series, numbered};
use super::panel::Panel;
use super::sheet::sheet;
use super::style::TALL;

/// Surfaces to compare.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SurfaceFigure<'a> {
    /// Above the panel.
    pub(crate) title: &'a str,
    /// Name such as "t = 457", abscissas, heights.
    pub(crate) curves: &'a [Series<'a>],
}

/// One panel, a curve for every surface. An SVG document.
pub(crate) fn surface(figure: &SurfaceFigure) -> String {
    let labels = ("x (σ)", "u (kσ²/a)");
    sheet(figure.title, &[Panel::fitted(labels, numbered(figure.curves), TALL, 1.0)])
}
