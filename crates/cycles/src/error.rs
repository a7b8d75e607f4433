//! Errors of the limit-cycle functions.

use crate::Ended;
use stickslip_stability::StabilityError;
use stickslip_tip::RunError;
use stickslip_tip::memory::FitError;
use thiserror::Error;

/// An error of a limit-cycle function.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CycleError {
    /// The requested residual is out of range.
    #[error(
        "the tolerance must lie between {min:e}, below which round-off takes over, and {max:e}; {0:e} does not",
        min = super::TOLERANCES.0, max = super::TOLERANCES.1
    )]
    Tolerance(f64),
    /// The model has no spring, so that nothing drags the tip.
    #[error(
        "limit cycles exist only for a tip on a spring behind a support: without a spring the lag l is not defined"
    )]
    NoSpring,
    /// The footprint never fades, so that the history of the tip is not a state of a few numbers.
    #[error(
        "cycles need a footprint that decays; this one does not (J0 falls like 1/√x, cos x not at all)"
    )]
    NeverFades,
    /// The footprint has too much detail for a sum of exponentials.
    #[error(
        "the history of the tip cannot be represented accurately enough for a tolerance of {allowed:e}: {}",
        instead(*reached)
    )]
    Rough {
        /// The requested tolerance.
        allowed: f64,
        /// The smallest tolerance that the best sum of exponentials permits.
        reached: f64,
    },
    /// The fit of f' failed.
    #[error(transparent)]
    Fit(FitError),
    /// Steady motion is stable, and the small cycle exists only on the other side of αc.
    #[error(
        "there is no small cycle at alpha = {alpha:?}: the one that begins at alpha = {critical:?} (r = {r:?}) exists only above it; below it steady motion is stable"
    )]
    NoSmallCycle {
        /// The requested α.
        alpha: f64,
        /// The requested r.
        r: f64,
        /// αc(r).
        critical: f64,
    },
    /// A request to stop: [`stickslip_tip::stop`].
    #[error("stopped before a cycle was found")]
    Stopped,
    /// No run came close to a cycle.
    #[error(
        "no cycle was found at alpha = {alpha:?}, r = {r:?}: runs from a kick end {}",
        Ended::described(*ended)
    )]
    NoCycleReached {
        /// The requested α.
        alpha: f64,
        /// The requested r.
        r: f64,
        /// Result of the longest run.
        ended: Option<Ended>,
    },
    /// Newton's method did not converge from the given cycle.
    #[error("no cycle was reached at alpha = {alpha:?}, r = {r:?}: start from a nearer one")]
    NotConverged {
        /// The requested α.
        alpha: f64,
        /// The requested r.
        r: f64,
    },
    /// The eigenvalues of the monodromy matrix are not available.
    #[error(
        "the cycle at alpha = {alpha:?}, r = {r:?} is too stiff or too long for its Floquet multipliers to be computed"
    )]
    Multipliers {
        /// The requested α.
        alpha: f64,
        /// The requested r.
        r: f64,
    },
    /// The tip moves back farther than the range in which the sum of exponentials is valid.
    #[error("the tip moves back by {retreat:.3}, more than the {most:.3} that cycles can have")]
    Retreat {
        /// Largest backward motion, in σ.
        retreat: f64,
        /// Largest backward motion for which the sum is valid, in σ.
        most: f64,
    },
    /// An error of the linear-stability functions, such as a missing critical point.
    #[error(transparent)]
    Stability(#[from] StabilityError),
    /// A run failed.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl From<FitError> for CycleError {
    fn from(error: FitError) -> Self {
        match error {
            FitError::NeverFades => Self::NeverFades,
            FitError::Stopped => Self::Stopped,
            error => Self::Fit(error),
        }
    }
}

/// The remedy in the message if the sum of exponentials permits no smaller tolerance than this.
fn instead(reached: f64) -> String {
    // To one digit, up: what is less will not do.
    let unit = 10_f64.powf(reached.log10().floor());
    let enough = (reached / unit).ceil() * unit;
    if enough <= super::TOLERANCES.1 {
        return format!("take {enough:.0e} or more, or a footprint of less detail");
    }
    "take a smaller alpha/r, or a footprint of less detail".into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Advice for 1.2e-9 must not be 1e-9, which is below it.
    #[test]
    fn a_tolerance_that_is_advised_is_enough() {
        for (reached, advised) in [(1.2e-9, "2e-9"), (2.0e-8, "2e-8"), (9.4e-6, "1e-5")] {
            let advice = format!("take {advised} or more");
            assert!(instead(reached).starts_with(&advice), "{}", instead(reached));
        }
        assert!(instead(1.0).starts_with("take a smaller alpha/r"));
    }
}
