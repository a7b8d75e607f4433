//! The critical point: where steady motion loses its stability.

use super::StabilityError;
use super::axis::{Axis, AxisPoint};
use std::f64::consts::PI;
use stickslip_tip::{TipFunction, stop};

/// A point of the stability boundary with the oscillation that is born there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Critical {
    /// αc, (43).
    pub alpha: f64,
    /// r, (42).
    pub r: f64,
    /// Frequency ω = rΩ in time.
    pub omega: f64,
    /// T = 2π/ω.
    pub period: f64,
    /// L = 2πr/ω = 2π/Ω.
    pub wavelength: f64,
}

impl Critical {
    pub(super) fn new(alpha: f64, r: f64, wave_number: f64) -> Self {
        let omega = r * wave_number;
        Self { alpha, r, omega, period: 2.0 * PI / omega, wavelength: 2.0 * PI / wave_number }
    }
}

/// αc(r): the smallest α at which a root of (30) reaches the imaginary axis.
///
/// Steady motion is stable below it. Several Ω can satisfy (42) at one r; all are found by scanning Ω
/// over the band of the tip function, and the one of the smallest α (43) is returned. For J0,
/// αc = r² and Ω of (47) are exact; the ω of (46), (47) is Ω of section IV.B, so that the frequency in
/// time is rΩ.
///
/// # Errors
/// `r` not a positive finite number, or no crossing at any α.
pub fn critical(tip: &TipFunction, r: f64) -> Result<Critical, StabilityError> {
    if !(r.is_finite() && r > 0.0) {
        return Err(StabilityError::R(r));
    }
    if matches!(tip, TipFunction::Bessel) {
        return Ok(Critical::new(r * r, r, bessel_wave_number(r)));
    }
    first_crossing(&Axis::new(tip), r)
}

pub(super) fn first_crossing(axis: &Axis, r: f64) -> Result<Critical, StabilityError> {
    // αc = r/c: the first crossing is the one of the largest c.
    let first = axis.crossings_of_r(r).into_iter().max_by(|a, b| a.cosine.total_cmp(&b.cosine));
    let none = unless_stopped(StabilityError::NoCrossing { r });
    let AxisPoint { cosine, wave_number, .. } = first.ok_or(none)?;
    Ok(Critical::new(r / cosine, r, wave_number))
}

/// rc(α): the largest r at which a root of (30) reaches the imaginary axis.
///
/// Coming from fast motion, which is stable, this is where stability is lost.
///
/// # Errors
/// `alpha` not a positive finite number, or no crossing at any r.
pub fn critical_r(tip: &TipFunction, alpha: f64) -> Result<Critical, StabilityError> {
    if !(alpha.is_finite() && alpha > 0.0) {
        return Err(StabilityError::Alpha(alpha));
    }
    if matches!(tip, TipFunction::Bessel) {
        let r = alpha.sqrt();
        return Ok(Critical::new(alpha, r, bessel_wave_number(r)));
    }
    let crossings = Axis::new(tip).crossings_of_alpha(alpha);
    let fastest = crossings.into_iter().max_by(|a, b| a.cosine.total_cmp(&b.cosine));
    // r = αc: the fastest is the one of the largest c.
    let none = unless_stopped(StabilityError::NoCriticalR { alpha });
    let AxisPoint { cosine, wave_number, .. } = fastest.ok_or(none)?;
    Ok(Critical::new(alpha, alpha * cosine, wave_number))
}

/// Why nothing was found, if the search came to its end.
fn unless_stopped(none: StabilityError) -> StabilityError {
    if stop::is_asked() { StabilityError::Stopped } else { none }
}

/// Ω of (47), written so that nothing cancels: Ω² = 2/(√(1+4r²) + 1).
pub(super) fn bessel_wave_number(r: f64) -> f64 {
    (2.0 / (f64::hypot(1.0, 2.0 * r) + 1.0)).sqrt()
}
