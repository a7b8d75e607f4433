//! The parameters of a question: options of the command line, keywords of Python and parameter files follow from them. A
//! parameter is declared once, as a field of a question; `make reference` writes the tables from the types, because a
//! program that read schemas at each start would take a twentieth longer for a short run.

#[cfg(feature = "schema")]
pub(crate) mod declared;

pub use crate::distinct::Distinct;
use crate::{Refused, Typed};
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer};
use serde_json::{Map, Value, json};
use std::cmp::Reverse;

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
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parameter {
    /// The name, such as `alpha_above`.
    pub name: &'static str,
    /// Meaning, unit and range.
    pub description: &'static str,
    /// The kind of its values.
    pub kind: Kind,
    /// The default value as JSON, if there is one.
    pub default: Option<&'static str>,
    /// Whether the parameter is required.
    pub is_required: bool,
    /// The symbol of its value on the help page, such as `R`.
    pub symbol: &'static str,
    /// The group of parameters that it belongs to, such as `Extended model`.
    pub group: &'static str,
}

impl Parameter {
    /// The default value, if there is one.
    pub fn default_value(&self) -> Option<Value> {
        serde_json::from_str(self.default?).ok()
    }
}

/// The values that a parameter takes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Kind {
    /// A number.
    Number,
    /// A whole number of 0 or more.
    Integer,
    /// True or false.
    Switch,
    /// One name out of this list of names with their meanings.
    Name(&'static [(&'static str, &'static str)]),
    /// Both ends of a range; `points` and `spacing` of the same question define its division.
    Ends,
    /// A list of numbers.
    Numbers,
    /// Several names out of this list of names with their meanings.
    Names(&'static [(&'static str, &'static str)]),
    /// A text, such as a unit.
    Text,
    /// A footprint, as [`Tip`](crate::Tip) reads it.
    Tip,
    /// Any other value, such as a table.
    Other,
}

/// The parameters of a question, or the names of an enumeration.
#[derive(Debug)]
pub struct Declared {
    /// Parameters that a user may give, in the order of a help page.
    pub options: &'static [Parameter],
    /// Other properties by name, such as results of [`Ask::resolved`](crate::Ask::resolved): documents contain them.
    pub others: &'static [Parameter],
    /// The variants of an enumeration, each with its meaning.
    pub names: &'static [(&'static str, &'static str)],
}

/// A type with parameters or names that users may set.
pub trait Parameters: DeserializeOwned + 'static {
    /// The table that `make reference` writes from the type.
    const DECLARED: Declared;
}

/// The names of the variants of an enumeration, each with its meaning.
pub fn names<T: Parameters>() -> &'static [(&'static str, &'static str)] {
    T::DECLARED.names
}

/// The parameters that a user may give, in the order of a help page.
pub fn parameters<Q: Parameters>() -> &'static [Parameter] {
    Q::DECLARED.options
}

impl Declared {
    /// All properties, options or not.
    fn properties(&self) -> impl Iterator<Item = &'static Parameter> + Clone + use<> {
        self.options.iter().chain(self.others)
    }

    fn property(&self, name: &str) -> Option<&'static Parameter> {
        self.properties().find(|parameter| parameter.name == name)
    }
}

/// The question with the given parameters, and defaults for the others.
///
/// # Errors
/// An unknown name, a missing parameter, or a value of the wrong kind.
pub fn question<Q: Parameters>(values: Map<String, Value>) -> Result<Q, Refused> {
    let declared = Q::DECLARED;
    for (name, value) in &values {
        let Some(property) = declared.property(name) else {
            let known = declared.properties().map(|property| property.name);
            let advice = match nearest(known, name) {
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
        |property: &&Parameter| property.is_required && !values.contains_key(property.name);
    if let Some(property) = declared.properties().filter(is_missing).min_by_key(|one| one.name) {
        if values.get("no_spring") == Some(&Value::Bool(true)) {
            return Err(Refused::whole("no_spring", NOTHING_DRAGS));
        }
        let meaning = property.description.trim_end_matches('.').to_owned();
        // Other parameters in it are named in the style of the interface.
        let named = |text: String, Parameter { name, .. }: &Parameter| {
            text.replace(&format!("`{name}`"), &format!("{{{name}}}"))
        };
        let meaning = declared.properties().fold(meaning, named);
        return Err(Refused::whole(property.name, format!("is needed: {meaning}")));
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
/// the most initial letters with it, the shortest; `None` if they share less than half of `name`. Of equal ones the order
/// of letters decides.
fn nearest<'a>(names: impl Iterator<Item = &'a str> + Clone, name: &str) -> Option<&'a str> {
    // Two letters that changed places are two changes.
    let most = (name.len() / 2).min(1 + name.len() / 5);
    let changes = |other: &str| strsim::levenshtein(name, other);
    let fewest = names.clone().min_by_key(|other| (changes(other), *other));
    if let Some(other) = fewest.filter(|other| changes(other) <= most) {
        return Some(other);
    }
    let shared = |other: &str| name.bytes().zip(other.bytes()).take_while(|(a, b)| a == b).count();
    let best = names.max_by_key(|other| (shared(other), Reverse(other.len()), *other))?;
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
            let names: Vec<&str> = names.iter().map(|(name, _)| *name).collect();
            format!("must be one of {}", names.join(", "))
        }
        Kind::Text => "must be a text".into(),
        Kind::Numbers => "must be finite numbers".into(),
        Kind::Tip | Kind::Other => String::new(),
    })
}

/// The first name in `values` that is no parameter of `Q`.
pub fn unknown_parameter<Q: Parameters>(values: &Map<String, Value>) -> Option<&str> {
    values.keys().map(String::as_str).find(|name| Q::DECLARED.property(name).is_none())
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
