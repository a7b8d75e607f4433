//! Two runs side by side: where they differ most, and by how much they may.

use super::repeat::Witness;
use super::spread::{Spread, places};
use std::iter::Peekable;
use stickslip_surface::{Surface, SurfaceError};
use stickslip_tip::{InitialSurface, Model, RunError, Step, Support, Trajectory};

/// l and heights of order one are not known better than this, whatever the tolerance,
const ROUND_OFF: f64 = 1e-12;
/// a large l not to this part of itself,
const DIGITS: f64 = 8.0 * f64::EPSILON;
/// and a height not to this part of what was carved there.
const DIGITS_OF_SUM: f64 = 1e-13;
/// Sums by FFT leave this part of the deepest groove everywhere.
const DIGITS_OF_FFT: f64 = f64::EPSILON;

/// The largest difference of two runs; where differences are not allowed, the one that is least so.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// |difference|
    pub largest: f64,
    /// Time or position.
    pub at: f64,
    /// By the tolerance that was asked for.
    pub allowed: f64,
}

impl Difference {
    /// Whether it is no larger than allowed. NaN is larger.
    #[must_use]
    pub fn is_allowed(&self) -> bool {
        self.largest <= self.allowed
    }

    /// Whether it, rather than another, is to be reported.
    fn is_worse(&self, other: &Self) -> bool {
        if self.is_allowed() && other.is_allowed() {
            return self.largest >= other.largest;
        }
        // A NaN is worse than all.
        self.largest.is_nan() || self.largest / self.allowed >= other.largest / other.allowed
    }
}

/// What a run says of one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Time, in Γ/k.
    pub t: f64,
    /// l(t), in σ, or what else a motion is followed by ([`Step::followed`]).
    pub l: f64,
    /// x0(t), in σ.
    pub x0: f64,
}

/// Which samples were compared.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct ComparedSamples {
    /// How many.
    pub number: u64,
    /// The one whose difference is reported, from 0.
    pub worst: u64,
    /// How many differ by more than is allowed.
    pub wrong: u64,
    /// The first of these, from 0.
    pub first_wrong: Option<u64>,
}

/// What is found of l, time by time.
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

    /// Takes note of a difference; whether it is now the one to be reported.
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

/// Of a claimed l at t from the second run's.
fn difference_in_l(t: f64, claimed: f64, other: f64, allowed: f64) -> Difference {
    let allowed = allowed + ROUND_OFF + DIGITS * other.abs();
    Difference { largest: (claimed - other).abs(), at: t, allowed }
}

/// l over all of two runs.
pub(super) fn compare_l(
    trajectory: &Trajectory,
    reference: &Trajectory,
    allowed: f64,
) -> Judgement {
    let mut judgement = Judgement::new(reference.start(), allowed);
    let mut compare = |t: f64| {
        judgement.take(difference_in_l(t, trajectory.followed(t), reference.followed(t), allowed));
    };
    let end = trajectory.end().min(reference.end());
    for step in trajectory.steps().iter().chain(reference.steps()) {
        for part in [0.0, 0.25, 0.5, 0.75] {
            let t = step.t + part * step.h;
            if t <= end {
                compare(t);
            }
        }
    }
    compare(end);
    judgement
}

/// Compares samples with the second run as it passes them; neither is kept.
pub(super) struct AgainstSamples<F, I: Iterator> {
    support: Support,
    samples: F,
    start: f64,
    until: f64,
    allowed: f64,
    ahead: Option<Peekable<I>>,
    judgement: Judgement,
    found: ComparedSamples,
}

impl<I: Iterator<Item = Sample>, F: Fn() -> I> AgainstSamples<F, I> {
    pub(super) fn new(
        support: Support,
        samples: F,
        (start, until): (f64, f64),
        allowed: f64,
    ) -> Self {
        let judgement = Judgement::new(start, allowed);
        let found = ComparedSamples::default();
        Self { support, samples, start, until, allowed, ahead: None, judgement, found }
    }

    pub(super) fn finish(self) -> (Judgement, ComparedSamples) {
        (self.judgement, self.found)
    }

    fn compare(&mut self, step: &Step, is_due: impl Fn(f64) -> bool) {
        while let Some(sample) = self.ahead.as_mut().and_then(|a| a.next_if(|s| is_due(s.t))) {
            let (in_l, in_x0) = self.differences(&sample, step);
            let x0_is_wrong = !in_x0.is_allowed() && in_x0.is_worse(&in_l);
            let difference = if x0_is_wrong { in_x0 } else { in_l };
            if !difference.is_allowed() {
                self.found.wrong += 1;
                self.found.first_wrong.get_or_insert(self.found.number);
            }
            if self.judgement.take(difference) {
                self.found.worst = self.found.number;
            }
            self.found.number += 1;
        }
    }

    /// In l, and in x0 = rt - r - l, which is rounded more coarsely the farther the tip has come.
    fn differences(&self, sample: &Sample, step: &Step) -> (Difference, Difference) {
        let Sample { t, l, x0 } = *sample;
        let in_l = difference_in_l(t, l, step.followed(&self.support, t), self.allowed);
        let rounding = DIGITS * self.support.position(t).abs();
        let largest = (x0 - step.position(&self.support, t)).abs();
        (in_l, Difference { largest, at: t, allowed: in_l.allowed + rounding })
    }
}

impl<I: Iterator<Item = Sample>, F: Fn() -> I> Witness for AgainstSamples<F, I> {
    fn begin(&mut self) {
        self.ahead = Some((self.samples)().peekable());
        self.judgement = Judgement::new(self.start, self.allowed);
        self.found = ComparedSamples::default();
    }

    fn see(&mut self, step: &Step) -> Result<(), RunError> {
        self.compare(step, |t| t < step.end());
        Ok(())
    }

    fn end(&mut self, last: &Step) {
        let until = self.until;
        self.compare(last, |t| t <= until);
    }
}

/// Largest difference in the surface at the end, against what is allowed there.
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
