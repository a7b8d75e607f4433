//! Fuzz tests of parsers: for any file and any command line the program ends without a panic, within a second per
//! case, and with at most 256 MB. Mutations of a small corpus (`tests/corpus`), and random bytes, pass through every
//! parser and through the checks of its result.
//!
//! `PROPTEST_CASES` sets the number of cases of each parser; `make fuzz` runs millions.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::print_stdout, reason = "counts are printed also when all is well")]

use crate::arguments::{Cli, Command, Options, Questions};
use crate::commands::run::disturbance::parse_pulses;
use crate::commands::sweep::merge;
use crate::commands::{model, run};
use crate::files::columns::parse_profile;
use crate::files::input::parse_tip;
use crate::files::lines::Lines;
use crate::files::measured::parse_measured;
use crate::session::Session;
use clap::Parser;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestCaseResult, TestRunner};
use std::path::Path;
use std::time::{Duration, Instant};
use stickslip::{Run, RunDocument, SweepDocument, parameter};
use stickslip_figures::{self as figures, Size, View};
use stickslip_outcome::{Classified, Watched};
use stickslip_surface::Surface;
use stickslip_tables::{Sheet, Table, decoded};
use stickslip_tip::{Force, Relief};
use stickslip_units::Unit;

/// Default number of cases of each parser: some seconds in total.
const CASES: u32 = 2000;
const LONGEST: Duration = Duration::from_secs(1);
/// Largest memory of the process, in kB.
const MOST_MEMORY: u64 = 256 << 10;

const UNITS: [Unit; 5] =
    [Unit::Damping, Unit::Stiffness, Unit::Length, Unit::Velocity, Unit::Force];

/// Replacements: numbers at the limits of f64, and the delimiters of the formats.
const TOKENS: [&str; 28] = [
    "0",
    "-0",
    "1",
    "-1",
    "1e-300",
    "-1e300",
    "1e308",
    "1e999",
    "5e-324",
    "0.1",
    "1e-9",
    "1e17",
    "NaN",
    "inf",
    "-inf",
    "null",
    "18446744073709551616",
    "{",
    "}",
    "[",
    "]",
    ",",
    ":",
    "\"",
    "\n",
    "#",
    " ",
    "µ",
];

/// One change to a text: position (as a fraction of its length), length, and replacement.
#[derive(Debug, Clone)]
enum Change {
    Replace(f64, usize, &'static str),
    Repeat(f64, usize, usize),
    Byte(f64, u8),
}

impl Change {
    fn any() -> impl Strategy<Value = Self> {
        let place = || 0.0..1.0;
        let token = proptest::sample::select(&TOKENS[..]);
        prop_oneof![
            4 => (place(), 0_usize..12, token).prop_map(|(at, n, by)| Self::Replace(at, n, by)),
            1 => (place(), 1_usize..40, 1_usize..60).prop_map(|(at, n, k)| Self::Repeat(at, n, k)),
            1 => (place(), any::<u8>()).prop_map(|(at, byte)| Self::Byte(at, byte)),
        ]
    }

    fn apply(&self, text: &mut Vec<u8>) {
        let place = |at: f64, len: usize| (at * (len + 1) as f64) as usize;
        match *self {
            Self::Replace(at, n, by) => {
                let from = place(at, text.len());
                let to = (from + n).min(text.len());
                text.splice(from..to, by.bytes());
            }
            Self::Repeat(at, n, k) => {
                let from = place(at, text.len());
                let part = text[from..(from + n).min(text.len())].repeat(k);
                text.splice(from..from, part);
            }
            Self::Byte(at, byte) => {
                let from = place(at, text.len());
                text.splice(from..(from + 1).min(text.len()), [byte]);
            }
        }
    }
}

/// Files of the corpus with a few changes, and sometimes random bytes.
///
/// The same as text; files that are not text are rejected by the reader.
fn texts(corpus: &str) -> impl Strategy<Value = String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus").join(corpus);
    let mut names: Vec<_> = folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    names.sort();
    let seeds: Vec<Vec<u8>> = names.iter().map(|name| std::fs::read(name).unwrap()).collect();
    let changed = (proptest::sample::select(seeds), proptest::collection::vec(Change::any(), 0..6));
    let changed = changed.prop_map(|(mut text, changes)| {
        changes.iter().for_each(|change| change.apply(&mut text));
        text
    });
    let bytes = prop_oneof![19 => changed, 1 => proptest::collection::vec(any::<u8>(), 0..200)];
    bytes.prop_map(|bytes| String::from_utf8_lossy(&bytes).into_owned())
}

