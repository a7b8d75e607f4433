//! What can go wrong in a stability computation.

use thiserror::Error;

/// Why a stability figure could not be had.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum StabilityError {
    /// r must be finite and > 0.
    #[error("r is {0}: the dimensionless support velocity (12) must be a finite number > 0")]
    R(f64),
    /// α must be finite and > 0 here.
    #[error("alpha is {0}: the dimensionless indentation rate (13) must be a finite number > 0")]
    Alpha(f64),
    /// No root reaches the imaginary axis, however large α.
    #[error(
        "steady motion with this tip function at r = {r} is stable for every alpha: no root reaches the imaginary axis"
    )]
    NoCrossing {
        /// The support velocity asked for.
        r: f64,
    },
    /// No support velocity loses stability at this α.
    #[error("no r makes alpha = {alpha} critical for this tip function")]
    NoCriticalR {
        /// The indentation rate asked for.
        alpha: f64,
    },
    /// p ∫e^{-ps}(-f')ds is nowhere positive: nothing can hold the tip.
    #[error("this tip function cannot trap the tip at any alpha")]
    NoTrapping,
}
