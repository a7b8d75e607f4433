//! Step-size control from error estimates, and the constants of the integrator.

use crate::collocation::{RADAU, STAGES};
use crate::elementary::{exp, ln};
use crate::state::{Damaged, Reader, State};

/// Largest error allowed within one step, as a fraction of the tolerance. The rest allows for the sum over steps and
/// for amplification by the motion; tests/science/tolerance_ladder.rs tests this choice.
const SHARE_OF_A_STEP: f64 = 0.05;

/// Largest accepted ratio of a displacement to the planned one.
pub(crate) const OVERSHOOT: f64 = 1.5;

/// Weight, in the error estimate, of the change of the defect from step to step: near a zero of the leading
/// derivative the defect alone is too small.
const WEIGHT_OF_CHANGE: f64 = 0.5;

/// Length of the first step, in units of Γ/k.
const FIRST_STEP: f64 = 0.01;
const SAFETY: f64 = 0.9;
const LARGEST_GROWTH: f64 = 2.5;
const LARGEST_SHRINKAGE: f64 = 0.2;

#[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "a small count")]
const ORDER_WITHIN_A_STEP: i32 = STAGES as i32 + 1;

#[derive(Debug, Clone)]
pub(crate) struct Control {
    tolerance: f64,
    next: f64,
    fixed: bool,
    just_rejected: bool,
    /// h times the defect, and h, for the last accepted step.
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

    /// Continues after steps of about this length by another method.
    pub(crate) fn resume(&mut self, h: f64) {
        (self.next, self.just_rejected, self.last) = (h, false, None);
    }

    pub(crate) fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Writes all data, except the tolerance, that determine the next lengths.
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

    /// The length of the next step: below `limit`, and either equal to `distance`, at which steps must end, or short
    /// enough for a second step of the same length.
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

    /// Accepts a step of length h or returns the length to try instead. There are two measures of its error. One is
    /// the defect of its stage polynomial at the start (its velocity minus the exact one), the other its error as an
    /// interpolant. `beside` is the error of any other quantity that the step determines.
    ///
    /// As long as the `stiffness` of the groove is small compared with 1/h, the error follows from the defect, δ
    /// N(τ)/N(0) with δ at the start and N(τ) = Π(τ - `c_i`). If the stiffness is large, the stages are exact but
    /// velocities are not, and the error of the stage polynomial is that of interpolation.
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
