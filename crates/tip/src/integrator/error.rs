//! Errors that end an integration.

use thiserror::Error;

/// Errors that end a run.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum IntegrationError {
    /// The step length fell to the round-off of t.
    #[error(
        "at t = {t}: the tolerance {tolerance:e} cannot be met, the step length fell to {h:.1e}; allow a larger tolerance, or give smoother forces and surfaces"
    )]
    StepTooSmall {
        /// Time reached.
        t: f64,
        /// Last step length.
        h: f64,
        /// Requested tolerance.
        tolerance: f64,
    },
    /// The tip returned to positions so far back that the memory no longer contains them.
    #[error(
        "at t = {t}: the tip retreated further than the {kept} that the memory keeps behind it; use the memory direct, which keeps all"
    )]
    Forgotten {
        /// Time reached.
        t: f64,
        /// Distance behind the tip over which the past is kept, in σ.
        kept: f64,
    },
}
