//! Steady motion as linear theory has it.

use num_complex::Complex64;
use stickslip_stability::leading_roots;
use stickslip_tip::Model;

/// Whether small deviations from steady motion grow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Linear {
    /// They decay at this rate, in k/Γ, at least.
    Stable(f64),
    /// They grow at this rate at most.
    Unstable(f64),
    /// Round-off hides which.
    Unknown,
}

impl Linear {
    pub(crate) fn of(model: &Model) -> Self {
        let Ok(spectrum) = leading_roots(model, 1) else { return Self::Unknown };
        let leading = spectrum.roots.first().copied().unwrap_or(Complex64::new(-1.0, 0.0));
        if leading.re.abs() <= spectrum.certificate.largest_error {
            Self::Unknown
        } else if leading.re < 0.0 {
            Self::Stable(-leading.re)
        } else {
            Self::Unstable(leading.re)
        }
    }
}
