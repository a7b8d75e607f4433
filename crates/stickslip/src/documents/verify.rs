//! `stickslip/verify`.

use crate::documents::table::{Named, Tabular};
use crate::parameter::strictly;
use crate::{FORMAT_VERSION, LinesDocument, Run, Software, VerificationDocument};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The verification of a saved run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VerifyDocument {
    /// "stickslip/verify"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// Everything that defines the run.
    #[serde(deserialize_with = "strictly")]
    pub parameters: Run,
    /// What was found.
    pub verification: VerificationDocument,
    /// What the run says of itself and a recomputation does not; empty where all of it follows.
    #[serde(default)]
    pub differences: Vec<ClaimDocument>,
    /// How much of a run written as lines there was; null for a document.
    pub lines: Option<LinesDocument>,
}

/// A value of a run that does not follow from its parameters and its motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClaimDocument {
    /// Such as `samples.lag` or `oscillation.period`.
    pub field: String,
    /// Time of the sample whose difference is largest against what is allowed, in Γ/k; null where it is no sample.
    pub t: Option<f64>,
    /// What stands there.
    pub claimed: Value,
    /// What was computed.
    pub computed: Value,
    /// By how much a number may differ, in its unit; null for what is no number.
    pub allowed: Option<f64>,
    /// Entries of the field that differ by more than is allowed.
    pub count: u64,
}

impl VerifyDocument {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/verify";

    /// What was found of the run with these parameters.
    pub fn new(
        parameters: Run,
        verification: VerificationDocument,
        differences: Vec<ClaimDocument>,
        lines: Option<LinesDocument>,
    ) -> Self {
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            parameters,
            verification,
            differences,
            lines,
        }
    }
}

impl Tabular for VerifyDocument {
    /// None: there are no columns to what was found.
    fn columns(&self) -> Vec<Named<'_>> {
        vec![]
    }
}
