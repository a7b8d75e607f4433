//! Derivatives of quantities along the orbit with respect to its unknowns, as rows.

use super::blocks::Vector;
use multiversion::multiversion;
use nalgebra::DMatrix;
use num_complex::Complex;
use stickslip_tip::collocation::{STAGES, Stages};

/// Rows of derivatives with respect to the state X at t = 0, the period and the free parameter, and last the change
/// that solves the stage equations. They are stored row by row.
#[derive(Debug, Clone, Default)]
pub(super) struct Sensitivity {
    columns: usize,
    entries: Vec<f64>,
}

/// Columns beyond those of the state: period, free parameter, correction.
const CONSTANTS: usize = 3;
/// Room, in entries, for nearly all cycles: memory that is never written costs nothing.
const USUAL_ROOM: usize = 1 << 18;
/// Number of columns in a block, which stays in registers.
const LANES: usize = 4;

impl Sensitivity {
    fn zeros(rows: usize, columns: usize) -> Self {
        Self { columns, entries: vec![0.0; rows * columns.next_multiple_of(LANES)] }
    }

    /// No rows yet of as many columns as these, with room for this number: in the memory of others if it suffices.
    pub(super) fn none_in(&self, others: Self, rows: usize) -> Self {
        let (mut entries, count) = (others.entries, rows * self.stride());
        entries.clear();
        if entries.capacity() < count {
            // First without the old memory, which the new one may then begin with.
            entries = vec![];
            entries.reserve_exact(count.next_power_of_two().max(USUAL_ROOM));
        }
        Self { columns: self.columns, entries }
    }

    /// Drops all rows, and keeps their memory.
    pub(super) fn clear(&mut self) {
        self.entries.clear();
    }

    /// Number of entries for which there is room.
    pub(super) fn room(&self) -> usize {
        self.entries.capacity()
    }

    pub(super) fn rows(&self) -> usize {
        self.entries.len() / self.stride()
    }

    /// Derivatives of a state of this length with respect to itself.
    pub(super) fn identity(n: usize) -> Self {
        let mut identity = Self::zeros(n, n + CONSTANTS);
        for i in 0..n {
            identity.row_mut(i)[i] = 1.0;
        }
        identity
    }

    /// Derivatives of a state with respect to unknowns, each of which changes it by a column.
    pub(super) fn of(columns: &DMatrix<f64>) -> Self {
        let mut found = Self::zeros(columns.nrows(), columns.ncols() + CONSTANTS);
        for (k, column) in columns.column_iter().enumerate() {
            found.set_column(k, column.iter().copied());
        }
        found
    }

    pub(super) fn set_column(&mut self, k: usize, column: impl Iterator<Item = f64>) {
        column.enumerate().for_each(|(i, value)| self.row_mut(i)[k] = value);
    }

    /// The columns of the derivatives.
    pub(super) fn columns(&self) -> DMatrix<f64> {
        DMatrix::from_fn(self.rows(), self.columns - CONSTANTS, |i, k| self.row(i)[k])
    }

    /// Number of entries of a row in memory; the last of them are unused.
    fn stride(&self) -> usize {
        self.columns.next_multiple_of(LANES)
    }

    pub(super) fn row(&self, i: usize) -> &[f64] {
        &self.entries[i * self.stride()..][..self.columns]
    }

    fn row_mut(&mut self, i: usize) -> &mut [f64] {
        let (stride, columns) = (self.stride(), self.columns);
        &mut self.entries[i * stride..][..columns]
    }

    pub(super) fn clear_row(&mut self, i: usize) {
        self.row_mut(i).fill(0.0);
    }

    /// The derivatives of row i with respect to the period and the free parameter, and its correction.
    pub(super) fn constants(&mut self, i: usize) -> &mut [f64] {
        let from = self.columns - CONSTANTS;
        &mut self.row_mut(i)[from..]
    }

    /// Appends one row per stage: `Σ_j factors[j][k]` times row j of the state, and these constants.
    pub(super) fn append_contracted(
        &mut self,
        state: &Self,
        factors: &[Stages],
        constants: &[Vector; CONSTANTS],
    ) {
        self.columns = state.columns;
        let (first, stride) = (self.rows(), self.stride());
        self.entries.resize((first + STAGES) * stride, 0.0);
        contract(&state.entries, stride, factors, &mut self.entries[first * stride..]);
        for i in 0..STAGES {
            for (column, constant) in self.constants(first + i).iter_mut().zip(constants) {
                *column += constant[i];
            }
        }
    }

