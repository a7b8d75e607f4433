//! `stickslip/surface`.

use super::{ModelParameters, Software};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Surfaces reconstructed from a run. Lengths in σ, times in Γ/k, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SurfaceDocument {
    /// "stickslip/surface"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// Of the run that they come from.
    pub(crate) parameters: SurfaceParameters,
    /// One curve per time.
    pub(crate) surfaces: Vec<SurfaceCurve>,
}

impl SurfaceDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/surface";
}

/// What was reconstructed.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub(crate) struct SurfaceParameters {
    /// Footprint, α and r of the run.
    #[serde(flatten)]
    pub(crate) model: ModelParameters,
    /// Whether the initial surface was left out, (35).
    pub(crate) far_behind: bool,
}

/// u(x,t) at one t.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SurfaceCurve {
    pub(crate) t: f64,
    pub(crate) x: Vec<f64>,
    pub(crate) u: Vec<f64>,
}
