//! Fuzz tests of documents: for any document every command ends without a panic, with at most a gigabyte, and without
//! long work that cannot be interrupted. Documents of every format (`tests/corpus/documents`) are changed as JSON:
//! numbers at the limits of f64, lists of other lengths, fields removed or of another type.
//!
//! `PROPTEST_CASES` sets the number of documents, `FUZZ_SEED` selects them; `make fuzz` runs a million.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::print_stdout, reason = "counts are printed also when all is well")]

use super::fuzz::spent;
use crate::commands::sweep::divided::Divided;
use crate::hosted::{Host, Supply, call};
use allocation_counter::measure;
use chacha20::ChaCha8Rng;
use rand::seq::IndexedRandom;
use rand::{RngExt, SeedableRng};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::Ordering;
use std::sync::{Arc, mpsc};
use std::time::{Duration, Instant};
use stickslip::{CycleDocument, RasterSweepDocument, SweepDocument, read};
use stickslip_figures::{self as figures, View};

/// Default number of documents.
const CASES: u32 = 400;
/// Largest memory that the thread of a command holds at a time.
const MOST_MEMORY: u64 = 1 << 30;
/// Time limit of reading, drawing and merging; longer computations are interrupted after it.
const PATIENCE: Duration = Duration::from_secs(2);
/// Time limit for the end of interrupted work. The program itself ends immediately.
const STOPPED: Duration = Duration::from_secs(2);

/// Replacements of numbers.
const NUMBERS: [f64; 24] = [
    0.0, -0.0, 1.0, -1.0, 1e-310, 5e-324, -1e9, 1e10, 1e17, 1e100, -1e100, 1e300, -1e300, 1.7e308,
    1e-9, 1e-5, 0.5, 3.0, 1e3, 1e6, 1e13, -1e13, 1e12, 1e8,
];
const FACTORS: [f64; 12] =
    [-1.0, 2.0, 0.5, 10.0, 1e3, 1e6, 1e9, 1e-3, 1e-9, 1.0 + 1e-9, 1.0 + 1e-5, 1e-300];

fn any_value(rng: &mut ChaCha8Rng) -> Value {
    match rng.random_range(0..12) {
        0 => Value::Null,
        1 => json!("x"),
        2 => json!([]),
        3 => json!({}),
        4 => json!(true),
        5 => json!([1, 2]),
        6 => json!(u64::MAX),
        7 => json!(1_u64 << 53),
        8 => json!(1_000_000_000),
        _ => json!(NUMBERS.choose(rng)),
    }
}

/// The fields of a document by their names; all entries of a list have one name.
fn places(value: &Value, at: &str, name: &str, found: &mut BTreeMap<String, Vec<String>>) {
    let mut inner = |key: &str, part: &str, value: &Value| {
        let (at, name) = (format!("{at}/{key}"), format!("{name}/{part}"));
        found.entry(name.clone()).or_default().push(at.clone());
        places(value, &at, &name, found);
    };
    match value {
        Value::Object(fields) => {
            fields.iter().for_each(|(key, value)| inner(key, key, value));
        }
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(i, value)| inner(&i.to_string(), "#", value));
        }
        _ => {}
    }
}

fn changed_number(value: f64, rng: &mut ChaCha8Rng) -> Value {
    match rng.random_range(0..10) {
        0..6 => json!(NUMBERS.choose(rng)),
        6..9 => json!(value * FACTORS.choose(rng).unwrap()),
        _ => any_value(rng),
    }
}

fn changed_list(list: &[Value], rng: &mut ChaCha8Rng) -> Value {
    let factor = *FACTORS.choose(rng).unwrap();
    let times = |value: &Value| value.as_f64().map_or(value.clone(), |v| json!(v * factor));
    match rng.random_range(0..7) {
        0 => json!([]),
        1 => json!(list[..rng.random_range(0..=list.len())]),
        // Not all of a figure a hundred times.
        2 if list.iter().all(|entry| entry.is_number() || entry.is_null()) => {
            let more = list.last().into_iter().cycle().take(rng.random_range(1..300));
            list.iter().chain(more).cloned().collect()
        }
        3 => list.iter().rev().cloned().collect(),
        4 => list.iter().map(|_| json!(NUMBERS.choose(rng))).collect(),
        _ => list.iter().map(times).collect(),
    }
}

