//! Heights of the surface after a raster.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Area, Line, Path, Plan, Scanned};

/// The height map u(x,y).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeightMap {
    /// Positions along the lines, in σ.
    pub x: Vec<f64>,
    /// Positions across the lines, in σ.
    pub y: Vec<f64>,
    /// Heights, in kσ²/a: a row for each y.
    pub u: Vec<Vec<f64>>,
}

/// Points per width of the tip, along a line.
const POINTS: f64 = 4.0;
/// Largest number of points along a line.
const MOST: f64 = 4000.0;
/// Largest number of heights in a map: 80 MB.
const MOST_HEIGHTS: f64 = 1e7;
/// Number of rows on either side of a line that was scanned repeatedly.
const ROWS_BESIDE: usize = 20;

impl HeightMap {
    /// u at every y (rows) and every x (columns).
    pub(crate) fn at(plan: &Plan, lines: &[Line], x: Vec<f64>, y: Vec<f64>) -> Self {
        let heights = Scanned::new(plan, lines).heights(&x, &y);
        let u = heights.rows().into_iter().map(|row| row.to_vec()).collect();
        Self { x, y, u }
    }

    /// u on every line, at even distances from the smallest x to the largest. Unevenly spaced lines are interpolated
    /// on evenly spaced rows; around a repeated line, rows on either side are added.
    pub(crate) fn of(plan: &Plan, lines: &[Line]) -> Self {
        let width = 8.7 / plan.footprint.path().band();
        let (low, high) = plan.area.ends();
        let most = (MOST_HEIGHTS / plan.lines() as f64).clamp(2.0, MOST);
        let count = (POINTS * (high - low) / width).ceil().clamp(2.0, most);
        let x = (0..=count as usize).map(|i| low + (high - low) * i as f64 / count).collect();
        let y = if plan.path == Path::Repeat {
            let step = 0.5 * plan.reach_across() / ROWS_BESIDE as f64;
            (0..=2 * ROWS_BESIDE).map(|i| step * (i as f64 - ROWS_BESIDE as f64)).collect()
        } else {
            rows(plan)
        };
        Self::at(plan, lines, x, y)
    }
}

/// y of the rows: the lines, or at most as many evenly spaced rows over the same range.
fn rows(plan: &Plan) -> Vec<f64> {
    let y: Vec<f64> = (0..plan.lines()).map(|n| plan.track(n).y).collect();
    if matches!(plan.area, Area::Rectangle { .. }) || plan.area.pitch(plan.path).is_some() {
        return y;
    }
    let least = |low: f64, y: &f64| low.min(*y);
    let (low, high) =
        (y.iter().fold(f64::INFINITY, least), y.iter().copied().fold(f64::NEG_INFINITY, f64::max));
    let count = y.len().clamp(3, MOST as usize);
    // Lines that all lie at one y are looked at from both sides.
    let (low, high) = if high > low { (low, high) } else { (low - 1.0, high + 1.0) };
    (0..count).map(|i| low + (high - low) * i as f64 / (count - 1) as f64).collect()
}
