//! Two runs side by side: where they differ most, and by how much they may.

use super::Claim;
use super::spread::{Spread, places};
use crate::{Surface, SurfaceError};
use stickslip_tip::{InitialSurface, Model, Run, Trajectory};

/// l and heights of order one are not known better than this, whatever the tolerance,
const ROUND_OFF: f64 = 1e-12;
/// a large l not to this part of itself,
const DIGITS: f64 = 8.0 * f64::EPSILON;
/// and a height not to this part of what was carved there.
const DIGITS_OF_SUM: f64 = 1e-13;

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

    /// The one of two that is to be reported.
    fn worse(self, other: Self) -> Self {
        let of_self = if self.is_allowed() && other.is_allowed() {
            self.largest >= other.largest
        } else {
            // A NaN is worse than all.
            self.largest.is_nan() || self.largest / self.allowed >= other.largest / other.allowed
        };
        if of_self { self } else { other }
    }
}

/// Largest difference in l, and the first time at which it is not allowed.
pub(super) fn compare_l(
    claim: Claim,
    reference: &Trajectory,
    allowed: f64,
) -> (Difference, Option<f64>) {
    let mut worst = Difference { largest: 0.0, at: reference.start(), allowed };
    let mut trusted_until = None;
    let mut compare = |t: f64, l: f64| {
        let other = reference.l(t);
        let difference = Difference {
            largest: (l - other).abs(),
            at: t,
            allowed: allowed + ROUND_OFF + DIGITS * other.abs(),
        };
        if !difference.is_allowed() && trusted_until.is_none_or(|earlier| t < earlier) {
            trusted_until = Some(t);
        }
        worst = worst.worse(difference);
    };
    match claim {
        Claim::Samples(samples, _) => samples.iter().for_each(|(t, l)| compare(*t, *l)),
        Claim::History(trajectory) => {
            let end = trajectory.end().min(reference.end());
            for step in trajectory.steps().iter().chain(reference.steps()) {
                for part in [0.0, 0.25, 0.5, 0.75] {
                    let t = step.t + part * step.h;
                    if t <= end {
                        compare(t, trajectory.l(t));
                    }
                }
            }
            compare(end, trajectory.l(end));
        }
    }
    (worst, trusted_until)
}

/// Largest difference in the surface at the end, against what is allowed there.
pub(super) fn compare_u(
    model: &Model,
    trajectory: &Trajectory,
    reference: &Run,
    allowed: f64,
) -> Result<Difference, SurfaceError> {
    let flat = InitialSurface::flat();
    let end = trajectory.end().min(reference.trajectory.end());
    let x = places(model, trajectory);
    let carved = |by: &Trajectory| Surface::new(model, &flat, by).heights(end, &x);
    let (one, other) = (carved(trajectory)?, carved(&reference.trajectory)?);
    let spread = Spread::of(model.tip(), trajectory, &x);
    let mut worst = Difference { largest: 0.0, at: x[0], allowed };
    for (i, at) in x.iter().enumerate() {
        let allowed =
            model.alpha() * (allowed * spread.slope[i] + DIGITS_OF_SUM * spread.height[i]);
        let difference = Difference {
            largest: (one[i] - other[i]).abs(),
            at: *at,
            allowed: allowed + ROUND_OFF,
        };
        worst = worst.worse(difference);
    }
    Ok(worst)
}
