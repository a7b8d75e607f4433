//! Comparison of a run with a repetition.

use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_verify::{Difference, Verification};

/// Comparison of a run with a repetition by another memory and a tighter tolerance.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VerificationDocument {
    /// Whether all differences are within their limits.
    pub kept: bool,
    /// Memory of the repetition.
    pub memory: String,
    /// Tolerance of the repetition, in σ.
    pub tolerance: f64,
    /// Difference of l over the whole run; ten tolerances are allowed. Without the history of the run, the largest
    /// difference of l and x0 at its samples.
    pub l: Difference,
    /// Difference of y0, with the limit of `l`, if the tip is free to move across the scan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub y0: Option<Difference>,
    /// Difference of the surface at the end; null for a run without its history, and in two coordinates. The limit is the effect of an
    /// allowed error of x0.
    pub u: Option<Difference>,
    /// The first time, in Γ/k, at which the difference of l or y0 exceeds its limit; null if it never does.
    pub trusted_until: Option<f64>,
    /// Largest amplification of a small initial error during the run.
    pub amplification: f64,
    /// Estimate of the leading Lyapunov exponent from this run, in k/Γ: small errors grow (or decay) like
    /// exp(exponent t). Null if the run is too short for an estimate.
    pub lyapunov_exponent: Option<f64>,
}

/// Number of samples in a run written as lines, and the lines with differences.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LinesDocument {
    /// Number of samples, which are all compared.
    pub samples: u64,
    /// Time of the last sample, in Γ/k.
    pub verified_until: f64,
    /// How the file ends.
    pub ending: EndingName,
    /// Number of the line, from 1, with the reported difference of l.
    pub line: u64,
    /// Number of samples with a difference beyond its limit: few if lines were damaged, most of the later ones if the
    /// motion amplifies errors.
    pub wrong: u64,
    /// Number of the first line with a difference beyond its limit; null if there is none.
    pub first_wrong_line: Option<u64>,
}

/// The end of the lines of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EndingName {
    /// The run is complete.
    Complete,
    /// A signal stopped the run, as reported in its last line.
    Interrupted,
    /// The lines break off: the run was killed, or the file was truncated.
    CutOff,
}

impl From<&Verification> for VerificationDocument {
    fn from(found: &Verification) -> Self {
        Self {
            kept: found.is_kept(),
            memory: found.memory.into(),
            tolerance: found.tolerance,
            l: found.l,
            y0: found.y,
            u: found.u,
            trusted_until: found.trusted_until,
            amplification: found.growth.amplification,
            lyapunov_exponent: found.growth.exponent,
        }
    }
}
