//! `stickslip/raster-compare`.

use crate::documents::table::{Array, Column, Named, Tabular, as_arrays};
use crate::schema::JsonSchema;
use crate::{DifferenceDocument, Document, GridName, GridWork, Question, Raster};
use serde::{Deserialize, Serialize};
use stickslip_raster::{Line, Plan, Scanned};

/// Comparison of a raster with the full PDE on rows of cells. Lengths in σ, times in Γ/k, heights in kσ²/a; times
/// count from the start of each line.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterCompareFound {
    /// The lines in the order in which they were scanned.
    pub lines: Vec<ComparedLine>,
    /// Positions of `closed_u` and `grid_u` along the lines, in σ; these surfaces are those after the last line.
    pub x: Vec<f64>,
    /// y of the rows, one for every line, ascending, in σ.
    pub y: Vec<f64>,
    /// Heights from the closed equation, in kσ²/a: a row for each y.
    pub closed_u: Vec<Vec<f64>>,
    /// Heights from the grid, in kσ²/a.
    pub grid_u: Vec<Vec<f64>>,
    /// Largest differences between closed equation and grid.
    pub max_difference: DifferenceDocument,
    /// Cost of the closed equation.
    pub closed_work: RasterComparedWork,
    /// Cost of the grid.
    pub grid_work: GridWork,
    /// Computing time of the grid over that of the closed equation. This ratio differs from run to run, as `seconds` do.
    pub speedup: f64,
}

/// A comparison of rasters and the question that it answers.
pub type RasterCompareDocument = Document<RasterCompareParameters>;

impl Question for RasterCompareParameters {
    const FORMAT: &'static str = "stickslip/raster-compare";
    type Answer = RasterCompareFound;
}

/// The parameters of the comparison.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct RasterCompareParameters {
    /// The raster.
    #[serde(flatten)]
    pub raster: Raster,
    /// Discretisation: sinc or windowed, or spectral if the tip is free to move across the lines.
    pub grid: GridName,
    /// Δx of the cells, in σ.
    pub spacing: f64,
    /// Local error allowed in a step, of x0 in σ and of heights in kσ²/a; null if the step is constant.
    pub grid_tolerance: Option<f64>,
    /// Constant length of all steps, in Γ/k; null if steps are adaptive.
    pub step: Option<f64>,
}

/// Both motions along one line.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ComparedLine {
    /// y of the line, in σ.
    pub y: f64,
    /// Times since the start of the line, in Γ/k: those requested, or the ends of the grid's steps.
    pub t: Vec<f64>,
    /// x0 from the closed equation, in σ.
    pub closed_x0: Vec<f64>,
    /// x0 from the grid, in σ.
    pub grid_x0: Vec<f64>,
    /// y0 from the closed equation, in σ, if the tip is free to move across the lines.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closed_y0: Option<Vec<f64>>,
    /// y0 from the grid, in σ, if the tip is free to move across the lines.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub grid_y0: Option<Vec<f64>>,
}

/// Counts that depend on the input alone, and the time of the computation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterComparedWork {
    /// Number of accepted steps.
    pub steps: u64,
    /// Number of steps repeated with a smaller length.
    pub rejected: u64,
    /// Number of Newton iterations in all steps.
    pub newton_iterations: u64,
    /// Shortest computing time of the repetitions within half a second, at least one, in seconds.
    pub seconds: f64,
}

/// Results of a grid for a raster.
pub struct RasterCompared {
    /// Positions along rows.
    pub x: Vec<f64>,
    /// For each line, times since its start with (x0, y0).
    pub motions: Vec<Vec<(f64, [f64; 2])>>,
    /// y of the rows.
    pub y: Vec<f64>,
    /// Heights, a row for each y.
    pub u: Vec<Vec<f64>>,
    /// Cost of the grid.
    pub work: GridWork,
}

