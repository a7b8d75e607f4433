//! Saved states of the integrator between two steps.

use super::{Integrator, Work};
use crate::state::{Damaged, Reader, Saved, State};

/// The saved state contains all data that determine the next steps, except the arguments of [`Integrator::new`].
impl Saved for Integrator<'_> {
    fn save(&self, state: &mut State) {
        let (slope, force) = self.limits_from_before;
        for number in [self.t, self.extension, self.velocity, self.curvature, slope, force] {
            state.number(number);
        }
        state.steps(self.last().into_iter());
        self.corner.iter().for_each(|corner| corner.save(state));
        self.work.save(state);
        self.control.save(state);
        self.taylor.save(state);
        self.memory.save(state);
    }

    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        (self.t, self.extension) = (state.finite()?, state.finite()?);
        (self.velocity, self.curvature) = (state.finite()?, state.finite()?);
        self.limits_from_before = (state.finite()?, state.finite()?);
        self.last = state.steps()?.pop();
        if let Some(corner) = &mut self.corner {
            corner.restore(state)?;
        }
        if self.last.is_some_and(|last| last.height.is_some() != self.corner.is_some()) {
            return Err(Damaged::OutOfRange);
        }
        self.work.restore(state)?;
        self.control.restore(state)?;
        self.taylor.restore(state, (self.t, self.extension))?;
        self.memory.restore(state)
    }
}

impl Saved for Work {
    fn save(&self, state: &mut State) {
        let Self { steps, rejected, newton_iterations, series, switches } = *self;
        for count in [steps, rejected, newton_iterations, series, switches] {
            state.count(count);
        }
    }

    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let Self { steps, rejected, newton_iterations, series, switches } = self;
        for count in [steps, rejected, newton_iterations, series, switches] {
            // One that can still be counted on.
            *count = state.count()?;
            if *count >= u64::MAX / 2 {
                return Err(Damaged::OutOfRange);
            }
        }
        Ok(())
    }
}
