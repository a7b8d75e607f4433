//! Is a run that was written as lines verified as its document is? Judged by that document; by lines changed on
//! purpose, in one digit, and cut off at every place; by processes that are killed; and by an allocator that
//! counts what a verification holds.

use crate::folder::{Folder, said};
use allocation_counter::measure;
use serde_json::{Value, json};
use std::ops::ControlFlow;
use std::process::Output;
use stickslip_tip::{MemoryChoice, Model, Running, Scenario, Step, TipFunction};
use stickslip_verify::{Sample, verify_samples};

const RUN: &str = "run --alpha 1.2 --r 1 --kick 0.05 --until 76 --sample-every 0.5";

/// A folder with a run as lines, and the lines.
fn written(name: &str) -> (Folder, Vec<String>) {
    let folder = Folder::new(name);
    folder.prints(&format!("{RUN} -o run.jsonl"));
    let text = String::from_utf8(folder.read("run.jsonl")).unwrap();
    let lines = text.lines().map(|line| format!("{line}\n")).collect();
    (folder, lines)
}

/// What was found, and the exit status.
fn found(output: &Output) -> (Value, Option<i32>) {
    (serde_json::from_slice(&output.stdout).unwrap(), output.status.code())
}

#[test]
fn lines_are_verified_as_the_samples_of_a_document() {
    let (folder, lines) = written("verified_lines");
    let document = folder.prints_json("verify run.jsonl");
    let schema = jsonschema::validator_for(&folder.prints_json("schema verify")).unwrap();
    assert!(schema.is_valid(&document), "{document}");
    folder.prints(&format!("{RUN} --history none -o run.json"));
    let of_document = folder.prints_json("verify run.json");
    assert_eq!(document["verification"], of_document["verification"]);
    assert_eq!(document["parameters"], of_document["parameters"]);
    assert!(of_document["lines"].is_null());
    let told = &document["lines"];
    assert_eq!(told["samples"], json!(lines.len() - 2));
    assert_eq!(told["ending"], json!("complete"));
    assert_eq!((&told["wrong"], &told["first_wrong_line"]), (&json!(0), &Value::Null));
    let reported = usize::try_from(told["line"].as_u64().unwrap()).unwrap();
    let reported: Value = serde_json::from_str(&lines[reported - 1]).unwrap();
    assert_eq!(reported["t"], document["verification"]["l"]["at"]);
    let last: Value = serde_json::from_str(&lines[lines.len() - 2]).unwrap();
    assert_eq!(told["verified_until"], last["t"]);

    let piped = folder.stickslip_reading("verify -", folder.read("run.jsonl"));
    assert_eq!(found(&piped), (document.clone(), Some(0)));
    // By what it holds, whatever its name.
    folder.write("renamed.json", lines.concat());
    assert_eq!(folder.prints_json("verify renamed.json"), document);
    folder.prints("verify run.jsonl -o found.json");
    assert_eq!(folder.json("found.json"), document);
}

/// The ninth digit of a number of line 100, up or down by `by`.
fn changed(lines: &[String], fields: &[&str], by: f64) -> String {
    let mut line: Value = serde_json::from_str(&lines[99]).unwrap();
    for field in fields {
        // What l gains, x0 loses.
        let sign = if *field == "x0" { -1.0 } else { 1.0 };
        line[field] = json!(line[field].as_f64().unwrap() + sign * by);
    }
    let line = format!("{line}\n");
    lines.iter().enumerate().map(|(i, l)| if i == 99 { &line } else { l }.as_str()).collect()
}

#[test]
fn a_sample_that_is_off_by_more_than_the_tolerance_is_named() {
    let (folder, lines) = written("wrong_line");
    let t = &serde_json::from_str::<Value>(&lines[99]).unwrap()["t"];
    for fields in [&["l"][..], &["x0"], &["l", "x0"]] {
        // 20 tolerances; 10 are allowed.
        folder.write("wrong.jsonl", changed(&lines, fields, 2e-8));
        let output = folder.stickslip("verify wrong.jsonl");
        let (document, status) = found(&output);
        assert_eq!(status, Some(1), "{}", said(&output));
        for words in ["wrong.jsonl", "line 100", "1 of 120 samples", "tolerance is not met"] {
            assert!(said(&output).contains(words), "{fields:?}: {}", said(&output));
        }
        assert_eq!(document["verification"]["kept"], json!(false));
        assert_eq!(&document["verification"]["trusted_until"], t);
        let told = &document["lines"];
        assert_eq!((&told["line"], &told["first_wrong_line"]), (&json!(100), &json!(100)));
        assert_eq!(told["wrong"], json!(1));
        // Control: what is allowed passes.
        folder.write("right.jsonl", changed(&lines, fields, 5e-9));
        folder.prints("verify right.jsonl");
    }
    // A time that is off by as much is seen by where the support was, rt = l + r + x0.
    folder.write("late.jsonl", changed(&lines, &["t"], 2e-8));
    let output = folder.stickslip("verify late.jsonl");
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("line 100"), "{}", said(&output));
}

