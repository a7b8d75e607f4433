//! Saved states of the integrator between two steps.

use super::super::history::Step;
use super::PlanarRunning;
use crate::state::{Damaged, Reader, Saved, State};

impl PlanarRunning<'_> {
    /// Writes all data, except the scenario, that determine the rest of the run.
    pub fn save(&self, state: &mut State) {
        let [along, across] = self.velocity;
        for number in [self.t, self.extension, self.y, along, across] {
            state.number(number);
        }
        save_steps(self.last.iter(), state);
        save_steps(self.made.iter(), state);
        self.corner.iter().for_each(|corner| corner.save(state));
        self.work.save(state);
        self.control.save(state);
        self.switch.save(state);
        self.parts.iter().for_each(|part| part.save(state));
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        (self.t, self.extension, self.y) = (state.finite()?, state.finite()?, state.finite()?);
        self.velocity = [state.finite()?, state.finite()?];
        self.last = restored_steps(state)?.pop();
        self.made = restored_steps(state)?.into();
        if let Some(corner) = &mut self.corner {
            corner.restore(state)?;
        }
        let is_limited = |step: &Step| step.along.height.is_some();
        let all = self.last.iter().chain(&self.made);
        if all.into_iter().any(|step| is_limited(step) != self.corner.is_some()) {
            return Err(Damaged::OutOfRange);
        }
        self.work.restore(state)?;
        self.control.restore(state)?;
        self.switch.restore(state)?;
        self.parts.iter_mut().try_for_each(|part| part.restore(state))
    }
}

fn save_steps<'a>(steps: impl ExactSizeIterator<Item = &'a Step>, state: &mut State) {
    state.count(steps.len() as u64);
    steps.for_each(|step| step.save(state));
}

fn restored_steps(state: &mut Reader) -> Result<Vec<Step>, Damaged> {
    (0..state.length(1)?).map(|_| Step::restored(state)).collect()
}