    /// The rows of the stages appended last.
    fn last_stages(&self) -> &[f64] {
        &self.entries[self.entries.len() - STAGES * self.stride()..]
    }

    /// Adds `Σ_k factors[j][k]` times the row of stage k, of those appended last to `stages`, to each row j.
    pub(super) fn add_expanded(&mut self, factors: &[Stages], stages: &Self) {
        let stride = self.stride();
        expand(stages.last_stages(), stride, factors, &mut self.entries);
    }

    /// Adds `Σ_k factors[i][k]` times the row of stage k, of those appended last to `stages`, to each row i of those
    /// appended last to these.
    pub(super) fn add_to_last(&mut self, factors: &[Stages; STAGES], stages: &Self) {
        let stride = self.stride();
        let first = self.entries.len() - STAGES * stride;
        expand(stages.last_stages(), stride, factors, &mut self.entries[first..]);
    }

    /// Multiplies complex quantities by these factors. Their real parts are the rows from row `from` on, and their
    /// imaginary parts follow.
    pub(super) fn multiply_pairs(&mut self, from: usize, factors: &[Complex<f64>]) {
        let stride = self.stride();
        let pairs = &mut self.entries[from * stride..][..2 * factors.len() * stride];
        let (re, im) = pairs.split_at_mut(factors.len() * stride);
        turn(re, im, stride, factors);
    }

    /// Row i times the changes of the unknowns, with 1 for the correction.
    pub(super) fn change(&self, i: usize, unknowns: &[f64]) -> f64 {
        self.row(i).iter().zip(unknowns).map(|(s, u)| s * u).sum()
    }
}

/// Multiplies each complex row by its factor.
///
/// Compiled for wider vectors too: columns are independent of each other.
#[multiversion(targets("x86_64+avx2"))]
fn turn(re: &mut [f64], im: &mut [f64], stride: usize, factors: &[Complex<f64>]) {
    let rows = re.chunks_exact_mut(stride).zip(im.chunks_exact_mut(stride));
    for ((re, im), factor) in rows.zip(factors) {
        let (re, im) = (re.as_chunks_mut::<LANES>().0, im.as_chunks_mut::<LANES>().0);
        for (re, im) in re.iter_mut().zip(im) {
            for c in 0..LANES {
                let (a, b) = (re[c], im[c]);
                (re[c], im[c]) = (a * factor.re - b * factor.im, a * factor.im + b * factor.re);
            }
        }
    }
}

/// Sets row k of `into` to `Σ_j factors[j][k]` times row j of `rows`.
///
/// Compiled for wider vectors too: lanes and the order of sums are the same.
#[multiversion(targets("x86_64+avx2"))]
fn contract(rows: &[f64], stride: usize, factors: &[Stages], into: &mut [f64]) {
    for column in (0..stride).step_by(LANES) {
        let mut sums = [[0.0; LANES]; STAGES];
        for (factors, row) in factors.iter().zip(rows.chunks_exact(stride)) {
            let row: &[f64; LANES] = row[column..].first_chunk().expect("strides are whole lanes");
            for (sum, factor) in sums.iter_mut().zip(factors) {
                for c in 0..LANES {
                    sum[c] += factor * row[c];
                }
            }
        }
        for (to, sum) in into.chunks_exact_mut(stride).zip(&sums) {
            to[column..column + LANES].copy_from_slice(sum);
        }
    }
}

/// Adds `Σ_k factors[j][k]` times row k of the stages to each row j.
///
/// Compiled for wider vectors too: lanes and the order of sums are the same.
#[multiversion(targets("x86_64+avx2"))]
fn expand(stages: &[f64], stride: usize, factors: &[Stages], rows: &mut [f64]) {
    for column in (0..stride).step_by(LANES) {
        let mut block = [[0.0; LANES]; STAGES];
        for (block, stage) in block.iter_mut().zip(stages.chunks_exact(stride)) {
            block.copy_from_slice(&stage[column..column + LANES]);
        }
        for (factors, row) in factors.iter().zip(rows.chunks_exact_mut(stride)) {
            let mut sum = [0.0; LANES];
            for (factor, stage) in factors.iter().zip(&block) {
                for c in 0..LANES {
                    sum[c] += factor * stage[c];
                }
            }
            let row: &mut [f64; LANES] =
                row[column..].first_chunk_mut().expect("strides are whole lanes");
            for c in 0..LANES {
                row[c] += sum[c];
            }
        }
    }
}
