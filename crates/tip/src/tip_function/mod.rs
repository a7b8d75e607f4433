//! The footprint f(x) of the tip: its indentation rate at distance x from its apex.

mod apex;
mod bessel;
mod cosine;
mod error;
mod fading;
mod gaussian;
mod lattice;
mod scale;
pub(crate) mod table;
mod term;

use crate::Footprint;
pub(crate) use apex::Apex;
pub use bessel::bessel_orders;
pub use error::TipFunctionError;
pub use gaussian::GaussianSum;
pub use scale::{BAND_OF_A_GAUSSIAN, widths};
pub use term::Gaussian;

use num_complex::Complex;

/// A footprint f(x) → 0 with f'(0) = 0, with its derivatives and integrals. x in units of σ.
///
/// f is even unless it was made by [`asymmetric_sum`](Self::asymmetric_sum). A tip that moves to larger x is affected by
/// f at x > 0, one that moves to smaller x by f at x < 0.
#[derive(Debug, Clone, PartialEq)]
pub enum TipFunction {
    /// A sum of Gaussians, for example (48); tabulated tips are converted to such sums.
    Gaussians(GaussianSum),
    /// J0(x), the analytically tractable example of section IV.C.
    Bessel,
    /// cos x: a tip whose surface contains a single wave. Without a spring, and with α < 0, its equation is the
    /// Lorenz system.
    Cosine,
}

/// Largest parameter: products of three numbers up to this size, and their inverses, are finite.
const LARGEST: f64 = 1e100;

impl Default for TipFunction {
    /// The triple Gaussian (48) with β = 1 and width 1.
    fn default() -> Self {
        Self::triple_gaussian(1.0, 1.0).expect("β = 1 and width 1 are in range")
    }
}

impl TipFunction {
    /// (48): exp(-ξ²/2) - β/2 (exp(-(ξ+2)²/2) + exp(-(ξ-2)²/2)) with ξ = x/`width`.
    ///
    /// # Errors
    /// `beta` is not finite, or `width` is not a positive finite number.
    pub fn triple_gaussian(beta: f64, width: f64) -> Result<Self, TipFunctionError> {
        if !beta.is_finite() {
            return Err(TipFunctionError::Beta(beta));
        }
        let lobe = |amplitude, center: f64| Gaussian { amplitude, center: center * width, width };
        let mut terms = vec![lobe(1.0, 0.0)];
        if beta.abs() > 0.0 {
            terms.extend([lobe(-beta / 2.0, -2.0), lobe(-beta / 2.0, 2.0)]);
        }
        Self::gaussian_sum(terms)
    }

    /// exp(-x²/(2 `width`²)).
    ///
    /// # Errors
    /// `width` is not a positive finite number.
    pub fn gaussian(width: f64) -> Result<Self, TipFunctionError> {
        Self::gaussian_sum(vec![Gaussian { amplitude: 1.0, center: 0.0, width }])
    }

    /// Any even sum of Gaussians.
    ///
    /// # Errors
    /// A term that is not finite or far out of range, a width ≤ 0, a sum that is zero everywhere or not even.
    pub fn gaussian_sum(terms: Vec<Gaussian>) -> Result<Self, TipFunctionError> {
        GaussianSum::new(terms).map(Self::Gaussians)
    }

    /// A sum of Gaussians with f'(0) = 0 whose sides may differ: x > 0 is ahead of a tip that moves to larger x.
    ///
    /// # Errors
    /// A term that is not finite or far out of range, a width ≤ 0, a sum that is zero everywhere or has f'(0) ≠ 0.
    pub fn asymmetric_sum(terms: Vec<Gaussian>) -> Result<Self, TipFunctionError> {
        GaussianSum::with_apex_at_0(terms).map(Self::Gaussians)
    }

    /// Whether f(-x) = f(x).
    pub fn is_even(&self) -> bool {
        match self {
            Self::Gaussians(sum) => sum.is_even(),
            Self::Bessel | Self::Cosine => true,
        }
    }

    /// f(-x): the footprint of a tip that moves to smaller x, in the frame of its motion.
    pub fn mirrored(&self) -> Self {
        match self {
            Self::Gaussians(sum) if !sum.is_even() => Self::Gaussians(sum.mirrored()),
            even => even.clone(),
        }
    }

    /// The smooth even function through the points (x, f), sampled on x ≥ 0, which falls to 0 beyond the last point.
    ///
    /// It is a sum of Gaussians on an evenly spaced lattice: on the coarsest that reproduces the rows to 4e-12 of the
    /// largest value, or to the unit of their last digit if all are rounded to four or more; or else on that of the
    /// rows, with their values at its points. The sum is analytic, so that the orders of convergence hold. Between rows
    /// its error is at most that of a cubic spline.
    ///
    /// # Errors
    /// The table is too short or too long, not finite, not sorted, does not start at x = 0, or does not decay.
    pub fn table(x: &[f64], f: &[f64]) -> Result<Self, TipFunctionError> {
        Self::gaussian_sum(table::gaussians_through(x, f)?)
    }

