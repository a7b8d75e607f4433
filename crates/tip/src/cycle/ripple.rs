//! The surface that a cycle leaves far behind the tip.

use crate::{TipFunction, Trajectory};
use num_complex::Complex;
use std::f64::consts::TAU;

/// One wavelength of u far behind the tip, (35), as a Fourier series.
///
/// u(x) = -α ∫ f(x - x0(t))dt over all times, and x0 advances by the wavelength Λ = rT in each period T, so that
/// by Poisson's formula u(x) = -(α/Λ) `Σ_k f̂(q_k) e^{i q_k x} ∫_0^T e^{-i q_k x0(t)}dt`, `q_k` = 2πk/Λ. The sum ends
/// where f̂ does.
#[derive(Debug, Clone)]
pub(super) struct Ripple {
    wavelength: f64,
    /// That of k = 0.
    mean: f64,
    /// Coefficients of `e^{i q_k x}`, k ≥ 1; those of -k are their conjugates.
    coefficients: Vec<Complex<f64>>,
}

const POINTS_PER_HARMONIC: usize = 8;

impl Ripple {
    /// Of one period of the motion.
    pub(super) fn new(tip: &TipFunction, alpha: f64, period: &Trajectory) -> Self {
        let (positions, weights) = period.residence(period.end());
        let wavelength = period.r() * (period.end() - period.start());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let harmonics = (tip.band() * wavelength / TAU).ceil() as usize;
        let coefficient = |k: usize| {
            let q = TAU * k as f64 / wavelength;
            let at = |(x, w): (&f64, &f64)| Complex::from_polar(*w, -q * x);
            let spent: Complex<f64> = positions.iter().zip(&weights).map(at).sum();
            spent * (-alpha / wavelength * tip.fourier(q))
        };
        let mean = coefficient(0).re;
        Self { wavelength, mean, coefficients: (1..=harmonics).map(coefficient).collect() }
    }

    /// u(x).
    pub(super) fn height(&self, x: f64) -> f64 {
        self.mean + self.at(x).0
    }

    /// u less its mean, its slope and its curvature.
    fn at(&self, x: f64) -> (f64, f64, f64) {
        let mut sums = (0.0, 0.0, 0.0);
        for (k, coefficient) in self.coefficients.iter().enumerate() {
            let q = TAU * (k + 1) as f64 / self.wavelength;
            let value = coefficient * Complex::from_polar(2.0, q * x);
            sums.0 += value.re;
            sums.1 -= q * value.im;
            sums.2 -= q * q * value.re;
        }
        sums
    }

    /// Half peak-to-peak.
    pub(super) fn amplitude(&self) -> f64 {
        0.5 * (self.extremum(1.0) + self.extremum(-1.0))
    }

    /// Largest `sign` · u: the best of many points, then Newton's method for its zero slope.
    fn extremum(&self, sign: f64) -> f64 {
        let points = POINTS_PER_HARMONIC * self.coefficients.len().max(1);
        let spacing = self.wavelength / points as f64;
        let height = |x: f64| sign * self.at(x).0;
        let highest = (0..points)
            .map(|i| spacing * i as f64)
            .max_by(|a, b| height(*a).total_cmp(&height(*b)));
        let start = highest.unwrap_or_default();
        let mut x = start;
        for _ in 0..8 {
            let (_, slope, curvature) = self.at(x);
            let step = slope / curvature;
            if step.is_finite() {
                x = (x - step).clamp(start - spacing, start + spacing);
            }
        }
        height(x).max(height(start))
    }
}
