//! `stickslip/verify`, and the same within a run.

use super::{RunParameters, Software};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The verification of a saved run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct VerifyDocument {
    /// "stickslip/verify"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// Everything that defines the run.
    pub(crate) parameters: RunParameters,
    /// What was found.
    pub(crate) verification: VerificationDocument,
}

impl VerifyDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/verify";
}

/// The run against a repetition with another memory and a tighter tolerance.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct VerificationDocument {
    /// Whether all differences are allowed.
    pub(crate) kept: bool,
    /// Memory of the repetition.
    pub(crate) memory: String,
    /// Its tolerance.
    pub(crate) tolerance: f64,
    /// In l, over all of the run: ten tolerances are allowed.
    pub(crate) l: LargestDifferenceDocument,
    /// In the surface at the end; null for a run without its history. Allowed is what an allowed error of x0
    /// does to it.
    pub(crate) u: Option<LargestDifferenceDocument>,
    /// The first time at which l differs by more than is allowed; null where it never does.
    pub(crate) trusted_until: Option<f64>,
    /// What a small error of the start is amplified by, at most, in the course of the run.
    pub(crate) amplification: f64,
    /// The leading Lyapunov exponent, in k/Γ, as far as this run shows it: small errors grow (or die out)
    /// like exp(exponent t). Null where the run is too short to tell.
    pub(crate) lyapunov_exponent: Option<f64>,
}

/// A difference where it is largest against what is allowed there.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LargestDifferenceDocument {
    pub(crate) largest: f64,
    /// Time (of l) or position (of u).
    pub(crate) at: f64,
    pub(crate) allowed: f64,
}
