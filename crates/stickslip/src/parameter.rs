//! The parameters of a question, read from its JSON Schema, a file made from the type. Options of the command line,
//! keywords of Python and parameter files follow from them: a parameter is declared once, as a field of a question.

pub use crate::distinct::Distinct;
use crate::{Refused, Typed};
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value, json};
use std::any::TypeId;
use std::borrow::Cow;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Schema attributes of a parameter, by the key `x-option`: the symbol of its value, its group, and its rank on the
/// help page. A field without them, such as a result of [`Ask::resolved`](crate::Ask::resolved), is part of documents
/// but is no option.
#[cfg_attr(not(feature = "schema"), allow(dead_code, reason = "only schemas need it"))]
pub(crate) fn option(symbol: &str, group: &str, place: u32) -> Value {
    json!({ "symbol": symbol, "group": group, "place": place })
}

/// Removes the default of a parameter that only another parameter can replace: an area has its own lines.
#[cfg(feature = "schema")]
pub(crate) fn without_default(schema: &mut schemars::Schema) {
    schema.remove("default");
}

/// Reason given when a question that needs a spring gets a model without one.
pub(crate) const NOTHING_DRAGS: &str =
    "without a spring nothing drags the tip: there is no steady motion behind a support";

/// A parameter of a question.
#[derive(Debug, Clone, PartialEq)]
pub struct Parameter {
    /// The name, such as `alpha_above`.
    pub name: String,
    /// Meaning, unit and range.
    pub description: String,
    /// The kind of its values.
    pub kind: Kind,
    /// The default value, if there is one.
    pub default: Option<Value>,
    /// Whether the parameter is required.
    pub is_required: bool,
    /// The symbol of its value on the help page, such as `R`.
    pub symbol: String,
    /// The group of parameters that it belongs to, such as `Extended model`.
    pub group: String,
    /// Its rank on the help page.
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
    /// One name out of this list of names with their meanings.
    Name(Vec<(String, String)>),
    /// Both ends of a range; `points` and `spacing` of the same question define its division.
    Ends,
    /// A list of numbers.
    Numbers,
    /// Several names out of this list of names with their meanings.
    Names(Vec<(String, String)>),
    /// A text, such as a unit.
    Text,
    /// A footprint, as [`Tip`](crate::Tip) reads it.
    Tip,
    /// Any other value, such as a table.
    Other,
}

/// A type with parameters or names that users may set.
pub trait Parameters: DeserializeOwned + 'static {
    /// JSON Schema of the type.
    const SCHEMA: &'static str;
}

/// The parts of a JSON Schema that define parameters. No others are parsed: every command parses a schema when it
/// starts.
#[derive(Deserialize, Default)]
#[serde(default)]
struct Schema<'a> {
    #[serde(borrow)]
    required: Vec<&'a str>,
    #[serde(borrow)]
    properties: BTreeMap<&'a str, PropertySchema<'a>>,
    #[serde(borrow, rename = "$defs")]
    definitions: BTreeMap<&'a str, PropertySchema<'a>>,
    #[serde(borrow, rename = "oneOf")]
    names: Vec<NameSchema<'a>>,
}

/// The schema of a property, or of a type that properties refer to.
#[derive(Deserialize, Default)]
#[serde(default)]
struct PropertySchema<'a> {
    #[serde(borrow)]
    description: Cow<'a, str>,
    #[serde(rename = "type")]
    types: Value,
    items: Value,
    #[serde(rename = "maxItems")]
    most_items: Value,
    #[serde(rename = "anyOf")]
    alternatives: Vec<Value>,
    #[serde(rename = "$ref")]
    reference: Option<&'a str>,
    default: Value,
    #[serde(rename = "x-option")]
    option: Option<OptionSchema>,
    /// The constants of an enumeration.
    #[serde(borrow, rename = "oneOf")]
    names: Vec<NameSchema<'a>>,
}

/// The value of `x-option`, as [`option`] writes it.
#[derive(Clone, Default, Deserialize)]
struct OptionSchema {
    symbol: String,
    group: String,
    place: u64,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct NameSchema<'a> {
    #[serde(rename = "const")]
    name: Option<&'a str>,
    #[serde(borrow)]
    description: Cow<'a, str>,
}

/// The names of the variants of an enumeration, each with its meaning.
pub fn names<T: Parameters>() -> Vec<(String, String)> {
    names_of(&Schema::of::<T>().names)
}

/// The parsed schema of a question, computed once per process.
struct Described {
    /// All properties of the schema, options or not, by name.
    properties: &'static [Parameter],
    /// Those that are options, as on the help page.
    options: Vec<&'static Parameter>,
}

