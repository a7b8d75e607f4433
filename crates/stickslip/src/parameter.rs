//! The parameters of a question, read from its JSON Schema. Options of the command line, keywords of Python and parameter
//! files are all made of them, so that a parameter is declared in one place: a field of a question.

use crate::{Refused, Typed};
use schemars::{JsonSchema, schema_for};
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value, json};

/// The key of a property of a schema that makes it a parameter which a user may give: see [`option`].
const OPTION: &str = "x-option";

/// What a schema says of a parameter beside its description: the symbol of its value, the group of parameters that it belongs
/// to, and its place among all. A field without it, such as a result of [`Ask::resolved`](crate::Ask::resolved), is written to
/// documents and read from them, but is no option.
pub(crate) fn option(symbol: &str, group: &str, place: u32) -> Value {
    json!({ "symbol": symbol, "group": group, "place": place })
}

/// Why most questions need a spring.
pub(crate) const NOTHING_DRAGS: &str =
    "nothing drags the tip: there is no steady motion behind a support";

/// A parameter of a question.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// Such as `alpha_above`.
    pub name: String,
    /// Meaning, unit and range.
    pub description: String,
    /// What values it takes.
    pub kind: Kind,
    /// The value where none is given.
    pub default: Option<Value>,
    /// Whether the question cannot do without it.
    pub is_required: bool,
    /// What stands for its value, such as `R`.
    pub symbol: String,
    /// The group of parameters that it belongs to, such as `Wider law`.
    pub group: String,
    /// Its place among all.
    place: u64,
}

/// The values that a parameter takes.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// A number.
    Number,
    /// A whole number of 0 or more.
    Integer,
    /// True or false.
    Switch,
    /// One of several names, each with its meaning.
    Name(Vec<(String, String)>),
    /// Both ends of a range; `points` and `spacing` of the same question say how it is divided.
    Ends,
    /// Numbers.
    Numbers,
    /// A footprint, as [`Tip`](crate::Tip) reads it.
    Tip,
    /// Anything else, such as a table.
    Other,
}

/// The parameters that a user may give, in the order of a help page.
pub fn parameters<Q: JsonSchema>() -> Vec<Parameter> {
    let schema = schema_for!(Q).to_value();
    let required: Vec<&str> =
        schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    let mut found: Vec<Parameter> = properties(&schema)
        .filter_map(|(name, property)| {
            let option = property.get(OPTION)?;
            let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
            Some(Parameter {
                name: name.clone(),
                description: text(&property["description"]).replace('\n', " "),
                kind: kind(name, property, &schema),
                default: property.get("default").filter(|value| !value.is_null()).cloned(),
                is_required: required.contains(&name.as_str()),
                symbol: text(&option["symbol"]),
                group: text(&option["group"]),
                place: option["place"].as_u64().unwrap_or(u64::MAX),
            })
        })
        .collect();
    found.sort_by_key(|parameter| parameter.place);
    found
}

fn properties(schema: &Value) -> impl Iterator<Item = (&String, &Value)> {
    schema["properties"].as_object().into_iter().flatten()
}

/// By the type of a property, or by what it refers to.
fn kind(name: &str, property: &Value, schema: &Value) -> Kind {
    if name == "tip" {
        return Kind::Tip;
    }
    let types = match &property["type"] {
        Value::String(one) => vec![one.as_str()],
        Value::Array(several) => several.iter().filter_map(Value::as_str).collect(),
        _ => vec![],
    };
    if types.contains(&"number") {
        return Kind::Number;
    }
    if types.contains(&"integer") {
        return Kind::Integer;
    }
    if types.contains(&"boolean") {
        return Kind::Switch;
    }
    if types.contains(&"array") {
        return match (&property["items"]["type"], &property["maxItems"]) {
            (Value::String(of), Value::Null) if of == "number" => Kind::Numbers,
            (Value::String(of), _) if of == "number" => Kind::Ends,
            _ => Kind::Other,
        };
    }
    let alternatives = property["anyOf"].as_array().into_iter().flatten();
    let reference = alternatives.chain([property]).find_map(|one| one["$ref"].as_str());
    let names = reference.and_then(|path| schema.pointer(path.trim_start_matches('#')));
    let names = names.map(names_of).unwrap_or_default();
    if names.is_empty() { Kind::Other } else { Kind::Name(names) }
}

/// The names of an enumeration whose every name is explained.
fn names_of(schema: &Value) -> Vec<(String, String)> {
    let alternatives = schema["oneOf"].as_array().into_iter().flatten();
    let named = alternatives.filter_map(|one| {
        let meaning = one["description"].as_str().unwrap_or_default().replace('\n', " ");
        Some((one["const"].as_str()?.to_owned(), meaning.trim_end_matches('.').to_owned()))
    });
    named.collect()
}

