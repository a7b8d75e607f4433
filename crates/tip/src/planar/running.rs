//! A run in two coordinates.

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
    /// Counts.
    pub work: Work,
    /// How many layers there were across, and what they left out.
    pub layers: Layers,
    /// Whether it was [stopped](stop) before its end.
    pub interrupted: bool,
}

/// A tip on its way through a scenario: its memory is bounded.
pub struct PlanarRunning<'a> {
    until: f64,
    integrator: Integrator<'a>,
}

impl<'a> PlanarRunning<'a> {
    /// At the start of a scenario.
    ///
    /// # Errors
    /// A parameter out of range, or what is not available in two coordinates.
    pub fn new(scenario: &'a PlanarScenario) -> Result<Self, PlanarError> {
        scenario.validate()?;
        Ok(Self { until: scenario.along.until, integrator: Integrator::new(scenario)? })
    }

    /// Where [`save`](Self::save) was called: every step from there on is the same to the last bit as without the interruption.
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

    /// All that the rest of the run depends on, beside the scenario.
    pub fn save(&self, state: &mut State) {
        self.integrator.save(state);
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.integrator.t()
    }

    /// Steps of this length only, by collocation and without error control: for observing the order of convergence.
    #[must_use]
    pub fn with_fixed_step(mut self, h: f64) -> Self {
        self.integrator.fix_step(h);
        self
    }

    /// Makes the next step; `None` once the end of the scenario is reached.
    ///
    /// # Errors
    /// The tolerance cannot be met, or the tip goes where no memory follows it.
    pub fn step(&mut self) -> Result<Option<Step>, PlanarError> {
        self.integrator.step(self.until)
    }

    /// Counts so far.
    #[must_use]
    pub fn work(&self) -> Work {
        self.integrator.work()
    }

    /// How many layers there were so far, and what they left out.
    #[must_use]
    pub fn layers(&self) -> Layers {
        self.integrator.layers()
    }

    /// Numbers that the memory consists of.
    #[must_use]
    pub fn memory_size(&self) -> usize {
        self.integrator.memory_size()
    }
}

/// Integrates the motion to the end of the scenario, and keeps the whole history; for more than [`MOST_STEPS`] of it take
/// the steps one by one from [`PlanarRunning`].
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
