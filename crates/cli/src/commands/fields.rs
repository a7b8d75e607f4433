//! `--print FIELD`: single fields of a document, by their path.

use crate::failure::Failure;
use crate::message::harmless;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Requested fields, checked against the schema of the document.
#[derive(Debug, Clone, Default)]
pub(crate) struct Fields(Vec<String>);

impl Fields {
    /// Fields of a document of this format, such as "stickslip/run".
    pub(crate) fn of_document(format: &str, paths: &[String]) -> Result<Self, Failure> {
        let name = format.trim_start_matches("stickslip/");
        Self::within(|| schema(name), paths)
    }

    /// Fields of the last line of a run that is written as lines.
    pub(crate) fn of_last_line(paths: &[String]) -> Result<Self, Failure> {
        let last = || json!({ "$ref": "#/$defs/RunEnd", "$defs": schema("run-lines")["$defs"] });
        Self::within(last, paths)
    }

    fn within(schema: impl FnOnce() -> Value, paths: &[String]) -> Result<Self, Failure> {
        if paths.is_empty() {
            // A schema takes longer to read than many a result to compute.
            return Ok(Self::default());
        }
        let schema = schema();
        let found = |path: &String| match path
            .strip_prefix("physical.")
            .filter(|below| !below.starts_with("scales"))
        {
            Some(below) => {
                judge(&schema, &without_units(below), "physical.")?;
                Ok(path.clone())
            }
            None => named(&schema, path),
        };
        Ok(Self(paths.iter().map(found).collect::<Result<_, Failure>>()?))
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// A line for each field, in the order of the request: numbers as in the document, words without quotes, null for
    /// a missing value.
    pub(crate) fn of(&self, document: &dyn erased_serde::Serialize) -> Result<String, Failure> {
        let document = serde_json::to_value(document);
        let document = document.map_err(Failure::run)?;
        Ok(self.0.iter().map(|path| format!("{}\n", shown(&document, path))).collect())
    }
}

/// The schema of a document; null if there is none.
fn schema(name: &str) -> Value {
    let text = stickslip::schema(name).unwrap_or_default();
    serde_json::from_str(text).unwrap_or_default()
}

fn shown(document: &Value, path: &str) -> String {
    let step = |value: Value, name: &str| match (value, name.parse::<usize>()) {
        (Value::Array(mut values), Ok(i)) if i < values.len() => values.swap_remove(i),
        (Value::Object(mut fields), _) => fields.remove(name).unwrap_or_default(),
        _ => Value::Null,
    };
    // Of fields of which a document has one.
    let mut values = path.split('|').map(|path| path.split('.').fold(document.clone(), step));
    match values.find(|value| !value.is_null()).unwrap_or_default() {
        Value::String(text) => harmless(&text).into(),
        // JSON leaves DEL, C1 and marks of direction as they are.
        value => harmless(&value.to_string()).into(),
    }
}

/// The dimensionless field that corresponds to a field with a unit in its name.
fn without_units(path: &str) -> String {
    let plain = |name: &str| match strip(name) {
        "support_velocity" => "parameters.r".into(),
        "indentation_rate" => "parameters.alpha".into(),
        "lateral_force" => "lag".into(),
        name => name.to_owned(),
    };
    path.split('.').map(plain).collect::<Vec<String>>().join(".")
}

fn strip(name: &str) -> &str {
    match name.rsplit_once('_') {
        Some((rest, "nm" | "nm2" | "nm3" | "s" | "s2" | "nN" | "per")) => strip(rest),
        _ => name,
    }
}

/// The full path of a field; `path` may be its end if no other field ends so.
fn named(schema: &Value, path: &str) -> Result<String, Failure> {
    let Err(refused) = judge(schema, path, "") else { return Ok(path.into()) };
    let mut all = vec![];
    gather(schema, schema, "", 0, &mut all);
    all.sort();
    all.dedup();
    let end = format!(".{path}");
    let ending: Vec<&String> = all.iter().filter(|whole| whole.ends_with(&end)).collect();
    // Of a part that there is, all fields are listed.
    let is_of_part = path.rsplit_once('.').is_some_and(|(part, _)| judge(schema, part, "").is_ok());
    if path.is_empty() || (is_of_part && ending.is_empty()) {
        return Err(refused);
    }
    match ending.as_slice() {
        [one] => Ok((*one).clone()),
        several @ [_, ..] if several.iter().all(|name| is_of_motion(name)) => {
            let names: Vec<&str> = several.iter().map(|name| name.as_str()).collect();
            Ok(names.join("|"))
        }
        [] => Err(nearest(&all, path).map_or(refused, |meant| {
            let message = format!("there is no such field: did you mean {}?", meant.join(" or "));
            Failure::input(format!("--print {path}"), message)
        })),
        several => {
            let names: Vec<&str> = several.iter().map(|name| name.as_str()).collect();
            let message = format!("several fields have this end: give one of {}", names.join(", "));
            Err(Failure::input(format!("--print {path}"), message))
        }
    }
}

/// Whether a field belongs to a periodic motion. A run ends in one kind of it, an oscillation or snaking.
fn is_of_motion(name: &str) -> bool {
    ["oscillation.", "snaking."].into_iter().any(|part| name.starts_with(part))
}

/// Largest depth of nested parts.
const DEEPEST: usize = 6;

/// Collects the paths of all fields below one part that need no index.
fn gather(root: &Value, part: &Value, before: &str, depth: usize, all: &mut Vec<String>) {
    let kinds = kinds(root, part);
    let fields = kinds.iter().filter_map(|kind| kind["properties"].as_object()).flatten();
    for (name, field) in fields {
        let path = format!("{before}{name}");
        if depth < DEEPEST {
            gather(root, field, &format!("{path}."), depth + 1, all);
        }
        all.push(path);
    }
}

/// Smallest similarity of Jaro and Winkler at which a name is suggested.
pub(crate) const ALIKE: f64 = 0.85;
/// Largest number of suggestions.
const MOST_MEANT: usize = 3;

/// The fields whose path, or its end, is most similar to this one.
fn nearest(all: &[String], path: &str) -> Option<Vec<String>> {
    let segments = path.split('.').count();
    let likeness = |whole: &String| {
        let names: Vec<&str> = whole.split('.').collect();
        let end = names[names.len().saturating_sub(segments)..].join(".");
        strsim::jaro_winkler(&end, path)
    };
    let mut alike: Vec<(f64, &String)> = all
        .iter()
        .map(|whole| (likeness(whole), whole))
        .filter(|(alike, _)| *alike > ALIKE)
        .collect();
    alike.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    let best = alike.first()?.0;
    let near = alike.into_iter().take_while(|(alike, _)| *alike > best - 0.05).take(MOST_MEANT);
    Some(near.map(|(_, whole)| whole.clone()).collect())
}

/// Checks a path against the schema; `under` is the path of the parent.
fn judge(schema: &Value, path: &str, under: &str) -> Result<(), Failure> {
    let mut at = vec![schema];
    let mut before = String::new();
    for name in path.split('.') {
        let kinds: Vec<&Value> = at.iter().flat_map(|kind| kinds(schema, kind)).collect();
        let next: Vec<&Value> = kinds.iter().filter_map(|kind| below(kind, name)).collect();
        if next.is_empty() {
            let advice = match under {
                "" => "",
                _ => ", each with its unit behind it, as in period_s or samples.x0_nm",
            };
            return Err(unknown(&format!("{under}{path}"), &before, &kinds, advice));
        }
        before = format!("{before}{name}.");
        at = next;
    }
    Ok(())
}

/// The schemas that a schema stands for, with references and alternatives resolved.
fn kinds<'a>(root: &'a Value, schema: &'a Value) -> Vec<&'a Value> {
    let reference = schema["$ref"].as_str().and_then(|name| name.strip_prefix('#'));
    let referred = reference.and_then(|pointer| root.pointer(pointer));
    let parts = ["anyOf", "oneOf", "allOf"].into_iter().filter_map(|name| schema[name].as_array());
    let parts = parts.flatten().chain(referred);
    std::iter::once(schema).chain(parts.flat_map(|part| kinds(root, part))).collect()
}

/// The schema of a field, or of a list entry.
fn below<'a>(kind: &'a Value, name: &str) -> Option<&'a Value> {
    let field = kind["properties"].get(name);
    let entry = || kind.get("items").filter(|_| name.parse::<usize>().is_ok());
    field.or_else(entry)
}

