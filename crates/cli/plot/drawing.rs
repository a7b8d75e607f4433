//! A figure described panel by panel.

use super::axis::{Axis, Fit};
use super::curve::{Curve, Pen};
use super::error::PlotError;
use super::map::Map;
use super::panel::{Panel, Shade};
use super::sheet::sheet;
use super::style::{BLUE, LOW, TALL, VERMILLION};

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Style {
    /// What the panel is about.
    Line,
    /// To compare with: dashed, in the second colour.
    Dashed,
    /// What was before: dotted, black.
    Dotted,
    /// Discs in the first colour.
    Dots,
    /// Triangles in the second colour.
    Triangles,
    /// Small black discs, many of them.
    Points,
    /// A line with all above it shaded.
    Boundary,
}

/// Points in a style, and their name in the legend, if any.
#[derive(Debug, Clone, Copy)]
pub(crate) struct DrawnCurve<'a> {
    pub(crate) name: Option<&'a str>,
    pub(crate) style: Style,
    pub(crate) x: &'a [f64],
    pub(crate) y: &'a [f64],
}

/// Axes with curves, or with a map.
#[derive(Debug, Clone)]
pub(crate) struct DrawnPanel<'a> {
    pub(crate) heading: &'a str,
    /// Of x and y.
    pub(crate) labels: (&'a str, &'a str),
    pub(crate) curves: Vec<DrawnCurve<'a>>,
    /// Fills the axes, whose labels it has.
    pub(crate) map: Option<Map<'a>>,
    /// First and last y shown, where they are not fitted to the curves.
    pub(crate) y_range: Option<(f64, f64)>,
}

/// Panels one below the other. An SVG document.
pub(crate) fn drawing(title: &str, panels: &[DrawnPanel]) -> Result<String, PlotError> {
    let height = if panels.len() == 1 { TALL } else { LOW };
    let drawn: Result<Vec<Panel>, PlotError> =
        panels.iter().map(|panel| panel.drawn(height)).collect();
    Ok(sheet(title, &drawn?))
}

impl<'a> DrawnPanel<'a> {
    fn drawn(&self, height: f64) -> Result<Panel<'a>, PlotError> {
        if let Some(map) = &self.map {
            return map.panel();
        }
        let curve = |c: &DrawnCurve<'a>| Curve {
            x: c.x,
            y: c.y,
            pen: pen(c.style),
            label: c.name.map(str::to_owned),
        };
        let curves: Vec<Curve> = self.curves.iter().map(curve).collect();
        let mut panel = Panel::fitted(self.labels, curves, height, 0.0);
        panel.heading = self.heading;
        let marks =
            |c: &DrawnCurve| matches!(c.style, Style::Dots | Style::Triangles | Style::Points);
        if self.curves.iter().any(marks) {
            // Marks at the ends are not cut in half.
            let abscissas = self.curves.iter().flat_map(|c| c.x.iter().copied());
            panel.x = Axis::fit(abscissas, Fit { padding: 0.03, natural: 0.0, ticks: 9.0 });
        }
        if let Some((low, high)) = self.y_range {
            panel.y = Axis::new(low, high, height / 65.0);
        }
        let bounded = self.curves.iter().filter(|c| c.style == Style::Boundary);
        panel.shades = bounded.map(|c| Shade::Above(c.x, c.y, VERMILLION)).collect();
        Ok(panel)
    }
}

fn pen(style: Style) -> Pen {
    match style {
        Style::Line | Style::Boundary => Pen::MAIN,
        Style::Dashed => Pen::REFERENCE,
        Style::Dotted => Pen::BEFORE,
        Style::Dots => Pen::dots(BLUE),
        Style::Triangles => Pen::triangles(VERMILLION),
        Style::Points => Pen::POINTS,
    }
}
