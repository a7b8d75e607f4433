//! The canvas: panels in rows under a title, as one SVG document.

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
    let width = size.units();
    let asked = figure.columns.clamp(1, 12);
    let columns = if width < NARROWEST * asked as f64 { 1 } else { asked };
    let rows = rows(figure, columns, width);
    let sides = sides(&rows, columns, width);
    let between = |placed: &Placed| (sides[placed.columns.0].0, sides[placed.columns.1 - 1].1);
    let height_of =
        |placed: &Placed| placed.height + (placed.panel.head(between(placed)) - 24.0).max(0.0);
    let row_height = |row: &Vec<Placed>| row.iter().map(height_of).fold(0.0, f64::max);

    let title = wrapped(&figure.title, TITLE_SIZE, 0.94 * width);
    let head = if title.is_empty() { 0.0 } else { 8.0 + TITLE_LINE * title.len() as f64 };
    let height = head + rows.iter().map(row_height).sum::<f64>();
    let mut svg = Svg::default();
    if with_ground {
        svg.rect(
            Rect { left: 0.0, top: 0.0, right: width, bottom: height },
            Paint::fill("#ffffff"),
        );
    }
    for (i, line) in title.iter().enumerate() {
        let (x, y) = (0.5 * width, 8.0 + TITLE_LINE * (i as f64 + 0.75));
        let (label, size, anchor) = (line.as_str(), TITLE_SIZE, Anchor::Middle);
        svg.text(Text { x, y, label, size, anchor, upright: false });
    }
    let mut top = head;
    for row in &rows {
        let bottom = top + row_height(row);
        for placed in row {
            let column = width / columns as f64;
            let (left, right) =
                (column * placed.columns.0 as f64, column * placed.columns.1 as f64);
            placed.panel.draw(Rect { left, top, right, bottom }, between(placed), &mut svg)?;
        }
        top = bottom;
    }
    let written = if with_ground { size.written(height) } else { (number(width), number(height)) };
    Ok(svg.finish((width, height), written))
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
