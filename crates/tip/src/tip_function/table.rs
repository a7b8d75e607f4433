//! Conversion of a table (x, f) to a sum of Gaussians.
//!
//! On a lattice of spacing Δ, Gaussians of width 1.2 Δ reproduce every function that the lattice resolves: the
//! saturation error of such a quasi-interpolation is 2 exp(-2π²·1.2²) ≈ 1e-12, and its matrix has a condition number
//! below 1e3. The lattice is the coarsest found by bisection that reproduces the rows to 4e-12, or else that of the
//! rows.

use super::{Gaussian, TipFunctionError};
use crate::elementary::exp;
use crate::spline::{CubicSpline, Ends};

pub(crate) const MIN_ROWS: usize = 8;
pub(crate) const MAX_ROWS: usize = 2000;
/// Largest allowed ratio of the last value to the largest: a larger one would leave a visible step at the end of the
/// table.
const MAX_LAST_RATIO: f64 = 1e-3;
pub(crate) const WIDTH_PER_SPACING: f64 = 1.2;
/// Number of lattice points of value 0 added beyond the table, so that the sum decays to zero and stays there.
const ZEROS_BEYOND: usize = 12;
/// Half-width of the matrix in lattice points: exp(-(11/1.2)²/2) is below round-off.
const NEIGHBOURS: usize = 11;

/// Largest error with which a coarser lattice reproduces the rows, as a fraction of the largest value: a few times the
/// saturation error.
const REPRODUCED: f64 = 4e-12;
/// Smallest number of spacings of a coarser lattice.
const FEWEST: usize = 12;

/// The Gaussians through the points (x, f).
pub(super) fn gaussians_through(x: &[f64], f: &[f64]) -> Result<Vec<Gaussian>, TipFunctionError> {
    validate(x, f)?;
    let (spacing, coefficients) = lattice_through(x, &[f]);
    Ok(gaussians_of(spacing, &coefficients[0]))
}

/// Finds the coarsest lattice that reproduces the rows of all these functions of x, where x is valid for a table.
/// Returns its spacing and, for each function, the coefficients of the even sum of Gaussians on the points ≥ 0. The
/// coarsest lattice allows the longest steps, because the width of the Gaussians limits them.
pub(crate) fn lattice_through(x: &[f64], functions: &[&[f64]]) -> (f64, Vec<Vec<f64>>) {
    let fine: Vec<Through> = functions.iter().map(|f| Through::of(on_a_lattice(x, f))).collect();
    let wanted = |through: &Through| through.samples[..x.len()].to_vec();
    let wanted: Vec<Vec<f64>> = fine.iter().map(wanted).collect();
    let largest = wanted.iter().flatten().fold(0.0, |m: f64, v| m.max(v.abs()));
    let reproduces = |sum: &Through, wanted: &[f64]| {
        let off = |(i, f): (usize, &f64)| (sum.value(i as f64 * fine[0].spacing) - f).abs();
        wanted.iter().enumerate().all(|at| off(at) <= REPRODUCED * largest)
    };
    let coarser = |count: usize| -> Option<Vec<Through>> {
        let times = (x.len() - 1) as f64 / count as f64;
        let each = fine.iter().zip(&wanted).map(|(fine, wanted)| {
            let sum = fine.on(count, times);
            reproduces(&sum, wanted).then_some(sum)
        });
        each.collect()
    };
    // Bisection: a number of spacings that suffices, and one that does not.
    let (mut enough, mut few) = (x.len() - 1, FEWEST);
    let mut coarsest = None;
    while few < enough {
        let middle = few.midpoint(enough);
        match coarser(middle) {
            Some(sums) => (coarsest, enough) = (Some(sums), middle),
            None => few = middle + 1,
        }
    }
    let found = coarsest.unwrap_or(fine);
    let spacing = found.first().map_or(0.0, |through| through.spacing);
    (spacing, found.into_iter().map(|through| through.coefficients).collect())
}

/// An even sum of Gaussians through values on a lattice.
struct Through {
    spacing: f64,
    /// Values on the points ≥ 0, the last of them 0.
    samples: Vec<f64>,
    /// Coefficients on the same points.
    coefficients: Vec<f64>,
}

impl Through {
    /// The sum through these values at multiples of the spacing, and 0 beyond.
    fn of((spacing, mut samples): (f64, Vec<f64>)) -> Self {
        samples.resize(samples.len() + ZEROS_BEYOND, 0.0);
        let origin = samples.len() - 1;
        let coefficients = interpolate(&mirrored(&samples, 1.0)).split_off(origin);
        Self { spacing, samples, coefficients }
    }

    /// The sum through the values of this sum on another lattice, of `count` spacings that are `times` as wide.
    fn on(&self, count: usize, times: f64) -> Self {
        let spacing = times * self.spacing;
        Self::of((spacing, (0..=count).map(|i| self.value(i as f64 * spacing)).collect()))
    }

