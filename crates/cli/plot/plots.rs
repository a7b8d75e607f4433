//! The curves and shades of a panel as kuva's plots.

use super::curve::{Curve, Mark};
use super::panel::{Panel, SHADE_OPACITY, Shade};
use super::style::WIDTH;
use super::thin::thin;
use kuva::plot::scatter::MarkerShape;
use kuva::prelude::{BandPlot, LinePlot, LineStyle, Plot, ScatterPlot};

/// About how many points all curves of a panel may have together, so that a file of three panels
/// stays below 300 kB (a point takes some 20 bytes; a panel of a run has two curves).
const POINTS: usize = 12_000;

impl Panel<'_> {
    pub(super) fn plot(&self, curve: &Curve) -> Plot {
        // Marks that share a column are all meant to be seen.
        let line = matches!(curve.pen.mark, Mark::Line { .. });
        let columns = if line { self.columns() } else { curve.x.len() };
        let points = thin(curve.x, curve.y, (self.x.low, self.x.high), columns);
        match curve.pen.mark {
            Mark::Line { width, dashes } if points.len() > 1 => Plot::Line(
                LinePlot::new()
                    .with_data(points)
                    .with_color(curve.pen.colour)
                    .with_stroke_width(width)
                    .with_line_style(line_style(dashes)),
            ),
            // A line of a single point would not show.
            Mark::Line { width: radius, .. }
            | Mark::Dots { radius }
            | Mark::Triangles { radius } => Plot::Scatter(
                ScatterPlot::new()
                    .with_data(points)
                    .with_color(curve.pen.colour)
                    .with_marker(shape(curve.pen.mark))
                    .with_size(if let Mark::Line { .. } = curve.pen.mark { 3.0 } else { radius }),
            ),
        }
    }

    /// A column for every pixel unless there are many curves.
    fn columns(&self) -> usize {
        (WIDTH as usize).min(POINTS / (2 * self.curves.len().max(1)))
    }

    pub(super) fn band(&self, shade: &Shade) -> Option<Plot> {
        let Shade::Above(x, y, colour) = *shade else { return None };
        let points = thin(x, y, (self.x.low, self.x.high), WIDTH as usize);
        let (x, y): (Vec<f64>, Vec<f64>) = points.into_iter().unzip();
        let top = vec![self.y.high; x.len()];
        Some(Plot::Band(BandPlot::new(x, y, top).with_color(colour).with_opacity(SHADE_OPACITY)))
    }
}

fn shape(mark: Mark) -> MarkerShape {
    if let Mark::Triangles { .. } = mark { MarkerShape::Triangle } else { MarkerShape::Circle }
}

fn line_style(dashes: &str) -> LineStyle {
    if dashes.is_empty() { LineStyle::Solid } else { LineStyle::Custom(dashes.to_owned()) }
}