    /// The section f(x,0) of a footprint in three dimensions, which is kept with it.
    pub fn of_footprint(footprint: Footprint) -> Self {
        match footprint.path().clone() {
            Self::Gaussians(sum) => Self::Gaussians(sum.with_footprint(footprint)),
            other => other,
        }
    }

    /// The f(x,y) of which this is the section y = 0, if it was made from one.
    pub fn footprint(&self) -> Option<&Footprint> {
        match self {
            Self::Gaussians(sum) => sum.footprint(),
            Self::Bessel | Self::Cosine => None,
        }
    }

    /// f(x).
    pub fn value(&self, x: f64) -> f64 {
        match self {
            Self::Gaussians(sum) => sum.value(x),
            Self::Bessel => libm::j0(x),
            Self::Cosine => cosine::value(x),
        }
    }

    /// f'(x).
    pub fn slope(&self, x: f64) -> f64 {
        self.slope_and_curvature(x).0
    }

    /// f(x) and f'(x), which share the expensive part of their evaluation.
    pub(crate) fn value_and_slope(&self, x: f64) -> (f64, f64) {
        match self {
            Self::Gaussians(sum) => sum.value_and_slope(x),
            Self::Bessel | Self::Cosine => (self.value(x), self.slope(x)),
        }
    }

    /// f'(x) and f''(x), which share the expensive part of their evaluation.
    #[inline]
    pub fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        match self {
            Self::Gaussians(sum) => sum.slope_and_curvature(x),
            Self::Bessel => bessel::slope_and_curvature(x),
            Self::Cosine => cosine::slope_and_curvature(x),
        }
    }

    /// f(x), f'(x) and f''(x), likewise.
    pub fn value_slope_and_curvature(&self, x: f64) -> [f64; 3] {
        if let Self::Gaussians(sum) = self {
            return sum.value_slope_and_curvature(x);
        }
        let (slope, curvature) = self.slope_and_curvature(x);
        [self.value(x), slope, curvature]
    }

    /// f' and f'' at each x, equal to those of single evaluations bit for bit: for callers compiled for wider
    /// vectors.
    #[inline(always)]
    pub(crate) fn slopes_and_curvatures<const N: usize>(&self, x: &[f64; N]) -> [[f64; N]; 2] {
        if let Self::Gaussians(sum) = self {
            return sum.slopes_and_curvatures(x);
        }
        let mut told = [[0.0; N]; 2];
        for i in 0..N {
            (told[0][i], told[1][i]) = self.slope_and_curvature(x[i]);
        }
        told
    }

    /// Coefficients of x^n, n up to `degree`, in the Taylor series of f about its apex.
    fn taylor(&self, degree: usize) -> Vec<f64> {
        match self {
            Self::Gaussians(sum) => sum.taylor(degree),
            // Σ (-x²/4)^k / k!²
            Self::Bessel => even_series(degree, |k| -0.25 / (k * k)),
            // Σ (-x²)^k / (2k)!
            Self::Cosine => even_series(degree, |k| -1.0 / ((2.0 * k - 1.0) * (2.0 * k))),
        }
    }

    /// A bound on |f^{(n)}| for all x.
    fn derivative_bound(&self, n: usize) -> f64 {
        match self {
            Self::Gaussians(sum) => sum.derivative_bound(n),
            // J0 is the mean of cosines of wave numbers up to 1.
            Self::Bessel | Self::Cosine => 1.0,
        }
    }

    /// ∫_x^∞ f(ξ)dξ: the profile of steady motion, (24).
    pub fn tail(&self, x: f64) -> f64 {
        match self {
            Self::Gaussians(sum) => sum.tail(x),
            Self::Bessel => bessel::tail(x),
            // Its mean value, as if it faded slowly.
            Self::Cosine => cosine::tail(x),
        }
    }

    /// ∫_0^∞ f(x+y) e^{-sy}dy, s ≥ 0: the profile of steady motion over a surface that heals, s = 1/(rT).
    pub fn fading_tail(&self, x: f64, s: f64) -> f64 {
        if s <= 0.0 {
            return self.tail(x);
        }
        match self {
            Self::Gaussians(sum) => sum.terms().iter().map(|g| fading::gaussian(g, x, s)).sum(),
            Self::Bessel => fading::bessel(x, s),
            Self::Cosine => cosine::fading(x, s),
        }
    }

    /// ∫_{-∞}^∞ f(ξ)dξ, which determines the depth far behind the tip, (25).
    pub fn integral(&self) -> f64 {
        self.fourier(0.0)
    }

    /// ∫_{-∞}^∞ f(ξ) cos(qξ)dξ at wave number q: the Fourier transform of an even f.
    pub fn fourier(&self, q: f64) -> f64 {
        match self {
            Self::Gaussians(sum) => sum.fourier(q),
            Self::Bessel => bessel::fourier(q),
            // Two lines, at ±1.
            Self::Cosine => 0.0,
        }
    }

    /// ∫_{-∞}^∞ f(ξ) e^{-iqξ}dξ, the Fourier transform at wave number q.
    pub fn transform(&self, q: f64) -> Complex<f64> {
        match self {
            Self::Gaussians(sum) if !sum.is_even() => sum.fourier_fading(q, 0.0),
            even => even.fourier(q).into(),
        }
    }

    /// ∫_{-∞}^∞ f(ξ) e^{-κξ} e^{-iqξ}dξ at wave number q and decay rate κ = `fading`; `None` for a footprint that does
    /// not decay.
    pub fn fourier_fading(&self, q: f64, fading: f64) -> Option<Complex<f64>> {
        match self {
            Self::Gaussians(sum) => Some(sum.fourier_fading(q, fading)),
            Self::Bessel | Self::Cosine => None,
        }
    }

    /// Distance, in σ, beyond which f and its derivatives are below the round-off of their largest values; `None` for a
    /// footprint without such a distance (J0 decays only like 1/√x).
    pub fn reach(&self) -> Option<f64> {
        match self {
            Self::Gaussians(sum) => Some(sum.reach()),
            Self::Bessel | Self::Cosine => None,
        }
    }

    /// Wave number, in 1/σ, beyond which the transform of f is below the round-off of its largest value.
    pub fn band(&self) -> f64 {
        match self {
            Self::Gaussians(sum) => sum.band(),
            Self::Bessel | Self::Cosine => 1.0,
        }
    }
}

