//! Command-line options made from the parameters that a question declares.

use super::TipArguments;
use super::brief::has_help;
use super::range::{Interval, Range};
use clap::builder::{PossibleValue, PossibleValuesParser};
use clap::{Arg, ArgAction, ArgMatches, Args, Command, FromArgMatches, value_parser};
use serde_json::{Map, Value, json};
use std::marker::PhantomData;
use std::ops::Deref;
use std::path::PathBuf;
use stickslip::Question;
use stickslip::parameter::{Kind, Parameter, parameters};

/// Symbol of a parameter with several values, along which a grid may vary.
const RANGE: &str = "RANGE";

/// The questions that a command can answer.
pub(crate) trait Questions {
    /// The parameters of all of them.
    fn parameters() -> Vec<&'static Parameter>;
    /// The formats of their documents; empty if no document has these parameters.
    fn formats() -> Vec<&'static str>;
}

impl<Q: Question> Questions for Q {
    fn parameters() -> Vec<&'static Parameter> {
        parameters::<Q>().iter().collect()
    }

    fn formats() -> Vec<&'static str> {
        vec![Q::FORMAT]
    }
}

/// One of several questions, selected by the options given.
#[derive(Debug, Clone)]
pub(crate) struct Either<A, B>(PhantomData<(A, B)>);

impl<A: Questions, B: Questions> Questions for Either<A, B> {
    fn parameters() -> Vec<&'static Parameter> {
        let mut all = A::parameters();
        let is_new = |other: &&Parameter| all.iter().all(|one| one.name != other.name);
        let more: Vec<&Parameter> = B::parameters().into_iter().filter(is_new).collect();
        all.extend(more);
        all
    }

    fn formats() -> Vec<&'static str> {
        [A::formats(), B::formats()].concat()
    }
}

/// The given parameters of `Q`.
#[derive(Debug, Clone)]
pub(crate) struct Options<Q>(pub(crate) Given, PhantomData<fn() -> Q>);

/// The given parameters of a command.
#[derive(Debug, Clone)]
pub(crate) struct Given {
    /// Values by the names of the parameters, except the footprint.
    pub(crate) given: Map<String, Value>,
    pub(crate) tip: TipArguments,
    /// A file with further parameters.
    pub(crate) parameters: Option<PathBuf>,
    /// Ranges, each with its option.
    pub(crate) ranges: Vec<(String, Interval)>,
    /// The option that gives the number of values in a range.
    pub(crate) counted_by: Option<&'static str>,
}

impl<Q> Deref for Options<Q> {
    type Target = Given;

    fn deref(&self) -> &Given {
        &self.0
    }
}

