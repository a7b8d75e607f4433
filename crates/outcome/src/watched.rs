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

    /// Makes steps to the first one that ends after time `t`, but at most this number, and returns the last of them; `None`
    /// at the end of the scenario.
    ///
    /// # Errors
    /// The tolerance cannot be met, or the tip retreats beyond the range of the memory.
    fn step_past(&mut self, t: f64, most: usize) -> Result<Option<Self::Step>, Self::Error>;

    /// Makes the next step; `None` at the end of the scenario.
    ///
    /// # Errors
    /// As [`step_past`](Self::step_past).
    fn step(&mut self) -> Result<Option<Self::Step>, Self::Error> {
        self.step_past(f64::NEG_INFINITY, 1)
    }

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

    fn step_past(&mut self, t: f64, most: usize) -> Result<Option<Step>, RunError> {
        for left in (0..most).rev() {
            let Some(step) = self.running.advance()? else { break };
            // Observed where it was made: a step is long to copy, and slow to read just after a copy.
            self.observer.observe(step);
            if left == 0 || step.end() > t {
                return Ok(Some(*step));
            }
        }
        Ok(None)
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

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip_tip::{Model, TipFunction};

    /// The steps are those made one by one, and the one returned is the first that ends after t, unless there were too
    /// many.
    #[test]
    fn steps_past_a_time_are_steps() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let model = Model::new(tip, 1.2, 1.0).unwrap();
        let scenario = Scenario { kick: 0.05, ..Scenario::new(model, 60.0) };
        let surface = scenario.initial_surface().unwrap();
        let [mut one_by_one, mut past] = [0; 2].map(|_| Watched::new(&scenario, &surface).unwrap());
        let (mut made, mut t, mut most) = (0, 0.0, 1);
        while let Some(step) = past.step_past(t, most).unwrap() {
            let single: Vec<Step> = std::iter::from_fn(|| one_by_one.step().unwrap())
                .take_while(|single| single.t < step.t)
                .collect();
            made += single.len() + 1;
            assert!(single.iter().all(|single| single.end() <= t), "{t}");
            assert!(step.end() > t || single.len() + 1 == most, "{t}");
            assert_eq!((one_by_one.t(), one_by_one.last()), (past.t(), past.last()));
            (t, most) = (t + 0.7, most % 5 + 1);
        }
        // The last ones end before t.
        while one_by_one.step().unwrap().is_some() {}
        assert_eq!((one_by_one.t(), one_by_one.last()), (past.t(), past.last()));
        assert!(made > 100, "{made}");
    }
}
