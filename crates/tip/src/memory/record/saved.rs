//! Saving and restoring the history buffer.

use super::bins::{MOMENTS, MOST_BINS};
use super::{Kept, MOST_NODES, ORIGIN_STEP, Record};
use crate::TipFunction;
use crate::collocation::STAGES;
use crate::state::{Damaged, Reader, State};

impl Record {
    /// Writes the blocks, or the nodes and bins. The buffer of a lattice is written with the lattice.
    pub(crate) fn save(&self, state: &mut State) {
        state.number(self.position);
        match &self.kept {
            Kept::All(blocks) => {
                state.count(blocks.len() as u64);
                let mut start = 0;
                for block in blocks {
                    save_block(&self.nodes[start..block.end], state);
                    start = block.end;
                }
            }
            Kept::Gathered(bins, recent) => {
                recent.save(state);
                state.whole(bins.first);
                state.flag(bins.dropped);
                state.numbers(
                    bins.moments.iter().flatten().copied().collect::<Vec<_>>().into_iter(),
                );
            }
            Kept::OnLattice => {}
        }
    }

    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let steps = match &self.kept {
            Kept::All(_) => ORIGIN_STEP,
            Kept::Gathered(bins, _) => bins.origin_step(),
            Kept::OnLattice => return Ok(()),
        };
        self.position = state.within(4.0 * steps)?;
        self.nodes.clear();
        match &mut self.kept {
            Kept::All(blocks) => {
                blocks.clear();
                for _ in 0..state.length(2 * STAGES)? {
                    self.restore_block(state)?;
                }
            }
            Kept::Gathered(bins, recent) => {
                recent.restore(state, MOST_NODES)?;
                (bins.first, bins.dropped) = (state.whole()?, state.flag()?);
                let moments = state.numbers()?;
                let (moments, rest) = moments.as_chunks::<MOMENTS>();
                // So far behind may the first bin be where all since is kept as nodes.
                let far = bins.first.unsigned_abs() > 1 << 32;
                if moments.len() > MOST_BINS || !rest.is_empty() || far {
                    return Err(Damaged::OutOfRange);
                }
                bins.moments.clear();
                bins.moments.extend(moments);
            }
            Kept::OnLattice => {}
        }
        Ok(())
    }

    fn restore_block(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let mut numbers = [0.0; 2 * STAGES];
        for number in &mut numbers {
            *number = state.finite()?;
        }
        let (position, weight) = numbers.split_at(STAGES);
        self.nodes.extend(position.iter().copied().zip(weight.iter().copied()));
        self.close_block(STAGES);
        Ok(())
    }

    /// The buffer of a restored lattice, with nodes about the origin of the lattice.
    pub(in crate::memory) fn restored_on_lattice(
        tip: &TipFunction,
        position: f64,
        nodes: Vec<(f64, f64)>,
    ) -> Self {
        Self { position, nodes, ..Self::on_lattice(tip) }
    }

    pub(in crate::memory) fn missed(&self) -> bool {
        self.forgotten().is_some()
    }

    pub(in crate::memory) fn set_missed(&mut self, missed: bool) {
        if let Kept::Gathered(bins, _) = &mut self.kept {
            bins.missed = missed;
        }
    }
}

/// Writes positions, then weights. A short block is filled up with its last position and weight 0.
fn save_block(nodes: &[(f64, f64)], state: &mut State) {
    let last = nodes.last().map_or(0.0, |node| node.0);
    let padding = || std::iter::repeat_n((last, 0.0), STAGES - nodes.len());
    let full = || nodes.iter().copied().chain(padding());
    full().for_each(|(position, _)| state.number(position));
    full().for_each(|(_, weight)| state.number(weight));
}
