//! Heights of the surface after a raster.

use super::{RasterDocument, RasterParameters};
use crate::documents::table::{Array, Column, Named, Tabular};
use crate::{FORMAT_VERSION, InUnits, Physical, Software, Unusable};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Area, Path, Plan, Scanned};

/// Surfaces read off a raster. Lengths in σ, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterSurfaceDocument {
    /// "stickslip/raster-surface"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// Those of the raster.
    pub parameters: RasterParameters,
    /// One surface, after the last line.
    pub surfaces: Vec<HeightMap>,
    /// Numbers of it in nm, s and nN, where it was asked for these.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub physical: Option<InUnits>,
}

/// u(x,y).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct HeightMap {
    /// Positions along the lines, in σ.
    pub x: Vec<f64>,
    /// Positions across them, in σ.
    pub y: Vec<f64>,
    /// Heights, in kσ²/a: a row for each y.
    pub u: Vec<Vec<f64>>,
}

/// Points in a width of the tip,
const POINTS: f64 = 4.0;
/// but no more along a line than these.
const MOST: f64 = 4000.0;
/// Heights in a map: 80 MB.
const MOST_HEIGHTS: f64 = 1e7;
/// Rows over a line that was scanned again and again, on either side.
const ROWS_BESIDE: usize = 20;

impl RasterSurfaceDocument {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/raster-surface";

    /// The heights of a raster at every y and every x.
    ///
    /// # Errors
    /// The raster is damaged.
    pub fn of(raster: &RasterDocument, x: Vec<f64>, y: Vec<f64>) -> Result<Self, Unusable> {
        Ok(Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            physical: None,
            parameters: raster.parameters.clone(),
            surfaces: vec![raster.heights(x, y)?],
        })
    }
}

impl RasterDocument {
    /// u at every y (rows) and every x (columns).
    ///
    /// # Errors
    /// The document is damaged.
    pub fn heights(&self, x: Vec<f64>, y: Vec<f64>) -> Result<HeightMap, Unusable> {
        let (plan, lines) = self.scanned()?;
        let heights = Scanned::new(&plan, &lines).heights(&x, &y);
        let u = heights.rows().into_iter().map(|row| row.to_vec()).collect();
        Ok(HeightMap { x, y, u })
    }

    /// u on every line, at even distances from the smallest x to the largest; on evenly spaced rows where lines are not,
    /// and around a line that was repeated on lines beside it too.
    ///
    /// # Errors
    /// The document is damaged.
    pub fn height_map(&self) -> Result<HeightMap, Unusable> {
        let plan = self.parameters.plan()?;
        let width = 8.7 / plan.footprint.path().band();
        let (low, high) = plan.area.ends();
        let most = (MOST_HEIGHTS / plan.lines() as f64).clamp(2.0, MOST);
        let count = (POINTS * (high - low) / width).ceil().clamp(2.0, most);
        let x = (0..=count as usize).map(|i| low + (high - low) * i as f64 / count).collect();
        let y = if plan.path == Path::Repeat {
            let step = 0.5 * plan.reach_across() / ROWS_BESIDE as f64;
            (0..=2 * ROWS_BESIDE).map(|i| step * (i as f64 - ROWS_BESIDE as f64)).collect()
        } else {
            rows(&plan)
        };
        self.heights(x, y)
    }
}

/// The lines, or evenly spaced rows over them, no more of these than lines.
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

impl Physical for RasterSurfaceDocument {
    fn physical_mut(&mut self) -> &mut Option<InUnits> {
        &mut self.physical
    }
}

impl Tabular for RasterSurfaceDocument {
    /// A row for each place.
    fn columns(&self) -> Vec<Named<'_>> {
        let Some(HeightMap { x, y, u }) = self.surfaces.first() else { return vec![] };
        vec![
            ("x", Column::Repeated { values: x.into(), each: 1 }),
            ("y", Column::Repeated { values: y.into(), each: x.len() }),
            ("u", u.concat().into()),
        ]
    }

    /// `u` has a row for each y.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let Some(HeightMap { x, y, u }) = self.surfaces.first() else { return vec![] };
        vec![("x", Array::vector(x)), ("y", Array::vector(y)), ("u", Array::matrix(u))]
    }

    fn physical(&self) -> Option<&InUnits> {
        self.physical.as_ref()
    }
}