impl RasterCompareFound {
    /// The comparison of a plan, its lines and their computing time in seconds with the result of the grid.
    pub fn new((plan, lines, seconds): (&Plan, &[Line], f64), grid: RasterCompared) -> Self {
        let is_free = plan.free.is_some();
        let compared = |(line, motion): (&Line, &Vec<(f64, [f64; 2])>)| {
            let t: Vec<f64> = motion.iter().map(|(t, _)| *t).collect();
            let grid = |axis: usize| motion.iter().map(|(_, at)| at[axis]).collect();
            let closed = |of: fn(&Line, f64) -> f64| t.iter().map(|t| of(line, *t)).collect();
            ComparedLine {
                y: line.track().y,
                closed_x0: closed(Line::x0),
                grid_x0: grid(0),
                closed_y0: is_free.then(|| closed(Line::y0)),
                grid_y0: is_free.then(|| grid(1)),
                t,
            }
        };
        let compared: Vec<ComparedLine> = lines.iter().zip(&grid.motions).map(compared).collect();
        let heights = Scanned::new(plan, lines).heights(&grid.x, &grid.y);
        let closed_u: Vec<Vec<f64>> = heights.rows().into_iter().map(|row| row.to_vec()).collect();
        let pairs = compared.iter().flat_map(|line| line.closed_x0.iter().zip(&line.grid_x0));
        let across = compared
            .iter()
            .flat_map(|line| line.closed_y0.iter().flatten().zip(line.grid_y0.iter().flatten()));
        let max_difference = DifferenceDocument {
            x0: largest(pairs),
            y0: is_free.then(|| largest(across)),
            u: largest(closed_u.iter().flatten().zip(grid.u.iter().flatten())),
        };
        let total = |of: fn(&Line) -> u64| lines.iter().map(of).sum();
        Self {
            lines: compared,
            x: grid.x,
            y: grid.y,
            closed_u,
            grid_u: grid.u,
            max_difference,
            closed_work: RasterComparedWork {
                steps: total(|line| line.work().steps),
                rejected: total(|line| line.work().rejected),
                newton_iterations: total(|line| line.work().newton_iterations),
                seconds,
            },
            speedup: grid.work.seconds / seconds,
            grid_work: grid.work,
        }
    }
}

/// The largest difference; NaN if any is NaN.
fn largest<'a>(pairs: impl Iterator<Item = (&'a f64, &'a f64)>) -> f64 {
    let differences = pairs.map(|(a, b)| (a - b).abs());
    differences.fold(0.0, |most, d| if d.is_nan() || d > most { d } else { most })
}

impl Tabular for RasterCompareFound {
    /// Both motions as a table, line after line.
    fn columns(&self) -> Vec<Named<'_>> {
        let joined =
            |of: fn(&ComparedLine) -> &Vec<f64>| -> Column { self.lines.iter().map(of).collect() };
        let rows = |(n, line): (usize, &ComparedLine)| vec![n as f64 + 1.0; line.t.len()];
        let mut columns = vec![
            ("line", self.lines.iter().enumerate().flat_map(rows).collect()),
            ("t", joined(|line| &line.t)),
            ("closed", joined(|line| &line.closed_x0)),
            ("grid", joined(|line| &line.grid_x0)),
        ];
        if self.max_difference.y0.is_some() {
            let across = |of: fn(&ComparedLine) -> &Option<Vec<f64>>| -> Column {
                self.lines.iter().filter_map(|line| of(line).as_ref()).collect()
            };
            columns.push(("closed_y0", across(|line| &line.closed_y0)));
            columns.push(("grid_y0", across(|line| &line.grid_y0)));
        }
        columns
    }

    /// Motions one after the other, and both surfaces, as arrays.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let mut arrays: Vec<_> = as_arrays(self.columns()).collect();
        arrays.extend([
            ("x", Array::vector(&self.x)),
            ("y", Array::vector(&self.y)),
            ("closed_u", Array::matrix(&self.closed_u)),
            ("grid_u", Array::matrix(&self.grid_u)),
        ]);
        arrays
    }
}
