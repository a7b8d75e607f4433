//! The extended model: a depth limit, healing and inertia in addition to (10), (11); optionally without the spring.
//!
//! ```text
//!     M x0'' + x0' = -u_x(x0,t) + κ (R(t) - x0) + Fext(t)
//!     u_t(x,t) = -α w(t) f(x - x0(t)) - u(x,t)/T
//!     w(t) = exp(-|h(t)|/b),   h = u(x0,t)                        (61)
//! ```
//!
//! According to the paper no closed equation exists for (61). There is one: the height h under the tip is a further
//! integral over the past of the tip, with a weight w for each position. So the history remains a groove.

use crate::elementary::exp;
use thiserror::Error;

/// The parameters b, T, M and κ. The default is the basic model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wider {
    /// Depth limit b of (61), in kσ²/a, the unit of heights: the indentation rate falls as e^{-|h|/b}.
    pub depth_limit: Option<f64>,
    /// Relaxation time T of the surface, in Γ/k: indentations decay as e^{-t/T}.
    pub healing_time: Option<f64>,
    /// Inertia M, in Γ²/k.
    pub inertia: Option<f64>,
    /// Whether there is a spring: κ = 1 with a spring, 0 without.
    pub spring: bool,
}

/// A parameter of the extended model is out of range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum WiderError {
    /// b must be from 1e-100 to 1e100.
    #[error(
        "the depth limit b (61) must be above 0, from {min:e} to {max:e}, not {0:?}; leave it out for none",
        min = RANGE.0, max = RANGE.1
    )]
    DepthLimit(f64),
    /// T must be from 1e-100 to 1e100.
    #[error(
        "the healing time must be above 0, from {min:e} to {max:e}, not {0:?}; leave it out for none",
        min = RANGE.0, max = RANGE.1
    )]
    HealingTime(f64),
    /// M must be from 1e-100 to 1e100.
    #[error(
        "the inertia must be above 0, from {min:e} to {max:e}, not {0:?}; leave it out for none",
        min = RANGE.0, max = RANGE.1
    )]
    Inertia(f64),
}

impl WiderError {
    /// The name of the parameter, and its value.
    #[must_use]
    pub fn parameter(self) -> (&'static str, f64) {
        match self {
            Self::DepthLimit(b) => ("depth_limit", b),
            Self::HealingTime(time) => ("healing_time", time),
            Self::Inertia(mass) => ("inertia", mass),
        }
    }
}

impl Default for Wider {
    fn default() -> Self {
        Self { depth_limit: None, healing_time: None, inertia: None, spring: true }
    }
}

/// Range of the parameters; products of a few of them are finite.
const RANGE: (f64, f64) = (1e-100, 1e100);

impl Wider {
    /// Checks the range of each parameter.
    ///
    /// # Errors
    /// A parameter is not from 1e-100 to 1e100.
    pub fn validate(&self) -> Result<(), WiderError> {
        let bad = |value: &f64| !(RANGE.0..=RANGE.1).contains(value);
        if let Some(b) = self.depth_limit.filter(bad) {
            return Err(WiderError::DepthLimit(b));
        }
        if let Some(time) = self.healing_time.filter(bad) {
            return Err(WiderError::HealingTime(time));
        }
        if let Some(mass) = self.inertia.filter(bad) {
            return Err(WiderError::Inertia(mass));
        }
        Ok(())
    }

    /// Whether the tip is resonant, M > 1/2: after a slip its spring alone swings it back.
    pub fn swings_back(&self) -> bool {
        self.inertia.is_some_and(|mass| mass > 0.5)
    }

    /// Whether the model allows permanent trapping: not with a depth limit, which slows the growth of the groove ever
    /// more, and not with healing, which removes the groove.
    pub fn traps(&self) -> bool {
        self.depth_limit.is_none() && self.healing_time.is_none()
    }

    /// Whether these are the parameters of the basic model.
    pub fn is_basic(&self) -> bool {
        *self == Self::default()
    }

    /// Weight w of (61) at the height h under the tip.
    pub fn weight(&self, height: f64) -> f64 {
        self.depth_limit.map_or(1.0, |limit| exp(-height.abs() / limit))
    }

    /// 1/T, the rate at which indentations decay; 0 without healing.
    pub fn healing_rate(&self) -> f64 {
        self.healing_time.map_or(0.0, f64::recip)
    }

    /// 1/(vT), the rate per unit length at which the groove behind a tip of this speed decays; 0 without healing.
    pub fn fading(&self, speed: f64) -> f64 {
        self.healing_time.map_or(0.0, |time| 1.0 / (speed * time))
    }

    /// Undecayed part e^{-time/T} of an indentation after this time.
    pub fn left_after(&self, time: f64) -> f64 {
        self.healing_time.map_or(1.0, |healing| exp(-time / healing))
    }
}
