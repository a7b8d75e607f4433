//! Sums of Gaussians on a lattice, by least squares.
//!
//! On a lattice of spacing Δ, Gaussians of width 1.2 Δ reproduce every function that the lattice resolves: the
//! saturation error of such a quasi-interpolation is 2 exp(-2π²·1.2²) ≈ 1e-12, and its matrix has a condition number
//! below 1e3.

use super::banded::{BAND, LeastSquares};
use super::precision::Precision;
use crate::Gaussian;
use crate::elementary::exp;
use crate::spline::{CubicSpline, Ends};

const WIDTH_PER_SPACING: f64 = 1.2;
/// Half-width of the matrix in lattice points: exp(-(11/1.2)²/2) is below round-off.
const NEIGHBOURS: usize = BAND / 2;
/// Smallest number of spacings of a coarser lattice.
const FEWEST: usize = 12;
/// Number of points of a coarser lattice beyond the table, where the sum falls to zero.
const BEYOND: usize = 8;
/// Number of points of value 0 beyond the table on the lattice of the rows.
const ZEROS_BEYOND: usize = 12;
/// Largest value beyond the table, as a multiple of the last value or of the precision.
const LARGEST_BEYOND: f64 = 2.0;

/// Even sums of Gaussians on a lattice of points ≥ 0, by least squares: at the rows and beyond them, where they fall to
/// zero.
pub(crate) struct Lattice {
    /// Distance Δ of the points.
    pub(crate) spacing: f64,
    points: usize,
    /// Those of the rows first, then those beyond.
    equations: Vec<Equation>,
    /// Places of the rows, if equations at evenly spaced ones take their place.
    uneven: Option<Vec<f64>>,
}

/// The value of a sum at one place, in terms of its coefficients.
struct Equation {
    weight: f64,
    /// The first point whose Gaussians are not negligible.
    first: usize,
    /// The values of its Gaussians and of those of the following points.
    values: [f64; BAND],
}

impl Equation {
    fn at(x: f64, spacing: f64, weight: f64) -> Self {
        let at = x / spacing;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "< 1e4")]
        let first = (at.round() as usize).saturating_sub(NEIGHBOURS);
        let gaussian = |apart: f64| {
            let z = apart / WIDTH_PER_SPACING;
            exp(-0.5 * z * z)
        };
        // With the one at the opposite point.
        let pair = |j: usize| {
            let opposite = if j > 0 && first <= NEIGHBOURS { gaussian(at + j as f64) } else { 0.0 };
            gaussian(at - j as f64) + opposite
        };
        Self { weight, first, values: std::array::from_fn(|j| pair(first + j)) }
    }

    fn value(&self, coefficients: &[f64]) -> f64 {
        coefficients[self.first..].iter().zip(self.values).map(|(c, value)| c * value).sum()
    }
}

impl Lattice {
    /// The coarsest lattice that reproduces the rows of all these functions of x to their precision, or else that of
    /// the rows, where x is valid for a table.
    pub(crate) fn through(x: &[f64], functions: &[&[f64]]) -> Self {
        Self::coarsest(x, functions).unwrap_or_else(|| Self::of_rows(x))
    }

