//! A panel: one set of axes with its content.

use crate::axis::{Axis, Fit};
use crate::cells;
use crate::curve::{Frame, shape};
use crate::drawing::{Anchor, Drawing, Paint, Rect, Text};
use crate::legend::Legend;
use crate::map::Map;
use crate::style::{GRID, INK, LABEL_SIZE, PAPER, Pen, SHADE_OPACITY, Shape, TICK_SIZE, colour};
use crate::text::{width, wrapped};
use stickslip::{ArrowName, ColourName, PanelDocument};

/// Least space to the right of the axes.
const MARGIN_RIGHT: f64 = 28.0;
/// Space above the axes without a legend.
pub(crate) const MARGIN_TOP: f64 = 16.0;
/// Space below the axes, for tick labels and axis label.
pub(crate) const MARGIN_BOTTOM: f64 = 54.0;
const HEADING_LINE: f64 = 1.5 * LABEL_SIZE;
/// Approximate distance of the ticks, horizontal and vertical.
const TICK_DISTANCE: (f64, f64) = (95.0, 52.0);

/// A panel with axes fitted to its content.
pub(crate) struct Panel<'a> {
    pub(crate) document: &'a PanelDocument,
    x: Axis,
    y: Axis,
    map: Option<Map<'a>>,
}

impl<'a> Panel<'a> {
    /// A panel with axes of about this width and height.
    pub(crate) fn new(document: &'a PanelDocument, (width, height): (f64, f64)) -> Self {
        let map =
            document.map.as_ref().map(|map| Map::new(map, document.x_range, document.y_range));
        let (many_x, many_y) =
            ((width / TICK_DISTANCE.0).max(2.0), (height / TICK_DISTANCE.1).max(2.0));
        let of = |[low, high]: [f64; 2], scale, ticks| Axis::new(low, high, scale, ticks);
        let (x_scale, y_scale) = (document.x_scale, document.y_scale);
        if let Some(((left, right), (bottom, top))) = map.as_ref().map(Map::ranges) {
            let (x, y) = (of([left, right], x_scale, many_x), of([bottom, top], y_scale, many_y));
            return Self { document, x, y, map };
        }
        let x = document.x_range.map(|range| of(range, x_scale, many_x));
        let x = x.unwrap_or_else(|| abscissas(document, many_x));
        let y = document.y_range.map(|range| of(range, y_scale, many_y));
        let y = y.unwrap_or_else(|| ordinates(document, &x, many_y));
        Self { document, x, y, map }
    }

    /// Space for tick labels and axis label on the left.
    pub(crate) fn margin_left(&self) -> f64 {
        let widest = self.y.labelled().map(|(_, l)| width(l, TICK_SIZE)).fold(0.0, f64::max);
        widest + 16.0 + 1.7 * LABEL_SIZE
    }

    /// Space to the right of the axes, for half of the last tick label at least.
    pub(crate) fn margin_right(&self) -> f64 {
        let last = self.x.labelled().last().map_or(0.0, |(_, label)| width(label, TICK_SIZE));
        self.map.as_ref().map_or(MARGIN_RIGHT, Map::margin_right).max(0.5 * last + 2.0)
    }

    /// Height of heading and legend, with axes between `left` and `right`.
    pub(crate) fn head(&self, (left, right): (f64, f64)) -> f64 {
        let lines = self.heading(right - left).len() as f64;
        HEADING_LINE * lines + Legend::of(self.document, right - left).height()
    }

