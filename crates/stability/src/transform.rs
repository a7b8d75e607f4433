//! G(Λ) = ∫_0^∞ f''(y) e^{-Λy}dy, the transform in the characteristic equation (30).

mod panels;

use super::scaled_erfc::scaled_erfc;
use num_complex::Complex64;
use panels::Panels;
use std::f64::consts::{PI, SQRT_2};
use stickslip_tip::Gaussian;

/// Largest number of Gaussians in a closed form; longer sums, such as those of tables, are integrated by quadrature.
const MOST_CLOSED_FORMS: usize = 16;
/// Exponents above this are stored in [`Scaled::log_scale`].
const LARGEST_EXPONENT: f64 = 300.0;
/// Value of |Λ| times the largest width below which Λ²f̃ and Λf(0) do not cancel.
const NEAR_ORIGIN: f64 = 0.5;
/// Round-off that each unit of an exponent adds to the exponential, 3 × 2.2e-16, relative to its other round-off, 3e-14.
const ROUNDING_OF_EXPONENT: f64 = 0.02;

/// A value and its derivative with respect to Λ, both to be multiplied by e^`log_scale`.
///
/// G grows like e^{Λ²w²/2} to the left, beyond the range of floating point at |Λ| ≈ 40/w.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scaled {
    pub(super) value: Complex64,
    pub(super) derivative: Complex64,
    pub(super) log_scale: f64,
}

/// G for a sum of Gaussians.
#[derive(Debug, Clone)]
pub(super) enum CurvatureTransform {
    /// By the scaled complementary error function.
    ClosedForms(Vec<Gaussian>, Origin),
    /// By Gauss-Legendre quadrature, for the many narrow Gaussians of a table.
    Quadrature(Panels, Vec<Gaussian>),
}

impl CurvatureTransform {
    pub(super) fn new(terms: &[Gaussian], band: f64) -> Self {
        if terms.len() <= MOST_CLOSED_FORMS {
            return Self::ClosedForms(terms.to_vec(), Origin::of(terms));
        }
        Self::Quadrature(Panels::new(terms, band), terms.to_vec())
    }

    /// G(Λ) and G'(Λ).
    pub(super) fn at(&self, lambda: Complex64) -> Scaled {
        match self {
            Self::ClosedForms(terms, origin) if origin.is_near(lambda) => origin.at(terms, lambda),
            Self::ClosedForms(terms, _) => closed_forms(terms, lambda),
            Self::Quadrature(panels, _) if panels.serves(lambda) => panels.at(lambda),
            Self::Quadrature(_, terms) => closed_forms(terms, lambda),
        }
    }

    /// φ(Λ) = ∫_0^∞ f e^{-Λy}dy and φ'(Λ), for Λ so small that G(Λ) = Λ(Λφ - f(0)) does not determine φ; else `None`.
    pub(super) fn height_near_origin(&self, lambda: Complex64) -> Option<(Complex64, Complex64)> {
        match self {
            Self::ClosedForms(terms, origin) if origin.is_near(lambda) => {
                Some(transform_of_heights(terms, lambda))
            }
            Self::Quadrature(panels, _) => panels.height_near_origin(lambda),
            _ => None,
        }
    }

    /// Σ|terms| of the sum for G(Λ), times e^{-`log_scale`}: the scale of round-off in G(Λ).
    ///
    /// Side lobes of height β/2 at ±c cancel the peak along Re Λ = -ln(2/β)/c, where each of these terms is
    /// e^{Re(Λ²)w²/2} times as large as their sum.
    pub(super) fn size(&self, lambda: Complex64, log_scale: f64) -> f64 {
        match self {
            Self::ClosedForms(terms, origin) if origin.is_near(lambda) => {
                origin.size(terms, lambda)
            }
            Self::ClosedForms(terms, _) => size_of_closed_forms(terms, lambda, log_scale),
            Self::Quadrature(panels, _) if panels.serves(lambda) => panels.size(lambda, log_scale),
            Self::Quadrature(_, terms) => size_of_closed_forms(terms, lambda, log_scale),
        }
    }
}