    /// The coarsest lattice allows the longest steps, because the width of the Gaussians limits them.
    fn coarsest(x: &[f64], functions: &[&[f64]]) -> Option<Self> {
        let precision = Precision::of(functions);
        let with = |count: usize| {
            let lattice = Self::coarser(x, functions, &precision.rows, count);
            lattice.reproduces(functions, &precision.rows).then_some(lattice)
        };
        let gap = x.windows(2).fold(0.0, |gap: f64, x| gap.max(x[1] - x[0]));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "< MAX_ROWS")]
        let most = (x[x.len() - 1] / gap) as usize;
        // Bisection: a number of spacings that suffices, and one that does not. Each spacing contains a row.
        let (mut enough, mut few) = (most, FEWEST);
        let mut coarsest = None;
        while few < enough {
            let middle = few.midpoint(enough);
            match with(middle) {
                Some(lattice) => (coarsest, enough) = (Some(lattice), middle),
                None => few = middle + 1,
            }
        }
        if !precision.is_rounding || coarsest.is_none() {
            return coarsest;
        }
        // A third finer, so that the error of the lattice is small beside that of rounding.
        with((4 * enough).div_ceil(3).min(most)).or(coarsest)
    }

    /// The lattice with `count` spacings between 0 and the last row.
    fn coarser(x: &[f64], functions: &[&[f64]], precision: &[f64], count: usize) -> Self {
        let last = x.len() - 1;
        let spacing = x[last] / count as f64;
        let rows = x.iter().zip(precision).map(|(x, precision)| (*x, 1.0 / precision));
        // As small a weight as the values are large there: they are to fall to zero, but not at the expense of rows.
        let size = functions.iter().fold(10.0 * precision[last], |size, f| size.max(f[last].abs()));
        let beyond =
            (1..=2 * BEYOND + NEIGHBOURS).map(|i| (x[last] + 0.5 * i as f64 * spacing, 1.0 / size));
        let at = |(x, weight)| Equation::at(x, spacing, weight);
        let equations = rows.chain(beyond).map(at).collect();
        Self { spacing, points: count + 1 + BEYOND, equations, uneven: None }
    }

    /// The lattice with as many points as rows, and zeros beyond them.
    fn of_rows(x: &[f64]) -> Self {
        let spacing = x[x.len() - 1] / (x.len() - 1) as f64;
        let points = x.len() + ZEROS_BEYOND;
        let at = |i: usize| Equation::at(i as f64 * spacing, spacing, 1.0);
        let even = |(i, x): (usize, &f64)| (x - i as f64 * spacing).abs() < 1e-6 * spacing;
        let uneven = (!x.iter().enumerate().all(even)).then(|| x.to_vec());
        Self { spacing, points, equations: (0..points).map(at).collect(), uneven }
    }

    /// Whether the sums reproduce the rows to their precision, and remain small beyond them.
    fn reproduces(&self, functions: &[&[f64]], precision: &[f64]) -> bool {
        let last = precision.len() - 1;
        let is_right = |f: &[f64], i: usize, value: f64| match f.get(i) {
            Some(f) => (value - f).abs() <= precision[i],
            None => value.abs() <= LARGEST_BEYOND * f[last].abs().max(precision[last]),
        };
        let all_right = |(f, c): (&&[f64], Vec<f64>)| {
            self.equations
                .iter()
                .enumerate()
                .all(|(i, equation)| is_right(f, i, equation.value(&c)))
        };
        functions.iter().zip(self.coefficients(functions)).all(all_right)
    }

    /// The coefficients of the sums through these values at the rows.
    pub(crate) fn coefficients(&self, functions: &[&[f64]]) -> Vec<Vec<f64>> {
        if let Some(x) = &self.uneven {
            let functions: Vec<Vec<f64>> =
                functions.iter().map(|f| evenly(x, f, self.spacing)).collect();
            let functions: Vec<&[f64]> = functions.iter().map(Vec::as_slice).collect();
            return self.solved(&functions);
        }
        self.solved(functions)
    }

    /// The coefficients of the sums through these values at the first equations, and 0 at the others.
    fn solved(&self, functions: &[&[f64]]) -> Vec<Vec<f64>> {
        let mut system = LeastSquares::new(self.points, functions.len());
        for (i, Equation { weight, first, values }) in self.equations.iter().enumerate() {
            let right = functions.iter().map(|f| weight * f.get(i).unwrap_or(&0.0)).collect();
            system.add(*first, values.map(|value| weight * value), right);
        }
        system.solved()
    }

    /// The Gaussians on the whole lattice, from the coefficients on its points ≥ 0.
    pub(crate) fn gaussians(&self, coefficients: &[f64]) -> Vec<Gaussian> {
        let width = self.width();
        let term = |i: usize, sign: f64| {
            let center = sign * i as f64 * self.spacing;
            Gaussian { amplitude: coefficients[i], center, width }
        };
        let mut terms = vec![term(0, 1.0)];
        terms.extend((1..coefficients.len()).flat_map(|i| [term(i, -1.0), term(i, 1.0)]));
        terms
    }

    /// Width of the Gaussians.
    pub(crate) fn width(&self) -> f64 {
        WIDTH_PER_SPACING * self.spacing
    }
}

/// As many values as f has, evenly spaced from 0, of the cubic spline through (x, f), with slope 0 at 0, as for an even
/// function.
fn evenly(x: &[f64], f: &[f64], spacing: f64) -> Vec<f64> {
    // Mirrored, so that the spline is flat at 0 of itself.
    let spline = CubicSpline::through(mirrored(x, -1.0), mirrored(f, 1.0), Ends::Straight);
    (0..x.len()).map(|i| spline.value(i as f64 * spacing)).collect()
}

/// v on x ≥ 0 continued to x < 0 as an even (`sign` 1) or odd (-1) function.
fn mirrored(v: &[f64], sign: f64) -> Vec<f64> {
    v.iter().skip(1).rev().map(|v| sign * v).chain(v.iter().copied()).collect()
}
