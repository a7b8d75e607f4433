//! A run that is judged as it goes.

use crate::{Observer, Outcome, judge};
use stickslip_tip::state::State;
use stickslip_tip::{
    InitialSurface, Run, RunError, Running, Scenario, Step, Trajectory, Work, run,
};

/// A tip on its way through a scenario, and what its [`Outcome`] is read from: the steps at the end.
pub struct Watched<'a> {
    scenario: &'a Scenario,
    running: Running<'a>,
    observer: Observer,
    surface: &'a InitialSurface,
}

impl<'a> Watched<'a> {
    /// At the start of a scenario, over its [`Scenario::initial_surface`].
    ///
    /// # Errors
    /// A parameter out of range.
    pub fn new(scenario: &'a Scenario, surface: &'a InitialSurface) -> Result<Self, RunError> {
        let running = Running::new(scenario, surface)?;
        let observer = Observer::new(scenario);
        Ok(Self { scenario, running, observer, surface })
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
        let mut observer = Observer::new(scenario);
        observer.restore(&mut state)?;
        state.finish()?;
        Ok(Self { scenario, running, observer, surface })
    }

    /// All that the rest of the run, and its outcome, depend on, beside the scenario.
    #[must_use]
    pub fn save(&self) -> State {
        let mut state = State::default();
        self.running.save(&mut state);
        self.observer.save(&mut state);
        state
    }

    /// Makes the next step; `None` once the end of the scenario is reached.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    pub fn step(&mut self) -> Result<Option<Step>, RunError> {
        let step = self.running.step()?;
        step.iter().for_each(|step| self.observer.observe(step));
        Ok(step)
    }

    /// The last step made.
    #[must_use]
    pub fn last(&self) -> Option<Step> {
        self.observer.last()
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.running.t()
    }

    /// What the motion is, were the run to end here. This takes milliseconds: a cycle may be solved for.
    ///
    /// # Panics
    /// Before the first step.
    #[must_use]
    pub fn outcome(&self) -> Outcome {
        judge(self.scenario, self.surface, &self.observer)
    }

    /// The steps at the end that the outcome, and the ripple that belongs to it, are read from; `None`
    /// before the first step.
    #[must_use]
    pub fn tail(&self) -> Option<Trajectory> {
        self.observer.tail()
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
    let outcome = judge_trajectory(scenario, &run.initial_surface, &run.trajectory);
    Ok((run, outcome))
}

/// What the motion at the end of a trajectory is, which a run of the scenario over the surface has made.
#[must_use]
pub fn judge_trajectory(
    scenario: &Scenario,
    surface: &InitialSurface,
    trajectory: &Trajectory,
) -> Outcome {
    let mut observer = Observer::new(scenario);
    trajectory.steps().iter().for_each(|step| observer.observe(step));
    judge(scenario, surface, &observer)
}
