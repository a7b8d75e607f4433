//! Tolerances and step sizes.

use crate::GridError;

/// Local error allowed per step, in every unknown y: `atol` + `rtol` |y|, in the largest norm.
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
    #[must_use]
    pub fn ode45() -> Self {
        Self { rtol: 1e-3, atol: 1e-6, max_step: 0.04, first_step: 0.01 }
    }

    /// A constant absolute tolerance without a limit on the step.
    #[must_use]
    pub fn absolute(atol: f64) -> Self {
        Self { rtol: 0.0, atol, max_step: f64::INFINITY, first_step: 0.01 }
    }

    /// Steps of constant length without error control.
    #[must_use]
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
