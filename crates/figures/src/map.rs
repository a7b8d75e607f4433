//! Height maps: one colour for each height, and a colour bar.

use crate::axis::{Axis, Fit, extremes};
use crate::colours::at;
use crate::drawing::{Anchor, Drawing, Paint, Rect, Text, polygon};
use crate::picture::Picture;
use crate::style::{INK, LABEL_SIZE, TICK_SIZE};
use crate::text::width;
use stickslip::{ColoursName, MapDocument, ScaleName};

const BAR_GAP: f64 = 16.0;
const BAR: f64 = 18.0;
const BAR_STEPS: usize = 128;
/// Height of the triangle that marks values beyond an end of the bar.
const BEYOND: f64 = 11.0;

/// A map, its visible part, and its scale of heights.
pub(crate) struct Map<'a> {
    document: &'a MapDocument,
    /// First visible column and one past the last; first visible row and one past the last.
    columns: (usize, usize),
    rows: (usize, usize),
    scale: Axis,
    /// Whether there are values below the scale, and above it.
    clipped: (bool, bool),
}

impl<'a> Map<'a> {
    /// The cells with centres within the ranges.
    pub(crate) fn new(document: &'a MapDocument, x: Option<[f64; 2]>, y: Option<[f64; 2]>) -> Self {
        let columns = within(&document.x, x);
        let rows = within(&document.y, y);
        let heights = document.z.iter().flatten().copied();
        let scale = match (document.z_range, document.colours) {
            (Some([low, high]), _) => Axis::new(low, high, ScaleName::Linear, 5.0),
            (None, ColoursName::BlueRed) => {
                let most = heights.fold(0.0_f64, |most, z| most.max(z.abs()));
                Axis::fit([-most, most], FIT)
            }
            (None, _) => Axis::fit(heights, FIT),
        };
        let shown = document.z[rows.0..rows.1].iter().flat_map(|row| &row[columns.0..columns.1]);
        let (low, high) = extremes(shown.copied()).unwrap_or((scale.low, scale.high));
        let least = LEAST_CLIPPED * (scale.high - scale.low);
        let clipped = (low < scale.low - least, high > scale.high + least);
        Self { document, columns, rows, scale, clipped }
    }

    /// The edges of the visible part, half a cell beyond the first and the last centre.
    pub(crate) fn ranges(&self) -> ((f64, f64), (f64, f64)) {
        let of = |middles: &[f64], (from, to): (usize, usize)| {
            edges(middles.get(from..to).unwrap_or(&[]), middles)
        };
        (of(&self.document.x, self.columns), of(&self.document.y, self.rows))
    }

    /// Space to the right of the axes for the bar, its numbers and its label.
    pub(crate) fn margin_right(&self) -> f64 {
        let widest = self.scale.labelled().map(|(_, l)| width(l, TICK_SIZE)).fold(0.0, f64::max);
        BAR_GAP + BAR + 10.0 + widest + 1.9 * LABEL_SIZE
    }

    /// Draws the image, stretched over the axes.
    pub(crate) fn draw(&self, axes: Rect, drawing: &mut Drawing) {
        let ((from, to), (first, last)) = (self.columns, self.rows);
        let rows: Vec<&[f64]> =
            self.document.z[first..last].iter().map(|row| &row[from..to]).collect();
        let part = |z: f64| self.scale.part(z).unwrap_or(0.0);
        drawing.image(axes, Picture::of(&rows, |z| at(self.document.colours, part(z))));
    }

    /// Draws a triangle at each end of the bar beyond which there are values.
    fn draw_ends(&self, bar: Rect, drawing: &mut Drawing) {
        let middle = 0.5 * (bar.left + bar.right);
        let (below, above) = self.clipped;
        let ends = [(below, bar.bottom, BEYOND, 0.0), (above, bar.top, -BEYOND, 1.0)];
        for (_, y, height, part) in ends.into_iter().filter(|end| end.0) {
            let corners = [(bar.left, y), (middle, y + height), (bar.right, y)];
            let fill = Some(at(self.document.colours, part));
            drawing.path(polygon(&corners), Paint { fill, ..Paint::stroke(INK, 1.0) });
        }
    }

