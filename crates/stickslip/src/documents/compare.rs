//! `stickslip/compare`.

use crate::documents::table::{Array, Named, Tabular, columns};
use crate::schema::JsonSchema;
use crate::{Document, Question, Run};
use serde::{Deserialize, Serialize};

/// Comparison of the closed equation with the full PDE. Lengths in σ, times in Γ/k, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CompareFound {
    /// Times of the motions of `closed` and `grid`, in Γ/k.
    pub t: Vec<f64>,
    /// Positions of the surfaces of `closed` and `grid`, in σ; the surfaces are those at the last time.
    pub x: Vec<f64>,
    /// Results of the closed delay equation.
    pub closed: ClosedDocument,
    /// Results of the PDE on a grid.
    pub grid: GridDocument,
    /// Largest differences between closed equation and grid.
    pub max_difference: DifferenceDocument,
    /// Computing time of the grid over that of the closed equation, each per unit of simulated time. This ratio differs
    /// from run to run, as `work.seconds` does.
    pub speedup: f64,
}

/// A comparison and the question that it answers.
pub type CompareDocument = Document<CompareParameters>;

impl Question for CompareParameters {
    const FORMAT: &'static str = "stickslip/compare";
    type Answer = CompareFound;
}

/// The parameters of the comparison.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct CompareParameters {
    /// The run of the closed equation; the grid has the same model and initial condition.
    #[serde(flatten)]
    pub run: Run,
    /// Discretisation.
    pub grid: GridName,
    /// Δx, the distance of grid points, in σ.
    pub spacing: f64,
    /// Local error allowed in a step, of x0 in σ and of heights in kσ²/a; null if the step is constant.
    pub grid_tolerance: Option<f64>,
    /// Constant length of all steps, in Γ/k; null if steps are adaptive.
    pub step: Option<f64>,
    /// Time at which the grid ends, in Γ/k.
    pub grid_until: f64,
}

/// A discretisation of (10), (11).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum GridName {
    /// The paper's method: heights on a uniform grid, all of them advanced at every stage; order 2.
    Uniform,
    /// The same grid, but only heights within reach of the tip are updated; order 2.
    Windowed,
    /// A lattice with narrower Gaussians for writing and reading: exact to round-off in space.
    Spectral,
    /// Samples interpolated by a regularised sinc: a second method that is exact to round-off in space.
    Sinc,
}

/// Motion, surface and work of the closed equation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClosedDocument {
    /// x0 at the times `t`, in σ.
    pub x0: Vec<f64>,
    /// y0 at the times `t`, in σ, if the tip is free to move across the scan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y0: Option<Vec<f64>>,
    /// u at the positions `x` on the line y = 0, at the last time, in kσ²/a.
    pub u: Vec<f64>,
    /// Cost of the run from its start to `until`.
    pub work: ClosedWork,
}

/// Counts that depend on the input alone, and the time of the computation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClosedWork {
    /// Memory in use at the end.
    pub memory: String,
    /// Number of accepted steps.
    pub steps: u64,
    /// Number of steps repeated with a smaller length.
    pub rejected: u64,
    /// Number of Newton iterations in all steps.
    pub newton_iterations: u64,
    /// Number of Taylor expansions; each makes one or several steps without iteration.
    #[serde(default)]
    pub series: u64,
    /// Number of changes from Taylor steps to collocation.
    #[serde(default)]
    pub switches: u64,
    /// Shortest computing time of several repetitions, in seconds.
    pub seconds: f64,
}

/// Motion, surface and work of the grid.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridDocument {
    /// x0 at the times `t`, in σ.
    pub x0: Vec<f64>,
    /// y0 at the times `t`, in σ, if the tip is free to move across the scan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y0: Option<Vec<f64>>,
    /// u at the positions `x` on the line y = 0, at the last time, in kσ²/a.
    pub u: Vec<f64>,
    /// Cost of the grid from its start to `grid_until`.
    pub work: GridWork,
}

/// Counts that depend on the input alone, and the time of the computation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GridWork {
    /// Number of accepted steps.
    pub steps: u64,
    /// Number of steps repeated with a smaller length.
    pub rejected: u64,
    /// Number of evaluations of the right-hand side of (10).
    pub right_hand_sides: u64,
    /// Number of evaluations of the right-hand side of (11), summed over the cells.
    pub cells_updated: u64,
    /// Shortest computing time of the repetitions within half a second, at least one, in seconds.
    pub seconds: f64,
}

/// Largest differences between closed equation and grid.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DifferenceDocument {
    /// Difference of x0, over the times `t`, in σ.
    pub x0: f64,
    /// Difference of y0, over the times `t`, in σ, if the tip is free to move across the scan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y0: Option<f64>,
    /// Difference of u, over the positions `x` at the last time, in kσ²/a.
    pub u: f64,
}

impl CompareFound {
    /// y0 of both sides, if the tip is free to move across the scan.
    fn across(&self) -> impl Iterator<Item = (&'static str, &Vec<f64>)> {
        let sides = [("closed_y0", &self.closed.y0), ("grid_y0", &self.grid.y0)];
        sides.into_iter().filter_map(|(name, y0)| Some((name, y0.as_ref()?)))
    }
}

impl Tabular for CompareFound {
    /// Both motions as a table.
    fn columns(&self) -> Vec<Named<'_>> {
        let (t, closed, grid) = (&self.t, &self.closed.x0, &self.grid.x0);
        let mut columns = columns!(t, closed, grid);
        columns.extend(self.across().map(|(name, y0)| (name, y0.into())));
        columns
    }

    /// Motions and surfaces as arrays.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let mut arrays = vec![
            ("t", Array::vector(&self.t)),
            ("x", Array::vector(&self.x)),
            ("closed_x0", Array::vector(&self.closed.x0)),
            ("closed_u", Array::vector(&self.closed.u)),
            ("grid_x0", Array::vector(&self.grid.x0)),
            ("grid_u", Array::vector(&self.grid.u)),
        ];
        arrays.extend(self.across().map(|(name, y0)| (name, Array::vector(y0))));
        arrays
    }
}
