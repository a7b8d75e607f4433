//! `stickslip/cycle`.

use super::{ComplexDocument, History, ModelParameters, Software};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A periodic motion, l(t + T) = l(t). Lengths in σ, times in Γ/k, heights in kσ²/a; amplitudes are half
/// peak-to-peak.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CycleDocument {
    /// "stickslip/cycle"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// What was asked for.
    pub(crate) parameters: CycleParameters,
    /// T, in Γ/k.
    pub(crate) period: f64,
    /// rT, that of the surface left behind, in σ.
    pub(crate) wavelength: f64,
    /// Half peak-to-peak of l, that is of x0 less its steady advance, in σ.
    pub(crate) amplitude_x0: f64,
    /// Half peak-to-peak of the surface far behind the tip, (35), in kσ²/a.
    pub(crate) amplitude_u: f64,
    /// Maxima of l in one period.
    pub(crate) slips: usize,
    /// One period from where l is largest, sampled at uneven times: densely where the motion is fast.
    pub(crate) profile: CycleProfile,
    /// Floquet multipliers by falling modulus, down to 1e-6, the one above the real axis first of each
    /// pair: a small deviation is multiplied by them in each period. One is 1, that of a shift in time.
    pub(crate) floquet: Vec<ComplexDocument>,
    /// How far the multiplier that should be 1 is from it.
    pub(crate) floquet_error: f64,
    /// Whether every small deviation but a shift in time dies out.
    pub(crate) stable: bool,
    /// Estimate of the largest residual of (18) at any time, in kσ/Γ.
    pub(crate) residual: f64,
    /// One period, as it was solved for.
    pub(crate) history: History,
    /// What it took.
    pub(crate) work: CycleWork,
}

impl CycleDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/cycle";
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub(crate) struct CycleParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub(crate) model: ModelParameters,
    /// Largest residual of (18) asked for, in kσ/Γ.
    pub(crate) tolerance: f64,
}

/// Columns of equal length, at times that are uneven: each step of the cycle's mesh, short where the motion is fast,
/// is divided evenly. The largest velocity is seen to a per cent.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CycleProfile {
    /// From 0, where l is largest, to T, in Γ/k; ascending, at uneven distances.
    pub(crate) t: Vec<f64>,
    /// l = rt - r - x0, in σ.
    pub(crate) l: Vec<f64>,
    /// x0', in kσ/Γ.
    pub(crate) velocity: Vec<f64>,
}

/// Counts that depend on the input alone, and the time that it took.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CycleWork {
    /// Steps of the mesh over one period.
    pub(crate) steps: usize,
    /// Newton iterations, on all meshes.
    pub(crate) newton_iterations: usize,
    /// Time that it took, in seconds: the one field that differs from run to run.
    pub(crate) seconds: f64,
}
