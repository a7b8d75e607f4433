//! Saved states of the integrator between two steps.

use super::super::history::Step;
use super::Integrator;
use crate::collocation::Stages;
use crate::integrator::Work;
use crate::state::{Damaged, Reader, Saved, State};

/// Contains all data that determine the next steps, except the arguments of [`Integrator::new`].
impl Saved for Integrator<'_> {
    fn save(&self, state: &mut State) {
        let [along, across] = self.velocity;
        for number in [self.t, self.extension, self.y, along, across] {
            state.number(number);
        }
        save_steps(self.last.iter(), state);
        save_steps(self.made.iter(), state);
        self.corner.iter().for_each(|corner| corner.save(state));
        let Work { steps, rejected, newton_iterations, series, switches } = self.work;
        for count in [steps, rejected, newton_iterations, series, switches] {
            state.count(count);
        }
        self.control.save(state);
        self.switch.save(state);
        self.parts.iter().for_each(|part| part.save(state));
    }

    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
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
        self.work = Work {
            steps: restored_count(state)?,
            rejected: restored_count(state)?,
            newton_iterations: restored_count(state)?,
            series: restored_count(state)?,
            switches: restored_count(state)?,
        };
        self.control.restore(state)?;
        self.switch.restore(state)?;
        self.parts.iter_mut().try_for_each(|part| part.restore(state))
    }
}

/// One that can still be counted on.
fn restored_count(state: &mut Reader) -> Result<u64, Damaged> {
    state.count().and_then(|n| if n < u64::MAX / 2 { Ok(n) } else { Err(Damaged::OutOfRange) })
}

fn save_steps<'a>(steps: impl ExactSizeIterator<Item = &'a Step>, state: &mut State) {
    state.count(steps.len() as u64);
    for Step { along, y, across } in steps {
        state.step(along);
        state.number(*y);
        across.iter().for_each(|across| state.number(*across));
    }
}

fn restored_steps(state: &mut Reader) -> Result<Vec<Step>, Damaged> {
    let step = |state: &mut Reader| {
        let (along, y) = (state.step()?, state.finite()?);
        let mut across: Stages = [0.0; _];
        for across in &mut across {
            *across = state.finite()?;
        }
        Ok(Step { along, y, across })
    };
    (0..state.length(1)?).map(|_| step(state)).collect()
}