    /// The sum at x ≥ 0.
    fn value(&self, x: f64) -> f64 {
        let at = x / self.spacing;
        #[expect(clippy::cast_possible_truncation, reason = "a few thousand")]
        let nearest = at.round() as isize;
        let reach = NEIGHBOURS as isize;
        let term = |j: isize| {
            let coefficient = self.coefficients.get(j.unsigned_abs()).copied().unwrap_or(0.0);
            let z = (at - j as f64) / WIDTH_PER_SPACING;
            coefficient * exp(-0.5 * z * z)
        };
        (nearest - reach..=nearest + reach).map(term).sum()
    }
}

/// The Gaussians on the whole lattice, from the coefficients on its points ≥ 0.
pub(crate) fn gaussians_of(spacing: f64, coefficients: &[f64]) -> Vec<Gaussian> {
    let width = WIDTH_PER_SPACING * spacing;
    let term = |i: usize, sign: f64| {
        #[expect(clippy::cast_precision_loss, reason = "i < 1e4")]
        let center = sign * i as f64 * spacing;
        Gaussian { amplitude: coefficients[i], center, width }
    };
    let mut terms = vec![term(0, 1.0)];
    terms.extend((1..coefficients.len()).flat_map(|i| [term(i, -1.0), term(i, 1.0)]));
    terms
}

/// v on x ≥ 0 continued to x < 0 as an even (`sign` 1) or odd (-1) function.
fn mirrored(v: &[f64], sign: f64) -> Vec<f64> {
    v.iter().skip(1).rev().map(|v| sign * v).chain(v.iter().copied()).collect()
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

/// Spacing and values on an evenly spaced lattice from 0: the table itself if its rows are evenly spaced, otherwise a
/// cubic spline through it (with slope 0 at 0, as for an even function) at its mean spacing.
fn on_a_lattice(x: &[f64], f: &[f64]) -> (f64, Vec<f64>) {
    let last = x[x.len() - 1];
    #[expect(clippy::cast_precision_loss, reason = "at most MAX_ROWS")]
    let lattice = |i: usize| last * i as f64 / (x.len() - 1) as f64;
    let spacing = lattice(1);
    let even = x.iter().enumerate().all(|(i, x)| (x - lattice(i)).abs() < 1e-6 * spacing);
    if even {
        return (spacing, f.to_vec());
    }
    // Mirrored, so that the spline is flat at 0 of itself.
    let spline = CubicSpline::through(mirrored(x, -1.0), mirrored(f, 1.0), Ends::Straight);
    (spacing, (0..x.len()).map(|i| spline.value(lattice(i))).collect())
}

/// Coefficients c of the sum Σ_j c_j exp(-((i-j)/1.2)²/2) = samples_i over a lattice, by conjugate
/// gradients; 300 steps are far beyond convergence at the matrix's condition number.
fn interpolate(samples: &[f64]) -> Vec<f64> {
    let n = samples.len();
    let fading: [f64; NEIGHBOURS + 1] = std::array::from_fn(gaussian);
    let apply = |v: &[f64]| -> Vec<f64> {
        let row = |i: usize| -> f64 {
            let near = i.saturating_sub(NEIGHBOURS)..(i + NEIGHBOURS + 1).min(n);
            near.map(|j| fading[i.abs_diff(j)] * v[j]).sum()
        };
        (0..n).map(row).collect()
    };
    let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
    let mut c = vec![0.0; n];
    let mut residual = samples.to_vec();
    let mut direction = residual.clone();
    let mut square = dot(&residual, &residual);
    let enough = square * 1e-32;
    for _ in 0..300 {
        if square <= enough {
            break;
        }
        let image = apply(&direction);
        let step = square / dot(&direction, &image);
        for i in 0..n {
            c[i] += step * direction[i];
            residual[i] -= step * image[i];
        }
        let next = dot(&residual, &residual);
        for i in 0..n {
            direction[i] = residual[i] + next / square * direction[i];
        }
        square = next;
    }
    c
}

fn gaussian(distance: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "small")]
    let z = distance as f64 / WIDTH_PER_SPACING;
    exp(-0.5 * z * z)
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

    #[test]
    fn uneven_rows_are_followed_to_the_accuracy_of_a_spline() {
        let x: Vec<f64> = (0..=100).map(|i| 6.0 * (f64::from(i) / 100.0).powf(1.2)).collect();
        let f: Vec<f64> = x.iter().map(|x| (-x * x / 2.0).exp()).collect();
        let table = TipFunction::table(&x, &f).unwrap();
        for i in 0..500 {
            let x = 0.01 * f64::from(i);
            assert!((table.value(x) - (-x * x / 2.0).exp()).abs() < 2e-6, "{x}");
        }
    }
}