fn unknown(path: &str, before: &str, kinds: &[&Value], more: &str) -> Failure {
    let fields = kinds.iter().filter_map(|kind| kind["properties"].as_object());
    let names: BTreeSet<&String> = fields.flat_map(serde_json::Map::keys).collect();
    let names: Vec<String> = names.into_iter().map(|name| format!("{before}{name}")).collect();
    let has_entries = kinds.iter().any(|kind| kind.get("items").is_some());
    let advice = match (names.is_empty(), has_entries) {
        (false, _) => format!("there are {}", names.join(", ")),
        (true, true) => format!("{before}0 is the first entry there"),
        (true, false) => format!("{} has no fields", before.trim_end_matches('.')),
    };
    Failure::input(format!("--print {path}"), format!("there is no such field: {advice}{more}"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use stickslip::{RunDocument, StabilityDocument};

    #[test]
    fn fields_are_found_through_references_options_and_entries() {
        let good = [
            "oscillation.period",
            "parameters.alpha",
            "parameters.tip.gaussians.0.width",
            "history.displacement.0.5",
            "work",
        ];
        let good = good.map(String::from);
        assert!(Fields::of_document(RunDocument::FORMAT, &good).is_ok());
        for bad in ["oscillation.perod", "samples.t.first", "regime.x", "zzz", ""] {
            let refused =
                Fields::of_document(RunDocument::FORMAT, &[bad.into()]).unwrap_err().to_string();
            assert!(refused.contains("there is no such field"), "{refused}");
        }
        let refused =
            Fields::of_document(StabilityDocument::FORMAT, &["critical.x".into()]).unwrap_err();
        assert!(refused.to_string().contains("critical.alpha, critical.kind"), "{refused}");
    }

    #[test]
    fn a_name_is_enough_where_it_is_the_only_one() {
        let only = |paths: &[&str]| {
            let paths: Vec<String> = paths.iter().map(|path| (*path).into()).collect();
            Fields::of_document(RunDocument::FORMAT, &paths).map(|fields| fields.0)
        };
        let found = only(&["period", "amplitude_u", "steps", "regime"]).unwrap();
        assert_eq!(
            found,
            [
                "oscillation.period|snaking.period",
                "oscillation.amplitude_u",
                "work.steps",
                "regime"
            ]
        );
        let said = |path: &str| only(&[path]).unwrap_err().to_string();
        let several = said("velocity");
        assert!(
            several.contains("samples.velocity") && several.contains("drifting.velocity"),
            "{several}"
        );
        assert!(said("perod").contains("did you mean oscillation.period"), "{}", said("perod"));
        let meant = said("oscilation.period");
        assert!(meant.contains("did you mean oscillation.period"), "{meant}");
        assert!(said("zzz").contains("there are "));
    }

    #[test]
    fn fields_in_units_are_those_of_the_document_with_a_unit_behind() {
        let good = [
            "physical.samples.x0_nm",
            "physical.samples.lateral_force_nN.0",
            "physical.oscillation.period_s",
            "physical.steady_state.lag_nm",
            "physical.support_velocity_nm_per_s",
            "physical.scales.length",
            "physical",
        ];
        assert!(Fields::of_document(RunDocument::FORMAT, &good.map(String::from)).is_ok());
        for bad in ["physical.perod_s", "physical.samples.x1_nm", "physical.scales.x"] {
            assert!(Fields::of_document(RunDocument::FORMAT, &[bad.into()]).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_value_is_one_harmless_line() {
        let document = serde_json::json!({"name": "a\u{1b}[2J\nb", "all": ["\u{9b}2J\u{202e}"]});
        let shown = Fields(["name", "all"].map(String::from).into()).of(&document).unwrap();
        assert_eq!(shown, "a\\u{1b}[2J\\u{a}b\n[\"\\u{9b}2J\\u{202e}\"]\n");
    }

    #[test]
    fn values_are_those_of_the_document() {
        let document = serde_json::json!({"a": {"b": [1.5, null]}, "name": "x y", "none": null});
        let fields = ["a.b.0", "a.b.1", "a.b.7", "name", "none", "a"].map(String::from);
        let shown = Fields(fields.into()).of(&document).unwrap();
        assert_eq!(shown, "1.5\nnull\nnull\nx y\nnull\n{\"b\":[1.5,null]}\n");
    }
}
