//! Saving and restoring the state of the sum.

use super::{Bank, Group, Lane, Terms};
use crate::state::{Damaged, Reader, State};

impl Bank {
    /// Writes the states `z_j` and their exponents.
    pub(in crate::memory::modes) fn save(&self, state: &mut State) {
        for part in [0, 1] {
            state.numbers(self.parts(part, |group| group.exponent).into_iter());
            state.numbers(self.parts(part, |group| group.state).into_iter());
        }
    }

    pub(in crate::memory::modes) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        for part in [0, 1] {
            // A fit made on another machine may differ by a rounding: not to the last bit the same run.
            let same = |(a, b): (&f64, &f64)| a.to_bits() == b.to_bits();
            let (saved, ours) = (state.numbers()?, self.parts(part, |group| group.exponent));
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

    /// Real (`part` 0) or imaginary (`part` 1) parts of the exponents or states, group by group.
    fn parts(&self, part: usize, of: fn(&Group) -> Terms) -> Vec<f64> {
        let lanes = |group: &Group| <[Lane; 2]>::from(of(group))[part];
        self.groups.iter().flat_map(lanes).collect()
    }
}
