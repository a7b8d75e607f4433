//! Vectors and matrices of the stages of a step.

use nalgebra::{SMatrix, SVector};
use stickslip_tip::collocation::STAGES;

pub(super) type Square = SMatrix<f64, STAGES, STAGES>;
pub(super) type Vector = SVector<f64, STAGES>;

/// The inverse, by Gauss-Jordan elimination with the largest entry of each column as pivot; `None` for a singular
/// matrix. Rows are as wide as the SIMD registers of the machine: a third of the time of a general inverse.
pub(super) fn inverted(matrix: Square) -> Option<Square> {
    // Row by row: the matrix, and beside it what becomes the inverse.
    let mut left: [[f64; STAGES]; STAGES] = matrix.transpose().into();
    let mut right: [[f64; STAGES]; STAGES] = Square::identity().into();
    for k in 0..STAGES {
        let larger = |a: &usize, b: &usize| left[*a][k].abs().total_cmp(&left[*b][k].abs());
        let pivot = (k..STAGES).max_by(larger)?;
        left.swap(k, pivot);
        right.swap(k, pivot);
        let scale = 1.0 / left[k][k];
        if !scale.is_finite() {
            return None;
        }
        for i in 0..STAGES {
            left[k][i] *= scale;
            right[k][i] *= scale;
        }
        let (row, beside) = (left[k], right[k]);
        for other in (0..STAGES).filter(|other| *other != k) {
            let factor = left[other][k];
            for i in 0..STAGES {
                left[other][i] -= factor * row[i];
                right[other][i] -= factor * beside[i];
            }
        }
    }
    Some(Square::from(right).transpose())
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
            let (found, other) = (inverted(matrix).unwrap(), matrix.try_inverse().unwrap());
            let size = other.amax() * matrix.amax();
            assert!((matrix * found - Square::identity()).amax() < 1e-13 * size, "{seed}");
            assert!((found - other).amax() < 1e-13 * size * other.amax(), "{seed}");
        }
        assert!(inverted(Square::zeros()).is_none());
        assert!(inverted(Square::from_element(1.0)).is_none());
        assert!(inverted(Square::from_element(f64::NAN)).is_none());
    }
}
