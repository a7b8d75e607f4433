//! Step lengths from error estimates, and the constants that tune the integrator.

use crate::collocation::{RADAU, STAGES};
use crate::elementary::{exp, ln};
use crate::state::{Damaged, Reader, State};

/// The largest error allowed within one step, as a fraction of the tolerance. The rest is for what
/// steps add up to and for what the motion amplifies; tests/science/tolerance_ladder.rs holds the balance.
const SHARE_OF_A_STEP: f64 = 0.05;

/// A displacement larger than planned by this factor is still accepted.
pub(crate) const OVERSHOOT: f64 = 1.5;

/// Weight of the change of the defect from step to step in the error estimate: where the leading
/// derivative passes through zero, the defect alone says nothing.
const WEIGHT_OF_CHANGE: f64 = 0.5;

/// First step tried, in units of Γ/k.
const FIRST_STEP: f64 = 0.01;
const SAFETY: f64 = 0.9;
const LARGEST_GROWTH: f64 = 2.5;
const LARGEST_SHRINKAGE: f64 = 0.2;

#[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "a small count")]
const ORDER_WITHIN_A_STEP: i32 = STAGES as i32 + 1;

/// Chooses step lengths.
#[derive(Debug, Clone)]
pub(crate) struct Control {
    tolerance: f64,
    next: f64,
    fixed: bool,
    just_rejected: bool,
    /// h times the defect, and h, of the last accepted step.
    last: Option<(f64, f64)>,
}

impl Control {
    pub(crate) fn new(tolerance: f64) -> Self {
        Self { tolerance, next: FIRST_STEP, fixed: false, just_rejected: false, last: None }
    }

    pub(crate) fn fix(&mut self, h: f64) {
        (self.next, self.fixed) = (h, true);
    }

    pub(crate) fn is_fixed(&self) -> bool {
        self.fixed
    }

    /// Steps of about this length have been made otherwise.
    pub(crate) fn resume(&mut self, h: f64) {
        (self.next, self.just_rejected, self.last) = (h, false, None);
    }

    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// What the next lengths depend on, beside the tolerance.
    pub(crate) fn save(&self, state: &mut State) {
        state.number(self.next);
        state.flag(self.just_rejected);
        state.pairs(self.last.iter());
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        (self.next, self.just_rejected) = (state.finite()?, state.flag()?);
        self.last = state.pairs()?.pop();
        Ok(())
    }

    /// Largest error allowed within a step.
    pub(crate) fn target(&self) -> f64 {
        SHARE_OF_A_STEP * self.tolerance
    }

    /// The length to try next: below `limit`, and either reaching the end in `distance` or leaving
    /// room for a step of the same length before it.
    pub(crate) fn proposal(&self, limit: f64, distance: f64) -> f64 {
        let h = if self.fixed { self.next } else { self.next.min(limit) };
        if h >= distance * (1.0 - 1e-9) {
            distance
        } else if 2.0 * h > distance && !self.fixed {
            0.5 * distance
        } else {
            h
        }
    }

    /// Accepts a step of length h, or says what length to try instead, from two signs of its error: the
    /// defect with which its stage polynomial starts (its velocity less the true one), and its error as
    /// an interpolant; and from an error `beside` of anything else that a step determines.
    ///
    /// As long as the groove's `stiffness` is small against 1/h, the error follows from the defect, which
    /// is δ N(τ)/N(0), N vanishing at the nodes. Where it is large, the stages are exact, velocities are
    /// not, and the stage polynomial errs by interpolation.
    #[inline]
    pub(crate) fn judge(
        &mut self,
        (defect, interpolation): (f64, f64),
        h: f64,
        stiffness: f64,
        beside: f64,
    ) -> Result<(), f64> {
        if self.fixed {
            return Ok(());
        }
        let strayed = h * defect;
        let expected = |(last, h_last): (f64, f64)| last * (h / h_last).powi(ORDER_WITHIN_A_STEP);
        let change = self.last.map_or(0.0, |last| strayed - expected(last));
        let from_defect = strayed.abs() + WEIGHT_OF_CHANGE * change.abs();
        let soft = 1.0 / (1.0 + RADAU.defect_to_error * h * stiffness);
        let error = soft * RADAU.defect_to_error * from_defect + (1.0 - soft) * interpolation;
        // A NaN of either stays one.
        let error = if beside > error || beside.is_nan() { beside } else { error };
        let ratio = exp(ln(self.target() / error.max(1e-300)) / f64::from(ORDER_WITHIN_A_STEP));
        // An error that is NaN has the largest shrinkage: max and clamp would let it pass.
        let factor = if ratio.is_nan() { LARGEST_SHRINKAGE } else { SAFETY * ratio };
        let factor = factor.clamp(LARGEST_SHRINKAGE, LARGEST_GROWTH);
        if error.is_nan() || error > self.target() {
            self.just_rejected = true;
            return Err(h * factor.min(SAFETY));
        }
        // A step cut short by a knot or a break says nothing against the length that was planned.
        let planned = if h < self.next { self.next } else { 0.0 };
        self.next = if self.just_rejected { h * factor.min(1.0) } else { planned.max(h * factor) };
        self.just_rejected = false;
        self.last = Some((strayed, h));
        Ok(())
    }
}
