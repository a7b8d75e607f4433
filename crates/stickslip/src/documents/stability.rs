//! `stickslip/stability`.

use crate::documents::table::{Named, Tabular};
use crate::schema::JsonSchema;
use serde::{Deserialize, Deserializer, Serialize};
use stickslip_stability::{
    Certificate, Creep, Critical, Criticality, Onset, OnsetKind, SnakingCritical,
};

/// Linear stability of steady motion. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StabilityFound {
    /// The critical point, at which the first root reaches the imaginary axis; null if none does, see `remarks`.
    pub critical: Option<CriticalDocument>,
    /// Whether every deviation from steady motion decays at the α and r of `parameters`. At the critical point
    /// itself, false.
    pub stable: bool,
    /// The logarithmic creep of a trapped tip.
    pub trapping: TrappingDocument,
    /// Growth exponents λ at the α and r of `parameters`, by falling real part; of each complex pair the one above the
    /// real axis comes first.
    pub roots: Vec<ComplexDocument>,
    /// Evidence that no growth exponent is missing.
    pub certificate: CertificateDocument,
    /// The oscillation at onset; null if the leading order is not available, see `remarks`.
    pub onset: Option<OnsetDocument>,
    /// Extended model only: conditions under which steady motion is stable at every α.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<LimitsDocument>,
    /// Onset of snaking, with a spring across the scan; null if the tip never snakes.
    #[serde(default, skip_serializing_if = "Option::is_none", deserialize_with = "present")]
    pub snaking: Option<Option<SnakingDocument>>,
}

/// Onset of snaking on a single line, for a tip that is free to move across the scan.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SnakingDocument {
    /// α_y, the smallest α at which some deviation across the scan does not decay.
    pub alpha: f64,
    /// Frequency ω of the deviation that does not decay at this α, in k/Γ.
    pub omega: f64,
    /// 2πr/ω, in σ.
    pub wavelength: f64,
}

/// Deserialises an explicit null as `Some(None)`, to distinguish it from a missing field.
fn present<'de, T: Deserialize<'de>, D: Deserializer<'de>>(d: D) -> Result<Option<T>, D::Error> {
    T::deserialize(d).map(Some)
}

/// The parameter that is varied to find a critical point.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SolveFor {
    /// αc at a given r.
    #[default]
    Alpha,
    /// rc at a given α.
    R,
}

/// A complex number.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ComplexDocument {
    /// Real part, in the unit of the number.
    pub re: f64,
    /// Imaginary part, in the unit of the number.
    pub im: f64,
}

/// A point of the stability boundary with the oscillation that bifurcates there.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CriticalDocument {
    /// αc, (43).
    pub alpha: f64,
    /// rc, (42).
    pub r: f64,
    /// Frequency ω in time, in k/Γ.
    pub omega: f64,
    /// 2π/ω, in Γ/k.
    pub period: f64,
    /// 2πr/ω, in σ.
    pub wavelength: f64,
    /// Extended model only: the kind of onset at this point.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kind: Option<OnsetKind>,
}

/// Depth limit and memory length below which steady motion is stable at every α.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitsDocument {
    /// Depth limit b_c, in kσ²/a. With a depth limit below b_c, and the healing and inertia of `parameters`, steady
    /// motion is stable at every α. Null if steady motion is stable at every b, or unstable at some α for every b. Also
    /// null if the height under the steady tip is 0, the kink of |u|.
    pub least_depth_limit: Option<f64>,
    /// The product of r and healing time, in σ, below which steady motion is stable at every α and r without a depth
    /// limit. Null if there is none.
    pub memory_length: Option<f64>,
}

/// Permanent creep, x0 ~ (1/p) ln t.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrappingDocument {
    /// The smallest α at which permanent creep exists at this r; null if there is none at any α.
    pub alpha: Option<f64>,
    /// All rates p of creep at the α and r of `parameters`, in 1/σ, ascending; null if there are none.
    pub creep_rates: Option<Vec<f64>>,
    /// The stable rate of creep, which a trapped tip approaches, in 1/σ. Null if there is none, or if a complex root
    /// lies to the right of all rates: then every stick ends in a slip.
    pub attracting: Option<f64>,
    /// All roots p of 1 + (α/r) G(p) = 0 with a positive real part, in 1/σ, by falling real part; G is the one-sided
    /// Laplace transform of f''. Null if they could not be computed, see `remarks`.
    pub creep_roots: Option<Vec<ComplexDocument>>,
}

