//! The document of `stickslip sweep`.

use super::{RegimeName, Software, TipDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the tip settles into, over a grid of parameters.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepDocument {
    /// "stickslip/sweep"
    pub(crate) format: String,
    /// Version of the format.
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// The grid.
    pub(crate) parameters: SweepParameters,
    /// The points, by rising index.
    pub(crate) points: Vec<SweepPoint>,
    /// CRC-32 (IEEE) of the JSON `[parameters,points]`, without spaces and with the shortest digits: tells `merge`
    /// whether anything was changed.
    #[serde(default)]
    pub(crate) crc32: Option<u32>,
}

impl SweepDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/sweep";
}

/// The grid: footprints times r times α, the last varying fastest.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepParameters {
    /// Footprints f.
    pub(crate) tips: Vec<TipDocument>,
    /// Side lobes of each footprint, where they were given.
    pub(crate) beta: Option<Vec<f64>>,
    /// Dimensionless support velocities r (12).
    pub(crate) r: Vec<f64>,
    /// Dimensionless indentation rates α (13), where they were given as such.
    pub(crate) alpha: Option<Vec<f64>>,
    /// D, where they were given as αc(r) + D.
    pub(crate) alpha_above: Option<Vec<f64>>,
    /// Largest residual of (18) on a cycle, kσ/Γ.
    pub(crate) tolerance: f64,
    /// Part of the points that is here, all without.
    pub(crate) shard: Option<ShardDocument>,
}

/// Part `index` of `of`: the points whose index is `index` - 1 modulo `of`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ShardDocument {
    /// From 1 to `of`.
    pub(crate) index: usize,
    /// Number of parts.
    pub(crate) of: usize,
}

/// How a point was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum SourceName {
    /// Steady motion is stable, or as good as: α is below αc.
    Stability,
    /// The stable periodic solution of (18).
    Cycle,
    /// The end of a run from a disturbed steady state.
    Run,
}

impl std::fmt::Display for SourceName {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Self::Stability => "stability",
            Self::Cycle => "cycle",
            Self::Run => "run",
        })
    }
}

/// One point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SweepPoint {
    /// Its place in the grid.
    pub(crate) index: usize,
    /// Side lobes, where they were given.
    pub(crate) beta: Option<f64>,
    /// r, dimensionless.
    pub(crate) r: f64,
    /// α, dimensionless; null where αc(r) + D could not be found.
    pub(crate) alpha: Option<f64>,
    /// αc(r), if there is one.
    pub(crate) critical_alpha: Option<f64>,
    /// What the tip settles into; "transient" where a run of thousands of time units did not settle. Null
    /// where `error` says why.
    pub(crate) regime: Option<RegimeName>,
    /// How that was found.
    pub(crate) source: Option<SourceName>,
    /// Period of l(t), Γ/k.
    pub(crate) period: Option<f64>,
    /// Wavelength of the surface left behind, σ.
    pub(crate) wavelength: Option<f64>,
    /// Half peak-to-peak of l, σ.
    pub(crate) amplitude_x0: Option<f64>,
    /// Half peak-to-peak of the surface left behind, kσ²/a; of cycles only.
    pub(crate) amplitude_u: Option<f64>,
    /// Maxima of l in one period.
    pub(crate) slips: Option<usize>,
    /// Largest modulus of the Floquet multipliers but that of a shift in time; of cycles only.
    pub(crate) multiplier: Option<f64>,
    /// Why nothing was found.
    pub(crate) error: Option<String>,
}
