//! `stickslip/reproduction`.

use crate::schema::JsonSchema;
use crate::{Document, Question};
use serde::{Deserialize, Serialize};

/// Comparison of the numbers printed in the paper with ours.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReproductionFound {
    /// One row for each printed number.
    pub numbers: Vec<NumberDocument>,
}

/// The comparison and the question that it answers.
pub type ReproductionDocument = Document<ReproductionParameters>;

impl Question for ReproductionParameters {
    const FORMAT: &'static str = "stickslip/reproduction";
    type Answer = ReproductionFound;
}

/// No parameters.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReproductionParameters {}

/// A printed number.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NumberDocument {
    /// Name of the quantity.
    pub quantity: String,
    /// Footprint and parameters of the model.
    pub case: String,
    /// Section, equation or figure of the paper.
    pub place: String,
    /// The number as printed.
    pub printed: String,
    /// Value of the printed number, in the dimensionless units of the paper.
    pub value: f64,
    /// Half a unit of the last printed digit; 1e-9 for whole numbers, which are exact, 0.005 for exponents.
    pub precision: f64,
    /// Our value, in the dimensionless units of the paper.
    pub ours: f64,
    /// ours/value - 1; null where the printed value is 0.
    pub relative_difference: Option<f64>,
    /// Whether our value lies within the precision of the printed one.
    pub agrees: bool,
    /// Number of the entry in docs/findings/corrections.md that explains a difference.
    pub correction: Option<u32>,
    /// Explanation of a difference, in one line.
    pub remark: Option<String>,
}
