//! Conversion of curves from data to paths and marks within the axes.

use crate::axis::{Axis, drawable};
use crate::drawing::{Drawing, Paint, Path, Rect, Step, polygon, polyline};
use crate::style::{BAND_OPACITY, Colour, Mark, PAPER, Pen, SHADE_OPACITY, Shape, colour};
use crate::thin::{Point, thin};
use stickslip::{ColourName, CurveDocument, StyleName};

/// Approximate largest number of points of all lines in a panel, so that a file with three panels stays below 300 kB
/// (about 14 bytes per point).
const POINTS: usize = 12_000;

/// Axes and their position on the canvas.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frame<'a> {
    pub(crate) x: &'a Axis,
    pub(crate) y: &'a Axis,
    pub(crate) at: Rect,
    /// Whether lines and marks have a light edge, which keeps them visible on any colour.
    pub(crate) haloed: bool,
}

impl Frame<'_> {
    /// The position of a value on the canvas, in units.
    pub(crate) fn place(&self, (x, y): Point) -> Option<Point> {
        let (x, y) = (self.x.part(x)?, self.y.part(y)?);
        Some((self.at.left + x * self.at.width(), self.at.bottom - y * self.at.height()))
    }

    /// Draws one of `of` curves.
    pub(crate) fn draw(&self, curve: &CurveDocument, of: usize, drawing: &mut Drawing) {
        let pen = Pen::of(curve.style, curve.colour);
        match pen.mark {
            Mark::Band => self.band(curve, pen, drawing),
            Mark::Line { width, dashes } => {
                if curve.style == StyleName::Boundary {
                    self.shade_above(curve, drawing);
                }
                let columns = (self.at.width() as usize).min(POINTS / (2 * of.max(1))).max(2);
                let across = (self.at.left, self.at.right);
                for stretch in self.stretches(&curve.x, &curve.y) {
                    let stretch = thin(stretch, across, columns);
                    if let [(x, y)] = stretch[..] {
                        // A line of a single point would not show.
                        drawing.path(shape((x, y), Shape::Disc, 3.0), Paint::fill(pen.colour));
                        continue;
                    }
                    let path = if curve.smooth { smooth(&stretch) } else { polyline(&stretch) };
                    if self.haloed {
                        drawing.path(path.clone(), Paint::stroke(PAPER, width + 3.0));
                    }
                    drawing.path(path, Paint { dashes, ..Paint::stroke(pen.colour, width) });
                }
            }
            Mark::Point { shape: of, radius, filled } => {
                let places =
                    curve.x.iter().zip(&curve.y).filter_map(|(x, y)| self.place((*x, (*y)?)));
                let inside = places.filter(|p| self.is_near(*p));
                let path = Path(inside.flat_map(|place| shape(place, of, radius).0).collect());
                if self.haloed {
                    drawing.path(path.clone(), Paint::stroke(PAPER, 4.6));
                }
                drawing.path(path, marked(pen.colour, filled));
            }
        }
    }

    /// Whether a mark at this position is visible.
    fn is_near(&self, (x, y): Point) -> bool {
        let Rect { left, top, right, bottom } = self.at;
        (left - 10.0..=right + 10.0).contains(&x) && (top - 10.0..=bottom + 10.0).contains(&y)
    }

    /// The curve on the canvas, divided at missing values, and clipped to the visible part.
    fn stretches(&self, x: &[f64], y: &[Option<f64>]) -> Vec<Vec<Point>> {
        let places: Vec<Option<Point>> =
            x.iter().zip(y).map(|(x, y)| self.place((*x, (*y)?))).collect();
        let in_reach =
            |p: &Option<Point>| p.is_some_and(|p| (self.at.left..=self.at.right).contains(&p.0));
        // Points beside the axes show only where they are joined to a point within.
        let shows = |i: usize| {
            let crosses = |j: usize| match (places[i], places.get(j).copied().flatten()) {
                (Some(a), Some(b)) => {
                    in_reach(&Some(b)) || (a.0 < self.at.left) != (b.0 < self.at.left)
                }
                _ => false,
            };
            in_reach(&places[i]) || crosses(i + 1) || (i > 0 && crosses(i - 1))
        };
        let shown: Vec<Option<Point>> =
            (0..places.len()).map(|i| places[i].filter(|_| shows(i))).collect();
        let stretches = shown.split(Option::is_none);
        stretches
            .map(|s| s.iter().flatten().copied().collect())
            .filter(|s: &Vec<_>| !s.is_empty())
            .collect()
    }

    /// Draws the area between a curve and the top of the axes.
    fn shade_above(&self, curve: &CurveDocument, drawing: &mut Drawing) {
        let across = (self.at.left, self.at.right);
        for stretch in self.stretches(&curve.x, &curve.y) {
            let mut area = thin(stretch, across, self.at.width() as usize);
            let (Some(first), Some(last)) = (area.first().copied(), area.last().copied()) else {
                continue;
            };
            area.extend([(last.0, self.at.top), (first.0, self.at.top)]);
            let paint = Paint::translucent(colour(ColourName::Vermillion), SHADE_OPACITY);
            drawing.path(polygon(&area), paint);
        }
    }

    /// Draws the area between two curves, with its edges.
    fn band(&self, curve: &CurveDocument, pen: Pen, drawing: &mut Drawing) {
        let none = vec![];
        let low = curve.low.as_ref().unwrap_or(&none);
        let (above, below) = (self.stretches(&curve.x, &curve.y), self.stretches(&curve.x, low));
        for (above, below) in above.iter().zip(&below) {
            let area: Vec<Point> = above.iter().chain(below.iter().rev()).copied().collect();
            drawing.path(polygon(&area), Paint::translucent(pen.colour, BAND_OPACITY));
            for edge in [above, below] {
                drawing.path(polyline(edge), Paint::stroke(pen.colour, 1.2));
            }
        }
    }
}