/// Processor time of this thread if the system measures it, otherwise wall-clock time.
pub(super) fn spent(clock: &Instant) -> Duration {
    let measured = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = measured.and_then(|text| text.split_whitespace().next()?.parse().ok());
    nanoseconds.map_or_else(|| clock.elapsed(), Duration::from_nanos)
}

/// Passes the texts of a corpus to a target, which returns whether it accepts them. The test fails if all texts are
/// accepted or all are rejected, because it would then test one of the two only.
fn fuzz(corpus: &str, target: impl Fn(&str) -> bool) {
    let cases = std::env::var("PROPTEST_CASES").map_or(CASES, |cases| cases.parse().unwrap());
    // What fails is printed, shrunk; it belongs into the corpus, not into a file of seeds.
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let counts = std::cell::Cell::new((0_u32, 0_u32));
    let one = |text: String| -> TestCaseResult {
        let clock = Instant::now();
        let before = spent(&clock);
        let (taken, refused) = counts.get();
        counts.set(if target(&text) { (taken + 1, refused) } else { (taken, refused + 1) });
        let took = spent(&clock).saturating_sub(before);
        prop_assert!(took < LONGEST, "took {:?}", took);
        Ok(())
    };
    TestRunner::new(config).run(&texts(corpus), one).unwrap();
    let (taken, refused) = counts.get();
    println!("{corpus}: {taken} taken, {refused} refused, {:?} kB", peak_memory());
    assert!(taken > cases / 100 && refused > cases / 100, "{taken} taken, {refused} refused");
    assert!(peak_memory().is_none_or(|kb| kb < MOST_MEMORY));
}

/// Peak memory of this process so far, in kB, if the system reports it.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

#[test]
fn any_tip_file_is_taken_or_refused() {
    fuzz("tip", |text| {
        let Ok(tip) = parse_tip(&text.into()).and_then(model::from_file) else { return false };
        assert!(tip.value(0.3).is_finite() && tip.tail(-1.0).is_finite(), "{tip:?}");
        true
    });
}

#[test]
fn any_columns_are_taken_or_refused() {
    fuzz("columns", |text| {
        // Tables of two columns are read as this does; of three, surfaces alone.
        let Ok((x, u)) = parse_profile(&text.into(), None) else { return false };
        let Ok(force) = Force::new(vec![], Some((x.clone(), u.clone()))) else { return false };
        let Ok(relief) = Relief::profile(x, u) else { return false };
        let _ = relief.slope_and_curvature(16.2);
        // A spline through values near the largest number overflows between them, and a run says so.
        let _ = force.value(16.2);
        true
    });
}

/// The table in these bytes, as a command reads it.
fn table(bytes: Vec<u8>) -> Option<Sheet> {
    let sheet = decoded(bytes).and_then(|text| parse_measured(&Table::Text(text), &[2, 3])).ok()?;
    assert!(sheet.columns.iter().flatten().all(|value| value.is_finite()), "{sheet:?}");
    Some(sheet)
}

/// One table with damage, in several forms: any two forms that are accepted contain the same numbers and omit the
/// same rows.
#[test]
fn any_table_is_the_same_in_every_form_or_refused() {
    fuzz("tables", |text| {
        let bits = |sheet: &Sheet| -> Vec<u64> {
            sheet.columns.iter().flatten().map(|value| value.to_bits()).collect()
        };
        let Some(plain) = table(text.into()) else { return false };
        let mut forms = vec![
            text.replace('\n', "\r\n").into_bytes(),
            text.replace('\n', "\r").into_bytes(),
            format!("\u{feff}{text}").into_bytes(),
            text.encode_utf16().flat_map(u16::to_le_bytes).collect(),
            text.encode_utf16().flat_map(u16::to_be_bytes).collect(),
        ];
        // Where nothing but commas and points changes its meaning.
        if !text.contains([';', '"', '\r']) {
            let swap = |c: char| match c {
                ',' => ';',
                '.' => ',',
                c => c,
            };
            forms.push(text.replace(',', ";").into_bytes());
            forms.push(text.chars().map(swap).collect::<String>().into_bytes());
        }
        for other in forms.into_iter().filter_map(table) {
            assert_eq!(bits(&other), bits(&plain), "{other:?} for {plain:?}");
            assert_eq!(other.missing.len(), plain.missing.len());
        }
        true
    });
}

fn parse_run(text: &str) -> Result<RunDocument, String> {
    stickslip::read(text, RunDocument::FORMAT).map_err(|error| error.to_string())
}

