//! Summaries of results: a headline, aligned values with their errors, and commands to try next.

mod cycles;
mod linear;
mod measured;
mod others;
mod raster;
mod run;

pub(in crate::commands) use run::{of_lines, of_run};

use crate::message::harmless;
use crate::session::Made;
use std::fmt::Write;
use stickslip::{Dimension, InUnits, KnownScales, Law, digits};
use stickslip_saved::Document;

/// The summary of a result.
#[derive(Debug, Default)]
pub(crate) struct Summary {
    headline: String,
    rows: Vec<(String, String)>,
    remarks: Vec<String>,
    next: Vec<String>,
}

impl Summary {
    /// A summary with this headline: the main result, and for a verification whether the tolerance is met. Only this
    /// is printed when the result goes to a file.
    pub(crate) fn new(headline: impl Into<String>) -> Self {
        let headline = headline.into();
        let lines = headline.split('\n').map(harmless);
        Self { headline: lines.collect::<Vec<_>>().join("\n"), ..Self::default() }
    }

    /// Adds a value under its name. Values are escaped, because they may contain names of files.
    #[must_use]
    pub(crate) fn row(mut self, name: &str, value: impl Into<String>) -> Self {
        self.rows.push((harmless(name).into(), harmless(&value.into()).into()));
        self
    }

    /// Adds a value, if there is one.
    #[must_use]
    pub(crate) fn maybe(self, name: &str, value: Option<String>) -> Self {
        match value {
            Some(value) => self.row(name, value),
            None => self,
        }
    }

    /// Appends the value in nm, s and nN to each row, if the document contains the scales.
    #[must_use]
    pub(crate) fn in_units(mut self, physical: Option<&InUnits>) -> Self {
        let Some(InUnits { scales, .. }) = physical else { return self };
        for (_, value) in &mut self.rows {
            if let Some(beside) = in_units(value, scales) {
                value.push_str(&beside);
            }
        }
        self
    }

    /// Adds warnings.
    #[must_use]
    pub(crate) fn remarks(mut self, remarks: &[String]) -> Self {
        self.remarks.extend(remarks.iter().map(|remark| harmless(remark).into_owned()));
        self
    }

    /// Adds a command to try.
    #[must_use]
    pub(crate) fn next(mut self, command: impl Into<String>) -> Self {
        self.next.push(harmless(&command.into()).into());
        self
    }

    /// The summary printed when the result goes to a file: headline and warnings.
    pub(crate) fn in_short(&self) -> String {
        let remarks = self.remarks.iter().map(|remark| format!("\nremark: {remark}"));
        self.headline.clone() + &remarks.collect::<String>()
    }

    /// The result of an in-process command: the document and its summary, without commands to try.
    pub(crate) fn of(self, document: Box<dyn Document>) -> Made {
        let summary = Self { next: vec![], ..self };
        Made { document, text: summary.text(), headline: summary.headline }
    }

    /// The whole summary, as lines.
    pub(crate) fn text(&self) -> String {
        let width = self.rows.iter().map(|(name, _)| name.chars().count()).max().unwrap_or(0);
        let mut text = format!("{}\n", self.headline.trim_end());
        for (name, value) in &self.rows {
            let gap = width - name.chars().count();
            // A String takes all that is written to it.
            writeln!(text, "  {name}{:gap$}  {value}", "").ok();
        }
        for remark in &self.remarks {
            writeln!(text, "  remark: {remark}").ok();
        }
        for command in &self.next {
            writeln!(text, "next: {command}").ok();
        }
        text
    }
}

/// The command as typed, without its outputs; the options in `more` replace those of the same name.
pub(crate) fn again(more: &str) -> String {
    let words = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    typed(words, more)
}

/// Output options, each removed with its value.
const OUTLET: [&str; 4] = ["-o", "--output", "--plot", "--format"];

fn typed(mut words: impl Iterator<Item = String>, more: &str) -> String {
    let is_replaced = |name: &str| OUTLET.contains(&name) || more.split(' ').any(|m| m == name);
    let mut kept = vec![];
    while let Some(word) = words.next() {
        if word.starts_with("-o") && word.len() > 2 {
            continue;
        }
        let (name, value) = word.split_once('=').unwrap_or((&word, ""));
        if !(name.starts_with('-') && is_replaced(name)) {
            kept.push(quoted(word));
        } else if value.is_empty() {
            words.next();
        }
    }
    format!("stickslip {} {more}", kept.join(" "))
}