/// Whether a curve has no point to draw.
pub(crate) fn is_empty(curve: &CurveDocument) -> bool {
    !curve.x.iter().zip(&curve.y).any(|(x, y)| drawable(*x) && y.is_some_and(drawable))
}

/// Paint of a mark: filled, or an outline.
pub(crate) fn marked(colour: Colour, filled: bool) -> Paint {
    if filled { Paint::fill(colour) } else { Paint::stroke(colour, 1.6) }
}

/// The outline of a mark.
pub(crate) fn shape((x, y): Point, of: Shape, radius: f64) -> Path {
    let corners = |corners: &[Point]| {
        let places: Vec<Point> =
            corners.iter().map(|c| (x + radius * c.0, y + radius * c.1)).collect();
        polygon(&places)
    };
    match of {
        Shape::Disc => Path(vec![Step::Disc((x, y), radius)]),
        Shape::Triangle => corners(&[(0.0, -1.0), (0.866, 0.5), (-0.866, 0.5)]),
        Shape::Down => corners(&[(0.0, 1.0), (-0.7, -0.5), (0.7, -0.5)]),
        Shape::Square => corners(&[(-0.8, -0.8), (0.8, -0.8), (0.8, 0.8), (-0.8, 0.8)]),
        Shape::Diamond => corners(&[(0.0, -1.0), (1.0, 0.0), (0.0, 1.0), (-1.0, 0.0)]),
    }
}

/// A centripetal Catmull-Rom spline through the points, as Bézier arcs: no kinks, no loops.
fn smooth(points: &[Point]) -> Path {
    let mut distinct = points.to_vec();
    distinct.dedup_by(|a, b| (a.0 - b.0).hypot(a.1 - b.1) < 1e-3);
    if distinct.len() < 3 {
        return polyline(&distinct);
    }
    let at = |i: isize| distinct[i.clamp(0, distinct.len() as isize - 1) as usize];
    let mut path = polyline(&distinct[..1]);
    for i in 0..distinct.len() as isize - 1 {
        let [before, from, to, after] = [at(i - 1), at(i), at(i + 1), at(i + 2)];
        path.0.push(Step::Curve(handle(before, from, to), handle(after, to, from), to));
    }
    path
}

/// The Bézier handle at `here` toward `next`.
fn handle(before: Point, here: Point, next: Point) -> Point {
    let root = |a: Point, b: Point| (a.0 - b.0).hypot(a.1 - b.1).sqrt();
    let (d1, d2) = (root(before, here), root(here, next));
    if d1 < 1e-9 {
        return (here.0 + (next.0 - here.0) / 3.0, here.1 + (next.1 - here.1) / 3.0);
    }
    let blend = |before: f64, here: f64, next: f64| {
        (d1 * d1 * next - d2 * d2 * before + (2.0 * d1 * d1 + 3.0 * d1 * d2 + d2 * d2) * here)
            / (3.0 * d1 * (d1 + d2))
    };
    (blend(before.0, here.0, next.0), blend(before.1, here.1, next.1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip::ScaleName;

    fn axis(low: f64, high: f64) -> Axis {
        Axis::new(low, high, ScaleName::Linear, 5.0)
    }

    fn drawn(curve: &CurveDocument) -> String {
        let (x, y) = (axis(0.0, 10.0), axis(0.0, 1.0));
        let at = Rect { left: 0.0, top: 0.0, right: 100.0, bottom: 100.0 };
        let mut drawing = Drawing::default();
        Frame { x: &x, y: &y, at, haloed: false }.draw(curve, 1, &mut drawing);
        let size = ("100".into(), "100".into());
        crate::svg::document(&drawing, (100.0, 100.0), &size).unwrap()
    }

    #[test]
    fn a_spike_between_the_pixels_is_drawn() {
        let x: Vec<f64> = (0..100_000).map(|i| 1e-4 * f64::from(i)).collect();
        let mut y = vec![0.5; x.len()];
        y[33_333] = 0.875;
        let svg = drawn(&CurveDocument::new(StyleName::Line, "", &x, &y));
        assert!(svg.contains(" 12.5L") && svg.len() < 10_000, "{} bytes", svg.len());
    }

    #[test]
    fn a_curve_is_broken_where_it_has_no_value_and_cut_where_it_does_not_show() {
        let x = [-4.0, -3.0, 1.0, 2.0, 3.0, 4.0, 12.0, 13.0];
        let y = [0.1, 0.2, 0.3, f64::NAN, 0.5, 0.6, 0.7, 0.8];
        let svg = drawn(&CurveDocument::new(StyleName::Line, "", &x, &y));
        assert!(svg.contains("M-30 80L10 70\"") && svg.contains("M30 50L40 40L120 30\""), "{svg}");
    }

    #[test]
    fn a_smooth_line_passes_its_points_and_keeps_to_a_straight_one() {
        let path = smooth(&[(0.0, 0.0), (10.0, 10.0), (30.0, 30.0), (40.0, 40.0)]);
        assert!(path.0.len() == 4 && path.0[0] == Step::Move((0.0, 0.0)), "{path:?}");
        for (step, end) in path.0[1..].iter().zip([10.0, 30.0, 40.0]) {
            let Step::Curve(a, b, to) = *step else { panic!("{path:?}") };
            assert!([a, b, to].iter().all(|p| (p.0 - p.1).abs() < 1e-9), "{path:?}");
            assert_eq!(to, (end, end));
        }
    }
}
