//! Walking: the motion of a tip without a spring, driven permanently by the slope of its own groove.
//!
//! A steady walk with speed v over its own groove satisfies v = (α w0/v) φ1(s), s = 1/(vT), that is, v² = α w0 φ1(s).
//! For α < 0 the tip raises the surface, which pushes it away from its past positions. As v → 0, φ1 → f''(0)v²T²:
//! walking begins at αT²f''(0) = 1.

use super::characteristic::Characteristic;
use super::crossings::zeros;
use super::half_plane::leading;
use super::law::Law;
use super::{Spectrum, StabilityError};
use num_complex::Complex64;
use stickslip_tip::{Model, TipFunction, Wider};

/// Lower end of the search for speeds, as a fraction of the largest possible one.
const SLOWEST: f64 = 1e-7;
/// Number of samples per decade in this search.
const PER_DECADE: u32 = 60;
/// Largest round-off, relative to 1 + v, of the root 0 of a shift of the walk, if the certificate has no larger error.
const NEUTRAL: f64 = 1e-9;

/// A steady walk with the roots of small deviations from it.
#[derive(Debug, Clone, PartialEq)]
pub struct Walk {
    /// The speed v.
    pub speed: f64,
    /// w0, the rate of indentation relative to α.
    pub weight: f64,
    /// λ = vΛ, including the neutral root 0 of a shift.
    pub spectrum: Spectrum,
}

impl Walk {
    /// Number of roots right of the imaginary axis.
    pub fn unstable_count(&self) -> usize {
        self.spectrum.roots.iter().filter(|z| z.re > 0.0).count()
    }

    /// Whether every deviation decays, except a shift along the scan; `None` if the errors of the roots leave it open.
    pub fn is_stable(&self) -> Option<bool> {
        let error = self.spectrum.certificate.largest_error;
        let others = self.spectrum.roots.iter().filter(|z| z.norm() > 0.0);
        let leading = others.map(|z| z.re).fold(f64::NEG_INFINITY, f64::max);
        (leading.abs() > error).then_some(leading < 0.0)
    }
}

/// All speeds v of steady walks, ascending, above 1e-7 of the largest possible speed.
///
/// # Errors
/// [`StabilityError::Dragged`] if the model has a spring.
pub fn walking_speeds(model: &Model) -> Result<Vec<f64>, StabilityError> {
    if model.wider().spring {
        return Err(StabilityError::Dragged);
    }
    let largest = (model.alpha().abs() * slope_bound(model.tip())).sqrt();
    if largest <= 0.0 {
        return Ok(vec![]);
    }
    let decades = -SLOWEST.log10();
    let exponent = |n: u32| f64::from(n) / f64::from(PER_DECADE) - decades;
    let samples = (0..).map(|n| 1.01 * largest * 10_f64.powf(exponent(n)));
    let samples = samples.take_while(|v| *v < 1.1 * largest);
    let balance = |speed: f64| {
        let law = law_at(model, speed);
        1.0 - law.density * law.steady.slope / speed
    };
    let samples: Vec<(f64, f64)> = samples.map(|v| (v, balance(v))).collect();
    Ok(zeros(balance, &samples))
}

/// The walk at one of the [`walking_speeds`], with at least `count` leading roots.
///
/// # Errors
/// As [`walking_speeds`] and [`super::leading_roots`].
pub fn walk(model: &Model, speed: f64, count: usize) -> Result<Walk, StabilityError> {
    if model.wider().spring {
        return Err(StabilityError::Dragged);
    }
    StabilityError::unless_positive(speed)?;
    let law = law_at(model, speed);
    if Law::has_corner(model.wider(), model.tip(), &law.steady) {
        return Err(StabilityError::Corner);
    }
    let weight = law.density * speed / model.alpha();
    let mut spectrum = leading(&Characteristic::of(law), count)?;
    let error = spectrum.certificate.largest_error.max(NEUTRAL * (1.0 + speed));
    let neutral = spectrum.roots.iter_mut().min_by(|a, b| a.norm().total_cmp(&b.norm()));
    if let Some(neutral) = neutral.filter(|z| z.norm() < error) {
        *neutral = Complex64::ZERO;
    }
    Ok(Walk { speed, weight, spectrum })
}

/// Threshold of walking, e^{|h|/b}/(T²f''(0)) with |h| = f(0)/(T|f''(0)|), a negative number: for α below it a tip at
/// rest on a surface that heals within T begins to walk. `None` without healing.
///
/// At rest λ(Mλ + 1) = αw f''(0) λT/(λ + 1/T): at the threshold 0 is a double root for any M. A depth limit b changes
/// only the weight w = e^{-|h|/b} of the height h = αwT f(0).
pub fn walking_alpha(tip: &TipFunction, wider: &Wider) -> Option<f64> {
    let healing_time = wider.healing_time?;
    let curvature = tip.slope_and_curvature(0.0).1;
    let height = tip.value(0.0) / (healing_time * curvature);
    let exponent = wider.depth_limit.map_or(0.0, |limit| height.abs() / limit);
    Some(exponent.exp() / (healing_time * healing_time * curvature))
}

/// N at this speed, with w0 of a dragged tip of the same speed, whose groove is the same except for the sign.
fn law_at(model: &Model, speed: f64) -> Law {
    let dragged = Wider { spring: true, ..*model.wider() };
    let weight = Model::under(dragged, model.tip().clone(), model.alpha().abs(), speed)
        .map_or(1.0, |dragged| dragged.steady_weight());
    Law::with_density(model.wider(), model.tip(), speed, model.alpha() * weight / speed)
}

/// Bound on |φ1|: ∫_0^∞|f'|, or 1 for J0 and cos x.
fn slope_bound(tip: &TipFunction) -> f64 {
    match tip {
        TipFunction::Gaussians(sum) => sum.terms().iter().map(|g| 2.0 * g.amplitude.abs()).sum(),
        TipFunction::Bessel | TipFunction::Cosine => 1.0,
    }
}
