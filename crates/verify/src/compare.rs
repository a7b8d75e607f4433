//! Comparison of two runs: largest differences, and their limits.

use std::iter::Peekable;
use stickslip_surface::{Surface, SurfaceError};
use stickslip_tip::{InitialSurface, Model, Step, Support, TipFunction, Trajectory};

/// Absolute error of l, and of heights of order one, that is allowed at any tolerance.
const ROUND_OFF: f64 = 1e-12;
/// Relative error of l that is allowed at any tolerance.
const DIGITS: f64 = 8.0 * f64::EPSILON;
/// Error of a height that is allowed at any tolerance, relative to the sum of all contributions to this height.
const DIGITS_OF_SUM: f64 = 1e-13;
/// Error of sums by FFT relative to the deepest groove, everywhere.
const DIGITS_OF_FFT: f64 = f64::EPSILON;

/// The largest difference, relative to its limit.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "LargestDifferenceDocument"))]
pub struct Difference {
    /// The difference: of l and y0 in σ, of u in kσ²/a.
    pub largest: f64,
    /// Place of the largest difference: time for l and y0, in Γ/k; position for u, in σ.
    pub at: f64,
    /// The limit at the place of the largest difference, in its unit.
    pub allowed: f64,
}

impl Difference {
    /// Whether the difference is within its limit; a NaN is not.
    pub fn is_allowed(&self) -> bool {
        self.largest <= self.allowed
    }

    /// Whether this difference, rather than the other, is to be reported.
    fn is_worse(&self, other: &Self) -> bool {
        if self.is_allowed() && other.is_allowed() {
            return self.largest >= other.largest;
        }
        // A NaN is worse than all.
        self.largest.is_nan() || self.largest / self.allowed >= other.largest / other.allowed
    }
}

/// Values of a run at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time, in Γ/k.
    pub t: f64,
    /// l(t), in σ, or the variable that replaces it for other models ([`Step::followed`]).
    pub l: f64,
    /// x0(t), in σ.
    pub x0: f64,
    /// y0(t), in σ, of a run in two coordinates.
    pub y0: Option<f64>,
}

/// Statistics of compared samples.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ComparedSamples {
    /// Number of samples.
    pub number: u64,
    /// Index of the sample with the reported difference, from 0.
    pub worst: u64,
    /// Number of samples with a difference beyond its limit.
    pub wrong: u64,
    /// Index of the first of these, from 0.
    pub first_wrong: Option<u64>,
}

/// Accumulated differences of l or y0.
#[derive(Debug, Clone, Copy)]
pub(super) struct Judgement {
    pub(super) worst: Difference,
    pub(super) trusted_until: Option<f64>,
}

impl Judgement {
    fn new(start: f64, allowed: f64) -> Self {
        let worst = Difference { largest: 0.0, at: start, allowed };
        Self { worst, trusted_until: None }
    }

    /// Adds a difference, and returns whether it is now the one to be reported.
    fn take(&mut self, difference: Difference) -> bool {
        let t = difference.at;
        if !difference.is_allowed() && self.trusted_until.is_none_or(|earlier| t < earlier) {
            self.trusted_until = Some(t);
        }
        let is_worst = !self.worst.is_worse(&difference);
        if is_worst {
            self.worst = difference;
        }
        is_worst
    }
}

/// Difference of a claimed l or y0 at t from that of the second run.
fn difference_at(t: f64, claimed: f64, other: f64, allowed: f64) -> Difference {
    let allowed = allowed + ROUND_OFF + DIGITS * other.abs();
    Difference { largest: (claimed - other).abs(), at: t, allowed }
}

/// Comparison of a variable over the whole of two runs, the second of which is the reference.
pub(super) fn compare<S: AsRef<Step>>(
    claimed: &Trajectory<S>,
    other: &Trajectory<S>,
    value: impl Fn(&Trajectory<S>, f64) -> f64,
    allowed: f64,
) -> Judgement {
    let (start, end) = (other.start(), claimed.end().min(other.end()));
    let mut judgement = Judgement::new(start, allowed);
    let mut take = |t: f64| {
        judgement.take(difference_at(t, value(claimed, t), value(other, t), allowed));
    };
    for step in claimed.steps().iter().chain(other.steps()).map(AsRef::as_ref) {
        for part in [0.0, 0.25, 0.5, 0.75] {
            let t = step.t + part * step.h;
            if t <= end {
                take(t);
            }
        }
    }
    take(end);
    judgement
}

/// Comparison of samples with the second run as it proceeds; neither is stored.
pub(super) struct AgainstSamples<I: Iterator> {
    support: Support,
    samples: Peekable<I>,
    allowed: f64,
    /// Judgements of l with x0, and of y0.
    pub(super) judgements: [Judgement; 2],
    pub(super) found: ComparedSamples,
}

impl<I: Iterator<Item = Sample>> AgainstSamples<I> {
    pub(super) fn new(support: Support, samples: I, start: f64, allowed: f64) -> Self {
        let judgements = [Judgement::new(start, allowed); 2];
        let found = ComparedSamples::default();
        Self { support, samples: samples.peekable(), allowed, judgements, found }
    }

