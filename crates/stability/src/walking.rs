//! Tips without a spring that walk: driven for ever by the slope of what they left themselves.
//!
//! A steady walk with speed v over its own groove needs v = (α w0/v) φ1(s), s = 1/(vT): v² = α w0 φ1(s). For α < 0
//! the tip raises the surface and is pushed away from where it was. From rest, v → 0, φ1 → f''(0)v²T²: walking
//! begins where αT²f''(0) = 1.

use super::characteristic::Characteristic;
use super::crossings::zeros;
use super::half_plane::leading;
use super::law::Law;
use super::{Spectrum, StabilityError};
use num_complex::Complex64;
use stickslip_tip::{Model, TipFunction, Wider};

/// Speeds are looked for from this part of the largest possible, so many to a decade.
const SLOWEST: f64 = 1e-7;
const PER_DECADE: u32 = 60;
/// The root that a shift of the whole walk has is 0 but for round-off.
const NEUTRAL: f64 = 1e-9;

/// A steady walk with the roots of small deviations from it.
#[derive(Debug, Clone, PartialEq)]
pub struct Walk {
    /// v
    pub speed: f64,
    /// w0, the rate of indentation relative to α.
    pub weight: f64,
    /// λ = vΛ, the neutral root 0 of a shift among them.
    pub spectrum: Spectrum,
}

impl Walk {
    /// Roots right of the imaginary axis.
    #[must_use]
    pub fn unstable_count(&self) -> usize {
        self.spectrum.roots.iter().filter(|z| z.re > 0.0).count()
    }
}

/// All speeds v > 0 of steady walks, ascending, between 1e-7 of the largest possible and that.
///
/// # Errors
/// [`StabilityError::Dragged`] with a spring.
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
    if !(speed.is_finite() && speed > 0.0) {
        return Err(StabilityError::R(speed));
    }
    let law = law_at(model, speed);
    if Law::has_corner(model.wider(), model.tip(), &law.steady) {
        return Err(StabilityError::Corner);
    }
    let weight = law.density * speed / model.alpha();
    let mut spectrum = leading(&Characteristic::of(law), count)?;
    let neutral = spectrum.roots.iter_mut().min_by(|a, b| a.norm().total_cmp(&b.norm()));
    if let Some(neutral) = neutral.filter(|z| z.norm() < NEUTRAL * (1.0 + speed)) {
        *neutral = Complex64::ZERO;
    }
    Ok(Walk { speed, weight, spectrum })
}

/// α below which (it is negative) a tip at rest that heals within T begins to walk: 1/(T²f''(0)).
///
/// At rest λ(Mλ + 1) = α f''(0) λT/(λ + 1/T), whatever M: the root 0 has company there. A depth limit does not count
/// at rest, but for the weight of w.
#[must_use]
pub fn walking_alpha(tip: &TipFunction, healing_time: f64) -> f64 {
    1.0 / (healing_time * healing_time * tip.slope_and_curvature(0.0).1)
}

/// A tip dragged as fast has the same groove, up to its sign.
fn law_at(model: &Model, speed: f64) -> Law {
    let dragged = Wider { spring: true, ..*model.wider() };
    let weight = Model::under(dragged, model.tip().clone(), model.alpha().abs(), speed)
        .map_or(1.0, |dragged| dragged.steady_weight());
    Law::with_density(model.wider(), model.tip(), speed, model.alpha() * weight / speed)
}

/// Of |φ1|: ∫_0^∞|f'|, or 1 for J0 and cos x.
fn slope_bound(tip: &TipFunction) -> f64 {
    match tip {
        TipFunction::Gaussians(sum) => sum.terms().iter().map(|g| 2.0 * g.amplitude.abs()).sum(),
        TipFunction::Bessel | TipFunction::Cosine => 1.0,
    }
}