/// The parsed schema of a question, cached because parsing takes longer than many answers.
fn described<Q: Parameters>() -> &'static Described {
    // There are as many as types of questions.
    static KNOWN: Mutex<Vec<(TypeId, &'static Described)>> = Mutex::new(vec![]);
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let of_type = TypeId::of::<Q>();
    if let Some((_, described)) = known.iter().find(|(other, _)| *other == of_type) {
        return described;
    }
    let described = Box::leak(Box::new(Described::of(&Schema::of::<Q>())));
    known.push((of_type, described));
    described
}

impl Schema<'_> {
    /// The schema of a type; empty if its file is damaged, which a test excludes.
    fn of<Q: Parameters>() -> Self {
        serde_json::from_str(Q::SCHEMA).unwrap_or_default()
    }

    /// The names of the enumeration that a reference leads to; none for other types.
    fn names_at(&self, reference: &str) -> Vec<(String, String)> {
        let name = reference.trim_start_matches("#/$defs/");
        self.definitions.get(name).map(|named| names_of(&named.names)).unwrap_or_default()
    }
}

impl Described {
    fn of(schema: &Schema<'_>) -> Self {
        let parameter = |(name, property): (&&str, &PropertySchema<'_>)| {
            let OptionSchema { symbol, group, place } = property.option.clone().unwrap_or_default();
            Parameter {
                name: (*name).into(),
                description: property.description.replace('\n', " "),
                kind: kind(name, property, schema),
                default: Some(&property.default).filter(|value| !value.is_null()).cloned(),
                is_required: schema.required.contains(name),
                symbol,
                group,
                place,
            }
        };
        let properties = schema.properties.iter().map(parameter).collect::<Vec<_>>().leak();
        let is_option = schema.properties.values().map(|property| property.option.is_some());
        let options = properties.iter().zip(is_option).filter(|(_, is_option)| *is_option);
        let mut options: Vec<&Parameter> = options.map(|(parameter, _)| parameter).collect();
        options.sort_by_key(|parameter| parameter.place);
        Self { properties, options }
    }

    fn property(&self, name: &str) -> Option<&Parameter> {
        self.properties.iter().find(|parameter| parameter.name == name)
    }
}

/// The parameters that a user may give, in the order of a help page.
pub fn parameters<Q: Parameters>() -> &'static [&'static Parameter] {
    &described::<Q>().options
}

/// The kind of a property, from its type or from the definition that it refers to.
fn kind(name: &str, property: &PropertySchema<'_>, schema: &Schema<'_>) -> Kind {
    if name == "tip" {
        return Kind::Tip;
    }
    let types = match &property.types {
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
    if types.contains(&"string") {
        return Kind::Text;
    }
    if types.contains(&"array") {
        return kind_of_list(property, schema);
    }
    let alternatives = property.alternatives.iter().filter_map(|one| one["$ref"].as_str());
    let reference = alternatives.chain(property.reference).next();
    let names = reference.map(|path| schema.names_at(path)).unwrap_or_default();
    if names.is_empty() { Kind::Other } else { Kind::Name(names) }
}

fn kind_of_list(
    PropertySchema { items, most_items, .. }: &PropertySchema<'_>,
    schema: &Schema<'_>,
) -> Kind {
    if let Some(path) = items["$ref"].as_str() {
        let names = schema.names_at(path);
        return if names.is_empty() { Kind::Other } else { Kind::Names(names) };
    }
    match (&items["type"], most_items) {
        (Value::String(of), Value::Null) if of == "number" => Kind::Numbers,
        (Value::String(of), _) if of == "number" => Kind::Ends,
        _ => Kind::Other,
    }
}

/// The names of an enumeration, each with its description.
fn names_of(names: &[NameSchema<'_>]) -> Vec<(String, String)> {
    let named = names.iter().filter_map(|NameSchema { name, description }| {
        let meaning = description.replace('\n', " ");
        Some(((*name)?.to_owned(), meaning.trim_end_matches('.').to_owned()))
    });
    named.collect()
}

/// The question with the given parameters, and defaults for the others.
///
/// # Errors
/// An unknown name, a missing parameter, or a value of the wrong kind.
pub fn question<Q: Parameters>(values: Map<String, Value>) -> Result<Q, Refused> {
    let described = described::<Q>();
    let names = described.properties.iter().map(|parameter| &parameter.name);
    for (name, value) in &values {
        let Some(property) = described.property(name) else {
            let advice = match nearest(names, name) {
                Some(meant) => format!("did you mean \"{meant}\"?"),
                None => "leave it out".into(),
            };
            return Err(Refused::whole(name.clone(), format!("is no parameter here: {advice}")));
        };
        if let Some(why) = mistaken(&property.kind, value) {
            return Err(Refused::word(name.clone(), typed(value), why));
        }
    }
    let is_missing =
        |property: &&Parameter| property.is_required && !values.contains_key(&property.name);
    if let Some(property) = described.properties.iter().find(is_missing) {
        if values.get("no_spring") == Some(&Value::Bool(true)) {
            return Err(Refused::whole("no_spring", NOTHING_DRAGS));
        }
        let meaning = property.description.trim_end_matches('.').to_owned();
        // Other parameters in it are named in the style of the interface.
        let named = |text: String, name: &String| {
            text.replace(&format!("`{name}`"), &format!("{{{name}}}"))
        };
        let meaning = names.fold(meaning, named);
        return Err(Refused::whole(property.name.clone(), format!("is needed: {meaning}")));
    }
    serde_json::from_value(Value::Object(values.clone())).map_err(|error| {
        let parameter = culprit::<Q>(&values).unwrap_or("tip").to_owned();
        Refused::whole(parameter, error)
    })
}

/// Reads a question and rejects unknown names as [`question`] does; serde alone accepts unknown names where fields are
/// flattened.
pub(crate) fn strictly<'de, D: Deserializer<'de>, Q: Parameters>(
    deserializer: D,
) -> Result<Q, D::Error> {
    match Distinct::deserialize(deserializer)? {
        Distinct(Value::Object(values)) => question(values).map_err(D::Error::custom),
        _ => Err(D::Error::custom("parameters are an object")),
    }
}

/// Smallest number of initial letters that two names must share for one to be suggested for the other.
const SHARED: usize = 3;

/// The known name that differs from `name` in the fewest letters, if these are few. Otherwise, of the names that share
/// the most initial letters with it, the shortest; `None` if they share less than half of `name`.
fn nearest<'a>(names: impl Iterator<Item = &'a String> + Clone, name: &str) -> Option<&'a String> {
    // Two letters that changed places are two changes.
    let most = (name.len() / 2).min(1 + name.len() / 5);
    let changes = |other: &&String| strsim::levenshtein(name, other);
    if let Some(other) = names.clone().min_by_key(changes).filter(|other| changes(other) <= most) {
        return Some(other);
    }
    let shared = |other: &str| name.bytes().zip(other.bytes()).take_while(|(a, b)| a == b).count();
    let best = names.max_by_key(|other| (shared(other), Reverse(other.len())))?;
    (shared(best) >= SHARED.max(name.len().div_ceil(2))).then_some(best)
}

