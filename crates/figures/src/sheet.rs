//! The canvas: panels in rows under a title, as one SVG document.

#[cfg(feature = "animation")]
use crate::curve::Frame;
use crate::error::FigureError;
use crate::panel::Panel;
use crate::size::Size;
use crate::style::TITLE_SIZE;
use crate::svg::{Anchor, Paint, Rect, Svg, Text, number};
use crate::text::wrapped;
use stickslip::{FigureDocument, PanelDocument};

/// Smallest width of a column; with less, panels are placed below each other.
const NARROWEST: f64 = 240.0;
const TITLE_LINE: f64 = 1.4 * TITLE_SIZE;
/// Height of a panel over the width of the figure: for a single panel, for one of several, and for one with cells;
/// and the limits of all these.
const ALONE: f64 = 0.6;
const SHARED: f64 = 0.3;
const CELLS: f64 = 0.69;
const HEIGHTS: (f64, f64) = (230.0, 640.0);
/// Limits of the same ratio for a map, whose height otherwise follows from its own ratio of height to width.
const MAPS: (f64, f64) = (0.25, 0.47);

/// A panel with its columns: the first, and one past the last.
struct Placed<'a> {
    panel: Panel<'a>,
    columns: (usize, usize),
    height: f64,
}

/// Draws a figure: without background and size for a viewer that has its own, else on a background and in units.
pub(crate) fn sheet(
    figure: &FigureDocument,
    size: &Size,
    with_ground: bool,
) -> Result<String, FigureError> {
    let sheet = Sheet::of(figure, size.units());
    let (width, height) = sheet.size;
    let mut svg = Svg::default();
    if with_ground {
        let ground = Rect { left: 0.0, top: 0.0, right: width, bottom: height };
        svg.rect(ground, Paint::fill("#ffffff"));
    }
    sheet.draw(&mut svg)?;
    let written = if with_ground { size.written(height) } else { (number(width), number(height)) };
    Ok(svg.finish(sheet.size, written))
}

/// A figure with the places of its panels.
pub(crate) struct Sheet<'a> {
    /// Width and height, in units.
    pub(crate) size: (f64, f64),
    title: Vec<String>,
    panels: Vec<Laid<'a>>,
}

/// A panel with its space, and the left and right ends of its axes.
struct Laid<'a> {
    panel: Panel<'a>,
    space: Rect,
    between: (f64, f64),
}

impl<'a> Sheet<'a> {
    /// The figure at this width, in units.
    pub(crate) fn of(figure: &'a FigureDocument, width: f64) -> Self {
        let asked = figure.columns.clamp(1, 12);
        let columns = if width < NARROWEST * asked as f64 { 1 } else { asked };
        let rows = rows(figure, columns, width);
        let sides = sides(&rows, columns, width);
        let between = |placed: &Placed| (sides[placed.columns.0].0, sides[placed.columns.1 - 1].1);
        let height_of =
            |placed: &Placed| placed.height + (placed.panel.head(between(placed)) - 24.0).max(0.0);
        let title = wrapped(&figure.title, TITLE_SIZE, 0.94 * width);
        let head = if title.is_empty() { 0.0 } else { 8.0 + TITLE_LINE * title.len() as f64 };
        let column = width / columns as f64;
        let (mut top, mut panels) = (head, vec![]);
        for row in rows {
            let bottom = top + row.iter().map(height_of).fold(0.0, f64::max);
            for placed in row {
                let (left, right) =
                    (column * placed.columns.0 as f64, column * placed.columns.1 as f64);
                let (space, between) = (Rect { left, right, top, bottom }, between(&placed));
                panels.push(Laid { panel: placed.panel, space, between });
            }
            top = bottom;
        }
        Self { size: (width, top), title, panels }
    }

    pub(crate) fn draw(&self, svg: &mut Svg) -> Result<(), FigureError> {
        for (i, line) in self.title.iter().enumerate() {
            let (x, y) = (0.5 * self.size.0, 8.0 + TITLE_LINE * (i as f64 + 0.75));
            let (label, size, anchor) = (line.as_str(), TITLE_SIZE, Anchor::Middle);
            svg.text(Text { x, y, label, size, anchor, upright: false });
        }
        self.panels.iter().try_for_each(|laid| laid.panel.draw(laid.space, laid.between, svg))
    }

    /// The axes of each panel.
    #[cfg(feature = "animation")]
    pub(crate) fn frames(&self) -> Vec<Frame<'_>> {
        self.panels.iter().map(|laid| laid.panel.frame(laid.space, laid.between)).collect()
    }
}

/// The panels by rows, filled as far as their spans allow.
fn rows(figure: &FigureDocument, columns: usize, width: f64) -> Vec<Vec<Placed<'_>>> {
    let mut rows: Vec<Vec<Placed>> = vec![];
    let alone = figure.panels.len() == 1;
    for document in &figure.panels {
        let span = document.span.clamp(1, columns);
        let from = match rows.last().and_then(|row| row.last()) {
            Some(last) if last.columns.1 + span <= columns => last.columns.1,
            _ => {
                rows.push(vec![]);
                0
            }
        };
        let height = height(document, width, alone);
        let axes = (width * span as f64 / columns as f64 - 110.0, height - 90.0);
        let placed =
            Placed { panel: Panel::new(document, axes), columns: (from, from + span), height };
        rows.last_mut().expect("one was pushed").push(placed);
    }
    rows
}

fn height(panel: &PanelDocument, width: f64, alone: bool) -> f64 {
    let part = match (&panel.map, &panel.cells) {
        (Some(map), _) => {
            let length = |v: &[f64]| match (v.first(), v.last()) {
                (Some(first), Some(last)) => (last - first).abs(),
                _ => 1.0,
            };
            let aspect = length(&map.y) / length(&map.x);
            let (least, most) = MAPS;
            if aspect.is_finite() { (0.75 * aspect).clamp(least, most) } else { least }
        }
        (_, Some(_)) => CELLS,
        _ if alone => ALONE,
        _ => SHARED,
    };
    (part * width + 24.0).clamp(HEIGHTS.0, HEIGHTS.1)
}

/// Left and right ends of the axes in each column, the same in all rows.
fn sides(rows: &[Vec<Placed>], columns: usize, width: f64) -> Vec<(f64, f64)> {
    let column = width / columns as f64;
    let all = || rows.iter().flatten();
    let side = |i: usize| {
        let starting = all().filter(|p| p.columns.0 == i).map(|p| p.panel.margin_left());
        let ending = all().filter(|p| p.columns.1 == i + 1).map(|p| p.panel.margin_right());
        let (left, right) = (starting.fold(0.0, f64::max), ending.fold(0.0, f64::max));
        (column * i as f64 + left, column * (i + 1) as f64 - right)
    };
    (0..columns).map(side).collect()
}
