//! A run against a repetition.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_verify::{Difference, Verification};

/// The run against a repetition with another memory and a tighter tolerance.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VerificationDocument {
    /// Whether all differences are allowed.
    pub kept: bool,
    /// Memory of the repetition.
    pub memory: String,
    /// Its tolerance, in σ.
    pub tolerance: f64,
    /// In l, over all of the run: ten tolerances are allowed. Of a run without its history, in l and x0 of its
    /// samples.
    pub l: LargestDifferenceDocument,
    /// In the surface at the end; null for a run without its history. Allowed is what an allowed error of x0
    /// does to it.
    pub u: Option<LargestDifferenceDocument>,
    /// The first time, in Γ/k, at which l differs by more than is allowed; null where it never does.
    pub trusted_until: Option<f64>,
    /// What a small error of the start is amplified by, at most, in the course of the run.
    pub amplification: f64,
    /// The leading Lyapunov exponent, in k/Γ, as far as this run shows it: small errors grow (or die out)
    /// like exp(exponent t). Null where the run is too short to tell.
    pub lyapunov_exponent: Option<f64>,
}

/// A difference where it is largest against what is allowed there.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LargestDifferenceDocument {
    /// The difference: of l in σ, of u in kσ²/a.
    pub largest: f64,
    /// Time (of l, in Γ/k) or position (of u, in σ).
    pub at: f64,
    /// What is allowed there, in the unit of the difference.
    pub allowed: f64,
}

/// How much of a run written as lines there was, and which of them say what was found.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinesDocument {
    /// Samples compared: all that there were.
    pub samples: u64,
    /// Time of the last of them, in Γ/k.
    pub verified_until: f64,
    /// How the run ended.
    pub ending: EndingName,
    /// Line, from 1, of the difference reported of l.
    pub line: u64,
    /// Samples whose difference is not allowed: few where lines were damaged, most of those that follow where
    /// the motion amplifies errors.
    pub wrong: u64,
    /// The line of the first of these.
    pub first_wrong_line: Option<u64>,
}

/// How the lines of a run end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EndingName {
    /// The run came to its end.
    Complete,
    /// A signal stopped it, which its last line says.
    Interrupted,
    /// They break off: the run was killed, or the file was cut.
    CutOff,
}

impl From<&Verification> for VerificationDocument {
    fn from(found: &Verification) -> Self {
        Self {
            kept: found.is_kept(),
            memory: found.memory.into(),
            tolerance: found.tolerance,
            l: (&found.l).into(),
            u: found.u.as_ref().map(Into::into),
            trusted_until: found.trusted_until,
            amplification: found.growth.amplification,
            lyapunov_exponent: found.growth.exponent,
        }
    }
}

impl From<&Difference> for LargestDifferenceDocument {
    fn from(difference: &Difference) -> Self {
        let Difference { largest, at, allowed } = *difference;
        Self { largest, at, allowed }
    }
}