    /// Height over width of the axes, if one scale serves both: they are positions on the surface, in one unit.
    pub(crate) fn aspect(&self) -> Option<f64> {
        let parts = |label: &'a str| label.strip_suffix(')')?.rsplit_once(" (");
        let (x, y) = (parts(&self.document.x_label)?, parts(&self.document.y_label)?);
        let is_surface = matches!((x.0, y.0), ("x" | "support at x", "y") | ("x₀", "y₀"));
        let aspect = (self.y.high - self.y.low) / (self.x.high - self.x.low);
        (is_surface && x.1 == y.1 && aspect.is_finite() && aspect > 0.0).then_some(aspect)
    }

    /// The axes of the panel at this place.
    pub(crate) fn frame(&self, at: Rect) -> Frame<'_> {
        Frame { x: &self.x, y: &self.y, at, haloed: self.document.cells.is_some() }
    }

    /// Draws the panel within `space`, its heading between `left` and `right`, above its axes.
    pub(crate) fn draw(
        &self,
        space: Rect,
        (left, right): (f64, f64),
        at: Rect,
        drawing: &mut Drawing,
    ) {
        let legend = Legend::of(self.document, right - left);
        let heading = self.heading(right - left);
        let legend_top = at.top - legend.height();
        let heading_top = legend_top - HEADING_LINE * heading.len() as f64;
        let frame = self.frame(at);
        if let Some(map) = &self.map {
            map.draw(at, drawing);
        }
        self.ground(frame, drawing);
        drawing.clip(at);
        if let Some(cells) = &self.document.cells {
            cells::draw(cells, frame, drawing);
        }
        let is_line = |style| Pen::of(style, None).is_line();
        let lines = self.document.curves.iter().filter(|c| is_line(c.style)).count();
        for curve in &self.document.curves {
            frame.draw(curve, lines, drawing);
        }
        drawing.unclip();
        self.notes(frame, drawing);
        drawing.rect(at, Paint::stroke(INK, 1.2));
        self.ticks(frame, drawing);
        self.labels(space, at, drawing);
        for (i, label) in heading.into_iter().enumerate() {
            let (x, size, anchor) = (left, LABEL_SIZE, Anchor::Start);
            let y = heading_top + HEADING_LINE * i as f64 + 0.65 * size;
            drawing.text(Text { x, y, label, size, anchor, upright: false });
        }
        legend.draw(left, legend_top, drawing);
        if let Some(map) = &self.map {
            map.draw_bar(at, drawing);
        }
    }

    /// Draws shaded intervals and grid lines.
    fn ground(&self, frame: Frame, drawing: &mut Drawing) {
        let at = frame.at;
        for [from, to] in &self.document.shades {
            let place = |x: f64| {
                let part = self.x.part(x).unwrap_or(0.0);
                at.left + part.clamp(0.0, 1.0) * at.width()
            };
            let at = Rect { left: place(*from), right: place(*to), ..at };
            drawing.rect(at, Paint::translucent(colour(ColourName::Vermillion), SHADE_OPACITY));
        }
        if self.map.is_some() || self.document.cells.is_some() {
            return;
        }
        let grid = Paint::stroke(GRID, 1.0);
        for x in self.x.labelled().filter_map(|(x, _)| self.x_of(x, at)) {
            drawing.segment((x, at.top), (x, at.bottom), grid);
        }
        for y in self.y.labelled().filter_map(|(y, _)| self.y_of(y, at)) {
            drawing.segment((at.left, y), (at.right, y), grid);
        }
    }

    fn x_of(&self, value: f64, at: Rect) -> Option<f64> {
        Some(at.left + self.x.part(value)? * at.width())
    }

    fn y_of(&self, value: f64, at: Rect) -> Option<f64> {
        Some(at.bottom - self.y.part(value)? * at.height())
    }

    /// Draws the ticks outwards, minor ones shorter, and their labels.
    fn ticks(&self, frame: Frame, drawing: &mut Drawing) {
        let (at, ink, size) = (frame.at, Paint::stroke(INK, 1.0), TICK_SIZE);
        let length = |label: &Option<String>| if label.is_some() { 5.0 } else { 3.0 };
        let mut free = f64::NEG_INFINITY;
        for tick in &self.x.ticks {
            let Some(x) = self.x_of(tick.value, at) else { continue };
            drawing.segment((x, at.bottom), (x, at.bottom + length(&tick.label)), ink);
            // A number that would run into the one before is left out.
            let half = tick.label.as_ref().map_or(0.0, |label| 0.5 * width(label, size));
            if let Some(label) = tick.label.clone().filter(|_| x - half >= free) {
                free = x + half + 0.3 * size;
                let y = at.bottom + 8.0 + 0.9 * size;
                drawing.text(Text { x, y, label, size, anchor: Anchor::Middle, upright: false });
            }
        }
        let mut free = f64::INFINITY;
        for tick in &self.y.ticks {
            let Some(y) = self.y_of(tick.value, at) else { continue };
            drawing.segment((at.left - length(&tick.label), y), (at.left, y), ink);
            if let Some(label) = tick.label.clone().filter(|_| y <= free) {
                free = y - 1.2 * size;
                let (x, y) = (at.left - 8.0, y + 0.36 * size);
                drawing.text(Text { x, y, label, size, anchor: Anchor::End, upright: false });
            }
        }
    }

    /// Draws the labels of the axes.
    fn labels(&self, space: Rect, at: Rect, drawing: &mut Drawing) {
        let (size, middle) = (LABEL_SIZE, Anchor::Middle);
        let (across, upward) = (0.5 * (at.left + at.right), 0.5 * (at.top + at.bottom));
        let (x, y, label) = (across, at.bottom + 46.0, self.document.x_label.clone());
        drawing.text(Text { x, y, label, size, anchor: middle, upright: false });
        // At the margin, hence at the same place in panels below each other.
        let (x, y, label) = (space.left + 1.2 * size, upward, self.document.y_label.clone());
        drawing.text(Text { x, y, label, size, anchor: middle, upright: true });
    }

    /// The heading, broken into lines as wide as the axes.
    fn heading(&self, width: f64) -> Vec<String> {
        wrapped(&self.document.heading, LABEL_SIZE, width)
    }

    fn notes(&self, frame: Frame, drawing: &mut Drawing) {
        let size = LABEL_SIZE;
        for note in &self.document.notes {
            let Some((x, y)) = frame.place((note.x, note.y)) else { continue };
            // Within the axes, whole; beside an arrow, on a ground that separates it from the curves.
            let half = 0.5 * width(&note.text, size) + 6.0;
            let (from, to) = (frame.at.left + half, frame.at.right - half);
            let wanted = if note.arrow.is_some() { x - half - 10.0 } else { x };
            let shown = if from < to { wanted.clamp(from, to) } else { x };
            if note.arrow.is_some() || self.document.cells.is_some() {
                let (left, right) = (shown - half, shown + half);
                let ground = Rect { left, right, top: y - 0.7 * size, bottom: y + 0.7 * size };
                drawing.rect(ground, Paint::translucent(PAPER, 0.8));
            }
            let (label, anchor, upright) = (note.text.clone(), Anchor::Middle, false);
            drawing.text(Text { x: shown, y: y + 0.35 * size, label, size, anchor, upright });
            let (edge, of) = match note.arrow {
                Some(ArrowName::Down) => (frame.at.bottom - 9.0, Shape::Down),
                Some(ArrowName::Up) => (frame.at.top + 9.0, Shape::Triangle),
                None => continue,
            };
            drawing.path(shape((x, edge), of, 7.0), Paint::fill(INK));
        }
    }
}

