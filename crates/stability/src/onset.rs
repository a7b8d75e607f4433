//! The oscillation that bifurcates at the stability boundary: the Hopf bifurcation to leading order.
//!
//! Put l = l0 + A e^{iωt} + c.c. + … into (18), expanded to third order in the differences l(t-τ) - l(t). The terms
//! of frequency ω give the amplitude equation (Lindstedt's method) D_λ A' = -D_α (α - αc) A + N |A|²A. Here
//! D(λ) = h(λ/r) of (30), and subscripts are derivatives. `docs/explanation/linear-theory.md` derives N.

use super::critical::Critical;
use super::one_sided::OneSided;
use super::{StabilityError, critical};
use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::{Gaussian, TipFunction, Wider};

/// The side of the boundary on which the small oscillation exists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "CriticalityName"))]
pub enum Criticality {
    /// Above the critical α, where it is stable.
    Supercritical,
    /// Below the critical α, where it is unstable.
    Subcritical,
}

/// The small oscillation near a critical point, to leading order in α - αc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Onset {
    /// The critical point.
    pub critical: Critical,
    /// The side of the boundary on which the oscillation exists.
    pub criticality: Criticality,
    /// First Lyapunov coefficient: that of |A|³ in |A|', where l = l0 + A e^{iωt} + c.c. Negative if supercritical.
    pub lyapunov: f64,
    /// d(Re λ)/dα of the critical pair.
    pub growth_slope: f64,
    /// d(a²)/dα, where a is half the peak-to-peak value of l (or x0). Negative if subcritical.
    pub amplitude_squared_slope: f64,
    /// dT/dα of the period T along the branch.
    pub period_slope: f64,
    /// dω/dα along the branch.
    pub omega_slope: f64,
}

/// The bifurcation at αc(r).
///
/// Limits: the results are of leading order, with a relative error O(α - αc) in quantities that depend on α. The
/// critical pair must be the only one on the axis. For J0, 2Ω = 1 is excluded: `lyapunov` is infinite at this branch
/// point.
///
/// # Errors
/// As [`critical`]; [`StabilityError::DegenerateOnset`] where the coefficients are not finite or vanish.
pub fn onset(tip: &TipFunction, r: f64) -> Result<Onset, StabilityError> {
    onset_at(tip, critical(&Wider::default(), tip, r)?)
}

/// As [`onset`], for a critical point already known.
///
/// # Errors
/// As [`onset`].
pub fn onset_at(tip: &TipFunction, critical: Critical) -> Result<Onset, StabilityError> {
    let Coefficients { slope_lambda, slope_alpha, cubic } = Coefficients::new(tip, &critical);
    let growth = -slope_alpha / slope_lambda;
    let damping = cubic / slope_lambda;
    let square = -growth.re / damping.re;
    let omega_slope = growth.im + damping.im * square;
    let onset = Onset {
        critical,
        criticality: if square > 0.0 {
            Criticality::Supercritical
        } else {
            Criticality::Subcritical
        },
        lyapunov: damping.re,
        growth_slope: growth.re,
        // l = A e^{iωt} + c.c. swings between ±2|A|.
        amplitude_squared_slope: 4.0 * square,
        period_slope: -2.0 * PI * omega_slope / critical.omega.powi(2),
        omega_slope,
    };
    let usable = square.is_finite() && omega_slope.is_finite() && square.abs() > 0.0;
    if usable { Ok(onset) } else { Err(StabilityError::DegenerateOnset { r: critical.r }) }
}

/// D_λ, D_α and N at the critical point.
struct Coefficients {
    slope_lambda: Complex64,
    slope_alpha: Complex64,
    cubic: Complex64,
}

impl Coefficients {
    /// Φ_n(Λ) = ∫_0^∞ F^{(n)}(rτ) e^{-Λrτ}dτ, F = -αf', from G by parts: Φ1 = -κG, Φ2 = -κ(ΛG - f''(0)),
    /// Φ3 = -κ(Λ(ΛG - f''(0)) - f'''(0)), with κ = α/r.
    fn new(tip: &TipFunction, critical: &Critical) -> Self {
        let footprint = OneSided::new(tip);
        let kappa = critical.alpha / critical.r;
        let curvature = tip.slope_and_curvature(0.0).1;
        let i_omega = Complex64::new(0.0, critical.omega / critical.r);
        let (first, first_slope) = footprint.plain(i_omega).curvature;
        let (double, _) = footprint.plain(i_omega * 2.0).curvature;
        let second = |z: Complex64, g: Complex64| -(z * g - curvature) * kappa;
        let (p2, p2_double) = (second(i_omega, first), second(i_omega * 2.0, double));
        let p2_zero = kappa * curvature;
        // 0 for an even f.
        let p3_zero = kappa * third_derivative_at_0(tip);
        let (p3, p3_double) = (i_omega * p2 + p3_zero, i_omega * 2.0 * p2_double + p3_zero);

        // Second harmonic: D(2iω) B = b A².
        let b = (p2_double - p2 * 2.0 + p2_zero) * 0.5;
        let d_double = i_omega * (2.0 * critical.r) + 1.0 + double * kappa;
        let quadratic = b / d_double * (p2 - p2.conj() - p2_double + p2_zero);
        let cubic = quadratic + (p3 * 3.0 + p3.conj() - p3_double - p3_zero * 3.0) * 0.5;
        Self {
            slope_lambda: first_slope * (kappa / critical.r) + 1.0,
            slope_alpha: first / critical.r,
            cubic,
        }
    }
}

fn third_derivative_at_0(tip: &TipFunction) -> f64 {
    let TipFunction::Gaussians(sum) = tip else { return 0.0 };
    if tip.is_even() {
        return 0.0;
    }
    let term = |g: &Gaussian| {
        let z = g.center / g.width;
        g.amplitude * (z * z - 3.0) * z * (-0.5 * z * z).exp() / g.width.powi(3)
    };
    sum.terms().iter().map(term).sum()
}
