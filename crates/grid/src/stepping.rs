//! Tolerances and step sizes, and their control.

use crate::GridError;

/// Local error allowed per step: `atol` + `rtol` |y| in every unknown y.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepping {
    /// Relative part. It also applies to x0, which grows indefinitely.
    pub rtol: f64,
    /// Absolute part.
    pub atol: f64,
    /// Longest step.
    pub max_step: f64,
    /// The first step tried.
    pub first_step: f64,
}

impl Stepping {
    /// ode45 with its defaults, 1e-3 and 1e-6, and the paper's Δt ≈ 0.04 as the longest step.
    pub fn ode45() -> Self {
        Self { rtol: 1e-3, atol: 1e-6, max_step: 0.04, first_step: 0.01 }
    }

    /// A constant absolute tolerance without a limit on the step.
    pub fn absolute(atol: f64) -> Self {
        Self { rtol: 0.0, atol, max_step: f64::INFINITY, first_step: 0.01 }
    }

    /// Steps of constant length without error control.
    pub fn fixed(step: f64) -> Self {
        Self { rtol: 0.0, atol: f64::INFINITY, max_step: step, first_step: step }
    }

    /// The error allowed if the unknown changes from `before` to `after`.
    pub(crate) fn allowed(&self, before: f64, after: f64) -> f64 {
        self.atol + self.rtol * before.abs().max(after.abs())
    }

    pub(crate) fn check(&self) -> Result<(), GridError> {
        let tolerances = self.rtol >= 0.0 && self.atol >= 0.0 && self.rtol + self.atol > 0.0;
        if tolerances && self.max_step > 0.0 && self.first_step > 0.0 {
            Ok(())
        } else {
            Err(GridError::Stepping)
        }
    }
}

/// Hairer, Nørsett and Wanner's elementary controller: after a step of error e, where 1 is allowed, the next step is
/// 0.9 e^{-1/p} times as long. This factor is limited to the range from 1/5 to 10, and to 1 after a rejection.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Control {
    /// p
    order: i32,
    max_step: f64,
    rejected: bool,
    /// The step to try next.
    pub(crate) step: f64,
}

impl Control {
    pub(crate) fn new(order: i32, stepping: &Stepping) -> Self {
        let step = stepping.first_step.min(stepping.max_step);
        Self { order, max_step: stepping.max_step, rejected: false, step }
    }

    /// Whether a step of length `tried`, possibly shortened to end at a requested time, is accepted. The error may be
    /// infinite but not NaN.
    pub(crate) fn judge(&mut self, tried: f64, error: f64) -> bool {
        let mut factor = (0.9 * error.powf(-1.0 / f64::from(self.order))).clamp(0.2, 10.0);
        let accepted = error <= 1.0;
        if accepted && self.rejected {
            factor = factor.min(1.0);
        }
        self.rejected = !accepted;
        let cut_short = tried < self.step;
        let proposed = (tried * factor).min(self.max_step);
        self.step = if accepted && cut_short { self.step.max(proposed) } else { proposed };
        accepted
    }
}

/// Whether `t` equals `target` up to round-off.
pub(crate) fn reached(t: f64, target: f64) -> bool {
    target - t <= 4.0 * f64::EPSILON * target.abs()
}

/// The step to take from `t`: `proposed`, or less to end exactly at `target`, also if the rest would only be
/// round-off.
pub(crate) fn towards(target: f64, t: f64, proposed: f64) -> f64 {
    if target - t <= proposed * (1.0 + 1e-9) { target - t } else { proposed }
}

/// Whether a step is lost in the round-off of t.
pub(crate) fn too_small(step: f64, t: f64) -> bool {
    step <= 4.0 * f64::EPSILON * t.abs().max(1e-3)
}

/// The error e5²/√(e5² + 0.01 e3²) of Hairer, Nørsett and Wanner from two estimates; e5 if there is no second one.
pub(crate) fn blend(fifth: f64, third: f64) -> f64 {
    if third > 0.0 { fifth * fifth / fifth.hypot(0.1 * third) } else { fifth }
}
