//! Tests of a residual against noise in the directions that some columns add to the span of others.

use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, FisherSnedecor};

/// Smallest fraction of a column outside of the span of the others that adds a direction.
const PART: f64 = 1e-5;

/// An orthonormal basis of the directions that `more` adds to the span of `base`, by the Gram-Schmidt method, applied
/// twice.
pub(super) fn beyond(base: &[Vec<f64>], more: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut basis: Vec<Vec<f64>> = vec![];
    let mut given = 0;
    for (i, column) in base.iter().chain(more).enumerate() {
        let before = dot(column, column).sqrt();
        let mut left = column.clone();
        for _ in 0..2 {
            for unit in &basis {
                let along = dot(unit, &left);
                left.iter_mut().zip(unit).for_each(|(v, u)| *v -= along * u);
            }
        }
        let size = dot(&left, &left).sqrt();
        if size > PART * before && size.is_finite() {
            left.iter_mut().for_each(|v| *v /= size);
            basis.push(left);
        }
        if i + 1 == base.len() {
            given = basis.len();
        }
    }
    basis.split_off(given)
}

pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The mean square of the residuals r along m orthonormal directions Q, in units of its expectation:
/// d'(Q'ΣQ + mean of s s')⁻¹d/m, d = Q'r. `times` is the product with the covariance Σ of the noise; the `shifts`,
/// s = Q'shift, are samples of a further error of the model.
pub(super) fn size(
    directions: &[Vec<f64>],
    residuals: &[f64],
    times: &dyn Fn(&[f64]) -> Vec<f64>,
    shifts: &[Vec<f64>],
) -> Option<f64> {
    let count = directions.len();
    if count == 0 {
        return None;
    }
    let onto = |v: &[f64]| DVector::from_iterator(count, directions.iter().map(|q| dot(q, v)));
    let columns: Vec<DVector<f64>> = directions.iter().map(|q| onto(&times(q))).collect();
    let mut covariance = DMatrix::from_columns(&columns);
    for shift in shifts {
        let shift = onto(shift);
        covariance += &shift * shift.transpose() / shifts.len() as f64;
    }
    let found = onto(residuals);
    let size = found.dot(&covariance.cholesky()?.solve(&found)) / count as f64;
    size.is_finite().then_some(size)
}

/// The probability that noise alone gives this [`size`] or more in `count` directions, from the F distribution
/// F(`count`, `freedom`).
pub(super) fn by_noise(size: f64, count: usize, freedom: f64) -> Option<f64> {
    FisherSnedecor::new(count as f64, freedom.clamp(2.0, 1e6)).ok().map(|law| law.sf(size))
}

/// The probability of the [`size`] of this residual by noise.
pub(super) fn probability(
    directions: &[Vec<f64>],
    residuals: &[f64],
    times: &dyn Fn(&[f64]) -> Vec<f64>,
    shifts: &[Vec<f64>],
    freedom: f64,
) -> Option<f64> {
    by_noise(size(directions, residuals, times, shifts)?, directions.len(), freedom)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn directions_are_new_and_orthonormal() {
        let x: Vec<f64> = (0..9).map(f64::from).collect();
        let (ones, squares) = (vec![1.0; 9], x.iter().map(|x| x * x).collect::<Vec<f64>>());
        let found = beyond(&[ones.clone(), x.clone()], &[squares, ones.clone(), x.clone()]);
        assert_eq!(found.len(), 1);
        assert!((dot(&found[0], &found[0]) - 1.0).abs() < 1e-12);
        assert!(dot(&found[0], &ones).abs() < 1e-12 && dot(&found[0], &x).abs() < 1e-11);
    }

    /// F(2, ∞): the probability of a mean square above s is e^-s.
    #[test]
    fn two_directions_have_the_probability_of_chi_squared() {
        let white = |v: &[f64]| v.to_vec();
        let directions = [vec![1.0, 0.0, 0.0], vec![0.0, 1.0, 0.0]];
        let found = probability(&directions, &[1.0, 2.0, 9.0], &white, &[], 1e6).unwrap();
        assert!((found - (-2.5_f64).exp()).abs() < 1e-5, "{found}");
        let shifts = [vec![0.0, 3_f64.sqrt(), 0.0]];
        let less = probability(&directions, &[1.0, 2.0, 9.0], &white, &shifts, 1e6).unwrap();
        assert!((less - (-1.0_f64).exp()).abs() < 1e-5, "{less}");
    }
}