/// Makes one change, to a field selected by its name.
fn change(document: &mut Value, rng: &mut ChaCha8Rng) {
    let mut found = BTreeMap::new();
    places(document, "", "", &mut found);
    found.retain(|name, _| !name.starts_with("/format"));
    let names: Vec<&Vec<String>> = found.values().collect();
    let Some(at) = names.choose(rng).and_then(|places| places.choose(rng)) else { return };
    let (parent, key) = at.rsplit_once('/').unwrap();
    if rng.random_bool(0.06) {
        match document.pointer_mut(parent).unwrap() {
            Value::Object(fields) => drop(fields.remove(key)),
            Value::Array(list) => {
                let i: usize = key.parse().unwrap();
                list.insert(i, list[i].clone());
            }
            _ => {}
        }
        return;
    }
    let value = document.pointer_mut(at).unwrap();
    *value = match &*value {
        Value::Number(number) => changed_number(number.as_f64().unwrap(), rng),
        Value::Array(list) => changed_list(list, rng),
        _ => any_value(rng),
    };
}

/// The document with a corrected checksum, so that later checks are reached.
fn sealed(text: String) -> String {
    fn of<D: Divided + serde::de::DeserializeOwned>(text: &str, format: &str) -> Option<String> {
        let sealed = read::<D>(text, format).ok()?.sealed().ok()?;
        serde_json::to_string(&sealed).ok()
    }
    let sealed = of::<SweepDocument>(&text, SweepDocument::FORMAT);
    sealed.or_else(|| of::<RasterSweepDocument>(&text, RasterSweepDocument::FORMAT)).unwrap_or(text)
}

fn changed(text: &str, rng: &mut ChaCha8Rng) -> String {
    let mut document: Value = serde_json::from_str(text).unwrap();
    for _ in 0..*[1, 1, 1, 2, 4].choose(rng).unwrap() {
        change(&mut document, rng);
    }
    sealed(document.to_string())
}

/// The corpus by file name, and a figure as data.
fn corpus() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/corpus/documents");
    let mut names: Vec<PathBuf> =
        folder.read_dir().unwrap().map(|entry| entry.unwrap().path()).collect();
    names.sort();
    let name = |path: &PathBuf| path.file_name().unwrap().to_string_lossy().into_owned();
    let of = |path: &PathBuf| (name(path), std::fs::read_to_string(path).unwrap());
    let mut corpus: Vec<_> = names.iter().map(of).collect();
    let cycle = &corpus.iter().find(|(name, _)| name == "cycle.json").unwrap().1;
    let cycle: CycleDocument = read(cycle, CycleDocument::FORMAT).unwrap();
    let figure = figures::of(&cycle, &View::default()).unwrap();
    corpus.push(("figure.json".into(), serde_json::to_string(&figure).unwrap()));
    corpus
}

/// The commands that read a document of this name; `true` for those that compute and may take long.
fn commands(name: &str) -> Vec<(&'static str, bool)> {
    let mut lines = vec![
        ("plot in.json -o OUT.svg", false),
        ("plot in.json -o OUT.svg --x-range=0:20 --y-range=-1:1", false),
        ("plot in.json -o OUT.svg --units units.json", false),
    ];
    if name.starts_with("verify") || name.starts_with("units") {
        // Without a picture: a command that draws one reads as far as the format.
        lines.truncate(1);
    }
    if name.starts_with("run") || name.starts_with("raster") {
        lines.push(("surface in.json", false));
        lines.push(("surface in.json --x 1,5,9", false));
        lines.push(("verify in.json", true));
    }
    if name.starts_with("cycle") {
        lines.push(("cycle --from in.json --alpha 1.201 --tolerance 1e-4", true));
        lines.push(("continue --from in.json --over alpha --to 1.21 --tolerance 1e-4", true));
    }
    if name.starts_with("sweep") {
        lines.push(("sweep merge in.json", false));
    }
    if name.starts_with("tip") || name.starts_with("fit") || name.starts_with("units") {
        lines.push(("run --tip-file in.json --alpha 1 --r 1 --until 20 --tolerance 1e-4", true));
        lines.push(("run --units in.json --alpha 1 --r 1 --until 20 --tolerance 1e-4", true));
    }
    lines
}