/// Σ over Gaussians of Λ²f̃ - Λf(0) - f'(0), written so that these three terms do not cancel. With z = (Λw² - c)/(w√2)
/// and R of [`scaled_erfc`], a Gaussian of amplitude a, center c and width w contributes
///
/// ```text
///     a e^{-c²/2w²} [ (Λ + c/w²) R(z) + (c²/w³) √(π/2) erfcx(z) ]
/// ```
///
/// and where Re z < 0, the same with erfcx(z), R(z) replaced by -erfcx(-z), R(-z), plus
/// a w √(2π) Λ² exp(Λ²w²/2 - cΛ).
fn closed_forms(terms: &[Gaussian], lambda: Complex64) -> Scaled {
    let largest = terms
        .iter()
        .filter(|g| is_left(g, lambda))
        .map(|g| exponent(g, lambda).re)
        .fold(f64::NEG_INFINITY, f64::max);
    let log_scale = if largest > LARGEST_EXPONENT { largest } else { 0.0 };
    let down = (-log_scale).exp();
    let mut value = Complex64::ZERO;
    let mut derivative = Complex64::ZERO;
    for g in terms {
        let (v, d) = algebraic_part(g, lambda);
        value += v * down;
        derivative += d * down;
        if is_left(g, lambda) {
            let growth = two_sided(g, lambda, log_scale);
            value += growth * lambda * lambda;
            derivative +=
                growth * lambda * (2.0 + lambda * (lambda * (g.width * g.width) - g.center));
        }
    }
    Scaled { value, derivative, log_scale }
}

/// G = Λ(Λf̃ - f(0)) for Λ small against 1/width, where these terms do not cancel. The terms of [`closed_forms`] do:
/// they are of the size of f'(0) of each Gaussian, while G falls like Λ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Origin {
    radius: f64,
    height: f64,
    /// Sum of the sizes of the terms of `height`.
    size: f64,
}

impl Origin {
    fn of(terms: &[Gaussian]) -> Self {
        let height = |g: &Gaussian| g.amplitude * (-0.5 * (g.center / g.width).powi(2)).exp();
        Self {
            radius: NEAR_ORIGIN / terms.iter().map(|g| g.width).fold(0.0, f64::max),
            height: terms.iter().map(height).sum(),
            size: terms.iter().map(|g| height(g).abs()).sum(),
        }
    }

    fn is_near(&self, lambda: Complex64) -> bool {
        lambda.norm_sqr() < self.radius * self.radius
    }

    fn at(&self, terms: &[Gaussian], lambda: Complex64) -> Scaled {
        let (transform, slope) = transform_of_heights(terms, lambda);
        let bracket = lambda * transform - self.height;
        let derivative = bracket + lambda * (transform + lambda * slope);
        Scaled { value: lambda * bracket, derivative, log_scale: 0.0 }
    }

    fn size(&self, terms: &[Gaussian], lambda: Complex64) -> f64 {
        let transform: f64 = terms.iter().map(|g| laplace(g, lambda).0.norm()).sum();
        lambda.norm() * (lambda.norm() * transform + self.size)
    }
}

/// Σ over Gaussians of f̃, and its derivative.
fn transform_of_heights(terms: &[Gaussian], lambda: Complex64) -> (Complex64, Complex64) {
    let each = terms.iter().map(|g| laplace(g, lambda));
    each.fold((Complex64::ZERO, Complex64::ZERO), |sum, f| (sum.0 + f.0, sum.1 + f.1))
}

/// f̃ = a w √(π/2) e^{-c²/2w²} erfcx(z) of one Gaussian, and its derivative.
fn laplace(g: &Gaussian, lambda: Complex64) -> (Complex64, Complex64) {
    let (c, w) = (g.center, g.width);
    let z = (lambda * w - c / w) / SQRT_2;
    let at_origin = (-0.5 * (c / w).powi(2)).exp();
    let scale = g.amplitude * w * (PI / 2.0).sqrt();
    // erfcx' = 2z erfcx - 2/√π = 2R/√π
    let (k, remainder) = scaled_erfc(if z.re < 0.0 { -z } else { z });
    let edge = remainder * (SQRT_2 * w / PI.sqrt()) * at_origin;
    if z.re >= 0.0 {
        return (k * at_origin * scale, edge * scale);
    }
    let growth = exponent(g, lambda).exp() * 2.0;
    let value = growth - k * at_origin;
    (value * scale, (growth * (lambda * (w * w) - c) + edge) * scale)
}

