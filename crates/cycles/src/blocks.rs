//! Vectors and matrices of the stages of a step.

use nalgebra::{SMatrix, SVector};
use stickslip_tip::collocation::STAGES;

pub(super) type Square = SMatrix<f64, STAGES, STAGES>;
pub(super) type Vector = SVector<f64, STAGES>;

/// The inverse, by Gauss-Jordan elimination in place with the largest entry of each column as pivot; `None` for a
/// singular matrix. It takes a fifth of the instructions of a general inverse.
pub(super) fn inverted(matrix: Square) -> Option<Square> {
    let mut rows: [[f64; STAGES]; STAGES] = matrix.transpose().into();
    let mut pivots = [0; STAGES];
    for k in 0..STAGES {
        let mut pivot = k;
        for i in k + 1..STAGES {
            if rows[i][k].abs() > rows[pivot][k].abs() {
                pivot = i;
            }
        }
        pivots[k] = pivot;
        rows.swap(k, pivot);
        let scale = 1.0 / rows[k][k];
        if !scale.is_finite() {
            return None;
        }
        // Column k of the inverse takes the place of that of the matrix, which is done with.
        rows[k][k] = 1.0;
        rows[k].iter_mut().for_each(|entry| *entry *= scale);
        let row = rows[k];
        for other in (0..STAGES).filter(|other| *other != k) {
            let factor = std::mem::take(&mut rows[other][k]);
            for i in 0..STAGES {
                rows[other][i] -= factor * row[i];
            }
        }
    }
    // Swapped rows of the matrix are columns of the inverse.
    for k in (0..STAGES).rev() {
        rows.iter_mut().for_each(|row| row.swap(k, pivots[k]));
    }
    Some(Square::from(rows).transpose())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comparison with the general inverse of nalgebra.
    #[test]
    fn an_inverse_is_the_inverse() {
        for seed in 0..50 {
            let entry = |i: usize, k: usize| {
                ((seed * 37 + i * i * 11 + k * k * k * 5 + 3 * i * k) as f64 * 0.7).sin()
            };
            let matrix = Square::from_fn(entry) + Square::identity() * (seed % 3) as f64;
            let (found, other) = (inverted(matrix).unwrap(), matrix.lu().try_inverse().unwrap());
            let size = other.amax() * matrix.amax();
            assert!((matrix * found - Square::identity()).amax() < 1e-13 * size, "{seed}");
            assert!((found - other).amax() < 1e-13 * size * other.amax(), "{seed}");
        }
        assert!(inverted(Square::zeros()).is_none());
        assert!(inverted(Square::from_element(1.0)).is_none());
        assert!(inverted(Square::from_element(f64::NAN)).is_none());
    }
}