/// Whether marks are drawn, which must not be cut at the ends.
fn has_marks(document: &PanelDocument) -> bool {
    document.curves.iter().any(|c| !Pen::of(c.style, None).is_line())
}

/// The horizontal axis: without padding unless marks are drawn or a curve turns back.
fn abscissas(document: &PanelDocument, ticks: f64) -> Axis {
    let winding = document.curves.iter().any(|c| !c.x.is_sorted());
    let padding = match (winding, has_marks(document)) {
        (true, _) => 0.06,
        (_, true) => 0.03,
        _ => 0.0,
    };
    let curves = document.curves.iter().flat_map(|c| c.x.iter().copied());
    let of_cells = document.cells.iter().flat_map(|cells| cells.x.iter().copied());
    let scale = document.x_scale;
    Axis::fit(curves.chain(of_cells), Fit { scale, padding, natural: 0.0, ticks })
}

/// The vertical axis: with padding above and below the values within the horizontal range.
fn ordinates(document: &PanelDocument, x: &Axis, ticks: f64) -> Axis {
    let shown = |c: &'_ f64| (x.low..=x.high).contains(c);
    let of_cells = document.cells.iter().flat_map(|cells| cells.y.iter().copied());
    let curves = document.curves.iter().flat_map(|c| {
        let low = c.low.iter().flat_map(|low| c.x.iter().zip(low));
        let points = c.x.iter().zip(&c.y).chain(low);
        points.filter(|(x, _)| shown(x)).filter_map(|(_, y)| *y)
    });
    let padding = if document.cells.is_some() { 0.0 } else { 0.06 };
    let (scale, natural) = (document.y_scale, document.natural.unwrap_or(0.0));
    Axis::fit(curves.chain(of_cells), Fit { scale, padding, natural, ticks })
}
