//! `stickslip/compare`.

use crate::documents::table::{Array, Column, Named, Tabular};
use crate::{Document, Question, Run};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The closed equation against the full PDE. Lengths in σ, times in Γ/k, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CompareFound {
    /// Times of the motions below, in Γ/k.
    pub t: Vec<f64>,
    /// Positions of the surfaces below, which are those at the last time, in σ.
    pub x: Vec<f64>,
    /// The closed delay equation.
    pub closed: ClosedDocument,
    /// The PDE on a grid.
    pub grid: GridDocument,
    /// How far they are apart.
    pub max_difference: DifferenceDocument,
    /// Seconds of the grid over seconds of the closed equation, each per unit of time simulated. It
    /// differs from run to run, as `work.seconds` does.
    pub speedup: f64,
}

/// The document of that.
pub type CompareDocument = Document<CompareParameters>;

impl Question for CompareParameters {
    const FORMAT: &'static str = "stickslip/compare";
    type Answer = CompareFound;
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct CompareParameters {
    /// The run of the closed equation; the grid is given the same.
    #[serde(flatten)]
    pub run: Run,
    /// Discretisation.
    pub grid: GridName,
    /// Δx, in σ.
    pub spacing: f64,
    /// Local error allowed in a step, of x0 in σ and of heights in kσ²/a; null where all steps have one length.
    pub grid_tolerance: Option<f64>,
    /// That length, in Γ/k; null where steps are adaptive.
    pub step: Option<f64>,
    /// Time at which the grid ends, in Γ/k.
    pub grid_until: f64,
}

/// A discretisation of (10), (11).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum GridName {
    /// The paper's: heights on a uniform grid, all of them advanced at every stage; order 2.
    Uniform,
    /// The same heights, but only those within reach of the tip are touched; order 2.
    Windowed,
    /// A lattice that writes and reads with narrower Gaussians: exact to round-off in space.
    Spectral,
    /// Samples read by a regularised sinc: exact to round-off in space, another way.
    Sinc,
}

/// Motion, surface and work of the closed equation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClosedDocument {
    /// x0 at the times `t`, in σ.
    pub x0: Vec<f64>,
    /// u at the positions `x`, at the last time, in kσ²/a.
    pub u: Vec<f64>,
    /// What it took, from its start to `until`.
    pub work: ClosedWork,
}

/// Counts that depend on the input alone, and the time that it took.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClosedWork {
    /// Memory in use at the end.
    pub memory: String,
    /// Accepted steps.
    pub steps: u64,
    /// Steps repeated with a smaller length.
    pub rejected: u64,
    /// Newton iterations in all steps.
    pub newton_iterations: u64,
    /// Taylor series that were expanded: each makes one step or several, without an iteration.
    #[serde(default)]
    pub series: u64,
    /// How often collocation took over from series.
    #[serde(default)]
    pub switches: u64,
    /// Shortest time of several repetitions, in seconds.
    pub seconds: f64,
}

/// Motion, surface and work of the grid.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridDocument {
    /// x0 at the times `t`, in σ.
    pub x0: Vec<f64>,
    /// u at the positions `x`, at the last time, in kσ²/a.
    pub u: Vec<f64>,
    /// What it took, from its start to `grid_until`.
    pub work: GridWork,
}

/// Counts that depend on the input alone, and the time that it took.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridWork {
    /// Accepted steps.
    pub steps: u64,
    /// Steps repeated with a smaller length.
    pub rejected: u64,
    /// Evaluations of the right-hand side of (10).
    pub right_hand_sides: u64,
    /// Evaluations of the right-hand side of (11), summed over the cells.
    pub cells_updated: u64,
    /// Shortest time of as many repetitions as half a second allows, at least one, in seconds.
    pub seconds: f64,
}

/// Largest differences.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DifferenceDocument {
    /// In x0, over the times `t`, in σ.
    pub x0: f64,
    /// In u, over the positions `x` at the last time, in kσ²/a.
    pub u: f64,
}

impl Tabular for CompareFound {
    /// Both motions.
    fn columns(&self) -> Vec<Named<'_>> {
        vec![
            ("t", Column::of(&self.t)),
            ("closed", Column::of(&self.closed.x0)),
            ("grid", Column::of(&self.grid.x0)),
        ]
    }

    /// Motions and surfaces.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        vec![
            ("t", Array::vector(&self.t)),
            ("x", Array::vector(&self.x)),
            ("closed_x0", Array::vector(&self.closed.x0)),
            ("closed_u", Array::vector(&self.closed.u)),
            ("grid_x0", Array::vector(&self.grid.x0)),
            ("grid_u", Array::vector(&self.grid.u)),
        ]
    }
}