/// The first parameter without which the others can be read.
fn culprit<Q: DeserializeOwned>(values: &Map<String, Value>) -> Option<&str> {
    let is_read_without = |name: &&str| {
        let mut others = values.clone();
        others.remove(*name);
        serde_json::from_value::<Q>(Value::Object(others)).is_ok()
    };
    values.keys().map(String::as_str).find(is_read_without)
}

/// A value in the form in which a user types it.
pub fn typed(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        value => value.as_f64().map_or(value.to_string(), |number| Typed(number).to_string()),
    }
}

/// The reason why a value is of the wrong kind; `None` if it is not. Null stands for a missing value.
fn mistaken(kind: &Kind, value: &Value) -> Option<String> {
    let is_right = value.is_null()
        || match kind {
            Kind::Number => value.is_number(),
            Kind::Integer => value.is_u64(),
            Kind::Switch => value.is_boolean(),
            Kind::Name(names) => names.iter().any(|(name, _)| value.as_str() == Some(name)),
            Kind::Names(names) => value.as_array().is_some_and(|all| {
                all.iter().all(|one| names.iter().any(|(name, _)| one.as_str() == Some(name)))
            }),
            Kind::Text => value.is_string(),
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
        Kind::Name(names) | Kind::Names(names) => {
            let names: Vec<&str> = names.iter().map(|(name, _)| name.as_str()).collect();
            format!("must be one of {}", names.join(", "))
        }
        Kind::Text => "must be a text".into(),
        Kind::Numbers => "must be finite numbers".into(),
        Kind::Tip | Kind::Other => String::new(),
    })
}

/// The first name in `values` that is no parameter of `Q`.
pub fn unknown_parameter<Q: Parameters>(values: &Map<String, Value>) -> Option<&str> {
    let described = described::<Q>();
    values.keys().map(String::as_str).find(|name| described.property(name).is_none())
}

/// The parameters `base` with the values `given` in their place. Values that become stale are removed: α and αc(r) + D
/// replace each other, as do the two ways to give times of samples; a hold replaces the path of a support, and the measures
/// of a rectangle replace an area; a line that is repeated has no pitch. A computed critical α or r is computed anew.
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
    if is_given("hold") {
        base.remove("support_path");
    }
    if is_given("sample_every") || is_given("sample_at") {
        base.remove("sample_every");
        base.remove("sample_at");
    }
    if ["pitch", "lines", "length"].into_iter().any(is_given) {
        base.remove("area");
    }
    if given.get("path").is_some_and(|path| path == "repeat") {
        base.remove("pitch");
    }
    base.extend(given);
    base
}