/// Λ²w²/2 - cΛ
fn exponent(g: &Gaussian, lambda: Complex64) -> Complex64 {
    lambda * (lambda * (0.5 * g.width * g.width) - g.center)
}

/// Σ|terms| of [`exponent`].
fn exponent_size(g: &Gaussian, lambda: Complex64) -> f64 {
    0.5 * lambda.norm_sqr() * g.width * g.width + lambda.norm() * g.center.abs()
}

/// Whether Re z < 0, with z of [`closed_forms`].
fn is_left(g: &Gaussian, lambda: Complex64) -> bool {
    lambda.re * g.width * g.width < g.center
}

/// a w √(2π) exp(Λ²w²/2 - cΛ) e^{-`log_scale`}
fn two_sided(g: &Gaussian, lambda: Complex64, log_scale: f64) -> Complex64 {
    (exponent(g, lambda) - log_scale).exp() * (g.amplitude * g.width * (2.0 * PI).sqrt())
}

/// Σ|terms| of [`closed_forms`].
fn size_of_closed_forms(terms: &[Gaussian], lambda: Complex64, log_scale: f64) -> f64 {
    let down = (-log_scale).exp();
    let size = |g: &Gaussian| {
        let algebraic = algebraic_part(g, lambda).0.norm() * down;
        if !is_left(g, lambda) {
            return algebraic;
        }
        let (squared, rounded) = (lambda.norm_sqr(), exponent_size(g, lambda));
        let rounding = 1.0 + ROUNDING_OF_EXPONENT * rounded;
        algebraic + two_sided(g, lambda, log_scale).norm() * squared * rounding
    };
    terms.iter().map(size).sum()
}

/// The bracket of [`closed_forms`] with its prefactor, and its derivative with respect to Λ: dz/dΛ = w/√2,
/// erfcx' = 2R/√π, R' = √π erfcx + 2zR (the same in both half-planes).
fn algebraic_part(g: &Gaussian, lambda: Complex64) -> (Complex64, Complex64) {
    let (c, w) = (g.center, g.width);
    let at_origin = g.amplitude * (-0.5 * (c / w).powi(2)).exp();
    if at_origin.abs() < f64::MIN_POSITIVE {
        return (Complex64::ZERO, Complex64::ZERO);
    }
    let z = (lambda * w - c / w) / SQRT_2;
    let (k, remainder) = if z.re < 0.0 {
        let (k, remainder) = scaled_erfc(-z);
        (-k, remainder)
    } else {
        scaled_erfc(z)
    };
    let shifted = lambda + c / (w * w);
    let lobe = (c / w).powi(2) / w * (PI / 2.0).sqrt();
    let remainder_slope = k * PI.sqrt() + z * remainder * 2.0;
    let value = shifted * remainder + k * lobe;
    let derivative = remainder
        + (shifted * remainder_slope + remainder * (2.0 / PI.sqrt() * lobe)) * (w / SQRT_2);
    (value * at_origin, derivative * at_origin)
}

#[cfg(test)]
mod tests {
    use super::super::one_sided::OneSided;
    use super::*;
    use stickslip_tip::TipFunction;

    #[test]
    fn the_derivative_agrees_with_differences() {
        let tips = [
            TipFunction::gaussian(1.0).unwrap(),
            TipFunction::triple_gaussian(0.7, 0.4).unwrap(),
            TipFunction::Bessel,
            TipFunction::Cosine,
        ];
        let points = [(0.0, 0.75), (0.3, 0.2), (-2.0, 1.0), (-3.5, 0.3), (4.0, 7.0), (0.0, 3.0)];
        for tip in &tips {
            let transform = OneSided::new(tip);
            for lambda in points.map(|(re, im)| Complex64::new(re, im)) {
                let at = |h: f64| transform.plain(lambda + h).curvature.0;
                let h = 5e-4;
                let difference = ((at(h) - at(-h)) * 8.0 - at(2.0 * h) + at(-2.0 * h)) / (12.0 * h);
                let (_, slope) = transform.plain(lambda).curvature;
                assert!((difference - slope).norm() < 1e-9 * slope.norm(), "{tip:?} {lambda}");
            }
        }
    }
}
