//! A run: the motion of a tip from a given start to a given time.

mod many;
mod running;
mod scenario;

pub use many::{collect_each, run_each, run_many};
pub use running::Running;
pub use scenario::{MOST_STEPS, RunError, Scenario, Start, TOLERANCES};

use crate::integrator::Work;
use crate::stop;
use crate::{InitialSurface, Step, Trajectory};
use std::ops::ControlFlow;

/// A finished run: with its [`Trajectory`], or with a collector of its steps ([`collect_each`]).
#[derive(Debug, Clone)]
pub struct Run<T = Trajectory> {
    /// Surface u0(x) at the start.
    pub initial_surface: InitialSurface,
    /// x0(t) at every t of the run, or the collector.
    pub trajectory: T,
    /// Numbers of steps, iterations and series.
    pub work: Work,
    /// Name of the memory in use at the end.
    pub memory: &'static str,
    /// Reason for this memory.
    pub memory_reason: String,
    /// Whether the run was stopped before `until`.
    pub interrupted: bool,
    /// Whether the run shared SIMD lanes with other motions: [`run_each`].
    pub side_by_side: bool,
}

impl Run<Vec<Step>> {
    fn into_run(self, scenario: &Scenario) -> Run {
        let Self { initial_surface, trajectory: steps, work, memory, memory_reason, .. } = self;
        let wider = *scenario.model.wider();
        Run {
            initial_surface,
            trajectory: Trajectory::under(wider, scenario.support(), steps),
            work,
            memory,
            memory_reason,
            interrupted: self.interrupted,
            side_by_side: self.side_by_side,
        }
    }
}

/// Integrates (15) from the start of the scenario to its end, and keeps the whole history. A history of more than
/// [`MOST_STEPS`] steps is an error; for longer runs take the steps one by one from [`Running`].
///
/// # Errors
/// A parameter out of range, a tolerance that cannot be met, or a history that is too long.
pub fn run(scenario: &Scenario) -> Result<Run, RunError> {
    run_observed(scenario, |_| ControlFlow::Continue(()))
}

/// Integrates as [`run`], and passes the history to an observer after each accepted step, which is its last. The observer
/// or [`stop`] may end the run there.
///
/// # Errors
/// As [`run`].
pub fn run_observed(
    scenario: &Scenario,
    mut observe: impl FnMut(&Trajectory) -> ControlFlow<()>,
) -> Result<Run, RunError> {
    let take = |history: &mut Trajectory, step: Step| {
        if history.steps().len() == MOST_STEPS {
            return Err(RunError::HistoryTooLong { t: step.t });
        }
        history.push(step);
        Ok(observe(history))
    };
    let begun = Trajectory::begun(*scenario.model.wider(), scenario.support());
    collected(scenario, begun, take)
}

/// Runs a scenario alone: `take` adds each step to a collector, and may end the run there.
fn collected<C>(
    scenario: &Scenario,
    mut steps: C,
    mut take: impl FnMut(&mut C, Step) -> Result<ControlFlow<()>, RunError>,
) -> Result<Run<C>, RunError> {
    scenario.validate()?;
    let initial_surface = scenario.initial_surface()?;
    let mut running = Running::new(scenario, &initial_surface)?;
    let mut interrupted = false;
    while !interrupted && let Some(step) = running.step()? {
        interrupted = take(&mut steps, step)?.is_break() || stop::is_requested();
    }
    let (work, memory, memory_reason) = (running.work(), running.memory(), running.memory_reason());
    drop(running);
    let side_by_side = false;
    let trajectory = steps;
    Ok(Run { initial_surface, trajectory, work, memory, memory_reason, interrupted, side_by_side })
}