impl<Q: Questions> Args for Options<Q> {
    fn augment_args(command: Command) -> Command {
        augmented(command, Q::parameters(), !Q::formats().is_empty())
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

/// The command with options for these parameters, and for a file of them.
fn augmented(command: Command, parameters: Vec<&'static Parameter>, has_file: bool) -> Command {
    let command = parameters.into_iter().fold(command, |command, parameter| match parameter.kind {
        Kind::Tip => TipArguments::augment_args(command),
        _ => command.next_help_heading(None).arg(argument(parameter)),
    });
    let file = Arg::new("parameters")
        .long("parameters")
        .value_name("FILE.json")
        .value_parser(value_parser!(PathBuf))
        .help_heading("Model")
        .help("Parameters from a document of this program, or from its \"parameters\" alone; options take their place");
    command.next_help_heading(None).args(has_file.then_some(file))
}

impl<Q: Questions> FromArgMatches for Options<Q> {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        Ok(Self(Given::of(&Q::parameters(), matches)?, PhantomData))
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl Given {
    fn of(all: &[&Parameter], matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut given = Map::new();
        for parameter in all {
            if parameter.kind != Kind::Tip && is_given(matches, parameter.name) {
                insert(&mut given, parameter, matches);
            }
        }
        let tip = match all.iter().any(|parameter| parameter.kind == Kind::Tip) {
            true => TipArguments::from_arg_matches(matches)?,
            false => TipArguments::default(),
        };
        let parameters = matches.try_get_one("parameters").ok().flatten().cloned();
        let ends = all.iter().filter(|parameter| parameter.kind == Kind::Ends);
        let range = |parameter: &&Parameter| {
            let interval: &Interval = matches.get_one(parameter.name)?;
            Some((format!("--{}", long(parameter.name)), interval.clone()))
        };
        let ranges = ends.filter_map(range).collect();
        let counts = |name: &str| name == "points" && is_given(matches, name);
        let counted_by = all.iter().any(|parameter| counts(parameter.name)).then_some("--points");
        Ok(Self { given, tip, parameters, ranges, counted_by })
    }
}

fn is_given(matches: &ArgMatches, name: &str) -> bool {
    matches.value_source(name) == Some(clap::parser::ValueSource::CommandLine)
}

/// The command-line option of a parameter.
fn argument(parameter: &'static Parameter) -> Arg {
    let Parameter { name, kind, symbol, group, .. } = *parameter;
    let mut argument = Arg::new(name).long(long(name)).help_heading(group);
    if has_help() {
        argument = argument.help(help(parameter));
    }
    if is_spacing(name) {
        return argument
            .action(ArgAction::SetTrue)
            .help("Equal ratios from one to the next, in place of equal differences");
    }
    if kind == Kind::Switch {
        return argument.action(ArgAction::SetTrue);
    }
    let argument = argument.value_name(symbol).allow_hyphen_values(true);
    match kind {
        Kind::Integer => argument.value_parser(value_parser!(u64)),
        Kind::Name(names) => {
            let value = |(name, meaning): &(&'static str, &'static str)| {
                PossibleValue::new(*name).help(has_help().then_some(*meaning))
            };
            argument.value_parser(PossibleValuesParser::new(names.iter().map(value)))
        }
        Kind::Names(names) => {
            let names = names.iter().map(|(name, _)| *name);
            argument.value_parser(PossibleValuesParser::new(names)).value_delimiter(',')
        }
        Kind::Text => argument,
        Kind::Ends => argument.value_parser(value_parser!(Interval)),
        // A range LO:HI:N, to which Python turns a tuple, or a list in one word.
        Kind::Numbers if symbol == RANGE => argument.value_parser(value_parser!(Range)),
        Kind::Numbers => argument.value_parser(value_parser!(Range)).value_delimiter(','),
        _ => argument.value_parser(value_parser!(f64)),
    }
}

/// Whether a parameter is the spacing of a range, whose second value is a switch, `--logarithmic`.
fn is_spacing(name: &str) -> bool {
    name == "spacing"
}

fn long(name: &str) -> String {
    if is_spacing(name) { "logarithmic".into() } else { name.replace('_', "-") }
}

/// The description as one paragraph without its final full stop, as is usual for help; names of parameters in it
/// become names of options.
fn help(parameter: &Parameter) -> String {
    let parts = parameter.description.trim_end_matches('.').split('`').enumerate();
    let text: String = parts
        .map(|(i, part)| if i % 2 == 1 { format!("--{}", long(part)) } else { part.to_owned() })
        .collect();
    match parameter.default_value() {
        Some(Value::String(name)) => format!("{text} [default: {name}]"),
        Some(Value::Number(number)) if number.is_f64() => {
            format!("{text} [default: {}]", stickslip::Typed(number.as_f64().unwrap_or_default()))
        }
        Some(Value::Number(number)) => format!("{text} [default: {number}]"),
        _ => text,
    }
}

/// A number as JSON. JSON has no infinities and no NaN, which are rejected later by the name of the parameter.
fn number(value: f64) -> Value {
    if value.is_finite() { json!(value) } else { json!(stickslip::Typed(value).to_string()) }
}

/// Adds the value of a parameter to the others; a range may contain its number of values.
fn insert(given: &mut Map<String, Value>, parameter: &Parameter, matches: &ArgMatches) {
    let Parameter { name, kind, .. } = *parameter;
    let value = match kind {
        _ if is_spacing(name) => json!("logarithmic"),
        Kind::Switch => json!(true),
        Kind::Integer => json!(matches.get_one::<u64>(name)),
        Kind::Name(_) | Kind::Text => json!(matches.get_one::<String>(name)),
        Kind::Names(_) => {
            json!(matches.get_many::<String>(name).into_iter().flatten().collect::<Vec<_>>())
        }
        Kind::Ends => {
            let Some(interval) = matches.get_one::<Interval>(name) else { return };
            if let Some(points) = interval.counted() {
                given.insert("points".into(), json!(points));
            }
            json!(interval.numbers().map(number))
        }
        Kind::Numbers => {
            let ranges = matches.get_many::<Range>(name).into_iter().flatten();
            Value::Array(ranges.flat_map(Range::values).map(number).collect())
        }
        _ => number(*matches.get_one::<f64>(name).unwrap_or(&f64::NAN)),
    };
    given.insert(name.into(), value);
}
