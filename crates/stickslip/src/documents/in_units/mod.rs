//! Documents in nm, s and nN: beside the dimensionless numbers, which stay, the same ones times the scales of an
//! experiment, σ for lengths, Γ/k for times, kσ²/a for heights and kσ for forces.
//!
//! One rule for all documents, tables and figures: what each number is a multiple of is said once, by its name, in
//! [`dimension`]; how a multiple becomes a number with a unit, by [`Dimension`]. A scale that is not known leaves
//! what needs it out.

mod dimension;
mod mirror;
mod names;

pub use dimension::Dimension;
pub use names::dimension;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// SI values of one of the model's units; null where they are not known.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KnownScales {
    /// σ in m, of lengths.
    pub length: Option<f64>,
    /// Γ/k in s, of times.
    pub time: Option<f64>,
    /// kσ²/a in m, of heights.
    pub height: Option<f64>,
    /// kσ in N, of forces.
    pub force: Option<f64>,
}

/// Numbers of a document in nm, s and nN: each as there, with its unit behind its name, in parts of the same names.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct InUnits {
    /// By what they are multiplied.
    pub scales: KnownScales,
    /// Such as `period_s`, or `samples` with its `x0_nm`; `support_velocity_nm_per_s` is v0 and
    /// `indentation_rate_nm_per_s` N, of r and α. `lateral_force_nN` is k times the lag.
    #[serde(flatten)]
    pub values: Map<String, Value>,
}

impl InUnits {
    /// Those of a document.
    pub(crate) fn of(document: &Value, scales: &KnownScales) -> Self {
        let none = Map::new();
        let fields = document.as_object().unwrap_or(&none);
        let parameters = document["parameters"].as_object().unwrap_or(&none);
        let mut values = mirror::of_parameters(parameters, scales);
        values.extend(mirror::mirror("", fields, scales));
        Self { scales: *scales, values }
    }
}
