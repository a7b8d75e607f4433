//! Conversion of a table (x, f) to a sum of Gaussians on a lattice: the coarsest on which a sum reproduces the rows to
//! their precision, or else that of the rows.

mod banded;
mod lattice;
mod precision;

use super::{Gaussian, TipFunctionError};
pub(crate) use lattice::Lattice;

pub(crate) const MIN_ROWS: usize = 8;
pub(crate) const MAX_ROWS: usize = 2000;
/// Largest allowed ratio of the last value to the largest: a larger one leaves open what lies beyond the
/// table.
const MAX_LAST_RATIO: f64 = 1e-3;

/// The Gaussians through the points (x, f).
pub(super) fn gaussians_through(x: &[f64], f: &[f64]) -> Result<Vec<Gaussian>, TipFunctionError> {
    validate(x, f)?;
    let lattice = Lattice::through(x, &[f]);
    Ok(lattice.gaussians(&lattice.coefficients(&[f])[0]))
}

fn validate(x: &[f64], f: &[f64]) -> Result<(), TipFunctionError> {
    let found = x.len().min(f.len());
    if let Some(i) = (0..found).find(|&i| !(x[i].is_finite() && f[i].is_finite())) {
        return Err(TipFunctionError::TableNotFinite { row: i + 1 });
    }
    validate_axis(&x[..found], MAX_ROWS)?;
    validate_decay(f[found - 1].abs(), f.iter().fold(0.0, |m: f64, v| m.max(v.abs())))
}

/// Checks that the last value is small relative to the largest one, and that this is not 0.
pub(crate) fn validate_decay(last: f64, largest: f64) -> Result<(), TipFunctionError> {
    if largest <= 0.0 {
        return Err(TipFunctionError::Zero);
    }
    let ratio = last / largest;
    if ratio > MAX_LAST_RATIO {
        return Err(TipFunctionError::TableDecay { ratio, most: MAX_LAST_RATIO });
    }
    Ok(())
}

