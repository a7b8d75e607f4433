//! A run that is classified while it proceeds.

use crate::{Observer, Outcome, judge};
use std::error::Error;
use stickslip_tip::state::State;
use stickslip_tip::{InitialSurface, Run, RunError, Running, Scenario, Step, Trajectory, run};

/// A run in progress, in one coordinate or in two, with the data that classify its motion.
pub trait Classified {
    /// A step of the motion.
    type Step: Copy + AsRef<Step>;
    /// The reason why there is no further step.
    type Error: Error;

    /// Makes the next step; `None` at the end of the scenario.
    ///
    /// # Errors
    /// The tolerance cannot be met, or the tip retreats beyond the range of the memory.
    fn step(&mut self) -> Result<Option<Self::Step>, Self::Error>;

    /// The last step.
    fn last(&self) -> Option<Self::Step>;

    /// Time reached.
    fn t(&self) -> f64;

    /// The complete state: with the scenario, it determines the rest of the run and its outcome.
    fn save(&self) -> State;
}

/// A tip on its way through a scenario, with the last steps, from which its [`Outcome`] follows.
pub struct Watched<'a> {
    scenario: &'a Scenario,
    running: Running<'a>,
    observer: Observer,
    surface: &'a InitialSurface,
}

impl<'a> Watched<'a> {
    /// A tip at the start of a scenario, on its [`Scenario::initial_surface`].
    ///
    /// # Errors
    /// A parameter out of range.
    pub fn new(scenario: &'a Scenario, surface: &'a InitialSurface) -> Result<Self, RunError> {
        let running = Running::new(scenario, surface)?;
        let observer = Observer::new(scenario);
        Ok(Self { scenario, running, observer, surface })
    }

    /// Resumes the run where [`save`](Classified::save) was called. Every later step is the same to the last bit as without
    /// the interruption.
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

    /// Classifies the motion up to the present time. This takes milliseconds, as a cycle may be computed.
    ///
    /// # Panics
    /// Before the first step.
    pub fn outcome(&self) -> Outcome {
        judge(self.scenario, self.surface, &self.observer)
    }

    /// The scenario, and the surface on which it begins.
    pub fn origin(&self) -> (&'a Scenario, &'a InitialSurface) {
        (self.scenario, self.surface)
    }

    /// The observer of the steps, from which the outcome follows.
    pub fn observer(&self) -> &Observer {
        &self.observer
    }

    /// The run, with its work and its memory.
    pub fn running(&self) -> &Running<'a> {
        &self.running
    }
}

impl Classified for Watched<'_> {
    type Step = Step;
    type Error = RunError;

    fn step(&mut self) -> Result<Option<Step>, RunError> {
        // Observed where it was made: a step is long to copy, and slow to read just after a copy.
        let made = self.running.advance()?;
        if let Some(step) = made {
            self.observer.observe(step);
        }
        Ok(made.copied())
    }

    fn last(&self) -> Option<Step> {
        self.observer.last()
    }

    fn t(&self) -> f64 {
        self.running.t()
    }

    fn save(&self) -> State {
        let mut state = State::default();
        self.running.save(&mut state);
        self.observer.save(&mut state);
        state
    }
}

/// Runs a scenario like [`run`] and classifies the motion.
///
/// # Errors
/// As [`run`].
pub fn run_and_judge(scenario: &Scenario) -> Result<(Run, Outcome), RunError> {
    let run = run(scenario)?;
    let outcome = judge_trajectory(scenario, &run.initial_surface, &run.trajectory);
    Ok((run, outcome))
}

/// Classifies the motion at the end of a trajectory, computed from this scenario.
pub fn judge_trajectory(
    scenario: &Scenario,
    surface: &InitialSurface,
    trajectory: &Trajectory,
) -> Outcome {
    let mut observer = Observer::new(scenario);
    trajectory.steps().iter().for_each(|step| observer.observe(step));
    judge(scenario, surface, &observer)
}
