//! `stickslip/reproduction`.

use crate::{Document, Question};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The numbers printed in the paper beside ours.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReproductionFound {
    /// One row for each printed number.
    pub numbers: Vec<NumberDocument>,
}

/// The document of that.
pub type ReproductionDocument = Document<ReproductionParameters>;

impl Question for ReproductionParameters {
    const FORMAT: &'static str = "stickslip/reproduction";
    type Answer = ReproductionFound;
}

/// None.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReproductionParameters {}

/// A printed number.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberDocument {
    /// What it is the value of.
    pub quantity: String,
    /// For which tip and parameters.
    pub case: String,
    /// Section, equation or figure of the paper.
    pub place: String,
    /// As printed.
    pub printed: String,
    /// Its value, in the dimensionless units of the paper.
    pub value: f64,
    /// Half a unit of its last digit; 1e-9 for whole numbers, which are exact, 0.005 for exponents.
    pub precision: f64,
    /// Our number for it, in the same unit.
    pub ours: f64,
    /// ours/value - 1; null where the printed value is 0.
    pub relative_difference: Option<f64>,
    /// Whether ours lies within the precision of the printed value.
    pub agrees: bool,
    /// Number of the entry in docs/corrections.md that explains a difference.
    pub correction: Option<u32>,
    /// What explains it, in a line.
    pub remark: Option<String>,
}
