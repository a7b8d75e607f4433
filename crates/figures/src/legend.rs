//! The legend: samples and names in rows above the axes.

use crate::curve::{is_empty, marked, shape};
use crate::drawing::{Anchor, Drawing, Paint, Rect, Text};
use crate::style::{BAND_OPACITY, Colour, LEGEND_SIZE, Mark, Pen, Shape, colour};
use crate::text::width;
use stickslip::PanelDocument;

/// Length of a sample line.
const LINE: f64 = 34.0;
/// Distance between a sample and its name.
const GAP: f64 = 8.0;
/// Distance between two entries.
const SPACE: f64 = 20.0;
const ROW: f64 = 24.0;

#[derive(Debug, Clone, Copy)]
struct Entry<'a> {
    sample: Sample,
    name: &'a str,
}

#[derive(Debug, Clone, Copy)]
enum Sample {
    Curve(Pen),
    Cell(Colour),
}

/// Entries of a legend with their positions, in units from the upper left corner.
pub(crate) struct Legend<'a> {
    entries: Vec<(f64, f64, Entry<'a>)>,
    rows: usize,
}

impl<'a> Legend<'a> {
    /// The legend of all cells and named curves, divided into rows of the given width.
    pub(crate) fn of(panel: &'a PanelDocument, most: f64) -> Self {
        let mut legend = Self { entries: vec![], rows: 0 };
        let mut x = f64::INFINITY;
        for entry in cells(panel).chain(curves(panel)) {
            let needed = entry.sample.length() + GAP + width(entry.name, LEGEND_SIZE);
            if x + needed > most {
                x = 0.0;
                legend.rows += 1;
            }
            legend.entries.push((x, ROW * (legend.rows as f64 - 0.5), entry));
            x += needed + SPACE;
        }
        legend
    }

    pub(crate) fn height(&self) -> f64 {
        ROW * self.rows as f64
    }

    pub(crate) fn draw(&self, left: f64, top: f64, drawing: &mut Drawing) {
        let top = top - 0.15 * ROW;
        for (x, y, entry) in &self.entries {
            entry.sample.draw((left + x, top + y), drawing);
            let x = left + x + entry.sample.length() + GAP;
            let (y, size) = (top + y + 0.35 * LEGEND_SIZE, LEGEND_SIZE);
            let label = entry.name.to_owned();
            drawing.text(Text { x, y, label, size, anchor: Anchor::Start, upright: false });
        }
    }
}

fn curves(panel: &PanelDocument) -> impl Iterator<Item = Entry<'_>> {
    let named = panel.curves.iter().filter(|curve| !is_empty(curve));
    named.filter_map(|curve| {
        let sample = Sample::Curve(Pen::of(curve.style, curve.colour));
        Some(Entry { sample, name: curve.name.as_deref()? })
    })
}

fn cells(panel: &PanelDocument) -> impl Iterator<Item = Entry<'_>> {
    panel.cells.iter().flat_map(|cells| {
        let is_there = |kind| cells.kinds.iter().flatten().any(|cell| *cell == Some(kind));
        let kinds = cells.names.iter().zip(&cells.colours).enumerate();
        let present = kinds.filter(move |(kind, _)| is_there(*kind));
        present.map(|(_, (name, of))| Entry { sample: Sample::Cell(colour(*of)), name })
    })
}

impl Sample {
    fn length(self) -> f64 {
        match self {
            Self::Cell(_) => 16.0,
            Self::Curve(Pen { mark: Mark::Point { radius, .. }, .. }) => 2.0 * radius.max(3.0),
            Self::Curve(_) => LINE,
        }
    }

    fn draw(self, (x, y): (f64, f64), drawing: &mut Drawing) {
        let (left, right) = (x, x + self.length());
        match self {
            Self::Cell(colour) => {
                drawing
                    .rect(Rect { left, right, top: y - 8.0, bottom: y + 8.0 }, Paint::fill(colour));
            }
            Self::Curve(Pen { colour, mark: Mark::Line { width, dashes } }) => {
                let paint = Paint { dashes, ..Paint::stroke(colour, width + 0.4) };
                drawing.segment((left, y), (right, y), paint);
            }
            Self::Curve(Pen { colour, mark: Mark::Band }) => {
                let at = Rect { left, right, top: y - 6.0, bottom: y + 6.0 };
                drawing.rect(at, Paint::translucent(colour, BAND_OPACITY));
            }
            Self::Curve(Pen { colour, mark: Mark::Point { shape: of, radius, filled } }) => {
                let radius = if of == Shape::Disc { radius.max(3.0) } else { radius };
                let path = shape((0.5 * (left + right), y), of, radius);
                drawing.path(path, marked(colour, filled));
            }
        }
    }
}
