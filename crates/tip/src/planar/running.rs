//! A run in two coordinates.

use super::frame::Layers;
use super::history::Trajectory;
use super::integrator::PlanarRunning;
use super::scenario::{PlanarError, PlanarScenario};
use crate::integrator::Work;
use crate::run::{MOST_STEPS, RunError};
use crate::stop;

/// A finished run.
#[derive(Debug, Clone)]
pub struct PlanarRun {
    /// x0(t) and y0(t) at every t of the run.
    pub trajectory: Trajectory,
    /// Numbers of steps, iterations and series.
    pub work: Work,
    /// Number of layers across, and their error.
    pub layers: Layers,
    /// Whether the run was [stopped](stop) before its end.
    pub interrupted: bool,
}

/// Integrates the motion to the end of the scenario, and keeps the whole history. A history of more than
/// [`MOST_STEPS`] steps is an error; for longer runs take the steps one by one from [`PlanarRunning`].
///
/// # Errors
/// As [`PlanarRunning`], or the history is too long.
pub fn run(scenario: &PlanarScenario) -> Result<PlanarRun, PlanarError> {
    let mut running = PlanarRunning::new(scenario)?;
    let (mut steps, mut interrupted) = (vec![], false);
    while !interrupted && let Some(step) = running.step()? {
        if steps.len() == MOST_STEPS {
            return Err(RunError::HistoryTooLong { t: step.along.t }.into());
        }
        steps.push(step);
        interrupted = stop::is_requested();
    }
    let (work, layers) = (running.work(), running.layers());
    let along = &scenario.along;
    let trajectory = Trajectory::under(*along.model.wider(), along.support(), steps);
    Ok(PlanarRun { trajectory, work, layers, interrupted })
}
