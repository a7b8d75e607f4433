//! `stickslip/units`.

use super::{Software, TipDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Measured quantities and the numbers of the model.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnitsDocument {
    /// "stickslip/units"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// What was given.
    pub(crate) parameters: UnitsParameters,
    /// α = Γ N a/(σ² k²), dimensionless, (13).
    pub(crate) alpha: f64,
    /// r = Γ v0/(kσ), dimensionless, (12).
    pub(crate) r: f64,
    /// All six quantities.
    pub(crate) physical: PhysicalDocument,
    /// By how much the tip lags behind the support in steady motion.
    pub(crate) lag: LagDocument,
    /// What one unit of the model is.
    pub(crate) scales: ScalesDocument,
    /// Where stick-slip sets in.
    pub(crate) critical: CriticalUnits,
    /// Whether steady motion is stable.
    pub(crate) stable: bool,
    /// Why something is null; empty if nothing is.
    pub(crate) remarks: Vec<String>,
}

impl UnitsDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/units";
}

/// What was given; null for what was solved for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct UnitsParameters {
    /// Footprint f.
    pub(crate) tip: TipDocument,
    /// Γ in kg/s.
    pub(crate) damping: Option<f64>,
    /// k in N/m.
    pub(crate) stiffness: Option<f64>,
    /// σ in m.
    pub(crate) tip_width: Option<f64>,
    /// N in m/s.
    pub(crate) indentation_rate: Option<f64>,
    /// a in N.
    pub(crate) slope_force: Option<f64>,
    /// v0 in m/s.
    pub(crate) velocity: Option<f64>,
    /// α, dimensionless.
    pub(crate) alpha: Option<f64>,
    /// D, where α was given as αc(r) + D; dimensionless.
    pub(crate) alpha_above: Option<f64>,
    /// r, dimensionless.
    pub(crate) r: Option<f64>,
}

/// SI values.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PhysicalDocument {
    /// Γ in kg/s.
    pub(crate) damping: f64,
    /// k in N/m.
    pub(crate) stiffness: f64,
    /// σ in m.
    pub(crate) tip_width: f64,
    /// N in m/s.
    pub(crate) indentation_rate: f64,
    /// a in N.
    pub(crate) slope_force: f64,
    /// v0 in m/s.
    pub(crate) velocity: f64,
}

/// D of (23).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LagDocument {
    /// (Γ v0 + N a f(0)/v0)/k in m.
    pub(crate) metres: f64,
    /// r + α f(0)/r, in σ.
    pub(crate) dimensionless: f64,
}

/// SI values of the model's units.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ScalesDocument {
    /// σ in m, for x, l and x0.
    pub(crate) length: f64,
    /// Γ/k in s.
    pub(crate) time: f64,
    /// kσ²/a in m, for the surface u.
    pub(crate) height: f64,
    /// kσ in N, for the external force.
    pub(crate) force: f64,
}

/// The onset of stick-slip, one quantity varied and all else as it is. Null where there is none.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CriticalUnits {
    /// αc(r), dimensionless.
    pub(crate) alpha: Option<f64>,
    /// N in m/s above which there is stick-slip.
    pub(crate) indentation_rate: Option<f64>,
    /// Period at that N, in s.
    pub(crate) period: Option<f64>,
    /// Wavelength at that N, in m.
    pub(crate) wavelength: Option<f64>,
    /// rc(α), the largest, dimensionless.
    pub(crate) r: Option<f64>,
    /// v0 in m/s below which there is stick-slip.
    pub(crate) velocity: Option<f64>,
}
