//! Repetition of a run with the first applicable memory, observed step by step.

use super::VerificationError;
use std::ops::ControlFlow;
use stickslip_tip::{InitialSurface, MOST_STEPS, MemoryChoice, RunError, Running, Scenario, Step};

/// Largest number of steps repeated with direct sums, which take long.
const MOST_STEPS_OF_DIRECT: u64 = 3000;

/// Observer of a repetition.
pub(super) trait Witness {
    /// The repetition begins, or begins again because a memory was not applicable.
    fn begin(&mut self);

    /// A step of the repetition.
    fn see(&mut self, step: &Step) -> Result<(), RunError>;

    /// The repetition ended with this step.
    fn end(&mut self, last: &Step);
}

/// Two observers of one repetition.
impl<A: Witness, B: Witness> Witness for (&mut A, &mut B) {
    fn begin(&mut self) {
        self.0.begin();
        self.1.begin();
    }

    fn see(&mut self, step: &Step) -> Result<(), RunError> {
        self.0.see(step)?;
        self.1.see(step)
    }

    fn end(&mut self, last: &Step) {
        self.0.end(last);
        self.1.end(last);
    }
}

/// Observer that stores the whole history.
#[derive(Default)]
pub(super) struct Kept {
    pub(super) steps: Vec<Step>,
}

impl Witness for Kept {
    fn begin(&mut self) {
        self.steps.clear();
    }

    fn see(&mut self, step: &Step) -> Result<(), RunError> {
        if self.steps.len() == MOST_STEPS {
            return Err(RunError::HistoryTooLong { t: step.t });
        }
        self.steps.push(*step);
        Ok(())
    }

    fn end(&mut self, _: &Step) {}
}

/// Memories for the repetition of a run with this number of steps, the most independent first.
pub(super) fn another(used: &str, steps: u64) -> Vec<MemoryChoice> {
    let mut others = vec![MemoryChoice::Modes, MemoryChoice::Fft, MemoryChoice::Direct];
    if steps <= MOST_STEPS_OF_DIRECT {
        others.rotate_right(1);
    }
    let name = |choice: &MemoryChoice| match choice {
        MemoryChoice::Auto => "auto",
        MemoryChoice::Direct => "direct",
        MemoryChoice::Fft => "fft",
        MemoryChoice::Modes => "modes",
    };
    others.retain(|choice| name(choice) != used);
    others
}

/// A repetition, and its share of the total work.
pub(super) struct Repetition<'a> {
    pub(super) scenario: &'a Scenario,
    pub(super) surface: &'a InitialSurface,
    pub(super) from: f64,
    pub(super) to: f64,
}

impl Repetition<'_> {
    /// Repeats with the first applicable memory, and returns its name.
    pub(super) fn run(
        &self,
        memories: Vec<MemoryChoice>,
        witness: &mut impl Witness,
        observe: &mut impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<&'static str, VerificationError> {
        let mut last = None;
        for memory in memories {
            let scenario = Scenario { memory, ..self.scenario.clone() };
            witness.begin();
            match self.with(&scenario, witness, observe) {
                Ok(Some(memory)) => return Ok(memory),
                Ok(None) => return Err(VerificationError::Interrupted),
                Err(error @ (RunError::Modes(_) | RunError::Integration(_))) => last = Some(error),
                Err(error) => return Err(error.into()),
            }
        }
        Err(last.map_or(VerificationError::Interrupted, VerificationError::Run))
    }

    /// Repeats the run with the memory of `scenario`, and returns the final one; `None` if the observer stopped the work.
    fn with(
        &self,
        scenario: &Scenario,
        witness: &mut impl Witness,
        observe: &mut impl FnMut(f64) -> ControlFlow<()>,
    ) -> Result<Option<&'static str>, RunError> {
        let (start, until) = (scenario.start_time(), scenario.until);
        let part = |t: f64| self.from + (self.to - self.from) * (t - start) / (until - start);
        let mut running = Running::new(scenario, self.surface)?;
        let mut last = None;
        while let Some(step) = running.step()? {
            last = Some(step);
            witness.see(&step)?;
            if observe(part(step.end())).is_break() {
                return Ok(None);
            }
        }
        if let Some(step) = last {
            witness.end(&step);
        }
        Ok(Some(running.memory()))
    }
}
