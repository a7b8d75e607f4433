//! State of a run at its end, for the search for cycles. `stickslip-outcome` classifies the motion in detail.

use stickslip_tip::motion::{Oscillation, latest_extrema};
use stickslip_tip::{Run, Scenario};

/// A run that did not come close to a stable cycle.
#[derive(Debug, Clone)]
pub struct UnsettledRun {
    /// The scenario of the run.
    pub scenario: Scenario,
    /// The run.
    pub run: Run,
}

/// State of a run at its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// l is periodic.
    Repeating,
    /// l has only risen in the second half of the run: the groove holds the tip, for a long time or permanently.
    Stuck,
    /// Neither repeating nor stuck.
    Unsettled,
}

impl UnsettledRun {
    /// The state at the end of this run.
    pub fn ended(&self) -> Ended {
        let trajectory = &self.run.trajectory;
        let extrema = latest_extrema(trajectory);
        if Oscillation::of(trajectory, &extrema).is_some() {
            return Ended::Repeating;
        }
        let (start, end) = (trajectory.start(), trajectory.end());
        let turned = extrema.first().is_some_and(|latest| latest.t > 0.5 * (start + end));
        let rises = trajectory.velocity(end) < 0.5 * trajectory.r();
        if rises && !turned { Ended::Stuck } else { Ended::Unsettled }
    }
}

impl Ended {
    pub(super) fn described(ended: Option<Self>) -> &'static str {
        match ended {
            Some(Self::Repeating) => {
                "in a periodic motion, but Newton's method found no cycle near it"
            }
            Some(Self::Stuck) => {
                "with the tip sticking: trapped, or the next slip comes after their end"
            }
            Some(Self::Unsettled) | None => "without having settled",
        }
    }
}
