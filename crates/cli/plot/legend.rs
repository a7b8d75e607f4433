//! The legend: samples and names in rows above the axes, where they hide nothing.

use super::curve::{Curve, Mark, Pen};
use super::style::{LEGEND_SIZE, text_width};
use kuva::render::render::{PathData, Primitive, Scene, TextAnchor};

/// Length of a sample line.
const LINE: f64 = 34.0;
/// Between a sample and its name.
const GAP: f64 = 8.0;
/// Between an entry and the next.
const SPACE: f64 = 16.0;
const ROW: f64 = 24.0;

/// Entries with their places, in pixels from the upper left corner.
pub(super) struct Legend<'a> {
    entries: Vec<(f64, f64, Pen, &'a str)>,
    rows: usize,
}

impl<'a> Legend<'a> {
    /// Of the curves that have a name, broken into rows of the given width.
    pub(super) fn of(curves: &'a [Curve], width: f64) -> Self {
        let mut legend = Self { entries: Vec::new(), rows: 0 };
        let mut x = f64::INFINITY;
        for curve in curves {
            let Some(label) = curve.label.as_deref() else { continue };
            let needed = length(curve.pen) + GAP + text_width(label, LEGEND_SIZE);
            if x + needed > width {
                x = 0.0;
                legend.rows += 1;
            }
            legend.entries.push((x, ROW * (legend.rows as f64 - 0.5), curve.pen, label));
            x += needed + SPACE;
        }
        legend
    }

    pub(super) fn height(&self) -> f64 {
        ROW * self.rows as f64
    }

    pub(super) fn draw(&self, left: f64, top: f64, scene: &mut Scene) {
        let top = top - 0.3 * ROW;
        for &(x, y, pen, label) in &self.entries {
            scene.add(sample(left + x, top + y, pen));
            scene.add(Primitive::Text {
                x: left + x + length(pen) + GAP,
                y: top + y + 0.35 * f64::from(LEGEND_SIZE),
                content: label.to_owned(),
                size: LEGEND_SIZE,
                anchor: TextAnchor::Start,
                rotate: None,
                bold: false,
                color: None,
            });
        }
    }
}

/// Of a sample.
fn length(pen: Pen) -> f64 {
    match pen.mark {
        Mark::Line { .. } => LINE,
        Mark::Dots { radius } | Mark::Triangles { radius } => 2.0 * radius,
    }
}

fn sample(x: f64, y: f64, pen: Pen) -> Primitive {
    match pen.mark {
        Mark::Line { width, dashes } => Primitive::Line {
            x1: x,
            y1: y,
            x2: x + LINE,
            y2: y,
            stroke: pen.colour.into(),
            stroke_width: width + 0.4,
            stroke_dasharray: (!dashes.is_empty()).then(|| dashes.to_owned()),
        },
        Mark::Triangles { radius } => {
            Primitive::Path(Box::new(triangle(x + radius, y, radius, pen)))
        }
        Mark::Dots { radius } => Primitive::Circle {
            cx: x + radius,
            cy: y,
            r: radius,
            fill: pen.colour.into(),
            fill_opacity: None,
            stroke: None,
            stroke_width: None,
        },
    }
}

/// As kuva draws the marks in the panel.
fn triangle(x: f64, y: f64, radius: f64, pen: Pen) -> PathData {
    let (half, base) = (0.866 * radius, y + 0.5 * radius);
    PathData {
        d: format!("M{x},{} L{},{base} L{},{base} Z", y - radius, x - half, x + half),
        fill: Some(pen.colour.into()),
        stroke: pen.colour.into(),
        stroke_width: 0.0,
        opacity: None,
        stroke_dasharray: None,
    }
}
