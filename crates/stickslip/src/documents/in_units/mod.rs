//! Documents in nm, s and nN. The dimensionless numbers are kept, and copies are multiplied by the scales of an
//! experiment. The scales are σ for lengths, Γ/k for times, kσ²/a for heights and kσ for forces.
//!
//! All documents, tables and figures follow one rule: [`dimension`] defines the dimension of each number by its name,
//! and [`Dimension`] converts it to a number with a unit. Numbers whose scale is unknown are omitted.

mod dimension;
mod mirror;
mod names;

pub use dimension::Dimension;
pub use names::dimension;

use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// SI values of the model's units; null if unknown.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KnownScales {
    /// σ in m, the unit of length.
    pub length: Option<f64>,
    /// Γ/k in s, the unit of time.
    pub time: Option<f64>,
    /// kσ²/a in m, the unit of height.
    pub height: Option<f64>,
    /// kσ in N, the unit of force.
    pub force: Option<f64>,
}

/// Numbers of a document in nm, s and nN. Each has its name followed by the unit, in a part of the same name.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct InUnits {
    /// Scales of the conversion.
    pub scales: KnownScales,
    /// The numbers, such as `period_s`, or `samples` with its `x0_nm`; `support_velocity_nm_per_s` is v0 and
    /// `indentation_rate_nm_per_s` N, from r and α. `lateral_force_nN` is k times the lag. `axes` has the values along the
    /// axes of a sweep, such as `pitch_nm`.
    #[serde(flatten)]
    pub values: Map<String, Value>,
}

impl InUnits {
    /// The converted numbers of a document.
    pub(crate) fn of(document: &Value, scales: &KnownScales) -> Self {
        let none = Map::new();
        let fields = document.as_object().unwrap_or(&none);
        let parameters = document["parameters"].as_object().unwrap_or(&none);
        let mut values = mirror::of_parameters(parameters, scales);
        values.extend(mirror::mirror("", fields, scales));
        values.extend(mirror::of_axes(parameters, scales).map(|axes| ("axes".into(), axes)));
        Self { scales: *scales, values }
    }
}
