//! Saving and restoring the memory.

use super::{Fft, Now, Policy, Record, Retreats};
use crate::memory::MemoryChoice;
use crate::state::{Damaged, Reader, Saved, State};

impl Saved for Policy {
    fn save(&self, state: &mut State) {
        self.fading.save(state);
        if self.choice == MemoryChoice::Auto {
            state.flag(matches!(self.now, Now::Direct));
        }
        let record = self.record.as_ref();
        match &self.now {
            Now::Direct => record.iter().for_each(|record| record.save(state)),
            Now::Fft(fft, _) => fft.save(record, state),
            Now::Modes(modes, retreats) => {
                modes.save(state);
                record.iter().for_each(|record| record.save(state));
                state.count(retreats.count);
                state.flag(record.is_some_and(Record::missed));
                state.flag(retreats.fft.is_some());
                if let Some(fft) = &retreats.fft {
                    fft.save(None, state);
                    state.number(retreats.farthest_back);
                }
            }
        }
    }

    /// Restores a memory that was made with the same arguments.
    fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.fading.restore(state)?;
        if self.choice == MemoryChoice::Auto {
            (self.record, self.now) = if state.flag()? {
                (Some(Record::whole(&self.tip)), Now::Direct)
            } else {
                self.without_direct(std::iter::empty()).ok_or(Damaged::Other("fit"))?
            };
        }
        match (&mut self.now, &mut self.record) {
            (Now::Fft(fft, _), record) => *record = fft.restore(state)?,
            (Now::Modes(modes, retreats), Some(record)) => {
                modes.restore(state)?;
                record.restore(state)?;
                *retreats = Retreats { count: state.count()?, ..Retreats::default() };
                record.set_missed(state.flag()?);
                if state.flag()? {
                    let mut fft = Fft::new(&self.tip, std::iter::empty());
                    fft.restore(state)?;
                    retreats.fft = Some(Box::new(fft));
                    retreats.farthest_back = state.number()?;
                }
            }
            (_, Some(record)) => record.restore(state)?,
            (_, None) => {}
        }
        // What was put off where a signal came.
        if matches!(self.now, Now::Direct) {
            self.decide();
        }
        Ok(())
    }
}
