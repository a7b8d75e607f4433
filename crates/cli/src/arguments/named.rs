//! Options whose values are names from documents: names and descriptions are those of the schema.

use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use serde_json::Value;
use stickslip::parameter::{self, Parameters};

/// Parses the names of `T`.
pub(super) fn named<T>() -> impl TypedValueParser<Value = T>
where
    T: Parameters + Clone + Send + Sync,
{
    PossibleValuesParser::new(names::<T>())
        .try_map(|name| serde_json::from_value(Value::String(name)))
}

/// The names of an enumeration, each of which has a description.
fn names<T: Parameters>() -> Vec<PossibleValue> {
    let names = parameter::names::<T>().iter();
    names.map(|(name, meaning)| PossibleValue::new(*name).help(*meaning)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip::parameter::{Kind, parameters};
    use stickslip::{Continue, GridName, Run, RunFormat, Stability, TipName};

    /// The names that a parameter of a question may have.
    fn of<Q: Parameters>(parameter: &str) -> Vec<PossibleValue> {
        let found = parameters::<Q>().iter().find(|one| one.name == parameter).unwrap();
        let Kind::Name(names) = &found.kind else { panic!("{:?}", found.kind) };
        names.iter().map(|(name, meaning)| PossibleValue::new(*name).help(*meaning)).collect()
    }

    #[test]
    fn every_name_is_there_and_explained() {
        for (names, count) in [
            (of::<Run>("memory"), 4),
            (names::<RunFormat>(), 5),
            (names::<GridName>(), 4),
            (of::<Continue>("over"), 2),
            (of::<Stability>("solve_for"), 2),
            (names::<TipName>(), 4),
        ] {
            assert_eq!(names.len(), count, "{names:?}");
            for name in names {
                assert!(!name.get_name().is_empty());
                assert!(name.get_help().is_some_and(|help| !help.to_string().is_empty()));
            }
        }
    }
}
