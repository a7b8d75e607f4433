//! Elimination for the linear systems of a step, s×s for each coordinate. They are solved once or twice per step, and
//! are so small that a general routine would spend most of its time on bookkeeping.

use crate::collocation::STAGES;

/// P J = L U with partial pivoting: L below the diagonal, U on and above it.
pub(crate) struct Factors<const N: usize = STAGES> {
    rows: [[f64; N]; N],
    order: [usize; N],
}

impl<const N: usize> Factors<N> {
    /// The factors; `None` for a matrix that is singular or not finite.
    #[inline]
    pub(crate) fn of(mut rows: [[f64; N]; N]) -> Option<Self> {
        let mut order = std::array::from_fn(|i| i);
        for k in 0..N {
            let pivot = (k..N).max_by(|&i, &j| rows[i][k].abs().total_cmp(&rows[j][k].abs()))?;
            if !(rows[pivot][k].is_finite() && rows[pivot][k].abs() > 0.0) {
                return None;
            }
            rows.swap(k, pivot);
            order.swap(k, pivot);
            let (above, below) = rows.split_at_mut(k + 1);
            let top = &above[k];
            for row in below {
                let factor = row[k] / top[k];
                for j in k + 1..N {
                    row[j] -= factor * top[j];
                }
                row[k] = factor;
            }
        }
        Some(Self { rows, order })
    }

    /// J⁻¹ `right`
    #[inline]
    pub(crate) fn solve(&self, right: &[f64; N]) -> [f64; N] {
        let mut x = self.order.map(|i| right[i]);
        for i in 1..N {
            for j in 0..i {
                x[i] -= self.rows[i][j] * x[j];
            }
        }
        for i in (0..N).rev() {
            for j in i + 1..N {
                x[i] -= self.rows[i][j] * x[j];
            }
            x[i] /= self.rows[i][i];
        }
        x
    }

    /// J⁻¹ times each column of `right`, in SIMD lanes.
    pub(crate) fn solve_columns(&self, right: &[[f64; N]; N]) -> [[f64; N]; N] {
        let mut x = self.order.map(|i| right[i]);
        for i in 0..N {
            for j in 0..i {
                x[i] = less(x[i], self.rows[i][j], x[j]);
            }
        }
        for i in (0..N).rev() {
            for j in i + 1..N {
                x[i] = less(x[i], self.rows[i][j], x[j]);
            }
            x[i] = x[i].map(|x| x / self.rows[i][i]);
        }
        x
    }
}

/// a - factor b
fn less<const N: usize>(a: [f64; N], factor: f64, b: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| a[i] - factor * b[i])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collocation::{Stages, apply};

    #[test]
    fn solutions_satisfy_their_equations_where_rows_must_be_exchanged_too() {
        // No pivot on the diagonal: a cyclic permutation, disturbed.
        let matrix: [Stages; STAGES] = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let small = 0.01 * ((3 * i + 5 * j) as f64).sin();
                small + if j == (i + 1) % STAGES { 2.0 } else { 0.0 }
            })
        });
        let wanted: Stages = std::array::from_fn(|i| i as f64 - 2.5);
        let (factors, right) = (Factors::of(matrix).unwrap(), apply(&matrix, &wanted));
        let found = factors.solve(&right);
        for (a, b) in found.iter().zip(wanted) {
            assert!((a - b).abs() < 1e-14, "{a} {b}");
        }
        // Columns of which each is another multiple.
        let columns =
            factors.solve_columns(&right.map(|b| [b, 2.0 * b, -b, 0.5 * b, 4.0 * b, 0.0]));
        for (row, x) in columns.iter().zip(found) {
            let wanted = [x, 2.0 * x, -x, 0.5 * x, 4.0 * x, 0.0];
            assert_eq!(row.map(f64::to_bits), wanted.map(f64::to_bits));
        }
    }

    #[test]
    fn a_singular_matrix_has_no_factors() {
        let rows = [[1.0; STAGES]; STAGES];
        assert!(Factors::of(rows).is_none());
        assert!(Factors::of([[f64::NAN; STAGES]; STAGES]).is_none());
    }
}
