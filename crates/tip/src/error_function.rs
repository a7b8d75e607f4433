//! The scaled complementary error function, with the same bits on every machine.

use crate::elementary::{complex_exp, exp};
use num_complex::Complex64;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Number of points of the trapezoidal rules: their error is of the order of e^{-π POINTS}.
const POINTS: usize = 12;
/// Distance h = √(π/POINTS) of neighbouring points of these rules.
const SPACING: f64 = 0.511_663_353_973_244_3;

/// One of two trapezoidal rules for the Faddeeva function w(ζ) = (2iζ/π) ∫_0^∞ e^{-t²}/(ζ² - t²) dt at ζ = iz.
struct Rule {
    /// t²
    squares: [f64; POINTS],
    /// 2h e^{-t²}/π
    weights: [f64; POINTS],
}

/// Points at (k + ½)h.
static BETWEEN: LazyLock<Rule> = LazyLock::new(|| Rule::starting_at(0.5));
/// Points at kh, k = 1, 2, …; the term of t = 0 is added separately.
static WHOLE: LazyLock<Rule> = LazyLock::new(|| Rule::starting_at(1.0));

impl Rule {
    fn starting_at(first: f64) -> Self {
        let t: [f64; POINTS] = std::array::from_fn(|k| (k as f64 + first) * SPACING);
        let squares = t.map(|t| t * t);
        Self { squares, weights: squares.map(|square| 2.0 * SPACING / PI * exp(-square)) }
    }

    /// Σ weight/(z² + t²)
    fn sum(&self, square: Complex64) -> Complex64 {
        let points = self.squares.iter().zip(&self.weights);
        let term = |(t, weight): (&f64, &f64)| {
            let distance = square + t;
            distance.conj() * (weight / distance.norm_sqr())
        };
        points.map(term).sum()
    }
}

/// erfcx(z) = e^{z²} erfc(z) for Re z ≥ 0, to a few units in the last place, by the trapezoidal rule, corrected for the
/// pole of its integrand (M. Al Azah & S. N. Chandler-Wilde, SIAM J. Numer. Anal. 59, 2346, 2021).
///
/// Of two sets of points, the one farther from the pole is used.
pub fn erfcx(z: Complex64) -> Complex64 {
    let (square, pole, across) = (z * z, PI / SPACING, z.im.abs());
    if z.re >= pole.max(across) {
        return z * BETWEEN.sum(square);
    }
    let residue = complex_exp(square) * 2.0;
    let turn = complex_exp(z * (2.0 * pole));
    let place = (across / SPACING).fract();
    if z.re < across && (0.25..=0.75).contains(&place) {
        return z * WHOLE.sum(square) + SPACING / (PI * z) + residue / (1.0 - turn);
    }
    z * BETWEEN.sum(square) + residue / (1.0 + turn)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The complex plane is judged by a table of mpmath in the crate of linear stability.
    #[test]
    fn on_the_real_axis_it_is_the_product_of_its_factors() {
        for i in 0..=500 {
            let x = 0.01 * f64::from(i);
            let expected = libm::exp(x * x) * libm::erfc(x);
            let value = erfcx(Complex64::from(x));
            assert!((value.re / expected - 1.0).abs() < 1e-14 && value.im == 0.0, "{x}");
        }
    }

    /// 1/(√π (x + ½/(x + 1/(x + …)))): Abramowitz & Stegun 7.1.14.
    #[test]
    fn far_out_it_is_the_continued_fraction() {
        for i in 5..=60 {
            let x = f64::from(i);
            let fraction = (1..=200).rev().fold(x, |below, n| x + 0.5 * f64::from(n) / below);
            let value = erfcx(Complex64::from(x)).re;
            assert!((value * PI.sqrt() * fraction - 1.0).abs() < 1e-14, "{x}");
        }
    }
}
