//! Curves from the dense history of a motion, which include every peak in runs of any length.

use crate::error::FigureError;
use stickslip::{CurveDocument, StyleName};
use stickslip_tip::{Step, Trajectory};

/// Points per step, whose polynomials have degree 5 or less.
const PARTS: usize = 16;
/// Columns of a curve; more than the pixels of a page.
const COLUMNS: usize = 1200;
/// Largest number of columns of an envelope, and smallest number of oscillations per column.
const ENVELOPE: usize = 400;
const OSCILLATIONS: f64 = 1.5;

/// A quantity as a function of a step and a time in it.
pub(super) type Quantity<'a> = &'a dyn Fn(&Step, f64) -> f64;

/// Lowest and highest value in each column, in temporal order, with their times.
struct Columns {
    points: Vec<[(f64, f64); 2]>,
}

/// The part of a motion between two times.
pub(super) fn shown(
    motion: &str,
    [start, end]: [f64; 2],
    [from, to]: [f64; 2],
) -> Result<[f64; 2], FigureError> {
    let times = [from.max(start), to.min(end)];
    if times[0] < times[1] {
        return Ok(times);
    }
    Err(FigureError::Still(format!(
        "the {motion} lasts from t = {start} to {end}, and the times {from} to {to} are outside of it"
    )))
}

/// Duration of a path of this length at the mean velocity of a motion.
pub(super) fn duration(path: f64, (way, time): (f64, f64)) -> f64 {
    path / (way.abs() / time).max(1e-3)
}

/// A part of a trajectory.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part<'a> {
    steps: &'a [Step],
    /// First and last time.
    pub(super) span: (f64, f64),
}

impl<'a> Part<'a> {
    /// The part between these times; by default all.
    pub(super) fn of(trajectory: &'a Trajectory, range: Option<[f64; 2]>) -> Self {
        let (start, end) = (trajectory.start(), trajectory.end());
        let [from, to] = range.unwrap_or([start, end]);
        let (from, to) = (from.max(start), to.min(end));
        let (from, to) = if from < to { (from, to) } else { (start, end) };
        let steps = trajectory.steps();
        let first = steps.partition_point(|step| step.end() <= from);
        let last = steps.partition_point(|step| step.t < to);
        Self { steps: &steps[first..last.max(first + 1).min(steps.len())], span: (from, to) }
    }

    /// The last part of this length.
    pub(super) fn tail(&self, trajectory: &'a Trajectory, length: f64) -> Self {
        Self::of(trajectory, Some([(self.span.1 - length).max(self.span.0), self.span.1]))
    }

    /// Sample times, with the steps that contain them.
    fn samples(&self) -> impl Iterator<Item = (&'a Step, f64)> + use<'a> {
        let (from, to) = self.span;
        let within = move |step: &'a Step| {
            (0..PARTS).map(move |i| (step, step.t + step.h * i as f64 / PARTS as f64))
        };
        let last = self.steps.last().map(|step| (step, to.min(step.end())));
        let inner = self.steps.iter().flat_map(within).filter(move |(_, t)| *t > from && *t < to);
        let first = self.steps.first().map(|step| (step, from.max(step.t)));
        first.into_iter().chain(inner).chain(last)
    }

    /// Number of maxima of the quantity.
    pub(super) fn maxima(&self, of: Quantity) -> usize {
        let mut last = [f64::INFINITY; 2];
        let mut maxima = 0;
        for (step, t) in self.samples() {
            let value = of(step, t);
            maxima += usize::from(last[0] < last[1] && last[1] >= value);
            last = [last[1], value];
        }
        maxima
    }

    fn columns(&self, of: Quantity, count: usize) -> Columns {
        let (from, to) = self.span;
        let mut points: Vec<[(f64, f64); 2]> = vec![];
        let mut current = usize::MAX;
        for (step, t) in self.samples() {
            let value = of(step, t);
            let column = (((t - from) / (to - from) * count as f64) as usize).min(count - 1);
            match points.last_mut() {
                Some([low, high]) if column == current => {
                    if value < low.1 {
                        *low = (t, value);
                    }
                    if value > high.1 {
                        *high = (t, value);
                    }
                }
                _ => {
                    points.push([(t, value); 2]);
                    current = column;
                }
            }
        }
        Columns { points }
    }