#[test]
fn lines_that_are_cut_off_are_told_from_wrong_ones() {
    let (folder, lines) = written("cut_off_lines");
    let whole = lines.concat();
    let start = lines[..2].concat().len();
    let places = [start + 1, whole.len() / 3, whole.len() / 2, whole.len() - 2];
    let at_lines = [3, 60, lines.len() - 1].map(|n| lines[..n].concat().len());
    for length in places.into_iter().chain(at_lines).filter(|length| *length > start + 200) {
        folder.write("run.jsonl.part", &whole[..length]);
        let output = folder.stickslip("verify run.jsonl.part");
        let (document, status) = found(&output);
        assert_eq!(status, Some(3), "{}", said(&output));
        // A line is whole before its end is written, too.
        let there = whole[..=length].matches('\n').count();
        let last: Value = serde_json::from_str(&lines[there.min(lines.len() - 1) - 1]).unwrap();
        let t = last["t"].as_f64().unwrap();
        let told = &document["lines"];
        assert_eq!(told["ending"], json!("cut-off"));
        assert_eq!(told["samples"], json!(there - 1), "{length}");
        assert_eq!(told["verified_until"], json!(t));
        assert_eq!(document["verification"]["kept"], json!(true));
        for words in ["cut off", &format!("t = {t} of 76"), "is kept", "run --resume"] {
            assert!(said(&output).contains(words), "{length}: {}", said(&output));
        }
    }
    // Nothing to verify: no document.
    for (length, words) in
        [(0, "within its first line"), (100, "within its first line"), (start, "first sample")]
    {
        let output = folder.stickslip_reading("verify -", &whole[..length]);
        // An empty pipe has no name to be known by.
        let status = if length == 0 { 2 } else { 3 };
        assert_eq!(output.status.code(), Some(status), "{}", said(&output));
        assert!(output.stdout.is_empty());
        assert!(status == 2 || said(&output).contains(words), "{}", said(&output));
        folder.write("nothing.jsonl", &whole[..length]);
        let output = folder.stickslip("verify nothing.jsonl");
        assert_eq!(output.status.code(), Some(3), "{}", said(&output));
        assert!(said(&output).contains(words), "{}", said(&output));
    }
    // Wrong and cut off: wrong.
    let both = changed(&lines, &["l"], 1e-7);
    folder.write("both.jsonl", &both[..both.len() - 400]);
    let output = folder.stickslip("verify both.jsonl");
    assert_eq!(found(&output).1, Some(1), "{}", said(&output));
    for words in ["line 100", "cut off"] {
        assert!(said(&output).contains(words), "{}", said(&output));
    }
}

/// Noise is drawn, and its spline goes, as far as the run was to go, not as far as it went.
#[test]
fn the_surface_under_a_run_that_was_cut_off_is_that_of_the_whole() {
    let folder = Folder::new("cut_off_noise");
    folder.prints(&format!("{RUN} --noise 1e-2 --noise-spacing 6 -o run.jsonl"));
    let whole = folder.read("run.jsonl");
    folder.write("half.jsonl", &whole[..whole.len() / 2]);
    let output = folder.stickslip("verify half.jsonl");
    assert_eq!(found(&output).1, Some(3), "{}", said(&output));
}

/// What a signal stopped has an end, and is whole.
#[test]
fn an_interrupted_run_is_verified_until_there() {
    let (folder, lines) = written("interrupted_lines");
    let mut end: Value = serde_json::from_str(lines.last().unwrap()).unwrap();
    end["interrupted"] = json!(true);
    end["end"] = json!(41.25);
    folder.write("run.jsonl", format!("{}{end}\n", lines[..50].concat()));
    let document = folder.prints_json("verify run.jsonl");
    assert_eq!(document["lines"]["ending"], json!("interrupted"));
    assert_eq!(document["lines"]["samples"], json!(49));
}

