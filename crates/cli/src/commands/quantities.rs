//! Quantities with a unit in place of numbers: `--pitch 40nm` becomes `--pitch 2` where σ is 20 nm.
//!
//! This happens before the command line is parsed, so that all commands and their questions have numbers of the model alone.

use super::in_units::{of_document, with_origin};
use crate::arguments::InUnitsArguments;
use crate::failure::{Failure, Typed};
use crate::files::columns::measured_in;
use crate::files::input::open;
use crate::session::{Session, TypedQuantity};
use clap::{Arg, ArgAction, Command};
use serde_json::Value;
use std::borrow::BorrowMut;
use std::ffi::OsString;
use std::path::{Path, PathBuf};
use stickslip::{Dimension, KnownScales};

/// A command line whose quantities are numbers, and these numbers as they were typed.
pub(crate) struct Translated {
    pub(crate) words: Vec<OsString>,
    pub(crate) typed: Vec<TypedQuantity>,
}

/// The units of an option, one for each of its parts, or one for all of them; the last of a range LO:HI:N has none.
pub(crate) fn units_of(command: &str, option: &str) -> Option<&'static [&'static str]> {
    const LENGTH: &[&str] = &["σ"];
    const TIME: &[&str] = &["Γ/k"];
    Some(match (command, option) {
        // Quantities in themselves, and pictures.
        ("units" | "friction", _) | ("plot", "width" | "times") => return None,
        ("fit", "width" | "pitch") | ("tip", "centre") => return None,
        ("continue" | "cycle" | "sweep", "tolerance") => &["kσ/Γ"],
        (_, "width" | "start-position" | "kick" | "kick-across" | "noise-spacing") => LENGTH,
        (_, "noise-spacing-across" | "width-y" | "pitch" | "pitch-range" | "length") => LENGTH,
        (_, "tolerance" | "x" | "y" | "range" | "y-range" | "spacing" | "spacing-y") => LENGTH,
        (_, "largest-radius") => LENGTH,
        (_, "until" | "at" | "sample-every" | "sample-at" | "hold" | "healing-time") => TIME,
        (_, "grid-until" | "step" | "longest-period" | "checkpoint-every") => TIME,
        (_, "depth-limit" | "noise") => &["kσ²/a"],
        (_, "pulse") => &["kσ", "Γ/k", "Γ/k"],
        (_, "start-velocity" | "r" | "r-range") => &["kσ/Γ"],
        (_, "alpha" | "alpha-above") => &["k²σ²/(aΓ)"],
        (_, "rotation" | "re-above") => &["k/Γ"],
        (_, "inertia") => &["Γ²/k"],
        (_, "load" | "load-range") => &["nN"],
        _ => return None,
    })
}

/// The scales that a number in this unit needs.
fn needs(unit: &str) -> &'static str {
    match unit {
        "σ" => "--sigma",
        "Γ/k" | "k/Γ" => "--damping and --stiffness, or --sigma and --velocity with one --r",
        "Γ²/k" => "--damping and --stiffness",
        "kσ" => "--sigma and --stiffness",
        "kσ/Γ" => "--sigma, --damping and --stiffness",
        "kσ²/a" => "--sigma, --stiffness and --slope-force",
        _ => "--sigma, --stiffness, --damping and --slope-force",
    }
}

/// The command line with numbers in place of quantities. The parser is built only for a line that may have some: that
/// takes a tenth of the time of a short command.
pub(crate) fn translated<P: BorrowMut<Command>>(
    session: &Session,
    words: Vec<OsString>,
    parser: impl FnOnce() -> P,
) -> Result<Translated, Failure> {
    let line =
        Line { words: words.iter().map(|word| word.to_string_lossy().into_owned()).collect() };
    let mut translated = Translated { words, typed: vec![] };
    if !line.options().any(|(_, value, ..)| is_quantity(value)) {
        return Ok(translated);
    }
    let mut parser = parser();
    let parser = parser.borrow_mut();
    let Some((at, command)) = line.command(parser) else { return Ok(translated) };
    let quantities: Vec<Quantity> = line.quantities(&command).collect();
    if quantities.is_empty() {
        return Ok(translated);
    }
    parser.build();
    let scales = line.scales(session, parser, at, &command, &quantities)?;
    let has_scales = option_of(parser, &command, "units").is_some();
    for quantity in &quantities {
        let [number, shown] = quantity.number(scales.as_ref(), has_scales)?;
        let Quantity { option, value, place, is_joined, .. } = quantity;
        let meant = format!("{value} is {shown} {}", quantity.units.join(", "));
        // Messages have the shortest digits, or the word as it is passed on.
        for found in [&shown, &number] {
            translated.typed.push(TypedQuantity {
                number: format!("{option} {found}"),
                typed: format!("{option} {value}"),
                meant: meant.clone(),
            });
        }
        translated.words[*place] =
            if *is_joined { format!("{option}={number}").into() } else { number.into() };
    }
    Ok(translated)
}

