//! The critical point: where steady motion loses its stability.

use super::StabilityError;
use super::axis::{Axis, AxisPoint};
use super::crossings::Crossing;
use std::f64::consts::PI;
use stickslip_tip::{TipFunction, Wider, stop};

/// A point of the stability boundary, with the oscillation that bifurcates there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Critical {
    /// αc; (43) in the basic model.
    pub alpha: f64,
    /// r; (42) in the basic model.
    pub r: f64,
    /// Frequency ω = rΩ in time.
    pub omega: f64,
    /// T = 2π/ω.
    pub period: f64,
    /// L = 2πr/ω = 2π/Ω.
    pub wavelength: f64,
    /// Whether linear theory holds at this point.
    pub kind: OnsetKind,
    /// A = αw0/r, the indentation of the steady tip per length.
    pub density: f64,
    /// w0, the rate of indentation in steady motion relative to α: below 1 under a depth limit.
    pub weight: f64,
}

/// Kinds of onset, by the equation of small deviations at the critical point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "OnsetKindName"))]
pub enum OnsetKind {
    /// A linear equation.
    Smooth,
    /// A piecewise linear equation with the kink of |u|: alpha is the value at which a small oscillation keeps its
    /// amplitude.
    NonSmooth,
}

impl Critical {
    pub(super) fn new(alpha: f64, r: f64, kind: OnsetKind, at: Crossing) -> Self {
        let Crossing { density, wave_number } = at;
        let omega = r * wave_number;
        let (period, wavelength) = (2.0 * PI / omega, 2.0 * PI / wave_number);
        let weight = r * density / alpha;
        Self { alpha, r, omega, period, wavelength, kind, density, weight }
    }

    /// The critical point in the basic model, by (43): αc = r/c.
    pub(super) fn on_curve(r: f64, AxisPoint { cosine, wave_number, .. }: AxisPoint) -> Self {
        Self::basic(r / cosine, r, wave_number)
    }

    /// The critical point of J0 in the basic model: αc = r², and Ω of (47).
    pub(super) fn bessel(r: f64) -> Self {
        Self::basic(r * r, r, bessel_wave_number(r))
    }

    fn basic(alpha: f64, r: f64, wave_number: f64) -> Self {
        let at = Crossing { density: alpha / r, wave_number };
        Self { weight: 1.0, ..Self::new(alpha, r, OnsetKind::Smooth, at) }
    }
}

/// rc(α): the largest r at which a root of (30) reaches the imaginary axis, in the basic model.
///
/// Steady motion is stable at larger r.
///
/// # Errors
/// `alpha` is not a positive finite number, there is no crossing at any r, or the model is not the basic one.
pub fn critical_r(law: &Wider, tip: &TipFunction, alpha: f64) -> Result<Critical, StabilityError> {
    if !law.is_basic() {
        return Err(StabilityError::PapersLawOnly("the r at which a given α is critical"));
    }
    if !(alpha.is_finite() && alpha > 0.0) {
        return Err(StabilityError::Alpha(alpha));
    }
    if *tip == TipFunction::Bessel {
        let r = alpha.sqrt();
        return Ok(Critical::basic(alpha, r, bessel_wave_number(r)));
    }
    // r = αc: the fastest is the one of the largest c.
    let fastest = Axis::of(tip).crossings_of_alpha(alpha).into_iter().max_by(by_cosine);
    let none = unless_stopped(StabilityError::NoCriticalR { alpha });
    let AxisPoint { cosine, wave_number, .. } = fastest.ok_or(none)?;
    Ok(Critical::basic(alpha, alpha * cosine, wave_number))
}

pub(super) fn by_cosine(a: &AxisPoint, b: &AxisPoint) -> std::cmp::Ordering {
    a.cosine.total_cmp(&b.cosine)
}

/// Error of a search without result: `Stopped` after a request to stop, else `none`.
pub(super) fn unless_stopped(none: StabilityError) -> StabilityError {
    if stop::is_requested() { StabilityError::Stopped } else { none }
}

/// Ω of (47), written so that nothing cancels: Ω² = 2/(√(1+4r²) + 1).
pub(super) fn bessel_wave_number(r: f64) -> f64 {
    (2.0 / (f64::hypot(1.0, 2.0 * r) + 1.0)).sqrt()
}
