//! Derivatives of the groove at the tip, of any order, from the state of the modes.
//!
//! On the side of the past f is `Σ_j Re(w_j/s_j e^{s_j ξ})`, so that the n-th derivative of the groove under the tip is
//! `Σ_j Re(w_j s_j^{n-1} z_j)`: a table of real numbers times the state.

use super::term::Term;
use crate::memory::derivatives::{Derivatives, ROOM};
use num_complex::Complex;

/// Lanes that are summed side by side.
const LANES: usize = 4;
type Row = [f64; ROOM];

/// `w_j s_j^{n-1}`, n = 0, 1, …
#[derive(Debug, Clone)]
pub(super) struct Powers {
    /// Of each term a row for the real part of its state and one for the imaginary part.
    rows: Vec<Row>,
    /// The derivatives of f at 0, as the sum has them.
    of_tip: Row,
}

impl Powers {
    pub(super) fn new(terms: &[Term]) -> Self {
        let mut rows = Vec::with_capacity(2 * terms.len());
        let mut of_tip = [0.0; ROOM];
        for Term { exponent, weight } in terms {
            let (mut real, mut imaginary) = ([0.0; ROOM], [0.0; ROOM]);
            let mut power = weight / exponent;
            for n in 0..ROOM {
                (real[n], imaginary[n]) = (power.re, -power.im);
                of_tip[n] += power.re;
                power *= exponent;
            }
            rows.extend([real, imaginary]);
        }
        Self { rows, of_tip }
    }

    /// The first `count` derivatives, and as many more as fill the lanes.
    pub(super) fn derivatives(
        &self,
        states: impl Iterator<Item = Complex<f64>>,
        count: usize,
        told: &mut Derivatives,
    ) {
        let states = states.flat_map(|z| [z.re, z.im]);
        told.of_tip = self.of_tip;
        match count.div_ceil(LANES) {
            0..=3 => self.sums::<3>(states, &mut told.past),
            4 => self.sums::<4>(states, &mut told.past),
            5 => self.sums::<5>(states, &mut told.past),
            6 => self.sums::<6>(states, &mut told.past),
            7 => self.sums::<7>(states, &mut told.past),
            _ => self.sums::<8>(states, &mut told.past),
        }
    }

    /// Row times state, in the order of the terms: the same bits on every machine.
    #[inline]
    fn sums<const GROUPS: usize>(&self, states: impl Iterator<Item = f64>, past: &mut Row) {
        let mut sums = [[0.0; LANES]; GROUPS];
        for (row, state) in self.rows.iter().zip(states) {
            for (sum, row) in sums.iter_mut().zip(row.as_chunks::<LANES>().0) {
                for (sum, power) in sum.iter_mut().zip(row) {
                    *sum += power * state;
                }
            }
        }
        past[..LANES * GROUPS].copy_from_slice(sums.as_flattened());
    }
}
