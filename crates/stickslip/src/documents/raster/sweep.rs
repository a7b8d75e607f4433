//! `stickslip/raster-sweep`.

use crate::documents::table::{Column, Named, Tabular};
use crate::schema::JsonSchema;
use crate::{Pattern, RasterRegimeName};
use serde::{Deserialize, Serialize};
use stickslip_raster::Written;

/// The pattern that a raster writes, over a grid of pitch and α. Lengths in σ, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterSweepFound {
    /// The points, by rising index.
    pub points: Vec<RasterSweepPoint>,
    /// Floating-point arithmetic of the machine that computed the points, as for `stickslip/sweep`.
    #[serde(default)]
    pub arithmetic: Option<String>,
    /// CRC-32 (IEEE) of the JSON `[parameters,points,arithmetic]`, as for `stickslip/sweep`.
    #[serde(default)]
    pub crc32: Option<u32>,
}

/// One raster of the grid.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterSweepPoint {
    /// Index in the grid.
    pub index: usize,
    /// Distance of the lines, in σ.
    pub pitch: f64,
    /// α, dimensionless.
    pub alpha: f64,
    /// α above which waves grow from line to line, by linear theory; null if it has no threshold.
    pub critical_alpha: Option<f64>,
    /// The regime of the surface; null if `error` is given.
    pub regime: Option<RasterRegimeName>,
    /// The ripple; null where there is none.
    pub pattern: Option<Pattern>,
    /// Number of lines on which the tip did not leave the pit at one end.
    pub stuck_lines: Option<usize>,
    /// Warnings: a part of the pattern is unknown, or may differ after more lines.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remarks: Vec<String>,
    /// The reason why there is no result.
    pub error: Option<String>,
}

impl RasterSweepPoint {
    /// A point without results.
    pub fn at(index: usize, (pitch, alpha): (f64, f64), critical_alpha: Option<f64>) -> Self {
        Self { index, pitch, alpha, critical_alpha, ..Self::default() }
    }

    /// The point with its results.
    #[must_use]
    pub fn written(self, found: &Written, stuck: usize) -> Self {
        Self {
            regime: Some(found.regime),
            pattern: found.pattern,
            stuck_lines: Some(stuck),
            remarks: found.doubts.iter().map(ToString::to_string).collect(),
            ..self
        }
    }
}

impl Tabular for RasterSweepFound {
    /// A row for each point.
    fn columns(&self) -> Vec<Named<'_>> {
        let of =
            |value: fn(&RasterSweepPoint) -> Option<f64>| self.points.iter().map(value).collect();
        let pattern = |value: fn(&Pattern) -> Option<f64>| {
            self.points.iter().map(|point| point.pattern.as_ref().and_then(value)).collect()
        };
        let regime = |point: &RasterSweepPoint| {
            point.regime.map_or(String::new(), |regime| regime.to_string())
        };
        vec![
            ("pitch", of(|point| Some(point.pitch))),
            ("alpha", of(|point| Some(point.alpha))),
            ("critical_alpha", of(|point| point.critical_alpha)),
            ("regime", Column::words(self.points.iter().map(regime))),
            ("q", pattern(|p| p.q)),
            ("kappa", pattern(|p| p.kappa)),
            ("wavelength", pattern(|p| p.wavelength)),
            ("wavelength_error", pattern(|p| p.wavelength_error)),
            ("crest_angle", pattern(|p| p.crest_angle)),
            ("crest_angle_error", pattern(|p| p.crest_angle_error)),
            ("coherence", pattern(|p| Some(p.coherence))),
            ("coherence_error", pattern(|p| p.coherence_error)),
            ("amplitude", pattern(|p| Some(p.amplitude))),
            ("defects", pattern(|p| Some(p.defects as f64))),
            ("stuck_lines", of(|point| point.stuck_lines.map(|lines| lines as f64))),
        ]
    }
}
