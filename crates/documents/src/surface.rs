//! `stickslip/surface`.

use crate::{ModelParameters, Software};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Surfaces reconstructed from a run. Lengths in σ, times in Γ/k, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceDocument {
    /// "stickslip/surface"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// Of the run that they come from.
    pub parameters: SurfaceParameters,
    /// One curve per time; none where images were asked for.
    pub surfaces: Vec<SurfaceCurve>,
    /// One image per time, in three dimensions.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub images: Vec<SurfaceImage>,
}

impl SurfaceDocument {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/surface";
}

/// What was reconstructed.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct SurfaceParameters {
    /// Footprint, α and r of the run.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// Whether the initial surface was left out, (35).
    pub far_behind: bool,
    /// Of images.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub across: Option<AcrossParameters>,
}

/// What images depend on besides the run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AcrossParameters {
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ; null where the tip has its own f(x,y).
    pub width_y: Option<f64>,
    /// k'/k above which y0 = 0 is certainly stable in steady motion, k' the transverse spring (52);
    /// null where no k' is certain to do.
    pub transverse_stiffness_needed: Option<f64>,
}

/// u(x,y,t) at one t.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceImage {
    /// Time, in Γ/k.
    pub t: f64,
    /// Positions along the way of the tip, in σ.
    pub x: Vec<f64>,
    /// Positions across it, in σ.
    pub y: Vec<f64>,
    /// Heights, in kσ²/a: a row for each y.
    pub u: Vec<Vec<f64>>,
}

/// u(x,t) at one t.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceCurve {
    /// Time, in Γ/k.
    pub t: f64,
    /// Positions, in σ.
    pub x: Vec<f64>,
    /// Heights there, in kσ²/a.
    pub u: Vec<f64>,
}
