//! `stickslip/compare`.

use super::{ForceTable, ModelParameters, NoiseParameters, Profile, PulseParameters, Software};
use crate::arguments::{GridName, MemoryName, StartName};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The closed equation against the full PDE. Lengths in σ, times in Γ/k, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CompareDocument {
    /// "stickslip/compare"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// What was asked for.
    pub(crate) parameters: CompareParameters,
    /// Times of the motions below, in Γ/k.
    pub(crate) t: Vec<f64>,
    /// Positions of the surfaces below, which are those at the last time, in σ.
    pub(crate) x: Vec<f64>,
    /// The closed delay equation.
    pub(crate) closed: ClosedDocument,
    /// The PDE on a grid.
    pub(crate) grid: GridDocument,
    /// How far they are apart.
    pub(crate) max_difference: DifferenceDocument,
    /// Seconds of the grid over seconds of the closed equation, each per unit of time simulated. It
    /// differs from run to run, as `work.seconds` does.
    pub(crate) speedup: f64,
}

impl CompareDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/compare";
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub(crate) struct CompareParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub(crate) model: ModelParameters,
    /// Initial state.
    pub(crate) start: StartName,
    /// X: position of the tip at the start, in σ.
    pub(crate) start_position: f64,
    /// D: the tip starts at X - D, in σ.
    pub(crate) kick: f64,
    /// Noise added to the initial surface.
    pub(crate) noise: Option<NoiseParameters>,
    /// Profile added to the initial surface.
    pub(crate) initial_surface: Option<Profile>,
    /// Gaussian pulses of external force.
    pub(crate) pulses: Vec<PulseParameters>,
    /// Tabulated external force.
    pub(crate) force: Option<ForceTable>,
    /// Time at which the closed equation ends, in Γ/k.
    pub(crate) until: f64,
    /// Error asked of the closed equation, in σ.
    pub(crate) tolerance: f64,
    /// Memory asked for.
    pub(crate) memory: MemoryName,
    /// Discretisation.
    pub(crate) grid: GridName,
    /// Δx, in σ.
    pub(crate) spacing: f64,
    /// Local error allowed in a step, of x0 in σ and of heights in kσ²/a; null where all steps have one length.
    pub(crate) grid_tolerance: Option<f64>,
    /// That length, in Γ/k; null where steps are adaptive.
    pub(crate) step: Option<f64>,
    /// Time at which the grid ends, in Γ/k.
    pub(crate) grid_until: f64,
}

/// Motion, surface and work of the closed equation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ClosedDocument {
    /// x0 at the times `t`, in σ.
    pub(crate) x0: Vec<f64>,
    /// u at the positions `x`, at the last time, in kσ²/a.
    pub(crate) u: Vec<f64>,
    /// What it took, from its start to `until`.
    pub(crate) work: ClosedWork,
}

/// Counts that depend on the input alone, and the time that it took.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ClosedWork {
    /// Memory in use at the end.
    pub(crate) memory: String,
    /// Accepted steps.
    pub(crate) steps: u64,
    /// Steps repeated with a smaller length.
    pub(crate) rejected: u64,
    /// Newton iterations in all steps.
    pub(crate) newton_iterations: u64,
    /// Shortest time of several repetitions, in seconds.
    pub(crate) seconds: f64,
}

/// Motion, surface and work of the grid.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GridDocument {
    /// x0 at the times `t`, in σ.
    pub(crate) x0: Vec<f64>,
    /// u at the positions `x`, at the last time, in kσ²/a.
    pub(crate) u: Vec<f64>,
    /// What it took, from its start to `grid_until`.
    pub(crate) work: GridWork,
}

/// Counts that depend on the input alone, and the time that it took.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct GridWork {
    /// Accepted steps.
    pub(crate) steps: u64,
    /// Steps repeated with a smaller length.
    pub(crate) rejected: u64,
    /// Evaluations of the right-hand side of (10).
    pub(crate) right_hand_sides: u64,
    /// Evaluations of the right-hand side of (11), summed over the cells.
    pub(crate) cells_updated: u64,
    /// Shortest time of as many repetitions as half a second allows, at least one, in seconds.
    pub(crate) seconds: f64,
}

/// Largest differences.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct DifferenceDocument {
    /// In x0, over the times `t`, in σ.
    pub(crate) x0: f64,
    /// In u, over the positions `x` at the last time, in kσ²/a.
    pub(crate) u: f64,
}