    /// Draws the bar and its numbers, to the right of the axes.
    pub(crate) fn draw_bar(&self, axes: Rect, drawing: &mut Drawing) {
        let left = axes.right + BAR_GAP;
        let bar = Rect { left, right: left + BAR, ..axes };
        let step = bar.height() / BAR_STEPS as f64;
        for i in 0..BAR_STEPS {
            let colour = at(self.document.colours, (i as f64 + 0.5) / BAR_STEPS as f64);
            let bottom = bar.bottom - step * i as f64;
            // The next one covers the excess: no seam is left.
            let top = (bottom - step - 0.5).max(bar.top);
            drawing.rect(Rect { top, bottom, ..bar }, Paint::fill(colour));
        }
        drawing.rect(bar, Paint::stroke(INK, 1.0));
        self.draw_ends(bar, drawing);
        let mut free = f64::INFINITY;
        for (value, label) in self.scale.labelled() {
            let y = bar.bottom - bar.height() * self.scale.part(value).unwrap_or(0.0);
            drawing.segment((bar.right, y), (bar.right + 5.0, y), Paint::stroke(INK, 1.0));
            // A number that would run into the one below is left out.
            if y > free {
                continue;
            }
            free = y - 1.2 * TICK_SIZE;
            let (x, y, size) = (bar.right + 9.0, y + 0.35 * TICK_SIZE, TICK_SIZE);
            let label = label.to_owned();
            drawing.text(Text { x, y, label, size, anchor: Anchor::Start, upright: false });
        }
        let x = axes.right + self.margin_right() - 0.4 * LABEL_SIZE;
        let y = 0.5 * (axes.top + axes.bottom);
        let (label, size, anchor) = (self.document.z_label.clone(), LABEL_SIZE, Anchor::Middle);
        drawing.text(Text { x, y, label, size, anchor, upright: true });
    }
}

/// Fraction of the scale by which values must exceed it to be marked.
const LEAST_CLIPPED: f64 = 1e-3;

const FIT: Fit = Fit { scale: ScaleName::Linear, padding: 0.0, natural: 0.0, ticks: 5.0 };

/// Indices of the first centre within the range and one past the last; all centres if none is within.
fn within(middles: &[f64], range: Option<[f64; 2]>) -> (usize, usize) {
    let all = (0, middles.len());
    let Some([low, high]) = range else { return all };
    let shows = |m: &f64| (low..=high).contains(m);
    match (middles.iter().position(shows), middles.iter().rposition(shows)) {
        (Some(first), Some(last)) => (first, last + 1),
        _ => all,
    }
}

/// Half a cell beyond the first and the last of `shown`; the size of a cell is computed from all centres.
fn edges(shown: &[f64], all: &[f64]) -> (f64, f64) {
    let (first, last) = extremes(shown.iter().copied()).unwrap_or((0.0, 0.0));
    let (low, high) = extremes(all.iter().copied()).unwrap_or((0.0, 0.0));
    let half = 0.5 * (high - low) / (all.len().max(2) - 1) as f64;
    let half = if half > 0.0 { half } else { 0.5 };
    (first - half, last + half)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(colours: ColoursName) -> MapDocument {
        let (x, y) = ((0..5).map(f64::from).collect(), vec![0.0, 1.0]);
        let z = vec![vec![-8.0, 0.0, 1.0, 2.0, 3.0], vec![0.0; 5]];
        MapDocument { x, y, z, z_label: "u".into(), colours, z_range: None }
    }

    #[test]
    fn zero_is_the_middle_of_a_scale_from_blue_to_red() {
        let document = map(ColoursName::BlueRed);
        let scale = Map::new(&document, None, None).scale;
        assert!((scale.low + 8.0).abs() < 1e-12 && (scale.high - 8.0).abs() < 1e-12);
    }

    #[test]
    fn a_range_cuts_the_map_to_whole_cells() {
        let document = map(ColoursName::Grey);
        let cut = Map::new(&document, Some([0.8, 3.2]), None);
        assert_eq!(cut.ranges(), ((0.5, 3.5), (-0.5, 1.5)));
        let outside = Map::new(&document, Some([70.0, 80.0]), None);
        assert_eq!(outside.ranges().0, (-0.5, 4.5));
    }
}
