//! `stickslip/boundary`.

use super::{CriticalityName, Software, TipDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The stability boundary. `Omega`, `r`, `alpha` and the columns of `onset` have equal lengths.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoundaryDocument {
    /// "stickslip/boundary"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// What was asked for.
    pub(crate) parameters: BoundaryParameters,
    /// Ω = ω/r of the oscillation that is born, in 1/σ.
    #[serde(rename = "Omega")]
    pub(crate) wave_number: Vec<f64>,
    /// r, ascending; those at which steady motion is stable for every α are left out.
    pub(crate) r: Vec<f64>,
    /// αc(r), the first crossing: steady motion is stable below.
    pub(crate) alpha: Vec<f64>,
    /// What is born there.
    pub(crate) onset: OnsetColumns,
    /// The whole curve (42), (43) within the range of r, by stretches on which Ω runs without a gap.
    /// Where there are several, or where one turns back in r, its parts above αc(r) are where further
    /// pairs of roots cross.
    pub(crate) branches: Vec<BranchDocument>,
    /// What is left out, and why; empty if nothing is.
    pub(crate) remarks: Vec<String>,
}

impl BoundaryDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/boundary";
}

/// How the range of r is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum SpacingName {
    /// Equal differences.
    Linear,
    /// Equal ratios.
    Logarithmic,
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BoundaryParameters {
    /// Footprint f.
    pub(crate) tip: TipDocument,
    /// First and last r.
    pub(crate) r_range: [f64; 2],
    /// Number of r.
    pub(crate) points: usize,
    /// How that range is divided.
    pub(crate) spacing: SpacingName,
}

/// The small oscillation along the boundary, to leading order in α - αc. Null where that says nothing.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OnsetColumns {
    /// Whether the oscillation is born with amplitude 0, beyond αc, or is there before.
    pub(crate) criticality: Vec<Option<CriticalityName>>,
    /// d(a²)/dα, a half the peak-to-peak of l, in σ².
    pub(crate) amplitude_squared_slope: Vec<Option<f64>>,
    /// dT/dα along the branch, in Γ/k.
    pub(crate) period_slope: Vec<Option<f64>>,
    /// First Lyapunov coefficient, in k/(Γσ²).
    pub(crate) lyapunov: Vec<Option<f64>>,
}

/// A stretch of the curve, evenly spaced in Ω.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct BranchDocument {
    /// Ω, ascending, in 1/σ.
    #[serde(rename = "Omega")]
    pub(crate) wave_number: Vec<f64>,
    /// r, dimensionless, (42).
    pub(crate) r: Vec<f64>,
    /// α, dimensionless, (43).
    pub(crate) alpha: Vec<f64>,
}