    /// Compares the samples before a time with a step. y0 is `None` in one coordinate.
    pub(super) fn see(&mut self, step: &Step, y0: impl Fn(f64) -> Option<f64>, before: f64) {
        while let Some(sample) = self.samples.next_if(|sample| sample.t < before) {
            let (in_l, in_x0) = self.differences(&sample, step);
            let x0_is_wrong = !in_x0.is_allowed() && in_x0.is_worse(&in_l);
            let difference = if x0_is_wrong { in_x0 } else { in_l };
            // A missing y0 is as wrong as a NaN.
            let in_y = y0(sample.t).map(|y0| {
                let claimed = sample.y0.unwrap_or(f64::NAN);
                difference_at(sample.t, claimed, y0, self.allowed)
            });
            if !(difference.is_allowed() && in_y.is_none_or(|in_y| in_y.is_allowed())) {
                self.found.wrong += 1;
                self.found.first_wrong.get_or_insert(self.found.number);
            }
            let [along, across] = &mut self.judgements;
            let is_worst = along.take(difference);
            let is_worst_across = in_y.is_some_and(|in_y| across.take(in_y));
            // Of two coordinates the line is that of the worse.
            let across_is_worse = in_y.is_some() && across.worst.is_worse(&along.worst);
            let is_reported = if across_is_worse { is_worst_across } else { is_worst };
            if is_reported {
                self.found.worst = self.found.number;
            }
            self.found.number += 1;
        }
    }

    /// Differences in l, and in x0 = rt - r - l, whose round-off grows with the distance of the tip.
    fn differences(&self, sample: &Sample, step: &Step) -> (Difference, Difference) {
        let Sample { t, l, x0, .. } = *sample;
        let in_l = difference_at(t, l, step.followed(&self.support, t), self.allowed);
        let rounding = DIGITS * self.support.position(t).abs();
        let largest = (x0 - step.position(&self.support, t)).abs();
        (in_l, Difference { largest, at: t, allowed: in_l.allowed + rounding })
    }
}

/// Largest difference of the final surfaces, relative to its limit.
pub(super) fn compare_u(
    model: &Model,
    trajectory: &Trajectory,
    reference: &Trajectory,
    allowed: f64,
) -> Result<Difference, SurfaceError> {
    let flat = InitialSurface::flat();
    let end = trajectory.end().min(reference.end());
    let x = places(model, trajectory);
    let carved = |by: &Trajectory| Surface::new(model, &flat, by).heights(end, &x);
    let (one, other) = (carved(trajectory)?, carved(reference)?);
    let spread = Spread::of(model.tip(), trajectory, &x);
    let everywhere = DIGITS_OF_FFT * spread.height.iter().fold(0.0, |most, u| u.max(most));
    let mut worst = Difference { largest: 0.0, at: x[0], allowed };
    for (i, at) in x.iter().enumerate() {
        let sum = DIGITS_OF_SUM * spread.height[i] + everywhere;
        let allowed = model.alpha() * (allowed * spread.slope[i] + sum);
        let difference = Difference {
            largest: (one[i] - other[i]).abs(),
            at: *at,
            allowed: allowed + ROUND_OFF,
        };
        if !worst.is_worse(&difference) {
            worst = difference;
        }
    }
    Ok(worst)
}

/// At each x: ∫|f(x - x0(t'))|dt' and ∫|f'(x - x0(t'))|dt' over a run.
struct Spread {
    height: Vec<f64>,
    slope: Vec<f64>,
}

/// Number of positions over the tip's whole path, and over its end.
const PLACES: usize = 2000;
/// Length of the end of the path, in reaches of the footprint (in widths, if it does not decay).
const REACHES: f64 = 10.0;
const WIDTHS: f64 = 100.0;

/// Positions at which two surfaces are compared, in order.
fn places(model: &Model, trajectory: &Trajectory) -> Vec<f64> {
    let margin = model.tip().reach().unwrap_or(WIDTHS);
    let ends = [trajectory.x0(trajectory.start()), trajectory.x0(trajectory.end())];
    let (low, high) = (ends[0].min(ends[1]) - margin, ends[0].max(ends[1]) + margin);
    let here = (ends[1] - REACHES * margin).max(low);
    let evenly = |low: f64, high: f64| {
        (0..PLACES).map(move |i| low + (high - low) * i as f64 / (PLACES - 1) as f64)
    };
    let mut x: Vec<f64> = evenly(low, high).chain(evenly(here, ends[1] + margin)).collect();
    x.sort_by(f64::total_cmp);
    x
}

impl Spread {
    /// The integrals of a run, at positions in order.
    fn of(tip: &TipFunction, trajectory: &Trajectory, x: &[f64]) -> Self {
        let reach = tip.reach().unwrap_or(f64::INFINITY);
        let mut spread = Self { height: vec![0.0; x.len()], slope: vec![0.0; x.len()] };
        let (positions, weights) = trajectory.residence(trajectory.end());
        for (position, weight) in positions.into_iter().zip(weights) {
            let first = x.partition_point(|x| *x < position - reach);
            for (i, x) in
                x.iter().enumerate().skip(first).take_while(|(_, x)| **x <= position + reach)
            {
                spread.height[i] += weight * tip.value(x - position).abs();
                spread.slope[i] += weight * tip.slope(x - position).abs();
            }
        }
        spread
    }
}
