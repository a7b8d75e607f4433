//! Linear least squares with a banded matrix, by Givens rotations.

/// Number of neighbouring unknowns in a row.
pub(super) const BAND: usize = 23;

/// The triangular factor R of the rows so far, and the right-hand sides that belong to it.
pub(super) struct LeastSquares {
    /// The entries of each row of R from the diagonal on.
    triangle: Vec<[f64; BAND]>,
    /// Right-hand sides, for each row of R the values of all systems.
    right: Vec<Vec<f64>>,
}

impl LeastSquares {
    /// No rows yet, for `systems` right-hand sides.
    pub(super) fn new(unknowns: usize, systems: usize) -> Self {
        Self { triangle: vec![[0.0; BAND]; unknowns], right: vec![vec![0.0; systems]; unknowns] }
    }

    /// Adds the row Σ_j `row[j]` c_{first + j} = `right`. Rows come in the order of `first`, so that R keeps the band.
    pub(super) fn add(&mut self, first: usize, mut row: [f64; BAND], mut right: Vec<f64>) {
        let to = (first + BAND).min(self.triangle.len());
        for (j, i) in (first..to).enumerate() {
            let below = row[j];
            let pivot = self.triangle[i][0];
            if below.abs() <= 0.0 {
                continue;
            }
            let length = (pivot * pivot + below * below).sqrt();
            let rotate = |upper: &mut f64, lower: &mut f64| {
                let (u, v) = (*upper, *lower);
                (*upper, *lower) =
                    ((pivot * u + below * v) / length, (pivot * v - below * u) / length);
            };
            self.triangle[i].iter_mut().zip(&mut row[j..]).for_each(|(u, v)| rotate(u, v));
            self.right[i].iter_mut().zip(&mut right).for_each(|(u, v)| rotate(u, v));
        }
    }

    /// The unknowns of each system. There must be rows enough to determine them.
    pub(super) fn solved(self) -> Vec<Vec<f64>> {
        let unknowns = self.triangle.len();
        let systems = self.right.first().map_or(0, Vec::len);
        let mut solutions = vec![vec![0.0; unknowns]; systems];
        for (system, solution) in solutions.iter_mut().enumerate() {
            for i in (0..unknowns).rev() {
                let [pivot, beyond @ ..] = &self.triangle[i];
                let known: f64 = beyond.iter().zip(&solution[i + 1..]).map(|(r, c)| r * c).sum();
                solution[i] = (self.right[i][system] - known) / pivot;
            }
        }
        solutions
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// Comparison with the singular value decomposition of the full matrix, of rows with weights from 1 to 1e-6.
    #[test]
    fn the_solution_is_that_of_the_full_matrix() {
        let (unknowns, rows) = (40, 90);
        let entry = |i: usize, j: usize| ((7 * i * i + 13 * j + 3 * i * j) as f64).sin();
        let weight = |i: usize| 10_f64.powi(-((i % 7) as i32));
        let mut equations = LeastSquares::new(unknowns, 2);
        let mut full = DMatrix::zeros(rows, unknowns);
        let right =
            |system: usize| DVector::from_fn(rows, |i, _| weight(i) * entry(i, 50 + system));
        for i in 0..rows {
            let first = i / 3;
            let row = std::array::from_fn(|j| weight(i) * entry(i, j));
            (0..BAND.min(unknowns - first)).for_each(|j| full[(i, first + j)] = row[j]);
            equations.add(first, row, vec![right(0)[i], right(1)[i]]);
        }
        let decomposed = full.svd(true, true);
        for (system, solution) in equations.solved().iter().enumerate() {
            let expected = decomposed.solve(&right(system), 0.0).unwrap();
            let off = |(a, b): (&f64, &f64)| (a - b).abs();
            let error = solution.iter().zip(&expected).map(off).fold(0.0, f64::max);
            assert!(error < 1e-9 * expected.amax(), "{error:e} of {:e}", expected.amax());
        }
    }
}