/// An option whose value has a unit.
struct Quantity {
    option: String,
    value: String,
    units: &'static [&'static str],
    /// Index of the word with the value, and whether this word contains the option too.
    place: usize,
    is_joined: bool,
}

impl Quantity {
    /// The value in numbers of the model, for the parser and as messages show it.
    fn number(
        &self,
        scales: Option<&KnownScales>,
        has_scales: bool,
    ) -> Result<[String; 2], Failure> {
        let Self { option, value, units, .. } = self;
        let is_range = value.matches(':').count() == 2;
        let mut number = [String::new(), String::new()];
        for (i, part) in value.split_inclusive([':', ',']).enumerate() {
            let typed = part.trim_end_matches([':', ',']);
            let is_count = is_range && i == 2;
            let unit = units[i.min(units.len() - 1)];
            let both = if is_count || typed.trim().parse() == Ok(0.0) {
                [typed.to_owned(), typed.to_owned()]
            } else {
                let why = |why| Failure::input(format!("{option} {value}"), why);
                let number = converted(typed, unit, scales, has_scales).map_err(why)?;
                [format!("{number:?}"), Typed(number).to_string()]
            };
            for (whole, one) in number.iter_mut().zip(both) {
                *whole += &one;
                *whole += &part[typed.len()..];
            }
        }
        Ok(number)
    }
}

/// A part of a value as a number of the model, or the error message.
fn converted(
    part: &str,
    unit: &str,
    scales: Option<&KnownScales>,
    has_scales: bool,
) -> Result<f64, String> {
    if !has_unit(part) {
        return Err(format!(
            "`{part}` has no unit and other parts have one: each needs one, or none"
        ));
    }
    let (kind, per_si) = measured_in(unit);
    let quantity = kind.parse(part).map_err(|error| error.to_string())? * per_si;
    if unit == "nN" {
        return Ok(Dimension::rounded(quantity));
    }
    let number = Dimension::of_unit(unit).zip(scales);
    number.and_then(|(dimension, scales)| dimension.number(quantity, scales)).ok_or_else(|| {
        let scales = if has_scales {
            format!("give --units, or {}; or ", needs(unit))
        } else {
            "there are none here: ".into()
        };
        format!("a unit needs the scales of the experiment: {scales}give the number in {unit}")
    })
}

/// Whether a part of the value of an option has a unit.
fn is_quantity(value: &str) -> bool {
    value.split([':', ',']).any(has_unit)
}

/// Whether a text is a number followed by something else.
fn has_unit(part: &str) -> bool {
    let part = part.trim();
    let is_begun = part.starts_with(|c: char| c.is_ascii_digit() || matches!(c, '+' | '-' | '.'));
    let is_finite = |c: char| c.is_ascii_digit();
    is_begun && part.contains(is_finite) && part.parse::<f64>().is_err()
}

/// The words of a command line.
struct Line {
    words: Vec<String>,
}

impl Line {
    /// The place of the command, and its name with that of its subcommand.
    fn command(&self, parser: &Command) -> Option<(usize, Vec<String>)> {
        let at = self.words.iter().position(|word| parser.find_subcommand(word).is_some())?;
        let first = self.words[at].clone();
        let second = self
            .words
            .get(at + 1)
            .filter(|word| matches!((&*first, &***word), ("sweep", "raster" | "merge")));
        Some((at, [Some(first), second.cloned()].into_iter().flatten().collect()))
    }