/// Coefficients of an even power series that begins with 1: that of x^{2k} is `ratio`(k) times that of x^{2k-2}.
fn even_series(degree: usize, ratio: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut sum = vec![0.0; degree + 1];
    let mut here = 1.0;
    for (k, coefficient) in (1..).zip(sum.iter_mut().step_by(2)) {
        *coefficient = here;
        here *= ratio(f64::from(k));
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    fn every_kind() -> Vec<TipFunction> {
        let x: Vec<f64> = (0..60).map(|i| 0.15 * f64::from(i)).collect();
        let f: Vec<f64> = x.iter().map(|x| (1.0 - 0.3 * x * x) * (-x * x / 2.0).exp()).collect();
        vec![
            TipFunction::triple_gaussian(1.0, 1.0).unwrap(),
            TipFunction::triple_gaussian(0.7, 0.4).unwrap(),
            TipFunction::gaussian(2.0).unwrap(),
            TipFunction::table(&x, &f).unwrap(),
            TipFunction::Bessel,
            TipFunction::Cosine,
        ]
    }

    /// Central differences of the next lower derivative; eighth order, so 1e-9 is far above its error.
    fn difference(f: impl Fn(f64) -> f64, x: f64) -> f64 {
        let h = 0.02;
        let d = |k: f64| f(x + k * h) - f(x - k * h);
        (d(1.0) * 4.0 / 5.0 - d(2.0) / 5.0 + d(3.0) * 4.0 / 105.0 - d(4.0) / 280.0) / h
    }

    #[test]
    fn derivatives_and_tail_agree_with_differences() {
        for tip in every_kind() {
            for x in [-7.3, -1.1, -0.2, 0.0, 1e-9, 0.4, 1.7, 3.0, 12.0, 39.0, 41.5] {
                let (slope, curvature) = tip.slope_and_curvature(x);
                assert!((slope - difference(|x| tip.value(x), x)).abs() < 1e-8, "{tip:?} {x}");
                assert!((curvature - difference(|x| tip.slope(x), x)).abs() < 1e-7, "{tip:?} {x}");
                assert!(
                    (tip.value(x) + difference(|x| tip.tail(x), x)).abs() < 1e-9,
                    "{tip:?} {x}"
                );
            }
        }
    }

    #[test]
    fn every_footprint_is_even_and_its_tail_spans_the_integral() {
        for tip in every_kind() {
            assert!((tip.tail(-35.0) + tip.tail(35.0) - tip.integral()).abs() < 1e-13, "{tip:?}");
            for x in [0.3, 2.0, 5.0] {
                assert!((tip.value(x) - tip.value(-x)).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn nothing_is_left_beyond_the_reach() {
        for tip in every_kind() {
            if let Some(reach) = tip.reach() {
                let (slope, curvature) = tip.slope_and_curvature(reach);
                assert!(tip.value(reach).abs() + slope.abs() + curvature.abs() < 1e-13, "{tip:?}");
            }
        }
    }

    #[test]
    fn a_lone_lobe_off_the_origin_is_refused() {
        let lobe = Gaussian { amplitude: 1.0, center: 1.0, width: 1.0 };
        assert_eq!(
            TipFunction::gaussian_sum(vec![lobe]),
            Err(TipFunctionError::NotEven { center: 1.0 })
        );
        let twin = Gaussian { center: -1.0, ..lobe };
        assert!(TipFunction::gaussian_sum(vec![lobe, twin]).is_ok());
    }
}
