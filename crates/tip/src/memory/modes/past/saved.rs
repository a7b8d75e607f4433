//! The record, written down and taken up again.

use super::{BINS_PER_ORIGIN, MOMENTS, MOST_BINS, MOST_NODES, Past};
use crate::state::{Damaged, Reader, State};

impl Past {
    pub(in crate::memory::modes) fn save(&self, state: &mut State) {
        state.number(self.position);
        state.pairs(self.nodes.iter());
        state.whole(self.first);
        state.flag(self.forgot);
        state.numbers(self.bins.iter().flatten().copied().collect::<Vec<_>>().into_iter());
    }

    pub(in crate::memory::modes) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        self.position = state.within(4.0 * BINS_PER_ORIGIN as f64 * self.length)?;
        let nodes = state.pairs()?;
        (self.first, self.forgot) = (state.whole()?, state.flag()?);
        let moments = state.numbers()?;
        let (bins, rest) = moments.as_chunks::<MOMENTS>();
        let far = self.first.unsigned_abs() > 2 * MOST_BINS as u64;
        if nodes.len() > MOST_NODES || bins.len() > MOST_BINS || !rest.is_empty() || far {
            return Err(Damaged::OutOfRange);
        }
        // Into the room taken at the start: no step is to allocate.
        self.nodes.clear();
        self.nodes.extend(nodes);
        self.bins.clear();
        self.bins.extend(bins);
        Ok(())
    }
}
