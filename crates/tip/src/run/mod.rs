//! A run: a tip set going from a given start, integrated to a given time.

mod many;
mod running;
mod scenario;

pub use many::{run_each, run_many};
pub use running::Running;
pub use scenario::{MOST_STEPS, RunError, Scenario, Start, TOLERANCES};

use crate::integrator::Work;
use crate::stop;
use crate::{InitialSurface, Step, Trajectory};
use std::ops::ControlFlow;

/// A finished run.
#[derive(Debug, Clone)]
pub struct Run {
    /// u0(x), what the tip found at the start.
    pub initial_surface: InitialSurface,
    /// x0(t) at every t of the run.
    pub trajectory: Trajectory,
    /// Counts.
    pub work: Work,
    /// Name of the memory in use at the end.
    pub memory: &'static str,
    /// Why that one.
    pub memory_reason: String,
    /// Whether the observer stopped it before `until`.
    pub interrupted: bool,
    /// Whether its series were made side by side with those of other motions: [`run_each`].
    pub side_by_side: bool,
}

/// Integrates (15) from the start of the scenario to its end, and keeps the whole history; for more than
/// [`MOST_STEPS`] of it take the steps one by one from [`Running`].
///
/// # Errors
/// A parameter out of range, a tolerance that turned out not to be met, or too long a history.
pub fn run(scenario: &Scenario) -> Result<Run, RunError> {
    run_observed(scenario, |_| ControlFlow::Continue(()))
}

/// As [`run`], showing each accepted step to an observer, who may stop the run there; so may [`stop`].
///
/// # Errors
/// As [`run`].
pub fn run_observed(
    scenario: &Scenario,
    mut observe: impl FnMut(&Step) -> ControlFlow<()>,
) -> Result<Run, RunError> {
    scenario.validate()?;
    let surface = scenario.initial_surface()?;
    let mut running = Running::new(scenario, &surface)?;
    let mut steps = vec![];
    let mut interrupted = false;
    while !interrupted && let Some(step) = running.step()? {
        if steps.len() == MOST_STEPS {
            return Err(RunError::HistoryTooLong { t: step.t });
        }
        steps.push(step);
        interrupted = observe(&step).is_break() || stop::is_asked();
    }
    let (work, memory) = (running.work(), running.memory());
    let memory_reason = running.memory_reason();
    drop(running);
    let wider = *scenario.model.wider();
    let trajectory = Trajectory::under(wider, scenario.support(), steps);
    let initial_surface = surface;
    let side_by_side = false;
    Ok(Run { initial_surface, trajectory, work, memory, memory_reason, interrupted, side_by_side })
}
