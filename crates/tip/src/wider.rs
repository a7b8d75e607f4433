//! What a wider law adds to the paper's (10), (11): a depth limit, healing, inertia; no spring.
//!
//! ```text
//!     M x0'' + x0' = -u_x(x0,t) + κ (R(t) - x0) + Fext(t)
//!     u_t(x,t) = -α w(t) f(x - x0(t)) - u(x,t)/T
//!     w(t) = exp(-|h(t)|/b),   h = u(x0,t)                        (61)
//! ```
//!
//! The paper says of (61) that no closed equation exists for it. It does: the height h under the tip is one
//! more sum over the tip's past, each visit with its own weight w. So the past stays a groove.

use crate::elementary::exp;
use thiserror::Error;

/// b, T, M and κ. The default is the paper's law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wider {
    /// b of (61), in kσ²/a, the unit of heights: the rate of indentation falls as e^{-|h|/b}.
    pub depth_limit: Option<f64>,
    /// T, in Γ/k: the surface comes back as e^{-t/T}.
    pub healing_time: Option<f64>,
    /// M, in Γ²/k.
    pub inertia: Option<f64>,
    /// Whether there is a spring: κ is 1 or 0.
    pub spring: bool,
}

/// A parameter of the wider law out of its range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum WiderError {
    /// b must be finite and > 0.
    #[error(
        "the depth limit b (61) must be a finite number above 0, not {0:?}; leave it out for none"
    )]
    DepthLimit(f64),
    /// T must be finite and > 0.
    #[error("the healing time must be a finite number above 0, not {0:?}; leave it out for none")]
    HealingTime(f64),
    /// M must be finite and > 0.
    #[error("the inertia must be a finite number above 0, not {0:?}; leave it out for none")]
    Inertia(f64),
}

impl Default for Wider {
    fn default() -> Self {
        Self { depth_limit: None, healing_time: None, inertia: None, spring: true }
    }
}

/// Numbers between which products of a few of them are finite.
const RANGE: (f64, f64) = (1e-100, 1e100);

impl Wider {
    /// # Errors
    /// A parameter that is no finite number above 0.
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

    /// Whether the tip swings back after a slip: from M = 1/2 on its spring alone makes it resonate.
    #[must_use]
    pub fn swings_back(&self) -> bool {
        self.inertia.is_some_and(|mass| mass > 0.5)
    }

    /// Whether a tip can be held for ever: a depth limit lets the groove deepen ever more slowly, healing lets it go.
    #[must_use]
    pub fn traps(&self) -> bool {
        self.depth_limit.is_none() && self.healing_time.is_none()
    }

    /// Whether it is the paper's law.
    #[must_use]
    pub fn is_papers(&self) -> bool {
        *self == Self::default()
    }

    /// w of (61) at the height h under the tip.
    #[must_use]
    pub fn weight(&self, height: f64) -> f64 {
        self.depth_limit.map_or(1.0, |limit| exp(-height.abs() / limit))
    }

    /// What is left after a time of what was there: e^{-time/T}.
    #[must_use]
    pub fn left_after(&self, time: f64) -> f64 {
        self.healing_time.map_or(1.0, |healing| exp(-time / healing))
    }
}
