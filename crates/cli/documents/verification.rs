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
    /// How much of a run written as lines there was; null for a document.
    pub(crate) lines: Option<LinesDocument>,
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
    /// Its tolerance, in σ.
    pub(crate) tolerance: f64,
    /// In l, over all of the run: ten tolerances are allowed. Of a run without its history, in l and x0 of its
    /// samples.
    pub(crate) l: LargestDifferenceDocument,
    /// In the surface at the end; null for a run without its history. Allowed is what an allowed error of x0
    /// does to it.
    pub(crate) u: Option<LargestDifferenceDocument>,
    /// The first time, in Γ/k, at which l differs by more than is allowed; null where it never does.
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
    /// The difference: of l in σ, of u in kσ²/a.
    pub(crate) largest: f64,
    /// Time (of l, in Γ/k) or position (of u, in σ).
    pub(crate) at: f64,
    /// What is allowed there, in the unit of the difference.
    pub(crate) allowed: f64,
}

/// How much of a run written as lines there was, and which of them say what was found.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct LinesDocument {
    /// Samples compared: all that there were.
    pub(crate) samples: u64,
    /// Time of the last of them, in Γ/k.
    pub(crate) verified_until: f64,
    /// How the run ended.
    pub(crate) ending: EndingName,
    /// Line, from 1, of the difference reported of l.
    pub(crate) line: u64,
    /// Samples whose difference is not allowed: few where lines were damaged, most of those that follow where
    /// the motion amplifies errors.
    pub(crate) wrong: u64,
    /// The line of the first of these.
    pub(crate) first_wrong_line: Option<u64>,
}

/// How the lines of a run end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum EndingName {
    /// The run came to its end.
    Complete,
    /// A signal stopped it, which its last line says.
    Interrupted,
    /// They break off: the run was killed, or the file was cut.
    CutOff,
}
