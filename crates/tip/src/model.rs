//! The model: a tip function and the two numbers α and r that rule the motion.

use crate::TipFunction;
use thiserror::Error;

/// Footprint, indentation rate and support velocity, validated.
#[derive(Debug, Clone, PartialEq)]
pub struct Model {
    tip: TipFunction,
    alpha: f64,
    r: f64,
}

/// A parameter outside its range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum ModelError {
    /// α must be finite and ≥ 0.
    #[error(
        "the dimensionless indentation rate alpha (13) must be a finite number, 0 or above, not {0:?}"
    )]
    Alpha(f64),
    /// r must be finite and > 0.
    #[error("the dimensionless support velocity r (12) must be a finite number above 0, not {0:?}")]
    R(f64),
}

impl Model {
    /// # Errors
    /// `alpha` < 0, `r` ≤ 0, or either not finite.
    pub fn new(tip: TipFunction, alpha: f64, r: f64) -> Result<Self, ModelError> {
        if !(alpha.is_finite() && alpha >= 0.0) {
            return Err(ModelError::Alpha(alpha));
        }
        if !(r.is_finite() && r > 0.0) {
            return Err(ModelError::R(r));
        }
        Ok(Self { tip, alpha, r })
    }

    /// The footprint f.
    #[must_use]
    pub fn tip(&self) -> &TipFunction {
        &self.tip
    }

    /// Dimensionless indentation rate α (13).
    #[must_use]
    pub fn alpha(&self) -> f64 {
        self.alpha
    }

    /// Dimensionless support velocity r (12).
    #[must_use]
    pub fn r(&self) -> f64 {
        self.r
    }

    /// l0 = α f(0)/r, the value of l = rt - r - x0 in steady motion. (21) prints α/r, which holds
    /// where f(0) = 1.
    #[must_use]
    pub fn steady_l(&self) -> f64 {
        self.alpha * self.tip.value(0.0) / self.r
    }

    /// r + l0, the distance by which the tip lags behind the support in steady motion, (23).
    #[must_use]
    pub fn steady_lag(&self) -> f64 {
        self.r + self.steady_l()
    }

    /// Height that steady motion leaves far behind the tip, (25).
    #[must_use]
    pub fn steady_surface_behind(&self) -> f64 {
        // 0.0 - 0.0 is 0.0, where a minus sign would make it -0.0.
        0.0 - self.alpha / self.r * self.tip.integral()
    }
}
