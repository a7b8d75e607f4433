//! Tables of parameters as Rust, from the JSON Schemas of the types.

use serde_json::{Map, Value};

/// The table of a type: an expression for [`Declared`](super::Declared).
pub(crate) fn declared(schema: &Value) -> String {
    let none = Map::new();
    let properties = schema["properties"].as_object().unwrap_or(&none);
    let (mut options, others): (Vec<_>, Vec<_>) =
        properties.iter().partition(|(_, property)| property.get("x-option").is_some());
    options.sort_by_key(|(_, property)| property["x-option"]["place"].as_u64());
    let list = |all: Vec<(&String, &Value)>| {
        let parameters: String =
            all.into_iter().map(|(name, property)| parameter(name, property, schema)).collect();
        if parameters.is_empty() { "[]".into() } else { format!("[\n{parameters}    ]") }
    };
    format!(
        "// Made by `make reference`: do not edit.\nDeclared {{\n    options: &{},\n    others: &{},\n    names: \
         &{:?},\n}}\n",
        list(options),
        list(others),
        names_of(schema)
    )
}

/// A property as an expression for [`Parameter`](super::Parameter).
fn parameter(name: &str, property: &Value, schema: &Value) -> String {
    let is_required =
        schema["required"].as_array().is_some_and(|all| all.contains(&Value::from(name)));
    let default =
        property.get("default").filter(|value| !value.is_null()).map(|value| value.to_string());
    let of_option = |key: &str| property["x-option"][key].as_str().unwrap_or_default().to_owned();
    format!(
        "        Parameter {{ name: {name:?}, description: {:?}, kind: {}, default: {default:?}, is_required: \
         {is_required}, symbol: {:?}, group: {:?} }},\n",
        on_one_line(&property["description"]),
        kind(name, property, schema),
        of_option("symbol"),
        of_option("group"),
    )
}

/// The kind of a property, from its type or from the definition that it refers to, as an expression for
/// [`Kind`](super::Kind).
fn kind(name: &str, property: &Value, schema: &Value) -> String {
    let is_of = |of: &str| match &property["type"] {
        Value::String(one) => one == of,
        Value::Array(several) => several.iter().any(|one| one == of),
        _ => false,
    };
    let simple =
        [("number", "Number"), ("integer", "Integer"), ("boolean", "Switch"), ("string", "Text")];
    if name == "tip" {
        "Kind::Tip".into()
    } else if let Some((_, kind)) = simple.iter().find(|(of, _)| is_of(of)) {
        format!("Kind::{kind}")
    } else if is_of("array") {
        kind_of_list(property, schema)
    } else {
        let alternatives = property["anyOf"].as_array().into_iter().flatten();
        let named = alternatives.chain([property]).find_map(|one| names_at(one, schema));
        named.map_or("Kind::Other".into(), |names| format!("Kind::Name(&{names:?})"))
    }
}

fn kind_of_list(property: &Value, schema: &Value) -> String {
    let items = &property["items"];
    if items.get("$ref").is_some() {
        let named = names_at(items, schema);
        return named.map_or("Kind::Other".into(), |names| format!("Kind::Names(&{names:?})"));
    }
    let kind = match property.get("maxItems") {
        _ if items["type"] != "number" => "Other",
        None => "Numbers",
        Some(_) => "Ends",
    };
    format!("Kind::{kind}")
}

/// The names of the enumeration that `$ref` leads to; `None` for other types.
fn names_at(reference: &Value, schema: &Value) -> Option<Vec<(String, String)>> {
    let name = reference["$ref"].as_str()?.trim_start_matches("#/$defs/");
    Some(names_of(&schema["$defs"][name])).filter(|names| !names.is_empty())
}

/// The names of an enumeration, each with its meaning.
fn names_of(schema: &Value) -> Vec<(String, String)> {
    let named = |one: &Value| {
        let meaning = on_one_line(&one["description"]);
        Some((one["const"].as_str()?.to_owned(), meaning.trim_end_matches('.').to_owned()))
    };
    schema["oneOf"].as_array().into_iter().flatten().filter_map(named).collect()
}

fn on_one_line(description: &Value) -> String {
    description.as_str().unwrap_or_default().replace('\n', " ")
}
