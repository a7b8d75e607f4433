//! What a tip comes to at given parameters.

use crate::{Outcome, judge_trajectory};
use stickslip_cycles::{Cycle, CycleError, Settled, settle};
use stickslip_tip::Model;

/// What a tip comes to when steady motion is disturbed a little.
#[derive(Debug, Clone)]
pub enum Motion {
    /// Steady motion is stable. (A large cycle may be too, where onset is subcritical.)
    Steady,
    /// A stable cycle.
    Cycle(Box<Cycle>),
    /// What a run ended as, that came near no stable cycle: trapped, or without end in sight.
    Run(Box<Outcome>),
}

/// What the motion at the parameters of the model comes to: by linear stability, by [`stickslip_cycles::cycle`], by
/// a run.
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
