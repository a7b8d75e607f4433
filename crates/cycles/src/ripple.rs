//! The surface of a cycle far behind the tip.

use num_complex::Complex;
use std::f64::consts::TAU;
use stickslip_tip::elementary::{complex_exp, exp, sin_cos};
use stickslip_tip::{TipFunction, Trajectory};

/// One wavelength of u far behind the tip, (35), as a Fourier series.
///
/// u(x) = -α ∫ f(x - x0(t))dt over all times, and x0 advances by the wavelength Λ = rT in each period T, so that by
/// Poisson's formula u(x) = -(α/Λ) `Σ_k f̂(q_k) e^{i q_k x} ∫_0^T e^{-i q_k x0(t)}dt`, `q_k` = 2πk/Λ. The sum ends
/// where f̂ is negligible.
///
/// If the surface heals, with the healing time T_h, u at the distance D behind the support is U(x) e^{-D/(rT_h)}. U is the
/// same series with f̂(q - i/(rT_h)) instead of f̂(q) and with the weight e^{(R - x0)/(rT_h)} of a visit, R = rt.
#[derive(Debug, Clone)]
pub(super) struct Ripple {
    wavelength: f64,
    /// Coefficient of k = 0.
    mean: f64,
    /// Coefficients of `e^{i q_k x}`, k ≥ 1; those of -k are their conjugates.
    coefficients: Vec<Complex<f64>>,
}

const POINTS_PER_HARMONIC: usize = 8;

impl Ripple {
    /// The series for one period of the motion, each visit with its weight w under a depth limit.
    pub(super) fn new(tip: &TipFunction, alpha: f64, period: &Trajectory) -> Self {
        let (positions, weights, exponent) = match period.wider().healing_time {
            None => {
                let (positions, weights) = period.residence(period.end());
                (positions, weights, 0.0)
            }
            Some(_) => period.residence_unfaded(),
        };
        let wavelength = period.r() * (period.end() - period.start());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let harmonics = (tip.band() * wavelength / TAU).ceil() as usize;
        let mut spent = vec![Complex::ZERO; harmonics + 1];
        for (positions, weights) in positions.chunks(LANES).zip(weights.chunks(LANES)) {
            let mut waves = Waves::at(positions, -TAU / wavelength);
            let mut lasted = [0.0; LANES];
            lasted[..weights.len()].copy_from_slice(weights);
            for spent in &mut spent {
                *spent += waves.sum(&lasted);
                waves.next();
            }
        }
        let fading = period.wider().healing_time.map(|time| 1.0 / (period.r() * time));
        for (k, spent) in spent.iter_mut().enumerate() {
            let q = TAU * k as f64 / wavelength;
            match fading {
                None => *spent *= tip.transform(q) * (-alpha / wavelength),
                Some(fading) => {
                    let transform = tip.fourier_fading(q, fading).unwrap_or_default();
                    *spent *= transform * (-alpha / wavelength * exp(exponent));
                }
            }
        }
        Self { wavelength, mean: spent[0].re, coefficients: spent.split_off(1) }
    }

    /// u(x).
    pub(super) fn height(&self, x: f64) -> f64 {
        self.mean + self.at(x).0
    }

    /// u minus its mean, the slope of u and its curvature.
    fn at(&self, x: f64) -> (f64, f64, f64) {
        let mut sums = (0.0, 0.0, 0.0);
        let wave_number = TAU / self.wavelength;
        let terms = self.coefficients.iter().zip(powers(wave_number * x).skip(1));
        for (k, (coefficient, power)) in terms.enumerate() {
            let q = wave_number * (k + 1) as f64;
            let value = coefficient * power * 2.0;
            sums.0 += value.re;
            sums.1 -= q * value.im;
            sums.2 -= q * q * value.re;
        }
        sums
    }

    /// Half the peak-to-peak value.
    pub(super) fn amplitude(&self) -> f64 {
        let points = POINTS_PER_HARMONIC * self.coefficients.len().max(1);
        let spacing = self.wavelength / points as f64;
        let x: Vec<f64> = (0..points).map(|i| spacing * i as f64).collect();
        let heights = self.heights(&x);
        let best = |sign: f64| {
            let heights = heights.iter().map(|u| sign * u).zip(&x);
            heights.max_by(|a, b| a.0.total_cmp(&b.0)).map_or(0.0, |(_, x)| *x)
        };
        0.5 * (self.extremum(1.0, best(1.0), spacing) + self.extremum(-1.0, best(-1.0), spacing))
    }

    /// u minus its mean at many points.
    fn heights(&self, x: &[f64]) -> Vec<f64> {
        let mut heights = Vec::with_capacity(x.len() + LANES);
        for x in x.chunks(LANES) {
            let mut waves = Waves::at(x, TAU / self.wavelength);
            let mut sums = [0.0; LANES];
            for coefficient in &self.coefficients {
                waves.next();
                for (i, sum) in sums.iter_mut().enumerate() {
                    *sum += 2.0 * (coefficient.re * waves.re[i] - coefficient.im * waves.im[i]);
                }
            }
            heights.extend(&sums[..x.len()]);
        }
        heights
    }

    /// Largest `sign` · u close to `start`, the best of points at this spacing: Newton's method for zero slope.
    fn extremum(&self, sign: f64, start: f64, spacing: f64) -> f64 {
        let height = |x: f64| sign * self.at(x).0;
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

/// Number of points that are evaluated together.
const LANES: usize = 8;

/// `e^{ikφ}` of some phases, for k = 0, 1, …
struct Waves {
    re: [f64; LANES],
    im: [f64; LANES],
    once: ([f64; LANES], [f64; LANES]),
}

impl Waves {
    /// Phases φ at these points, at most as many as there are lanes; 0 in unused lanes.
    fn at(places: &[f64], wave_number: f64) -> Self {
        let mut once = ([1.0; LANES], [0.0; LANES]);
        for (i, x) in places.iter().enumerate() {
            (once.1[i], once.0[i]) = sin_cos(wave_number * x);
        }
        Self { re: [1.0; LANES], im: [0.0; LANES], once }
    }

    fn next(&mut self) {
        for i in 0..LANES {
            let (re, im) = (self.re[i], self.im[i]);
            self.re[i] = re * self.once.0[i] - im * self.once.1[i];
            self.im[i] = re * self.once.1[i] + im * self.once.0[i];
        }
    }

    fn sum(&self, weights: &[f64; LANES]) -> Complex<f64> {
        let (mut re, mut im) = (0.0, 0.0);
        for (i, weight) in weights.iter().enumerate() {
            re += weight * self.re[i];
            im += weight * self.im[i];
        }
        Complex::new(re, im)
    }
}

/// `e^{ikφ}` for k = 0, 1, …
fn powers(phase: f64) -> impl Iterator<Item = Complex<f64>> {
    let once = complex_exp(Complex::new(0.0, phase));
    std::iter::successors(Some(Complex::ONE), move |power| Some(power * once))
}
