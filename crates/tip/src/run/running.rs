//! A run in progress: step by step, in bounded memory; it can be saved and resumed at any step.

use super::{RunError, Scenario};
use crate::integrator::{IntegrationError, Integrator, Work};
use crate::memory::MemoryReport;
use crate::state::{Reader, Saved, State};
use crate::{InitialSurface, Step};

/// A tip in motion through a scenario. Of its history only the data of the memory are kept.
pub struct Running<'a> {
    scenario: &'a Scenario,
    integrator: Integrator<'a>,
}

impl<'a> Running<'a> {
    /// Begins a scenario over its [`Scenario::initial_surface`].
    ///
    /// # Errors
    /// A parameter out of range, or `modes` is requested but does not fit the footprint.
    pub fn new(scenario: &'a Scenario, surface: &'a InitialSurface) -> Result<Self, RunError> {
        scenario.validate()?;
        let integrator = Integrator::new(scenario, surface, scenario.new_memory()?);
        Ok(Self { scenario, integrator })
    }

    /// Resumes a run from a state written by [`save`](Self::save). Every later step equals that of the uninterrupted
    /// run, bit for bit.
    ///
    /// # Errors
    /// As [`new`](Self::new); a state that is not one of this scenario.
    pub fn resumed(
        scenario: &'a Scenario,
        surface: &'a InitialSurface,
        state: &mut Reader,
    ) -> Result<Self, RunError> {
        let mut running = Self::new(scenario, surface)?;
        running.integrator.restore(state)?;
        scenario.check_saved(running.t(), running.integrator.made_until())?;
        Ok(running)
    }

    /// Writes all data, except the scenario, that determine the rest of the run.
    pub fn save(&self, state: &mut State) {
        self.integrator.save(state);
    }

    /// Makes the next step; `None` once the end of the scenario is reached.
    ///
    /// # Errors
    /// The tolerance cannot be met, or the tip retreats farther than the memory reaches back.
    #[inline]
    pub fn step(&mut self) -> Result<Option<Step>, RunError> {
        Ok(self.advance()?.copied())
    }

    /// Makes the next step like [`step`](Self::step), without copying it.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    #[inline]
    pub fn advance(&mut self) -> Result<Option<&Step>, RunError> {
        if self.integrator.t() >= self.scenario.until {
            return Ok(None);
        }
        self.integrator.step()?;
        if let Some(kept) = self.integrator.memory().forgotten() {
            return Err(IntegrationError::Forgotten { t: self.t(), kept }.into());
        }
        Ok(self.integrator.last())
    }

    /// Time reached.
    pub fn t(&self) -> f64 {
        self.integrator.t()
    }

    /// Numbers of steps, iterations and series so far.
    pub fn work(&self) -> Work {
        self.integrator.work()
    }

    /// Name of the memory in use.
    pub fn memory(&self) -> &'static str {
        self.memory_report().name()
    }

    /// Reason for this memory.
    pub fn memory_reason(&self) -> String {
        self.memory_report().reason()
    }

    /// The memory in use, the reason for it, and its errors.
    pub fn memory_report(&self) -> MemoryReport {
        self.integrator.memory().report()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Model, TipFunction};

    /// A state contains the steps of its series, which may end after another scenario does.
    #[test]
    fn a_state_of_a_longer_run_is_refused_where_its_steps_end_too_late() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let model = Model::new(tip, 0.9, 1.0).unwrap();
        let scenario = Scenario { kick: 0.1, ..Scenario::new(model, 200.0) };
        let surface = scenario.initial_surface().unwrap();
        let mut running = Running::new(&scenario, &surface).unwrap();
        let mut refused = 0;
        while let Some(step) = running.step().unwrap() {
            let mut state = State::default();
            running.save(&mut state);
            Running::resumed(&scenario, &surface, &mut state.reader()).unwrap();
            let shorter = Scenario { until: step.end() + 0.1 * step.h, ..scenario.clone() };
            match Running::resumed(&shorter, &surface, &mut state.reader()) {
                Err(_) => refused += 1,
                Ok(mut resumed) => {
                    while let Some(step) = resumed.step().unwrap() {
                        assert!(step.end() <= shorter.until + 1e-13, "{step:?}");
                    }
                }
            }
        }
        assert!(refused > 0);
    }
}
