//! `stickslip/continue`.

use super::{ModelParameters, Software};
use crate::arguments::OverName;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Branches of periodic motions. Lengths in σ, times in Γ/k, heights in kσ²/a; amplitudes are half
/// peak-to-peak.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ContinueDocument {
    /// "stickslip/continue"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// What was asked for; α and r are those of the first cycle.
    pub(crate) parameters: ContinueParameters,
    /// The first, and with --switch those of twice its period, of four times, ….
    pub(crate) branches: Vec<CycleBranch>,
    /// Where something happens to the cycles of a branch, in order of the branches.
    pub(crate) special: Vec<SpecialDocument>,
    /// The value of what varies at which the tip can be trapped for ever; null if there is none.
    pub(crate) trapping: Option<f64>,
    /// Whether a signal stopped it.
    pub(crate) interrupted: bool,
    /// What could not be followed; empty if all was.
    pub(crate) remarks: Vec<String>,
}

impl ContinueDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/continue";
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub(crate) struct ContinueParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub(crate) model: ModelParameters,
    /// What varies.
    pub(crate) over: OverName,
    /// Its last value, if any.
    pub(crate) to: Option<f64>,
    /// Whether the branches of twice the period were followed.
    pub(crate) switch: bool,
    /// The period, in Γ/k, beyond which a branch is not followed.
    pub(crate) longest_period: f64,
    /// Longest step from one cycle to the next, in relative changes of parameter, period and l.
    pub(crate) longest_step: f64,
    /// Number of cycles with which a branch ends at the latest.
    pub(crate) most_points: usize,
    /// Largest residual of (18), in kσ/Γ.
    pub(crate) tolerance: f64,
}

/// Cycles in the order in which they were found; columns of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CycleBranch {
    /// Index in `special` of the period doubling that it began at; null for the first branch.
    pub(crate) from: Option<usize>,
    /// α of each cycle, dimensionless (13).
    pub(crate) alpha: Vec<f64>,
    /// r of each cycle, dimensionless (12).
    pub(crate) r: Vec<f64>,
    /// T of each cycle, in Γ/k.
    pub(crate) period: Vec<f64>,
    /// Half peak-to-peak of l, that is of x0 less its steady advance, in σ.
    pub(crate) amplitude_x0: Vec<f64>,
    /// Half peak-to-peak of the surface far behind the tip, (35), in kσ²/a.
    pub(crate) amplitude_u: Vec<f64>,
    /// Whether every small deviation from the cycle but a shift in time dies out.
    pub(crate) stable: Vec<bool>,
    /// Real part of the largest Floquet multiplier but that of a shift in time, dimensionless; 0 where all are
    /// below 1e-6.
    pub(crate) multiplier_re: Vec<f64>,
    /// Its imaginary part.
    pub(crate) multiplier_im: Vec<f64>,
    /// Why it ends where it does.
    pub(crate) end: EndName,
}

/// Why a branch ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum EndName {
    /// What varies has its last value.
    Reached,
    /// The period exceeds the longest one.
    LongPeriod,
    /// The cycle has shrunk to steady motion.
    Steady,
    /// It joins the branch of half the period.
    Halved,
    /// Enough cycles.
    ManyPoints,
    /// No cycle was found a shortest step further on.
    Lost,
    /// A signal.
    Interrupted,
}

/// A point where something happens to the cycles of a branch.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SpecialDocument {
    /// What.
    pub(crate) kind: SpecialName,
    /// Index in `branches`.
    pub(crate) branch: usize,
    /// α there, dimensionless (13).
    pub(crate) alpha: f64,
    /// r there, dimensionless (12).
    pub(crate) r: f64,
    /// T of the cycle there, in Γ/k; at a Hopf point that of the oscillation that is born.
    pub(crate) period: f64,
    /// Half peak-to-peak of l of the cycle there, in σ; 0 at a Hopf point.
    pub(crate) amplitude_x0: f64,
}

/// Kinds of special points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum SpecialName {
    /// The cycle vanishes into steady motion.
    Hopf,
    /// The branch turns back.
    Fold,
    /// A multiplier passes -1: a branch of twice the period begins.
    PeriodDoubling,
    /// The branch joins one of half the period, where that doubles it; period and amplitude are that one's.
    PeriodHalving,
    /// A second multiplier passes 1, and the branch does not turn: another branch crosses.
    BranchPoint,
    /// A complex pair crosses the unit circle: a torus is born.
    Torus,
}