/// Checks that the number of x is within limits, and that they are finite, increase and start at 0.
pub(crate) fn validate_axis(x: &[f64], max: usize) -> Result<(), TipFunctionError> {
    let found = x.len();
    if !(MIN_ROWS..=max).contains(&found) {
        return Err(TipFunctionError::TableLength { found, min: MIN_ROWS, max });
    }
    if let Some(i) = (1..found).find(|&i| x[i] <= x[i - 1]) {
        return Err(TipFunctionError::TableUnsorted { row: i + 1, x: x[i] });
    }
    if x[0].abs() > 1e-9 * x[found - 1] {
        return Err(TipFunctionError::TableStart(x[0]));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use crate::TipFunction;

    #[test]
    fn a_table_of_the_triple_gaussian_gives_it_back() {
        let exact = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        // Finer than the width of the Gaussians requires: only their saturation error remains.
        let x: Vec<f64> = (0..=120).map(|i| 0.1 * f64::from(i)).collect();
        let f: Vec<f64> = x.iter().map(|&x| exact.value(x)).collect();
        let table = TipFunction::table(&x, &f).unwrap();
        for i in 0..2000 {
            let x = -10.0 + 0.01 * f64::from(i);
            assert!((table.value(x) - exact.value(x)).abs() < 1e-11, "{x}");
            assert!((table.slope(x) - exact.slope(x)).abs() < 1e-9, "{x}");
        }
    }

    /// Many rows of a smooth footprint have no wider a band than few, and make the same function. The rows' own spacing
    /// would give bands of 46.9, 158, 797 and 1594.
    #[test]
    fn the_band_is_that_of_the_function_and_not_of_the_rows() {
        let exact = TipFunction::gaussian(1.0).unwrap();
        for rows in [60, 200, 1000, 2000] {
            let x: Vec<f64> = (0..rows).map(|i| 8.5 * f64::from(i) / f64::from(rows - 1)).collect();
            let f: Vec<f64> = x.iter().map(|&x| exact.value(x)).collect();
            let table = TipFunction::table(&x, &f).unwrap();
            assert!(table.band() < 100.0, "{rows} rows: {}", table.band());
            for i in 0..900 {
                let x = 0.011 * f64::from(i);
                let (slope, curvature) = table.slope_and_curvature(x);
                let right = exact.slope_and_curvature(x);
                assert!((table.value(x) - exact.value(x)).abs() < 1e-11, "{rows} {x}");
                assert!((slope - right.0).abs() < 2e-10, "{rows} {x}: {:e}", slope - right.0);
                assert!((curvature - right.1).abs() < 1e-8, "{rows} {x}");
            }
        }
    }

    fn of(rows: u32, length: f64, f: impl Fn(f64) -> f64) -> TipFunction {
        let x: Vec<f64> = (0..rows).map(|i| length * f64::from(i) / f64::from(rows - 1)).collect();
        let f: Vec<f64> = x.iter().map(|x| f(*x)).collect();
        TipFunction::table(&x, &f).unwrap()
    }

    fn gaussian(x: f64) -> f64 {
        (-0.5 * x * x).exp()
    }

    /// A step from the last value to zero would need the band of the rows, 800 and more.
    #[test]
    fn a_table_that_does_not_end_at_zero_continues_smoothly_to_zero() {
        for length in [6.0, 5.0, 4.0, 3.75] {
            let table = of(1000, length, gaussian);
            assert!(table.band() < 60.0, "{length}: {}", table.band());
            for i in 0..=1000 {
                let x = 0.001 * length * f64::from(i);
                assert!((table.value(x) - gaussian(x)).abs() < 1e-11, "{length} {x}");
                let beyond = length + 0.01 * f64::from(i);
                assert!(table.value(beyond).abs() < 1.01 * gaussian(length), "{length} {beyond}");
            }
            assert!(table.value(length + 4.0).abs() < 1e-9 * gaussian(length), "{length}");
        }
    }

    /// Interpolation of the same rows is off by up to 14 % in the curvature, with bands from 800 on.
    #[test]
    fn rows_are_reproduced_to_the_digits_they_have() {
        let rounded = |digits: usize| {
            move |x: f64| format!("{:.digits$}", gaussian(x)).parse::<f64>().unwrap()
        };
        let of_digits =
            |digits: usize| move |x: f64| format!("{:.digits$e}", gaussian(x)).parse().unwrap();
        for digits in [5, 6, 8] {
            for table in [of(1000, 8.0, rounded(digits)), of(1000, 8.0, of_digits(digits))] {
                let unit = 0.1_f64.powi(digits as i32);
                assert!(table.band() < 30.0, "{digits}: {}", table.band());
                for i in 0..=800 {
                    let x = 0.01 * f64::from(i);
                    assert!((table.value(x) - gaussian(x)).abs() < unit, "{digits} {x}");
                }
                let curvature = table.slope_and_curvature(0.0).1;
                assert!((curvature + 1.0).abs() < 30.0 * unit, "{digits}: {curvature}");
            }
        }
        // So few digits are taken as exact.
        assert!(of(1000, 8.0, rounded(3)).band() > 800.0);
    }

    /// A kink that only the rows' own lattice follows.
    #[test]
    fn details_of_the_rows_are_kept() {
        let x: Vec<f64> = (0..400).map(|i| 0.02 * f64::from(i)).collect();
        let f: Vec<f64> = x.iter().map(|x| (1.0 - x).max(0.0)).collect();
        let table = TipFunction::table(&x, &f).unwrap();
        for (x, f) in x.iter().zip(&f) {
            assert!((table.value(*x) - f).abs() < 1e-11, "{x}");
        }
        assert!(table.band() > 8.7 / 0.03, "{}", table.band());
    }

    fn uneven(f: impl Fn(f64) -> f64) -> TipFunction {
        let x: Vec<f64> = (0..=100).map(|i| 6.0 * (f64::from(i) / 100.0).powf(1.2)).collect();
        let f: Vec<f64> = x.iter().map(|x| f(*x)).collect();
        TipFunction::table(&x, &f).unwrap()
    }

    #[test]
    fn smooth_functions_of_uneven_rows_are_followed_as_of_even_ones() {
        let table = uneven(gaussian);
        for i in 0..600 {
            let x = 0.01 * f64::from(i);
            assert!((table.value(x) - gaussian(x)).abs() < 1e-11, "{x}");
        }
    }

    /// A kink of the third derivative at 1, which only the lattice of the rows follows.
    #[test]
    fn other_uneven_rows_are_followed_to_the_accuracy_of_a_spline() {
        let f = |x: f64| gaussian(x) + 0.1 * (1.0 - x * x).max(0.0).powi(3);
        let table = uneven(f);
        for i in 0..500 {
            let x = 0.01 * f64::from(i);
            assert!((table.value(x) - f(x)).abs() < 2e-5, "{x}");
        }
        assert!(table.band() > 100.0, "{}", table.band());
    }
}
