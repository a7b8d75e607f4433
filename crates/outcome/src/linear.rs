//! Linear stability of steady motion.

use num_complex::Complex64;
use std::f64::consts::TAU;
use stickslip_stability::{Spectrum, StabilityError, critical, leading_roots};
use stickslip_tip::{Model, Wider};

/// Whether small deviations from steady motion grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Linear {
    /// They decay, at least at this rate.
    Stable(Slowest),
    /// They grow, at most at this rate.
    Unstable(Slowest),
    /// Round-off hides the sign.
    Unknown,
}

/// The root of largest real part.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Slowest {
    /// |Re λ|, in k/Γ.
    pub(crate) rate: f64,
    /// 2π/Im λ; for a real root, the time in which a deviation changes by a factor of e; in Γ/k.
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

/// Where steady motion lies on the kink of a depth limit there are no exponents. Small oscillations grow above another
/// αc, at about the same rate as without the limit at the same distance above its own αc.
fn beside_corner(model: &Model) -> Option<Spectrum> {
    let (tip, r) = (model.tip(), model.r());
    let limited = critical(model.wider(), tip, r).ok()?.alpha;
    let alpha = model.alpha() * critical(&Wider::default(), tip, r).ok()?.alpha / limited;
    leading_roots(&Model::new(tip.clone(), alpha, r).ok()?, 1).ok()
}
