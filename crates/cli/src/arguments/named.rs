//! Options whose values are names from documents: names and descriptions are those of the schema.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use schemars::{JsonSchema, schema_for};
use serde::de::DeserializeOwned;
use serde_json::Value;

/// Parses the names of `T`.
pub(super) fn named<T>() -> impl TypedValueParser<Value = T>
where
    T: JsonSchema + DeserializeOwned + Clone + Send + Sync + 'static,
{
    PossibleValuesParser::new(names(&schema_for!(T).to_value()))
        .try_map(|name| serde_json::from_value(Value::String(name)))
}

/// The names of an enumeration, each of which has a description.
fn names(schema: &Value) -> Vec<PossibleValue> {
    let alternatives = schema["oneOf"].as_array().into_iter().flatten();
    let name = |one: &Value| {
        let meaning = one["description"].as_str().unwrap_or_default();
        let meaning = meaning.replace('\n', " ");
        let name = one["const"].as_str().unwrap_or_default().to_owned();
        PossibleValue::new(name).help(meaning.trim_end_matches('.').to_owned())
    };
    alternatives.map(name).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip::{GridName, MemoryName, OverName, RunFormat, SolveFor};

    #[test]
    fn every_name_is_there_and_explained() {
        let counts = [
            (schema_for!(MemoryName), 4),
            (schema_for!(RunFormat), 5),
            (schema_for!(GridName), 4),
            (schema_for!(OverName), 2),
            (schema_for!(SolveFor), 2),
        ];
        for (schema, count) in counts {
            let names = names(&schema.to_value());
            assert_eq!(names.len(), count, "{names:?}");
            for name in names {
                assert!(!name.get_name().is_empty());
                assert!(name.get_help().is_some_and(|help| !help.to_string().is_empty()));
            }
        }
    }
}
