//! Steady motion as linear theory has it.

use num_complex::Complex64;
use std::f64::consts::TAU;
use stickslip_stability::{Spectrum, StabilityError, critical, leading_roots};
use stickslip_tip::{Model, Wider};

/// Whether small deviations from steady motion grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Linear {
    /// They decay at this rate at least.
    Stable(Slowest),
    /// They grow at this rate at most.
    Unstable(Slowest),
    /// Round-off hides which.
    Unknown,
}

/// The root of largest real part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Slowest {
    /// |Re λ|, in k/Γ.
    pub(crate) rate: f64,
    /// 2π/Im λ, or, of a real root, the time in which it changes by a factor of e; in Γ/k.
    pub(crate) period: f64,
}

impl Linear {
    pub(crate) fn of(model: &Model) -> Self {
        let spectrum = match leading_roots(model, 1) {
            Err(StabilityError::Corner) => beside_corner(model),
            found => found.ok(),
        };
        let Some(spectrum) = spectrum else { return Self::Unknown };
        let leading = spectrum.roots.first().copied().unwrap_or(Complex64::new(-1.0, 0.0));
        let rate = leading.re.abs();
        if rate <= spectrum.certificate.largest_error {
            return Self::Unknown;
        }
        let period = if leading.im > 0.0 { TAU / leading.im } else { 1.0 / rate };
        let slowest = Slowest { rate, period };
        if leading.re < 0.0 { Self::Stable(slowest) } else { Self::Unstable(slowest) }
    }
}

/// Where a depth limit has its corner at steady motion there are no exponents; small oscillations grow above another
/// αc, by about as much as without the limit that far above its own.
fn beside_corner(model: &Model) -> Option<Spectrum> {
    let (tip, r) = (model.tip(), model.r());
    let limited = critical(model.wider(), tip, r).ok()?.alpha;
    let alpha = model.alpha() * critical(&Wider::default(), tip, r).ok()?.alpha / limited;
    leading_roots(&Model::new(tip.clone(), alpha, r).ok()?, 1).ok()
}
