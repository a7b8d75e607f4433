//! A run that is judged as it goes.

use crate::{Classifier, Outcome};
use stickslip_tip::state::State;
use stickslip_tip::{
    InitialSurface, Run, RunError, Running, Scenario, Step, Trajectory, Work, run,
};

/// A tip on its way through a scenario, and what its [`Outcome`] is read from: the steps at the end.
pub struct Watched<'a> {
    scenario: &'a Scenario,
    running: Running<'a>,
    classifier: Classifier,
}

impl<'a> Watched<'a> {
    /// At the start of a scenario, over its [`Scenario::initial_surface`].
    ///
    /// # Errors
    /// A parameter out of range.
    pub fn new(scenario: &'a Scenario, surface: &'a InitialSurface) -> Result<Self, RunError> {
        let running = Running::new(scenario, surface)?;
        let classifier = Classifier::new(&scenario.model, scenario.tolerance);
        Ok(Self { scenario, running, classifier })
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
        let mut state = state.reader();
        let running = Running::resumed(scenario, surface, &mut state)?;
        let mut classifier = Classifier::new(&scenario.model, scenario.tolerance);
        classifier.restore(&mut state)?;
        state.finish()?;
        Ok(Self { scenario, running, classifier })
    }

    /// All that the rest of the run, and its outcome, depend on, beside the scenario.
    #[must_use]
    pub fn save(&self) -> State {
        let mut state = State::default();
        self.running.save(&mut state);
        self.classifier.save(&mut state);
        state
    }

    /// Makes the next step; `None` once the end of the scenario is reached.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    pub fn step(&mut self) -> Result<Option<Step>, RunError> {
        let step = self.running.step()?;
        step.iter().for_each(|step| self.classifier.observe(step));
        Ok(step)
    }

    /// The last step made.
    #[must_use]
    pub fn last(&self) -> Option<Step> {
        self.classifier.last()
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.running.t()
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
        self.running.work()
    }

    /// Name of the memory in use.
    #[must_use]
    pub fn memory(&self) -> &'static str {
        self.running.memory()
    }

    /// Why that one.
    #[must_use]
    pub fn memory_reason(&self) -> String {
        self.running.memory_reason()
    }
}

/// [`run`], and what became of it.
///
/// # Errors
/// As [`run`].
pub fn run_and_judge(scenario: &Scenario) -> Result<(Run, Outcome), RunError> {
    let run = run(scenario)?;
    let outcome = crate::classify(&run.trajectory, &scenario.model, scenario.tolerance);
    Ok((run, outcome))
}
