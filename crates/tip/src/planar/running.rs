//! A run in two coordinates.

use super::earlier::EarlierGrooves;
use super::frame::Layers;
use super::history::{Step, Trajectory};
use super::integrator::Integrator;
use super::scenario::{PlanarError, PlanarScenario};
use crate::integrator::Work;
use crate::run::{MOST_STEPS, RunError};
use crate::state::{Damaged, Reader, Saved, State};
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

/// A tip in motion through a scenario, with bounded memory.
pub struct PlanarRunning<'a> {
    until: f64,
    integrator: Integrator<'a>,
}

impl<'a> PlanarRunning<'a> {
    /// Begins a scenario.
    ///
    /// # Errors
    /// A parameter out of range, or an option that is not available in two coordinates.
    pub fn new(scenario: &'a PlanarScenario) -> Result<Self, PlanarError> {
        scenario.validate()?;
        Ok(Self { until: scenario.along.until, integrator: Integrator::new(scenario, None)? })
    }

    /// Begins a scenario on the surface that earlier scans left.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn over(
        scenario: &'a PlanarScenario,
        earlier: &'a EarlierGrooves,
    ) -> Result<Self, PlanarError> {
        scenario.validate()?;
        let integrator = Integrator::new(scenario, Some(earlier))?;
        Ok(Self { until: scenario.along.until, integrator })
    }

    /// Resumes a run from a state written by [`save`](Self::save). Every later step equals that of the uninterrupted
    /// run, bit for bit.
    ///
    /// # Errors
    /// As [`new`](Self::new); a state that is not one of this scenario.
    pub fn resumed(scenario: &'a PlanarScenario, state: &mut Reader) -> Result<Self, PlanarError> {
        let mut running = Self::new(scenario)?;
        running.integrator.restore(state).map_err(RunError::from)?;
        if !(scenario.along.start_time()..=scenario.along.until).contains(&running.t()) {
            return Err(RunError::from(Damaged::OutOfRange).into());
        }
        Ok(running)
    }

    /// Writes all data, except the scenario, that determine the rest of the run.
    pub fn save(&self, state: &mut State) {
        self.integrator.save(state);
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.integrator.t()
    }

    /// The run with a fixed step, by collocation and without error control: for observing the order of convergence.
    #[must_use]
    pub fn with_fixed_step(mut self, h: f64) -> Self {
        self.integrator.fix_step(h);
        self
    }

    /// Makes the next step; `None` once the end of the scenario is reached.
    ///
    /// # Errors
    /// The tolerance cannot be met, or the tip retreats beyond the range of the memory.
    pub fn step(&mut self) -> Result<Option<Step>, PlanarError> {
        self.integrator.step(self.until)
    }

    /// Counts so far.
    #[must_use]
    pub fn work(&self) -> Work {
        self.integrator.work()
    }

    /// Name of the memory in use, and the reason for it.
    #[must_use]
    pub fn memory(&self) -> (&'static str, String) {
        self.integrator.memory()
    }

    /// Number of layers so far, and their error.
    #[must_use]
    pub fn layers(&self) -> Layers {
        self.integrator.layers()
    }

    /// Number of real numbers in the memory.
    #[must_use]
    pub fn memory_size(&self) -> usize {
        self.integrator.memory_size()
    }
}

/// Integrates the motion to the end of the scenario, and keeps the whole history. A history of more than
/// [`MOST_STEPS`] steps is an error; for longer runs take the steps one by one from [`PlanarRunning`].
///
/// # Errors
/// As [`PlanarRunning`]; too long a history.
pub fn run(scenario: &PlanarScenario) -> Result<PlanarRun, PlanarError> {
    let mut running = PlanarRunning::new(scenario)?;
    let (mut steps, mut interrupted) = (vec![], false);
    while !interrupted && let Some(step) = running.step()? {
        if steps.len() == MOST_STEPS {
            return Err(RunError::HistoryTooLong { t: step.along.t }.into());
        }
        steps.push(step);
        interrupted = stop::is_asked();
    }
    let (work, layers) = (running.work(), running.layers());
    let along = &scenario.along;
    let trajectory = Trajectory::new(*along.model.wider(), along.support(), steps);
    Ok(PlanarRun { trajectory, work, layers, interrupted })
}
