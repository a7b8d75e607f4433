//! Saving and restoring the state of the sum.

use super::Bank;
use crate::state::{Damaged, Reader, State};

impl Bank {
    /// Writes the states `z_j` and their exponents.
    pub(in crate::memory::modes) fn save(&self, state: &mut State) {
        for part in [0, 1] {
            state.numbers(self.exponents(part).into_iter());
            state.numbers(self.states(part).into_iter());
        }
    }

    pub(in crate::memory::modes) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        for part in [0, 1] {
            // A fit made on another machine may differ by a rounding: not to the last bit the same run.
            let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
            let (saved, ours) = (state.numbers()?, self.exponents(part));
            if saved.len() != ours.len() || !saved.iter().zip(&ours).all(same) {
                return Err(Damaged::Other("fit of f' by exponentials"));
            }
            let values = state.numbers()?;
            if values.len() != ours.len() {
                return Err(Damaged::Short);
            }
            let lanes = self.groups.iter_mut().map(|group| match part {
                0 => &mut group.state.0,
                _ => &mut group.state.1,
            });
            lanes.flatten().zip(values).for_each(|(z, value)| *z = value);
        }
        Ok(())
    }

    /// Real (`part` 0) or imaginary (`part` 1) parts of the exponents.
    fn exponents(&self, part: usize) -> Vec<f64> {
        let lanes = |group: &super::Group| [group.exponent.0, group.exponent.1][part];
        self.groups.iter().flat_map(lanes).collect()
    }

    fn states(&self, part: usize) -> Vec<f64> {
        let lanes = |group: &super::Group| [group.state.0, group.state.1][part];
        self.groups.iter().flat_map(lanes).collect()
    }
}
