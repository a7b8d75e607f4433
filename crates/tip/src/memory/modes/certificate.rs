//! Error of a sum of exponentials as an approximation of f', everywhere on its half-line.

use super::term::Term;
use crate::elementary::{complex_exp, exp, norm};
use crate::{TipFunction, stop};
use num_complex::Complex;

/// Largest errors of `Σ_j Re(w_j e^{s_j ξ})` as an approximation of f'(ξ), over all ξ ≥ -(allowed retreat).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitCertificate {
    /// Error of f'(ξ): α times it bounds the error of the force per time spent within reach.
    pub slope: f64,
    /// Error of f''(ξ), which affects Newton's iteration only.
    pub curvature: f64,
    /// ∫|error of f'|dξ: α/v times it bounds the error of the force on a tip of velocity v.
    pub area: f64,
}

/// Grid points per 1/|s| of the fastest exponential.
const POINTS_PER_LENGTH: f64 = 16.0;
/// Distance, in reaches, at which a sum must have decayed.
const FARTHEST: f64 = 100.0;
/// Largest number of successive multiplications that form powers `e^{s n h}`; then a new exponential is evaluated.
const BLOCK: usize = 32;

/// Evaluates the errors on a grid from minus the retreat to the point where the sum of moduli, `Σ|w_j| e^{Re s_j ξ}`,
/// bounds the rest.
///
/// Between grid points the error is at most that at the nearest of them, plus half a spacing times the
/// largest error of the derivative.
pub(super) fn certify(
    tip: &TipFunction,
    reach: f64,
    retreat: f64,
    terms: &[Term],
) -> FitCertificate {
    let fastest = terms.iter().fold(0.0, |m: f64, t| m.max(norm(t.exponent)));
    let h = 1.0 / (POINTS_PER_LENGTH * fastest);
    let mut found = FitCertificate { slope: 0.0, curvature: 0.0, area: 0.0 };
    let steps: Vec<_> = terms.iter().map(|t| complex_exp(t.exponent * h)).collect();
    let mut values: Vec<Complex<f64>> = vec![];
    let mut xi = -retreat;
    for n in 0_usize.. {
        xi = n as f64 * h - retreat;
        if n % BLOCK == 0 {
            if xi > reach && tail(terms, xi) < 0.5 * found.slope {
                break;
            }
            if xi > FARTHEST * reach || stop::is_requested() {
                found.slope = f64::INFINITY;
                return found;
            }
            values = terms.iter().map(|t| t.weight * complex_exp(t.exponent * xi)).collect();
        }
        let (mut slope, mut curvature) = tip.slope_and_curvature(xi);
        for ((value, term), step) in values.iter_mut().zip(terms).zip(&steps) {
            slope -= value.re;
            curvature -= value.re * term.exponent.re - value.im * term.exponent.im;
            *value *= step;
        }
        found.slope = found.slope.max(slope.abs());
        found.curvature = found.curvature.max(curvature.abs());
        found.area += h * slope.abs();
    }
    let rest = |power: i32| -> f64 {
        let term =
            |t: &Term| norm(t.weight) * exp(t.exponent.re * xi) * t.exponent.re.abs().powi(power);
        terms.iter().map(term).sum()
    };
    found.area += rest(-1);
    found.slope += 0.5 * h * found.curvature;
    // The error's own derivative changes by no more than the fastest exponential does.
    found.curvature *= 1.0 + 0.5 * h * fastest;
    found
}

/// `Σ|w_j| e^{Re s_j ξ}`, which falls with ξ.
fn tail(terms: &[Term], xi: f64) -> f64 {
    terms.iter().map(|t| norm(t.weight) * exp(t.exponent.re * xi)).sum()
}
