//! Why a cycle could not be had.

use crate::Ended;
use stickslip_stability::StabilityError;
use stickslip_tip::RunError;
use stickslip_tip::memory::FitError;
use thiserror::Error;

/// Why there is no cycle to give.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum CycleError {
    /// A residual that cannot be reached, or is none.
    #[error(
        "the tolerance must lie between {min:e}, below which round-off takes over, and {max:e}; {0:e} does not",
        min = super::TOLERANCES.0, max = super::TOLERANCES.1
    )]
    Tolerance(f64),
    /// Nothing drags the tip.
    #[error(
        "cycles are those of a tip on a spring, behind a support: l repeats itself; without one there is none"
    )]
    NoSpring,
    /// A footprint whose past is no state of few numbers.
    #[error(
        "cycles need a footprint that fades; this one does not (J0 falls like 1/√x, cos x not at all)"
    )]
    NeverFades,
    /// A footprint with more detail than a sum of exponentials can follow.
    #[error(
        "the past of the tip cannot be told well enough for cycles to a tolerance of {allowed:e}: {}",
        instead(*reached)
    )]
    Rough {
        /// The tolerance asked for.
        allowed: f64,
        /// What the best sum of exponentials allows.
        reached: f64,
    },
    /// f' cannot be fitted.
    #[error(transparent)]
    Fit(FitError),
    /// Steady motion is stable, and the small cycle exists only on the other side of αc.
    #[error(
        "there is no small cycle at alpha = {alpha:?}: the one that is born at alpha = {critical:?} (r = {r:?}) exists only above that, and below it steady motion is stable"
    )]
    NoSmallCycle {
        /// As asked.
        alpha: f64,
        /// As asked.
        r: f64,
        /// αc(r).
        critical: f64,
    },
    /// Nobody waits for it any more: [`stickslip_tip::stop`].
    #[error("stopped before a cycle was found")]
    Stopped,
    /// Runs did not come near a cycle.
    #[error(
        "no cycle was found at alpha = {alpha:?}, r = {r:?}: runs from a kick end {}",
        Ended::told(*ended)
    )]
    NoCycleReached {
        /// As asked.
        alpha: f64,
        /// As asked.
        r: f64,
        /// What the longest run ended as.
        ended: Option<Ended>,
    },
    /// Newton's method did not converge from the cycle given.
    #[error("no cycle was reached at alpha = {alpha:?}, r = {r:?}: start from one that is nearer")]
    NotConverged {
        /// As asked.
        alpha: f64,
        /// As asked.
        r: f64,
    },
    /// The eigenvalues of the monodromy matrix cannot be had.
    #[error(
        "the cycle at alpha = {alpha:?}, r = {r:?} is beyond what its Floquet multipliers can be computed for"
    )]
    Multipliers {
        /// As asked.
        alpha: f64,
        /// As asked.
        r: f64,
    },
    /// The tip steps back farther than the past can be told by exponentials.
    #[error("the tip steps back by {retreat:.3}, more than the {most:.3} that cycles allow for")]
    Retreat {
        /// Farthest step back, in σ.
        retreat: f64,
        /// Farthest that holds.
        most: f64,
    },
    /// No critical point.
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

/// What would do where a sum of exponentials allows for no smaller tolerance than this.
fn instead(reached: f64) -> String {
    // To one digit, up: what is less will not do.
    let unit = 10_f64.powf(reached.log10().floor());
    let enough = (reached / unit).ceil() * unit;
    if enough <= super::TOLERANCES.1 {
        return format!("{enough:.0e} or more will do, or a footprint of less detail");
    }
    "a smaller alpha/r will do, or a footprint of less detail".into()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1.2e-9 was said as 1e-9, which had just been refused.
    #[test]
    fn a_tolerance_that_is_advised_is_enough() {
        for (reached, advised) in [(1.2e-9, "2e-9 or"), (2.0e-8, "2e-8 or"), (9.4e-6, "1e-5 or")] {
            assert!(instead(reached).starts_with(advised), "{}", instead(reached));
        }
        assert!(instead(1.0).starts_with("a smaller alpha/r"));
    }
}
