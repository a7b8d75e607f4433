//! `stickslip/sweep`.

use super::{RegimeName, Software, TipDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the motion comes to over a grid. Lengths in σ, times in Γ/k, heights in kσ²/a; amplitudes are half
/// peak-to-peak.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepDocument {
    /// "stickslip/sweep"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// The grid.
    pub(crate) parameters: SweepParameters,
    /// The part of the grid that this is; null for all of it.
    pub(crate) shard: Option<ShardDocument>,
    /// By beta, then r, then α, the last varying fastest.
    pub(crate) points: Vec<SweepPoint>,
}

impl SweepDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/sweep";
}

/// The grid.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepParameters {
    /// Footprint f; where beta is swept, that of its first value.
    pub(crate) tip: TipDocument,
    /// Side lobes of the triple Gaussian, where they were given.
    pub(crate) beta: Option<RangeDocument>,
    pub(crate) r: RangeDocument,
    /// Null where α - αc(r) is swept.
    pub(crate) alpha: Option<RangeDocument>,
    pub(crate) alpha_above: Option<RangeDocument>,
    /// Largest residual of (18) on a cycle.
    pub(crate) tolerance: f64,
}

/// So many values from low to high, both included.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RangeDocument {
    pub(crate) low: f64,
    pub(crate) high: f64,
    pub(crate) points: usize,
}

/// Points number index-1, index-1+of, … of the grid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShardDocument {
    /// From 1.
    pub(crate) index: usize,
    pub(crate) of: usize,
}

/// A point of the grid.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepPoint {
    /// Null where beta was not given.
    pub(crate) beta: Option<f64>,
    pub(crate) r: f64,
    /// Null where α - αc(r) was given, and there is no αc.
    pub(crate) alpha: Option<f64>,
    /// Null where nothing could be computed, see `remark`.
    pub(crate) regime: Option<RegimeName>,
    /// How that is known.
    pub(crate) method: Option<MethodName>,
    pub(crate) period: Option<f64>,
    /// Of l, that is of x0 less its steady advance.
    pub(crate) amplitude_x0: Option<f64>,
    /// Of the surface far behind the tip, (35); from cycles alone.
    pub(crate) amplitude_u: Option<f64>,
    /// Maxima of l in one period.
    pub(crate) slips: Option<usize>,
    /// Modulus of the largest Floquet multiplier but that of a shift in time; from cycles alone.
    pub(crate) multiplier: Option<f64>,
    /// Why something is missing.
    pub(crate) remark: Option<String>,
}

/// How a point is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum MethodName {
    /// Steady motion is linearly stable.
    Stability,
    /// A stable cycle, solved for.
    Cycle,
    /// What a run ended as.
    Run,
}