/// Description of a case that ended incorrectly.
fn flaw(line: &str, may_take_long: bool, text: String, units: &str) -> Result<bool, String> {
    let supply = |name: &str, text: String| (PathBuf::from(name), Supply::Text(text));
    let host =
        Arc::new(Host::new([supply("in.json", text), supply("units.json", units.to_owned())]));
    let (over, is_over) = mpsc::channel::<()>();
    let watched = Arc::clone(&host);
    let clock = Instant::now();
    let before = spent(&clock);
    let watch = std::thread::spawn(move || {
        if is_over.recv_timeout(PATIENCE).is_err() {
            watched.stop().store(true, Ordering::Relaxed);
        }
    });
    let mut ended = None;
    let held = measure(|| {
        ended = Some(catch_unwind(AssertUnwindSafe(|| call(line.split(' '), &host).is_ok())));
    });
    let took = spent(&clock).saturating_sub(before);
    over.send(()).ok();
    watch.join().unwrap();
    let taken = ended.unwrap().map_err(|_| "panicked".to_owned())?;
    let longest = if may_take_long { PATIENCE + STOPPED } else { PATIENCE };
    if took > longest {
        return Err(format!("took {took:?}"));
    }
    if held.bytes_max > MOST_MEMORY {
        return Err(format!("held {} MB", held.bytes_max >> 20));
    }
    Ok(taken)
}

#[test]
fn any_document_is_taken_or_refused_by_every_command_that_reads_it() {
    let number = |name: &str, default: u32| {
        std::env::var(name).map_or(default, |number| number.parse().unwrap())
    };
    let (cases, seed) = (number("PROPTEST_CASES", CASES), number("FUZZ_SEED", 1));
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out").display().to_string();
    let corpus = corpus();
    let units = &corpus.iter().find(|(name, _)| name == "units.json").unwrap().1;
    let mut rng = ChaCha8Rng::seed_from_u64(seed.into());
    let mut counts: BTreeMap<&str, [u32; 2]> = BTreeMap::new();
    let mut flaws = vec![];
    // The case under way, for whoever finds the process gone.
    let last = std::env::temp_dir().join(format!("stickslip-fuzz-{}.json", std::process::id()));
    for case in 0..cases {
        let (name, text) = corpus.choose(&mut rng).unwrap();
        let text = changed(text, &mut rng);
        let (line, may_take_long) = *commands(name).choose(&mut rng).unwrap();
        std::fs::write(&last, &text).unwrap();
        let typed = line.replace("OUT", &out);
        match flaw(&typed, may_take_long, text, units) {
            Ok(taken) => counts.entry(line).or_default()[usize::from(!taken)] += 1,
            Err(flaw) => {
                let kept = last.with_extension(format!("{case}.json"));
                std::fs::copy(&last, &kept).unwrap();
                flaws.push(format!("{name}: {line}: {flaw}: {}", kept.display()));
            }
        }
    }
    std::fs::remove_file(&last).ok();
    println!("{cases} documents, [taken, refused]: {counts:#?}");
    let taken: u32 = counts.values().map(|count| count[0]).sum();
    assert!(flaws.is_empty(), "{} flaws:\n{}", flaws.len(), flaws.join("\n"));
    assert!(taken > cases / 10 && taken < cases, "{taken} of {cases} were taken");
}

/// Without a change, some command accepts every document of the corpus, except a verification, which no command
/// reads.
#[test]
fn the_documents_that_are_changed_are_whole() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out").display().to_string();
    let corpus = corpus();
    let units = &corpus.iter().find(|(name, _)| name == "units.json").unwrap().1;
    for (name, text) in &corpus {
        let taken: Vec<&str> = commands(name)
            .into_iter()
            .filter(|(line, _)| {
                let typed = line.replace("OUT", &out);
                flaw(&typed, true, text.clone(), units).unwrap()
            })
            .map(|(line, _)| line)
            .collect();
        assert!(!taken.is_empty() || name == "verify.json", "{name}: no command takes it");
    }
}