    /// Options, their values, the places of the values, and whether option and value are one word.
    fn options(&self) -> impl Iterator<Item = (&str, &str, usize, bool)> {
        self.words.iter().enumerate().filter_map(|(at, word)| {
            let name = word.strip_prefix("--")?;
            match name.split_once('=') {
                Some((name, value)) => Some((name, value, at, true)),
                None => Some((name, self.words.get(at + 1)?, at + 1, false)),
            }
        })
    }

    fn value(&self, wanted: &str) -> Option<&str> {
        self.options().find(|(name, ..)| *name == wanted).map(|(_, value, ..)| value)
    }

    fn quantities(&self, command: &[String]) -> impl Iterator<Item = Quantity> {
        let name = command.first().map_or("", String::as_str);
        // The points of a sweep with --until are runs.
        let name = if name == "sweep" && (command.len() > 1 || self.value("until").is_some()) {
            "run"
        } else {
            name
        };
        self.options().filter_map(move |(option, value, place, is_joined)| {
            // A branch ends at a value of r, or of α.
            let option_meant = match (name, option) {
                ("continue", "to") if self.value("over") == Some("r") => "r",
                ("continue", "to") => "alpha",
                _ => option,
            };
            let units = units_of(name, option_meant)?;
            is_quantity(value).then(|| Quantity {
                option: format!("--{option}"),
                value: value.into(),
                units,
                place,
                is_joined,
            })
        })
    }

    /// The scales of the options, or else those of the documents that the command reads.
    fn scales(
        &self,
        session: &Session,
        parser: &Command,
        at: usize,
        command: &[String],
        quantities: &[Quantity],
    ) -> Result<Option<KnownScales>, Failure> {
        let text = |name: &str| self.value(name).map(str::to_owned);
        let arguments = InUnitsArguments {
            units: text("units").map(PathBuf::from),
            sigma: text("sigma").or(text("tip-width")),
            stiffness: text("stiffness"),
            damping: text("damping"),
            velocity: text("velocity"),
            slope_force: text("slope-force"),
        };
        let read = self.documents(parser, at + command.len(), command);
        let tip = self.value("tip-file").map(Path::new);
        // A velocity gives the scale of time together with r, which then is a number.
        let is_r = quantities.iter().any(|quantity| quantity.option == "--r");
        let r = text("r").filter(|_| !is_r).and_then(|r| r.parse().ok());
        let r = r.or_else(|| read.iter().find_map(|path| r_of(session, path)));
        if let (Some(scales), _) = with_origin(session, &arguments, tip, r)? {
            return Ok(Some(scales));
        }
        Ok(read.into_iter().chain(tip).find_map(|path| of_document(session, path).ok()))
    }

    /// The documents that the command reads; its arguments begin at `first`.
    fn documents(&self, parser: &Command, first: usize, command: &[String]) -> Vec<&Path> {
        let takes_value = |name: &str| {
            option_of(parser, command, name).is_some_and(|option| {
                matches!(option.get_action(), ArgAction::Set | ArgAction::Append)
            })
        };
        let behind = |at: usize| {
            let before = at.checked_sub(1).map_or("", |before| &self.words[before]);
            before == "-o" || before.strip_prefix("--").is_some_and(takes_value)
        };
        let positional = self.words.iter().enumerate().skip(first).filter(|(at, word)| {
            !word.starts_with('-') && !behind(*at) && (word.contains('.') || word.starts_with('<'))
        });
        let named = ["from", "parameters"].into_iter().filter_map(|name| self.value(name));
        named.chain(positional.map(|(_, word)| &**word)).map(Path::new).collect()
    }
}

fn option_of<'a>(parser: &'a Command, command: &[String], name: &str) -> Option<&'a Arg> {
    let command = command.iter().try_fold(parser, |at, name| at.find_subcommand(name))?;
    command.get_arguments().find(|argument| argument.get_long() == Some(name))
}

/// r among the parameters of a document.
fn r_of(session: &Session, path: &Path) -> Option<f64> {
    let document: Value =
        serde_json::from_reader(open(session, "--parameters", path).ok()?).ok()?;
    document.pointer("/parameters/r").or(document.get("r"))?.as_f64()
}
