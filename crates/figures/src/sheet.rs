//! The canvas: panels in rows under a title, as one drawing.

#[cfg(feature = "animation")]
use crate::curve::Frame;
use crate::drawing::{Anchor, Drawing, Paint, Rect, Text};
use crate::panel::{MARGIN_BOTTOM, MARGIN_TOP, Panel};
use crate::style::{PAPER, TITLE_SIZE};
use crate::text::wrapped;
use stickslip::{FigureDocument, PanelDocument};

/// Smallest width of a column; with less, panels are placed below each other.
const NARROWEST: f64 = 240.0;
/// The same for maps, which have a bar beside them.
const NARROWEST_MAP: f64 = 340.0;
const TITLE_LINE: f64 = 1.4 * TITLE_SIZE;
/// Height of a panel over the width of the figure: for a single panel, for one of several, and for one with cells.
const ALONE: f64 = 0.6;
const SHARED: f64 = 0.3;
const CELLS: f64 = 0.69;
/// Limits of the height of a panel, in units.
const HEIGHTS: (f64, f64) = (230.0, 640.0);
/// Height over width for a map whose axes have no scale in common.
const MAP: f64 = 0.4;
/// Limits of the sides of axes with a common scale, in units; only a map longer than their ratio is stretched.
const AXES: (f64, f64) = (70.0, 600.0);

/// A panel with its columns: the first, and one past the last.
struct Placed<'a> {
    panel: Panel<'a>,
    columns: (usize, usize),
    height: f64,
}

/// A figure with the places of its panels.
pub(crate) struct Sheet<'a> {
    /// Width and height, in units.
    pub(crate) size: (f64, f64),
    title: Vec<String>,
    panels: Vec<Laid<'a>>,
}

/// A panel with its space, the left and right ends of its column's axes, and its own axes.
struct Laid<'a> {
    panel: Panel<'a>,
    space: Rect,
    between: (f64, f64),
    axes: Rect,
}

impl<'a> Sheet<'a> {
    /// The figure at this width, in units.
    pub(crate) fn of(figure: &'a FigureDocument, width: f64) -> Self {
        let asked = figure.columns.clamp(1, 12);
        let has_map = figure.panels.iter().any(|panel| panel.map.is_some());
        let narrowest = if has_map { NARROWEST_MAP } else { NARROWEST };
        let columns = if width < narrowest * asked as f64 { 1 } else { asked };
        let rows = rows(figure, columns, width);
        let title = wrapped(&figure.title, TITLE_SIZE, 0.94 * width);
        let head = if title.is_empty() { 0.0 } else { 8.0 + TITLE_LINE * title.len() as f64 };
        let column = width / columns as f64;
        let ends = |row: &Vec<Placed>| -> Vec<(f64, f64)> {
            row.iter().map(|placed| between(placed, &rows, column)).collect()
        };
        let ends: Vec<Vec<(f64, f64)>> = rows.iter().map(ends).collect();
        let (mut top, mut panels) = (head, vec![]);
        for (row, ends) in rows.into_iter().zip(ends) {
            // One height for all headings, so that panels side by side have axes of one size.
            let both = || row.iter().zip(&ends);
            let heading = both().map(|(p, ends)| p.panel.head(*ends)).fold(0.0, f64::max);
            let sizes: Vec<(f64, f64)> = both().map(|(p, ends)| axes(p, *ends, heading)).collect();
            let highest = sizes.iter().map(|size| size.1).fold(0.0, f64::max);
            let bottom = top + MARGIN_TOP + heading + highest + MARGIN_BOTTOM;
            for ((placed, (across, up)), between) in row.into_iter().zip(sizes).zip(ends) {
                let (left, right) =
                    (column * placed.columns.0 as f64, column * placed.columns.1 as f64);
                let space = Rect { left, right, top, bottom };
                let (left, top) = (between.0, top + MARGIN_TOP + heading);
                let axes = Rect { left, right: left + across, top, bottom: top + up };
                panels.push(Laid { panel: placed.panel, space, between, axes });
            }
            top = bottom;
        }
        Self { size: (width, top), title, panels }
    }

    /// The figure as a drawing, on white paper or without a ground.
    pub(crate) fn drawing(&self, has_ground: bool) -> Drawing {
        let mut drawing = Drawing::default();
        if has_ground {
            let (right, bottom) = self.size;
            drawing.rect(Rect { left: 0.0, top: 0.0, right, bottom }, Paint::fill(PAPER));
        }
        for (i, line) in self.title.iter().enumerate() {
            let (x, y) = (0.5 * self.size.0, 8.0 + TITLE_LINE * (i as f64 + 0.75));
            let (label, size, anchor) = (line.clone(), TITLE_SIZE, Anchor::Middle);
            drawing.text(Text { x, y, label, size, anchor, upright: false });
        }
        self.panels.iter().for_each(|p| p.panel.draw(p.space, p.between, p.axes, &mut drawing));
        drawing
    }

    /// The axes of each panel.
    #[cfg(feature = "animation")]
    pub(crate) fn frames(&self) -> Vec<Frame<'_>> {
        self.panels.iter().map(|laid| laid.panel.frame(laid.axes)).collect()
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

/// Height of a panel whose axes have no scale in common.
fn height(panel: &PanelDocument, width: f64, alone: bool) -> f64 {
    let part = match (&panel.map, &panel.cells) {
        (Some(_), _) => MAP,
        (_, Some(_)) => CELLS,
        _ if alone => ALONE,
        _ => SHARED,
    };
    (part * width + 24.0).clamp(HEIGHTS.0, HEIGHTS.1)
}

/// Width and height of the axes of a panel between the ends of its column, below a heading of this height: one scale
/// for x and y, if both are positions on the surface.
fn axes(placed: &Placed, (left, right): (f64, f64), heading: f64) -> (f64, f64) {
    let across = right - left;
    match placed.panel.aspect() {
        Some(aspect) => {
            let up = (aspect * across).clamp(AXES.0, AXES.1);
            (across.min(up / aspect).max(AXES.0), up)
        }
        None => {
            let least = (24.0 - heading).max(0.0);
            (across, (placed.height - 24.0 - MARGIN_TOP - MARGIN_BOTTOM + least).max(10.0))
        }
    }
}

/// Left and right ends of the axes of a panel: panels of one span have the same margins, hence axes of one width.
fn between(placed: &Placed, rows: &[Vec<Placed>], column: f64) -> (f64, f64) {
    let span = |p: &Placed| p.columns.1 - p.columns.0;
    let alike = || rows.iter().flatten().filter(|other| span(other) == span(placed));
    let left = alike().map(|p| p.panel.margin_left()).fold(0.0, f64::max);
    let right = alike().map(|p| p.panel.margin_right()).fold(0.0, f64::max);
    (column * placed.columns.0 as f64 + left, column * placed.columns.1 as f64 - right)
}
