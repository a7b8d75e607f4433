//! `stickslip/reproduction`.

use super::Software;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The numbers printed in the paper beside ours.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReproductionDocument {
    /// "stickslip/reproduction"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// What the numbers depend on besides what each entry says: nothing.
    pub(crate) parameters: ReproductionParameters,
    /// One row for each printed number.
    pub(crate) numbers: Vec<NumberDocument>,
}

impl ReproductionDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/reproduction";
}

/// None.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ReproductionParameters {}

/// A printed number.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct NumberDocument {
    /// What it is the value of.
    pub(crate) quantity: String,
    /// For which tip and parameters.
    pub(crate) case: String,
    /// Section, equation or figure of the paper.
    pub(crate) place: String,
    /// As printed.
    pub(crate) printed: String,
    /// Its value, in the dimensionless units of the paper.
    pub(crate) value: f64,
    /// Half a unit of its last digit; 1e-9 for whole numbers, which are exact, 0.005 for exponents.
    pub(crate) precision: f64,
    /// Our number for it, in the same unit.
    pub(crate) ours: f64,
    /// ours/value - 1; null where the printed value is 0.
    pub(crate) relative_difference: Option<f64>,
    /// Whether ours lies within the precision of the printed value.
    pub(crate) agrees: bool,
    /// Number of the entry in docs/corrections.md that explains a difference.
    pub(crate) correction: Option<u32>,
    /// What explains it, in a line.
    pub(crate) remark: Option<String>,
}