/// The question with these parameters; those that are not given have their defaults.
///
/// # Errors
/// A name that is none of its parameters, one that is missing, a value of another kind.
pub fn question<Q: JsonSchema + DeserializeOwned>(
    values: Map<String, Value>,
) -> Result<Q, Refused> {
    let schema = schema_for!(Q).to_value();
    let known = |name: &str| schema["properties"].get(name);
    for (name, value) in &values {
        let Some(property) = known(name) else {
            return Err(Refused::whole(name.clone(), "is no parameter here: leave it out"));
        };
        if let Some(why) = mistaken(&kind(name, property, &schema), value) {
            let value = Some(typed(value));
            return Err(Refused { parameter: name.clone().into(), value, why });
        }
    }
    let required = schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
    if let Some(name) = required.into_iter().find(|name| !values.contains_key(*name)) {
        if values.get("no_spring") == Some(&Value::Bool(true)) {
            return Err(Refused::whole("no_spring", NOTHING_DRAGS));
        }
        let meaning = schema["properties"][name]["description"].as_str().unwrap_or_default();
        let meaning = meaning.trim_end_matches('.').replace('\n', " ");
        return Err(Refused::whole(name.to_owned(), format!("is needed: {meaning}")));
    }
    serde_json::from_value(Value::Object(values.clone())).map_err(|error| {
        let parameter = culprit::<Q>(&values).unwrap_or("tip").to_owned();
        Refused::whole(parameter, error)
    })
}

/// Reads a question as [`question`] does: serde alone lets names pass that are none of its parameters, where some of these are
/// grouped.
pub(crate) fn strictly<'de, D: Deserializer<'de>, Q: JsonSchema + DeserializeOwned>(
    deserializer: D,
) -> Result<Q, D::Error> {
    let refused = |refused: Refused| D::Error::custom(refused.described(str::to_owned));
    question(Map::deserialize(deserializer)?).map_err(refused)
}

/// The parameter without which the others can be read.
fn culprit<Q: DeserializeOwned>(values: &Map<String, Value>) -> Option<&str> {
    let is_read_without = |name: &&str| {
        let mut others = values.clone();
        others.remove(*name);
        serde_json::from_value::<Q>(Value::Object(others)).is_ok()
    };
    values.keys().map(String::as_str).find(is_read_without)
}

/// A value as one would type it.
pub fn typed(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        value => value.as_f64().map_or(value.to_string(), |number| Typed(number).to_string()),
    }
}

/// Why a value is of another kind, if it is. Null stands for what is not given.
fn mistaken(kind: &Kind, value: &Value) -> Option<String> {
    let is_right = value.is_null()
        || match kind {
            Kind::Number => value.is_number(),
            Kind::Integer => value.is_u64(),
            Kind::Switch => value.is_boolean(),
            Kind::Name(names) => names.iter().any(|(name, _)| value.as_str() == Some(name)),
            Kind::Ends => value
                .as_array()
                .is_some_and(|ends| ends.len() == 2 && ends.iter().all(Value::is_number)),
            Kind::Numbers => value.as_array().is_some_and(|all| all.iter().all(Value::is_number)),
            Kind::Tip | Kind::Other => true,
        };
    (!is_right).then(|| match kind {
        Kind::Number => "must be a finite number".into(),
        Kind::Integer => "must be a whole number of 0 or more".into(),
        Kind::Switch => "must be true or false".into(),
        Kind::Ends => "must be two finite numbers".into(),
        Kind::Name(names) => {
            let names: Vec<&str> = names.iter().map(|(name, _)| name.as_str()).collect();
            format!("must be one of {}", names.join(", "))
        }
        Kind::Numbers => "must be finite numbers".into(),
        Kind::Tip | Kind::Other => String::new(),
    })
}

/// The first name among these that is none of the parameters of `Q`.
pub fn stranger<Q: JsonSchema>(values: &Map<String, Value>) -> Option<&str> {
    let schema = schema_for!(Q).to_value();
    values.keys().map(String::as_str).find(|name| schema["properties"].get(*name).is_none())
}

/// Parameters with others in their place. What another value makes stale goes: α and αc(r) + D replace each other, and the
/// critical α or r of a question that was resolved is computed anew.
#[must_use]
pub fn overridden(mut base: Map<String, Value>, given: Map<String, Value>) -> Map<String, Value> {
    if base.remove("at_critical_point") == Some(Value::Bool(true)) {
        let is_r = base.get("solve_for").is_some_and(|name| name == "r");
        base.remove(if is_r { "r" } else { "alpha" });
    }
    let is_given = |name: &str| given.get(name).is_some_and(|value| !value.is_null());
    if is_given("alpha") || is_given("alpha_above") {
        base.remove("alpha");
        base.remove("alpha_above");
    } else if !given.is_empty() && base.get("alpha").is_some_and(Value::is_number) {
        base.remove("alpha_above");
    }
    base.extend(given);
    base
}