#[test]
fn lines_that_no_run_writes_are_refused_with_their_number() {
    let (folder, lines) = written("damaged_lines");
    let end = lines.last().unwrap();
    let with = |i: usize, line: &str| {
        let mut lines = lines.clone();
        lines[i] = line.into();
        lines.concat()
    };
    let replaced = |i: usize, from: &str, to: &str| {
        assert!(lines[i].contains(from), "{}", lines[i]);
        with(i, &lines[i].replacen(from, to, 1))
    };
    let earlier = lines[20].clone();
    for (text, words) in [
        (with(0, &lines[1]), &["format is missing"][..]),
        (replaced(0, "run-lines", "run"), &["format is stickslip/run"]),
        (replaced(0, "\"format_version\":1", "\"format_version\":2"), &["format_version is 2"]),
        (replaced(0, "\"alpha\":1.2", "\"alpha\":-1"), &["line 1", "0 or above, not -1"]),
        (replaced(0, "\"kick\":", "\"kicks\":"), &["line 1", "kick"]),
        (replaced(0, "}", ""), &["line 1 is damaged"]),
        (with(40, "\n"), &["line 41 is damaged"]),
        (with(40, "{}\n"), &["line 41 is damaged"]),
        (with(40, &earlier), &["line 41 is damaged", "comes after t ="]),
        (replaced(40, "\"t\":3", "\"t\":3000"), &["line 41 is damaged", "outside of the run"]),
        (replaced(40, "\"t\":3", "\"t\":-3"), &["line 41 is damaged", "outside of the run"]),
        (replaced(40, "\"l\":", "\"m\":"), &["line 41 is damaged", "at column"]),
        (replaced(40, "\"l\":", "\"l\":null,\"m\":"), &["line 41 is damaged"]),
        (with(40, end), &["line 42 is damaged", "after the end"]),
        (lines.concat() + &lines[40], &["line 123 is damaged", "after the end"]),
        (lines.concat() + "\n", &["line 123 is damaged", "after the end"]),
        (
            replaced(121, "\"end\":76.0", "\"end\":75.0"),
            &["line 122 is damaged", "not that of its samples"],
        ),
        (lines[0].clone() + &lines[1] + end, &["no samples after the start"]),
    ] {
        folder.write("damaged.jsonl", text);
        folder.refuses("verify damaged.jsonl", &[&["RUN.jsonl damaged.jsonl"], words].concat());
    }
    folder.refuses("verify none.jsonl", &["RUN none.jsonl", "cannot be read"]);
    folder.refuses("verify .", &["RUN .", "cannot be read"]);
    folder.refuses("verify run.jsonl -o no/found.json", &["--output no/found.json"]);
}

/// What is left of a run that was killed is verified, and so is what becomes of it.
#[cfg(unix)]
#[test]
fn a_killed_run_is_verified_before_and_after_it_is_resumed() {
    use std::process::Stdio;
    use std::time::{Duration, Instant};
    let folder = Folder::new("killed_lines");
    let line = "run --alpha 1.2 --r 1 --kick 0.05 --until 2000 --tolerance 1e-6 --memory direct \
                --sample-every 1 -o run.jsonl --checkpoint run.ck --checkpoint-every 5";
    let mut child = folder.command(line).stderr(Stdio::null()).spawn().unwrap();
    let started = Instant::now();
    let enough = || folder.path("run.jsonl.part").metadata().is_ok_and(|file| file.len() > 3000);
    while !enough() && started.elapsed() < Duration::from_secs(20) {
        std::thread::sleep(Duration::from_millis(5));
    }
    child.kill().unwrap();
    assert!(!child.wait().unwrap().success(), "it was too quick to be killed");
    let output = folder.stickslip("verify run.jsonl.part");
    let (document, status) = found(&output);
    assert_eq!(status, Some(3), "{}", said(&output));
    assert!(document["lines"]["verified_until"].as_f64().unwrap() > 20.0, "{document}");
    // The other memory of the three.
    assert_eq!(document["verification"]["memory"], json!("modes"));
    assert!(folder.command("run --resume run.ck").output().unwrap().status.success());
    let document = folder.prints_json("verify run.jsonl");
    assert_eq!(document["lines"]["ending"], json!("complete"));
    assert_eq!(document["lines"]["samples"], json!(1984));
}

/// The samples of a run, made as they are asked for.
struct Made<'a> {
    running: Running<'a>,
    r: f64,
    step: Step,
    t: f64,
}

impl Iterator for Made<'_> {
    type Item = Sample;

    fn next(&mut self) -> Option<Sample> {
        while self.t > self.step.end() {
            self.step = self.running.step().unwrap()?;
        }
        let t = self.t;
        self.t += 1.0;
        Some(Sample { t, l: self.step.l(self.r, t), x0: self.step.x0(self.r, t), y0: None })
    }
}

/// The most that a verification of samples over so long a time holds, in bytes.
fn held(until: f64) -> u64 {
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let model = Model::new(tip, 1.2, 1.0).unwrap();
    let memory = MemoryChoice::Modes;
    let run = Scenario { kick: 0.05, tolerance: 1e-4, memory, ..Scenario::new(model, until) };
    let surface = run.initial_surface().unwrap();
    let samples = || {
        let mut running = Running::new(&run, &surface).unwrap();
        let step = running.step().unwrap().unwrap();
        Made { running, r: run.model.r(), step, t: run.start_time() }
    };
    let mut number = 0;
    let counted = measure(|| {
        let found =
            verify_samples(&run, "modes", samples, until, |_| ControlFlow::Continue(())).unwrap();
        number = found.samples.unwrap().number;
    });
    assert_eq!(number, (until - run.start_time()).floor() as u64 + 1);
    counted.bytes_max
}

/// The density of `fft` has its full length after 24,000 widths (docs/how-to/long-runs.md).
#[test]
fn what_a_verification_of_samples_holds_does_not_grow() {
    let (early, late) = (held(26_000.0), held(60_000.0));
    println!("{early} bytes, then {late}");
    assert!(late as f64 <= 1.05 * early as f64, "{early}, then {late}");
}
