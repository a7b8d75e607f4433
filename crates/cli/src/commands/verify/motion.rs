//! The dense history of a run, in one coordinate or in two.

use stickslip::{Moved, RunDocument, RunScenario, SampleLine, Unusable};
use stickslip_tip::{Step, Support, Trajectory, Wider, planar};

/// The dense history of a run.
pub(super) enum Motion {
    Along(Trajectory),
    Across(planar::Trajectory),
}

impl Motion {
    /// The history in a document; `None` if it was left out.
    pub(super) fn of(run: &RunDocument, whole: &RunScenario) -> Result<Option<Self>, Unusable> {
        if run.history.is_none() {
            return Ok(None);
        }
        Ok(Some(match whole {
            RunScenario::Along(_) => Self::Along(run.trajectory()?),
            RunScenario::Across(_) => Self::Across(run.trajectory_across()?.1),
        }))
    }

    /// Its start and its end.
    pub(super) fn span(&self) -> (f64, f64) {
        match self {
            Self::Along(motion) => (motion.start(), motion.end()),
            Self::Across(motion) => (motion.start(), motion.end()),
        }
    }

    /// x0 and y0 at its start.
    pub(super) fn first(&self) -> (f64, Option<f64>) {
        match self {
            Self::Along(motion) => (motion.x0(motion.start()), None),
            Self::Across(motion) => (motion.x0(motion.start()), Some(motion.y0(motion.start()))),
        }
    }

    /// Number of steps.
    pub(super) fn count(&self) -> usize {
        match self {
            Self::Along(motion) => motion.steps().len(),
            Self::Across(motion) => motion.steps().len(),
        }
    }

    /// The step along the scan that contains a time, and the motion at this time. The end of a step belongs to the next one.
    pub(super) fn at(&self, law: (&Support, &Wider), t: f64) -> (&Step, SampleLine) {
        match self {
            Self::Along(motion) => of_step(motion.step_at(t), law, t),
            Self::Across(motion) => of_step(motion.step_at(t), law, t),
        }
    }
}

fn of_step<'a, S: Moved>(step: &'a S, law: (&Support, &Wider), t: f64) -> (&'a Step, SampleLine) {
    (step.as_ref(), step.sample(law, t))
}
