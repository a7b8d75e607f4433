//! A run in two coordinates that is classified while it proceeds.

use crate::{Classified, Observer, SnakingObserver};
use stickslip_tip::RunError;
use stickslip_tip::planar::{PlanarError, PlanarRunning, PlanarScenario, Step};
use stickslip_tip::state::State;

/// A tip on its way through a scenario in two coordinates, with the data that classify its motion.
pub struct WatchedAcross<'a> {
    scenario: &'a PlanarScenario,
    running: PlanarRunning<'a>,
    along: Observer,
    across: SnakingObserver,
}

impl<'a> WatchedAcross<'a> {
    /// A tip at the start of a scenario.
    ///
    /// # Errors
    /// A parameter out of range, or an option that is not available in two coordinates.
    pub fn new(scenario: &'a PlanarScenario) -> Result<Self, PlanarError> {
        Ok(Self {
            scenario,
            running: PlanarRunning::new(scenario)?,
            along: Observer::new(&scenario.along),
            across: SnakingObserver::new(scenario),
        })
    }

    /// Resumes the run where [`save`](Classified::save) was called. Every later step is the same to the last bit as without
    /// the interruption.
    ///
    /// # Errors
    /// As [`new`](Self::new); a state that is not one of this scenario.
    pub fn resumed(scenario: &'a PlanarScenario, state: &State) -> Result<Self, PlanarError> {
        let mut state = state.reader();
        let running = PlanarRunning::resumed(scenario, &mut state)?;
        let mut watched = Self { running, ..Self::new(scenario)? };
        watched.along.restore(&mut state).map_err(RunError::from)?;
        watched.across.restore(&mut state).map_err(RunError::from)?;
        state.finish().map_err(RunError::from)?;
        Ok(watched)
    }

    /// The scenario.
    pub fn scenario(&self) -> &'a PlanarScenario {
        self.scenario
    }

    /// The observer of the motion along the scan.
    pub fn along(&self) -> &Observer {
        &self.along
    }

    /// The observer of the motion across the scan.
    pub fn across(&self) -> &SnakingObserver {
        &self.across
    }

    /// The run, with its work, its memory and its layers.
    pub fn running(&self) -> &PlanarRunning<'a> {
        &self.running
    }
}

impl Classified for WatchedAcross<'_> {
    type Step = Step;
    type Error = PlanarError;

    fn step_past(&mut self, t: f64, most: usize) -> Result<Option<Step>, PlanarError> {
        for left in (0..most).rev() {
            let Some(step) = self.running.step()? else { break };
            self.along.observe(&step.along);
            self.across.observe(&step);
            if left == 0 || step.end() > t {
                return Ok(Some(step));
            }
        }
        Ok(None)
    }

    fn last(&self) -> Option<Step> {
        self.across.last().copied()
    }

    fn t(&self) -> f64 {
        self.running.t()
    }

    fn save(&self) -> State {
        let mut state = State::default();
        self.running.save(&mut state);
        self.along.save(&mut state);
        self.across.save(&mut state);
        state
    }
}
