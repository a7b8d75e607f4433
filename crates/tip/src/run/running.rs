//! A run under way: step by step, in bounded memory, to be saved and taken up again at any step.

use super::{RunError, Scenario};
use crate::integrator::{IntegrationError, Integrator, Work};
use crate::memory::{MemoryReport, Policy};
use crate::outcome::{Classifier, Outcome};
use crate::state::{Damaged, Saved, State};
use crate::{InitialSurface, Step, Trajectory};

/// A tip on its way through a scenario. It keeps no history but the steps at the end that its
/// [`Outcome`] is read from.
pub struct Running<'a> {
    scenario: &'a Scenario,
    integrator: Integrator<'a, Policy>,
    classifier: Classifier,
}

impl<'a> Running<'a> {
    /// At the start of a scenario, over its [`Scenario::initial_surface`].
    ///
    /// # Errors
    /// A parameter out of range.
    pub fn new(scenario: &'a Scenario, surface: &'a InitialSurface) -> Result<Self, RunError> {
        scenario.validate()?;
        let start = (scenario.start_time(), scenario.start_extension() + scenario.kick);
        let integrator = Integrator::new(
            &scenario.model,
            surface,
            &scenario.force,
            scenario.new_memory()?,
            start,
            scenario.tolerance,
        );
        let classifier = Classifier::new(&scenario.model, scenario.tolerance);
        Ok(Self { scenario, integrator, classifier })
    }

    /// Where [`save`](Self::save) was called: every step from there on is the same to the last bit as
    /// without the interruption.
    ///
    /// # Errors
    /// As [`new`](Self::new); a state that is not one of this scenario.
    pub fn resumed(
        scenario: &'a Scenario,
        surface: &'a InitialSurface,
        state: &State,
    ) -> Result<Self, RunError> {
        let mut running = Self::new(scenario, surface)?;
        let mut state = state.reader();
        running.integrator.restore(&mut state)?;
        running.classifier.restore(&mut state)?;
        let t = running.integrator.t();
        if !(scenario.start_time()..=scenario.until).contains(&t) {
            return Err(Damaged::OutOfRange.into());
        }
        state.finish()?;
        Ok(running)
    }

    /// All that the rest of the run depends on, beside the scenario.
    #[must_use]
    pub fn save(&self) -> State {
        let mut state = State::default();
        self.integrator.save(&mut state);
        self.classifier.save(&mut state);
        state
    }

    /// Makes the next step; `None` once the end of the scenario is reached.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    pub fn step(&mut self) -> Result<Option<Step>, RunError> {
        if self.integrator.t() >= self.scenario.until {
            return Ok(None);
        }
        let step = self.integrator.step(self.scenario.until)?;
        if let Some(kept) = self.integrator.memory().forgotten() {
            return Err(IntegrationError::Forgotten { t: self.t(), kept }.into());
        }
        self.classifier.observe(&step);
        Ok(Some(step))
    }

    /// The last step made.
    #[must_use]
    pub fn last(&self) -> Option<Step> {
        self.classifier.last()
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.integrator.t()
    }

    /// Regime and oscillation, were the run to end here.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        self.classifier.outcome(&self.scenario.model)
    }

    /// The steps at the end that the outcome, and the ripple that belongs to it, are read from; `None`
    /// before the first step.
    #[must_use]
    pub fn tail(&self) -> Option<Trajectory> {
        self.classifier.tail()
    }

    /// Counts so far.
    #[must_use]
    pub fn work(&self) -> Work {
        self.integrator.work()
    }

    /// Name of the memory in use.
    #[must_use]
    pub fn memory(&self) -> &'static str {
        self.memory_report().name()
    }

    /// Why that one.
    #[must_use]
    pub fn memory_reason(&self) -> String {
        self.memory_report().reason()
    }

    /// Which memory is in use, why, and how it fared.
    #[must_use]
    pub fn memory_report(&self) -> MemoryReport {
        self.integrator.memory().report()
    }
}
