//! A copy of the numbers of a document in nm, s and nN.

use super::names::{DIMENSIONLESS, dimension};
use super::{Dimension, KnownScales};
use serde_json::{Map, Number, Value};

/// The numbers with a dimension in the part called `part`, under names with units.
pub(super) fn mirror(
    part: &str,
    fields: &Map<String, Value>,
    scales: &KnownScales,
) -> Map<String, Value> {
    let mut values = Map::new();
    for (name, value) in fields.iter().filter(|(name, _)| !DIMENSIONLESS.contains(&&***name)) {
        if !is_numbers(value) {
            if let Some(below) = below(name, value, scales) {
                values.insert(name.clone(), below);
            }
            continue;
        }
        let mut put = |name: &str, dimension: Dimension| {
            if let Some(factor) = dimension.factor(scales) {
                values.insert(format!("{name}_{}", dimension.suffix()), times(value, factor));
            }
        };
        if let Some(dimension) = dimension(part, name) {
            put(name, dimension);
        }
        if name == "lag" {
            put("lateral_force", Dimension::FORCE);
        }
    }
    values
}

/// v0 and N, for parameters with a single r and α.
pub(super) fn of_parameters(
    fields: &Map<String, Value>,
    scales: &KnownScales,
) -> Map<String, Value> {
    let named = [
        ("r", "support_velocity", Dimension::VELOCITY),
        ("alpha", "indentation_rate", Dimension::INDENTATION),
    ];
    let one = |(name, called, dimension): (&str, &str, Dimension)| {
        let value = fields.get(name)?.as_f64()? * dimension.factor(scales)?;
        let value = Number::from_f64(value)?;
        Some((format!("{called}_{}", dimension.suffix()), Value::Number(value)))
    };
    named.into_iter().filter_map(one).collect()
}

/// The values along the axes of a grid, under names with units; `None` without a list of α, or if no value has a dimension.
pub(super) fn of_axes(fields: &Map<String, Value>, scales: &KnownScales) -> Option<Value> {
    ["alpha", "alpha_above"].iter().find_map(|name| fields.get(*name)?.as_array())?;
    let more = fields.get("axes").and_then(Value::as_array);
    let more = more
        .into_iter()
        .flatten()
        .filter_map(|axis| Some((axis["name"].as_str()?, axis.get("values")?)));
    let lists = fields.iter().filter(|(_, value)| value.is_array() && is_numbers(value));
    let mut values = Map::new();
    for (name, list) in lists.map(|(name, list)| (&**name, list)).chain(more) {
        let name = name.replace('-', "_");
        if let Some(dimension) = dimension("", &name)
            && let Some(factor) = dimension.factor(scales)
        {
            values.insert(format!("{name}_{}", dimension.suffix()), times(list, factor));
        }
    }
    (!values.is_empty()).then_some(Value::Object(values))
}

/// The numbers of a part with sub-parts; `None` if none has a dimension.
fn below(name: &str, value: &Value, scales: &KnownScales) -> Option<Value> {
    match value {
        Value::Object(fields) => {
            let values = mirror(name, fields, scales);
            (!values.is_empty()).then_some(Value::Object(values))
        }
        // Entries keep their places.
        Value::Array(entries) => {
            let of =
                |entry: &Value| below(name, entry, scales).unwrap_or_else(|| Map::new().into());
            let values: Vec<Value> = entries.iter().map(of).collect();
            let is_empty = |value: &Value| value.as_object().is_some_and(Map::is_empty);
            (!values.iter().all(is_empty)).then_some(Value::Array(values))
        }
        _ => None,
    }
}

/// Whether a value is a number or a list of numbers and nulls.
fn is_numbers(value: &Value) -> bool {
    match value {
        Value::Number(_) => true,
        Value::Array(entries) => {
            !entries.is_empty() && entries.iter().all(|entry| entry.is_null() || is_numbers(entry))
        }
        _ => false,
    }
}

fn times(value: &Value, factor: f64) -> Value {
    match value {
        Value::Array(entries) => entries.iter().map(|entry| times(entry, factor)).collect(),
        value => {
            let product = value.as_f64().and_then(|number| Number::from_f64(number * factor));
            product.map_or(Value::Null, Value::Number)
        }
    }
}
