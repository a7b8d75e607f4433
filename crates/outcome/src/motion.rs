//! The motion that a tip settles into at given parameters.

use crate::{Outcome, judge_trajectory};
use stickslip_cycles::{Cycle, CycleError, Settled, settle};
use stickslip_tip::Model;

/// The motion that a tip settles into after a small disturbance of steady motion.
#[derive(Debug, Clone)]
pub enum Motion {
    /// Steady motion is stable. (If onset is subcritical, a large cycle may also be stable.)
    Steady,
    /// A stable cycle.
    Cycle(Box<Cycle>),
    /// The outcome of a run that came close to no stable cycle: trapped, or undecided.
    Run(Box<Outcome>),
}

/// Finds the motion that the tip settles into at the parameters of the model: by linear stability, by
/// [`stickslip_cycles::cycle`], or by a run.
///
/// # Errors
/// A tolerance out of range, or a run that fails.
pub fn motion(model: &Model, tolerance: f64) -> Result<Motion, CycleError> {
    Ok(match settle(model, tolerance)? {
        Settled::Steady => Motion::Steady,
        Settled::Cycle(cycle) => Motion::Cycle(cycle),
        Settled::Run(tried) => {
            let (scenario, run) = (&tried.scenario, &tried.run);
            let outcome = judge_trajectory(scenario, &run.initial_surface, &run.trajectory);
            Motion::Run(Box::new(outcome))
        }
    })
}
