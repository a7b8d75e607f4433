//! `stickslip/verify`.

use crate::documents::table::Tabular;
use crate::parameter::strictly;
use crate::schema::JsonSchema;
use crate::{FORMAT_VERSION, LinesDocument, Run, Software, VerificationDocument};
use serde::{Deserialize, Serialize};
use serde_json::Value;

/// The verification of a saved run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct VerifyDocument {
    /// "stickslip/verify"
    pub format: String,
    /// Version of the format; 1.
    pub format_version: u32,
    /// The program that wrote the document.
    pub software: Software,
    /// Everything that defines the run.
    #[serde(deserialize_with = "strictly")]
    pub parameters: Run,
    /// Comparison of the run with its repetition.
    pub verification: VerificationDocument,
    /// Values in the document that differ from recomputed ones; empty if all agree.
    #[serde(default)]
    pub differences: Vec<ClaimDocument>,
    /// Extent of a run written as lines; null for a document.
    pub lines: Option<LinesDocument>,
}

/// A value in the document of a run that differs from the recomputed one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ClaimDocument {
    /// The field, such as `samples.lag` or `oscillation.period`.
    pub field: String,
    /// Time of the sample with the largest difference relative to its limit, in Γ/k; null for a field that is not
    /// sampled.
    pub t: Option<f64>,
    /// The value in the document.
    pub claimed: Value,
    /// The recomputed value.
    pub computed: Value,
    /// Allowed difference of a number, in its unit; null for other values.
    pub allowed: Option<f64>,
    /// Number of entries of the field with a difference beyond its limit.
    pub count: u64,
}

impl VerifyDocument {
    /// The value of the field `format`.
    pub const FORMAT: &'static str = "stickslip/verify";

    /// The document of a verified run.
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

/// The result is not a table.
impl Tabular for VerifyDocument {}
