//! How a run ended, as far as a search for cycles must know. What its motion is, is for `stickslip-outcome` to judge.

use stickslip_tip::motion::{Oscillation, latest_extrema};
use stickslip_tip::{Run, Scenario};

/// A run that came near no stable cycle.
#[derive(Debug, Clone)]
pub struct Tried {
    /// What was run.
    pub scenario: Scenario,
    /// The run.
    pub run: Run,
}

/// What the end of a run shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// l repeats itself.
    Repeating,
    /// l has only risen in the second half of the run: the groove holds the tip, for long or for ever.
    Stuck,
    /// Neither.
    Unsettled,
}

impl Tried {
    /// What its end shows.
    #[must_use]
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
    pub(super) fn told(ended: Option<Self>) -> &'static str {
        match ended {
            Some(Self::Repeating) => "in stick-slip that no cycle near it closes",
            Some(Self::Stuck) => "stuck: trapped for ever, or for longer than they last",
            Some(Self::Unsettled) | None => "without having settled",
        }
    }
}