#[test]
fn any_run_document_is_taken_or_refused() {
    fuzz("run", |text| {
        let Ok(document) = parse_run(text) else { return false };
        let again = serde_json::to_string(&document).unwrap();
        assert_eq!(serde_json::to_string(&parse_run(&again).unwrap()).unwrap(), again);
        let Ok(model) = document.parameters.model_parameters().model() else { return false };
        let Ok(trajectory) = document.trajectory() else { return false };
        let scenario = document.parameters.scenario();
        let Some(Ok(initial)) = scenario.ok().map(|s| s.initial_surface()) else { return false };
        let surface = Surface::new(&model, &initial, &trajectory);
        surface.heights(trajectory.end(), &[trajectory.x0(trajectory.end())]).unwrap();
        true
    });
}

#[test]
fn any_lines_are_taken_or_refused() {
    fuzz("lines", |text| {
        let mut lines = Lines::new(text.as_bytes());
        let Ok(head) = lines.head() else { return false };
        let Ok(scenario) = head.parameters.scenario() else { return false };
        let Ok(extent) = lines.survey(&(scenario.start_time()..=scenario.until)) else {
            return false;
        };
        // What the first reading counted, a second one finds.
        let mut again = Lines::new(text.as_bytes());
        again.head().unwrap();
        let times: Vec<f64> = (0..extent.samples).map(|_| again.sample().unwrap().t).collect();
        assert_eq!(times.last().copied(), extent.last);
        assert!(times.is_sorted());
        true
    });
}

/// The bytes of a checkpoint with a correct checksum: the first line, then its words from hexadecimal numbers.
fn checkpoint(text: &str) -> Option<Vec<u8>> {
    // A checkpoint continues in the version that made it.
    let version = |version| format!("\"version\":\"{version}\"");
    let text = text.replacen(&version("0.1.0"), &version(env!("CARGO_PKG_VERSION")), 1);
    let (head, words) = text.split_once('\n')?;
    let words: Vec<u64> =
        words.lines().filter_map(|word| u64::from_str_radix(word.trim(), 16).ok()).collect();
    let mut head: serde_json::Value = serde_json::from_str(head).ok()?;
    *head.get_mut("words")? = words.len().into();
    let mut bytes = serde_json::to_vec(&head).ok()?;
    bytes.push(b'\n');
    bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
    let sum = crc32fast::hash(&bytes);
    bytes.extend(sum.to_le_bytes());
    Some(bytes)
}

#[test]
fn any_checkpoint_is_taken_or_refused() {
    fuzz("checkpoint", |text| {
        // As it is, its checksum is wrong.
        assert!(run::checkpoint::parse(text.as_bytes()).is_err());
        let Some(bytes) = checkpoint(text) else { return false };
        let Ok((head, state)) = run::checkpoint::parse(&bytes) else { return false };
        let Ok(scenario) = head.order.parameters.scenario() else { return false };
        let Ok(surface) = scenario.initial_surface() else { return false };
        let Ok(mut running) = Watched::resumed(&scenario, &surface, &state) else { return false };
        // Numbers without sense may not be told from others, but they do no harm.
        for _ in 0..3 {
            if !running.step().is_ok_and(|step| step.is_some()) {
                break;
            }
        }
        let _ = running.outcome();
        true
    });
}

#[test]
fn any_sweep_is_taken_or_refused() {
    fuzz("sweep", |text| {
        let sweep = stickslip::read::<SweepDocument>(text, SweepDocument::FORMAT);
        let Ok(sweep) = sweep else { return false };
        let _ = merge::complete(&sweep);
        if let Ok(figure) = figures::of(&sweep, &View::default()) {
            figures::svg(&figure, &Size::default()).unwrap();
        }
        true
    });
}

/// Checks whether options define a run, as far as that needs no file.
fn judge_run<Q: Questions>(options: &Options<Q>) -> bool {
    let question = || options.values(&Session::default()).map(parameter::question::<Run>);
    let is_model = || question().is_ok_and(|run| run.is_ok_and(|run| run.model().is_ok()));
    options.tip.tip_file.is_some() || is_model()
}

#[test]
fn any_command_line_is_taken_or_refused() {
    fuzz("arguments", |text| {
        let words = std::iter::once("stickslip").chain(text.split_whitespace());
        for word in text.split_whitespace() {
            for unit in UNITS {
                assert!(unit.parse(word).map_or(true, |value| !value.is_nan()), "{word}");
            }
        }
        let Ok(cli) = Cli::try_parse_from(words) else { return false };
        match &cli.command {
            Command::Run(given) => {
                judge_run(&given.options) && parse_pulses(&given.disturbance.pulse).is_ok()
            }
            Command::Compare(given) => judge_run(&given.options),
            _ => true,
        }
    });
}
