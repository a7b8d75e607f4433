//! Derivatives of the groove at the tip, of any order, from the state of the modes.
//!
//! On the side of the past f is `Σ_j Re(w_j/s_j e^{s_j ξ})`, so that the n-th derivative of the groove under the tip is
//! `Σ_j Re(w_j s_j^{n-1} z_j)`: a table of real numbers times the state.

use super::term::Term;
use crate::memory::derivatives::ROOM;
use multiversion::multiversion;

const LANES: usize = 4;
pub(crate) type Row = [f64; ROOM];

/// `w_j s_j^{n-1}`, n = 0, 1, …
#[derive(Debug, Clone)]
pub(crate) struct Powers {
    /// For each term, a row of `Re(w_j s_j^{n-1})` and one of `-Im(w_j s_j^{n-1})`, n = 0, 1, …: the factors of the real
    /// and of the imaginary part of its state.
    pub(crate) rows: Vec<Row>,
    /// The derivatives at 0 of the sum of exponentials for f.
    pub(crate) of_tip: Row,
}

impl Powers {
    pub(crate) fn new(terms: &[Term]) -> Self {
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

    /// Computes the first `count` derivatives, and further ones that fill the lanes. `states` contains real and
    /// imaginary parts in turn.
    pub(super) fn derivatives(&self, states: &[f64], count: usize, past: &mut Row) {
        sums(&self.rows, states, count, past);
    }
}

/// Also compiled for wider vectors: each lane is a separate sum.
#[multiversion(targets("x86_64+avx2"))]
fn sums(rows: &[Row], states: &[f64], count: usize, past: &mut Row) {
    match count.div_ceil(LANES) {
        0..=3 => groups::<3>(rows, states, past),
        4 => groups::<4>(rows, states, past),
        5 => groups::<5>(rows, states, past),
        6 => groups::<6>(rows, states, past),
        7 => groups::<7>(rows, states, past),
        _ => groups::<8>(rows, states, past),
    }
}

/// Sums of rows times states, of real and of imaginary parts, in the order of the terms: the same bits on every machine.
#[inline(always)]
fn groups<const GROUPS: usize>(rows: &[Row], states: &[f64], past: &mut Row) {
    let mut sums = [[[0.0; LANES]; GROUPS]; 2];
    for (rows, states) in rows.as_chunks::<2>().0.iter().zip(states.as_chunks::<2>().0) {
        for ((sums, row), state) in sums.iter_mut().zip(rows).zip(states) {
            for (sum, row) in sums.iter_mut().zip(row.as_chunks::<LANES>().0) {
                for (sum, power) in sum.iter_mut().zip(row) {
                    *sum += power * state;
                }
            }
        }
    }
    let [real, imaginary] = &sums;
    let both = real.iter().zip(imaginary);
    for (past, (real, imaginary)) in past.as_chunks_mut::<LANES>().0.iter_mut().zip(both) {
        for i in 0..LANES {
            past[i] = real[i] + imaginary[i];
        }
    }
}