/// The rectangle re_min ≤ Re λ ≤ re_max, |Im λ| ≤ im_max, and the number of roots in it. No root outside has a real
/// part above re_min.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CertificateDocument {
    /// Left edge of the rectangle, in k/Γ.
    pub re_min: f64,
    /// Right edge of the rectangle, in k/Γ.
    pub re_max: f64,
    /// Upper edge of the rectangle, in k/Γ; the lower edge is its negative.
    pub im_max: f64,
    /// Number of roots in the rectangle, by the argument principle.
    pub counted: usize,
    /// Number of different listed roots that solve the equation.
    pub found: usize,
    /// Whether `counted` and `found` agree, and every listed root solves the equation.
    pub complete: bool,
    /// Largest residual of a listed root, relative to the terms of the equation.
    pub largest_residual: f64,
    /// Estimate of the largest error of a listed λ, in k/Γ.
    pub largest_error: f64,
}

/// The small oscillation near the critical point, to leading order in α - αc.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OnsetDocument {
    /// Whether the oscillation starts with amplitude 0 beyond αc (supercritical) or exists already below it
    /// (subcritical).
    pub criticality: Criticality,
    /// d(a²)/dα, with a = half the peak-to-peak of l, in σ².
    pub amplitude_squared_slope: f64,
    /// dT/dα of the period T along the branch of cycles, in Γ/k.
    pub period_slope: f64,
    /// dω/dα along the branch of cycles, in k/Γ.
    pub omega_slope: f64,
    /// d(Re λ)/dα of the critical pair, in k/Γ.
    pub growth_slope: f64,
    /// First Lyapunov coefficient, in k/(Γσ²): A' = … + (this + i…) |A|²A for l = l0 + A e^{iωt} + c.c. + ….
    pub lyapunov: f64,
}

impl ComplexDocument {
    /// The complex number with these parts.
    pub fn new(re: f64, im: f64) -> Self {
        Self { re, im }
    }
}

impl TrappingDocument {
    /// The trapping threshold and the creep rates; and a warning if a trapped tip approaches none of them.
    pub(crate) fn of(alpha: Option<f64>, creep: Option<&Creep>) -> (Self, Option<String>) {
        let rates = creep.map(Creep::rates).unwrap_or_default();
        let attracting = creep.and_then(Creep::attracting);
        let remark = (!rates.is_empty() && attracting.is_none()).then(|| {
            "trapping: a complex pair of creep_roots lies right of every real rate: no tip stays trapped here, every stick \
             ends in a slip"
                .into()
        });
        let of =
            |creep: &Creep| creep.roots.iter().map(|p| ComplexDocument::new(p.re, p.im)).collect();
        let creep_rates = (!rates.is_empty()).then_some(rates);
        (Self { alpha, creep_rates, attracting, creep_roots: creep.map(of) }, remark)
    }
}

impl CriticalDocument {
    /// A critical point, with its kind in an extended model.
    pub fn of(critical: &Critical, kind: Option<OnsetKind>) -> Self {
        let Critical { alpha, r, omega, period, wavelength, .. } = *critical;
        Self { alpha, r, omega, period, wavelength, kind }
    }
}

impl From<&Certificate> for CertificateDocument {
    fn from(certificate: &Certificate) -> Self {
        Self {
            re_min: certificate.region.re_min,
            re_max: certificate.region.re_max,
            im_max: certificate.region.im_max,
            counted: certificate.counted,
            found: certificate.found,
            complete: certificate.is_complete(),
            largest_residual: certificate.largest_residual,
            largest_error: certificate.largest_error,
        }
    }
}

impl From<SnakingCritical> for SnakingDocument {
    fn from(SnakingCritical { alpha, omega, wavelength, .. }: SnakingCritical) -> Self {
        Self { alpha, omega, wavelength }
    }
}

impl From<&Onset> for OnsetDocument {
    fn from(onset: &Onset) -> Self {
        Self {
            criticality: onset.criticality,
            amplitude_squared_slope: onset.amplitude_squared_slope,
            period_slope: onset.period_slope,
            omega_slope: onset.omega_slope,
            growth_slope: onset.growth_slope,
            lyapunov: onset.lyapunov,
        }
    }
}

impl Tabular for StabilityFound {
    /// The growth exponents as a table.
    fn columns(&self) -> Vec<Named<'_>> {
        let column = |of: fn(&ComplexDocument) -> f64| self.roots.iter().map(of).collect();
        vec![("re", column(|root| root.re)), ("im", column(|root| root.im))]
    }
}
