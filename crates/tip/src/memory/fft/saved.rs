//! Saving and restoring the lattice, with the history buffer that belongs to it.

use super::super::record::Record;
use super::{CELLS_PER_ORIGIN, Fft, most_pending, plan};
use crate::TipFunction;
use crate::state::{Damaged, Reader, State};
use std::ops::Range;
use stickslip_convolution::Density;

impl Fft {
    /// Writes the lattice. `visited` is the whole past, if the lattice may have to be built anew from it.
    pub(crate) fn save(&self, visited: Option<&Record>, state: &mut State) {
        state.number(self.position);
        state.number(self.convolver.plan().separation);
        state.pairs(self.pending.iter());
        state.flag(visited.is_some());
        state.pairs(visited.map_or(&[][..], Record::nodes).iter());
        let (first, sums, excess) = self.density.parts();
        state.whole(first);
        state.numbers(sums.iter().copied());
        state.numbers(excess.iter().copied());
        state.whole(self.field.first_cell());
        [self.known.start, self.known.end].into_iter().for_each(|cell| state.whole(cell));
    }

    /// Restores the lattice, and returns the history buffer that was saved with it.
    pub(crate) fn restore(&mut self, state: &mut Reader) -> Result<Option<Record>, Damaged> {
        self.position = state.finite()?;
        let separation = state.finite()?;
        if separation.to_bits() != self.convolver.plan().separation.to_bits() {
            self.convolver = plan(&self.tip, within(separation, &self.tip)?);
        }
        self.heights = None;
        self.most_pending = most_pending(&self.convolver);
        self.pending = state.pairs()?;
        let (recorded, nodes) = (state.flag()?, state.pairs()?);
        let (first, sums, excess) = (state.whole()?, state.numbers()?, state.numbers()?);
        let density = Density::from_parts(self.convolver.spacing(), first, sums, excess);
        self.density = density.ok_or(Damaged::OutOfRange)?;
        self.convolver.convolve(&self.density, state.whole()?, &mut self.field);
        self.known = state.whole()?..state.whole()?;
        let as_made = recorded == self.keeps_all();
        if as_made && self.field_holds(self.position) && self.stands_on_its_past() {
            let record = || Record::restored_on_lattice(&self.tip, self.position, nodes);
            return Ok(recorded.then(record));
        }
        Err(Damaged::OutOfRange)
    }

    /// Whether the tip is at the end of its past and, unless the whole past is kept, close to the origin.
    fn stands_on_its_past(&self) -> bool {
        let (cells, cell) = (self.density.range(), self.position / self.convolver.spacing());
        let about = |cells: &Range<i64>| {
            (cells.start as f64 - 1.0..=cells.end as f64 + 1.0).contains(&cell)
        };
        let near = self.keeps_all() || cell.abs() <= 4.0 * CELLS_PER_ORIGIN as f64;
        near && (cells.is_empty() || about(&cells))
    }
}

/// The separation of a saved state, if a run can have reached it.
fn within(separation: f64, tip: &TipFunction) -> Result<f64, Damaged> {
    let allowed = tip.reach().is_none() && (1.0..=1e6).contains(&separation);
    if allowed { Ok(separation) } else { Err(Damaged::OutOfRange) }
}