pub(in crate::commands) fn quoted(word: String) -> String {
    let is_plain = |c: char| c.is_alphanumeric() || "-_=.,:/+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word;
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

/// ` = 212 nm` for `7.067(2) σ`, with as many digits.
fn in_units(value: &str, scales: &KnownScales) -> Option<String> {
    let (number, unit) = value.rsplit_once(' ')?;
    let dimension = Dimension::of_unit(unit)?;
    let (digits_of, rest) = number.split_once('(').unwrap_or((number, ")"));
    let exponent = rest.split_once(')')?.1;
    let count = digits_of.chars().filter(char::is_ascii_digit).count();
    let converted =
        format!("{digits_of}{exponent}").parse::<f64>().ok()? * dimension.factor(scales)?;
    Some(format!(" = {} {}", digits(converted, count.max(3)), dimension.unit()))
}

/// The first and the last of these values, such as "0.1 to 2".
fn ends(values: &[f64]) -> String {
    let [first, last] =
        [values.first(), values.last()].map(|v| digits(v.copied().unwrap_or(0.0), 7));
    format!("{first} to {last}")
}

/// The least and the largest of these values.
fn extremes(values: impl Iterator<Item = f64>) -> [f64; 2] {
    stickslip_tip::sorting::ends(values).into()
}

/// A ratio with two digits: computing times are not more reproducible.
pub(crate) fn times(ratio: f64) -> String {
    let rounded = format!("{ratio:.1e}").parse().unwrap_or(ratio);
    digits(rounded, 2)
}

/// The name of the amplitude of u: on a surface that heals that of U(x), which u never has, as u is U(x) exp(-D/(rT)) at
/// the distance D behind the support.
fn amplitude_of_u(law: &Law) -> &'static str {
    match law.healing_time {
        Some(_) => "amplitude of u, unhealed",
        None => "amplitude of u",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_stand_below_each_other() {
        let summary =
            Summary::new("steady: t = 5").row("α", "1.2").maybe("none", None).row("period", "6");
        let summary = summary.remarks(&["few".into()]).next("stickslip units");
        let text =
            "steady: t = 5\n  α       1.2\n  period  6\n  remark: few\nnext: stickslip units\n";
        assert_eq!(summary.text(), text);
    }

    /// Names of files and contents of documents are escaped: ESC, C1, the right-to-left override, and line breaks.
    #[test]
    fn nothing_that_moves_a_cursor_is_printed() {
        let hostile = "a\u{1b}]0;x\u{7}\u{9b}2J\u{202e}b\rc\u{7f}\td";
        let summary =
            Summary::new(hostile).row(hostile, hostile).remarks(&[format!("{hostile}\n{hostile}")]);
        let summary = summary.next(hostile);
        for text in [summary.text(), summary.in_short()] {
            assert!(
                text.chars().all(|c| c == '\n' || harmless(&c.to_string()).len() == c.len_utf8())
            );
        }
        assert_eq!(summary.text().lines().count(), 4, "{}", summary.text());
    }

    #[test]
    fn ratios_have_two_digits() {
        let shown = [152_924.338, 3.1678, 0.0123, 99.6, 1e9, 0.0].map(times);
        assert_eq!(shown, ["150000", "3.2", "0.012", "100", "1000000000", "0"]);
    }

    #[test]
    fn a_value_with_an_exponent_is_converted_whole() {
        let scales = KnownScales { length: Some(30e-9), ..KnownScales::default() };
        assert_eq!(in_units("2.5(3)e-12 σ", &scales).unwrap(), " = 7.5e-11 nm");
        assert_eq!(in_units("2.50(3) σ", &scales).unwrap(), " = 75 nm");
    }

    #[test]
    fn a_command_is_typed_again_with_other_options() {
        let words = ["run", "--alpha", "1.2", "--until", "40", "--format=text", "-o", "a b.json"];
        let again = typed(words.map(String::from).into_iter(), "--until 160 --plot run.svg");
        assert_eq!(again, "stickslip run --alpha 1.2 --until 160 --plot run.svg");
        let again = typed(["surface", "a b.json"].map(String::from).into_iter(), "-o s.csv");
        assert_eq!(again, "stickslip surface 'a b.json' -o s.csv");
    }
}
