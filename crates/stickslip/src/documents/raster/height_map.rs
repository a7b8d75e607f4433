//! Heights of the surface after a raster.

use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Area, Line, Path, Plan, Scanned};
use stickslip_tip::sorting::ends;

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
/// Rows per width of the tip, and their largest number, between lines of a tip that is free to move across.
const ROWS_OF_A_WIDTH: f64 = 2.0;
const MOST_ROWS: f64 = 4000.0;
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
    /// on evenly spaced rows; around a repeated line, rows on either side are added, and for a tip that is free to move
    /// across, rows between the lines.
    pub(crate) fn of(plan: &Plan, lines: &[Line]) -> Self {
        let width = 8.7 / plan.footprint.path().band();
        let (low, high) = plan.area.ends();
        let y = if plan.path == Path::Repeat {
            let step = 0.5 * plan.reach_across() / ROWS_BESIDE as f64;
            (0..=2 * ROWS_BESIDE).map(|i| step * (i as f64 - ROWS_BESIDE as f64)).collect()
        } else {
            rows(plan)
        };
        let most = (MOST_HEIGHTS / plan.lines().max(y.len()) as f64).clamp(2.0, MOST);
        let count = (POINTS * (high - low) / width).ceil().clamp(2.0, most);
        let x = (0..=count as usize).map(|i| low + (high - low) * i as f64 / count).collect();
        Self::at(plan, lines, x, y)
    }
}

/// y of the rows between the first line and the last, for a tip that is free to move across lines one pitch apart: one
/// on every line, and one or more between neighbours.
fn rows_between(plan: &Plan, pitch: f64) -> Vec<f64> {
    let width = plan.footprint.layers().iter().map(|layer| layer.across.width);
    let width = width.fold(f64::INFINITY, f64::min);
    let most = (MOST_ROWS / plan.lines() as f64).max(1.0);
    let parts = (ROWS_OF_A_WIDTH * pitch / width).ceil().clamp(2.0, 20.0).min(most) as usize;
    let first = plan.track(0).y;
    let row = |n: usize| first + pitch * n as f64 / parts as f64;
    (0..=parts * (plan.lines() - 1)).map(row).collect()
}

/// y of the rows: those of the lines, or evenly spaced rows over the same range.
fn rows(plan: &Plan) -> Vec<f64> {
    if let (Some(_), Some(pitch)) = (&plan.free, plan.area.pitch(plan.path)) {
        return rows_between(plan, pitch);
    }
    let y: Vec<f64> = (0..plan.lines()).map(|n| plan.track(n).y).collect();
    if matches!(plan.area, Area::Rectangle { .. }) || plan.area.pitch(plan.path).is_some() {
        return y;
    }
    let (low, high) = ends(y.iter().copied());
    let count = y.len().clamp(3, MOST as usize);
    // Lines that all lie at one y are looked at from both sides.
    let (low, high) = if high > low { (low, high) } else { (low - 1.0, high + 1.0) };
    (0..count).map(|i| low + (high - low) * i as f64 / (count - 1) as f64).collect()
}