    /// The quantity as a curve, reduced to the lowest and the highest value of each column if there are more samples.
    pub(super) fn line(&self, name: &str, of: Quantity) -> CurveDocument {
        let (x, y): (Vec<f64>, Vec<f64>) = if PARTS * self.steps.len() <= 2 * COLUMNS {
            self.samples().map(|(step, t)| (t, of(step, t))).unzip()
        } else {
            let columns = self.columns(of, COLUMNS).points;
            let ordered =
                columns.into_iter().flat_map(|[low, high]| match low.0.total_cmp(&high.0) {
                    std::cmp::Ordering::Less => vec![low, high],
                    std::cmp::Ordering::Equal => vec![low],
                    std::cmp::Ordering::Greater => vec![high, low],
                });
            ordered.unzip()
        };
        CurveDocument::new(StyleName::Line, name, &x, &y)
    }

    /// The quantity as a band between the lowest and the highest value of each column, for motions with too many
    /// oscillations to draw.
    pub(super) fn envelope(&self, name: &str, of: Quantity, oscillations: usize) -> CurveDocument {
        let count = ((oscillations as f64 / OSCILLATIONS) as usize).clamp(8, ENVELOPE);
        let columns = self.columns(of, count).points;
        let middle = |[low, high]: &[(f64, f64); 2]| 0.5 * (low.0 + high.0);
        let mut x: Vec<f64> = columns.iter().map(middle).collect();
        if let (Some(first), Some(last)) = (x.first().copied(), x.last().copied()) {
            // From end to end.
            let n = x.len() - 1;
            (x[0], x[n]) = (self.span.0.min(first), self.span.1.max(last));
        }
        let high: Vec<f64> = columns.iter().map(|c| c[1].1).collect();
        let low: Vec<f64> = columns.iter().map(|c| c[0].1).collect();
        CurveDocument::band(name, &x, &low, &high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_tip::STAGES;

    /// Steps of length 1 in which the tip is at rest, except a jump by 1 in step `slip`.
    fn trajectory(steps: usize, slip: usize) -> Trajectory {
        let mut x0 = 0.0;
        let step = |i: usize| {
            let mut displacement = [0.0; STAGES];
            let (nodes, _) = stickslip_tip::nodes_and_weights();
            if i == slip {
                // A smooth jump, 6 times as fast in its middle as its mean.
                displacement = nodes.map(|c: f64| c * c * (3.0 - 2.0 * c));
            }
            let (t, h, extension) = (i as f64, 1.0, i as f64 - x0);
            x0 += displacement[STAGES - 1];
            Step { t, h, extension, displacement, height: None }
        };
        Trajectory::new(1.0, (0..steps).map(step).collect())
    }

    #[test]
    fn a_slip_shorter_than_a_column_is_drawn_at_its_full_velocity() {
        let long = trajectory(100_000, 54_321);
        let part = Part::of(&long, None);
        let velocity = |step: &Step, t: f64| step.velocity(t);
        let highest =
            |curve: &CurveDocument| curve.y.iter().flatten().fold(0.0_f64, |m, v| m.max(*v));
        let line = part.line("", &velocity);
        assert!(line.x.len() <= 2 * COLUMNS + 2 && (highest(&line) - 1.5).abs() < 1e-2);
        assert!(line.x.is_sorted());
        let band = part.envelope("", &velocity, 10_000);
        assert!((highest(&band) - 1.5).abs() < 1e-2 && band.x.len() <= ENVELOPE + 1);
    }

    #[test]
    fn a_part_has_its_ends_and_its_own_detail() {
        let long = trajectory(1000, 500);
        let part = Part::of(&long, Some([499.5, 502.25]));
        let line = part.line("", &|step, t| step.velocity(t));
        assert!((line.x[0] - 499.5).abs() < 1e-12);
        assert!((line.x[line.x.len() - 1] - 502.25).abs() < 1e-12 && line.x.len() > 40);
        assert_eq!(Part::of(&long, Some([7e3, 8e3])).span, (0.0, 1000.0));
    }
}
