//! Do runs survive? Real processes, killed at random moments, on full disks and closed pipes; what they
//! leave is judged by the schemas that the program prints, and by the bytes of the same run in one go.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![cfg(unix)]

mod program;

use jsonschema::Validator;
use program::{Folder, said};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use serde_json::{Value, json};
use std::fs;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

fn schema(folder: &Folder, name: &str) -> Validator {
    jsonschema::validator_for(&folder.prints_json(&format!("schema {name}"))).unwrap()
}

fn validate(schema: &Validator, document: &Value) {
    let errors: Vec<String> = schema.iter_errors(document).map(|e| e.to_string()).collect();
    assert!(errors.is_empty(), "{document}\n{}", errors.join("\n"));
}

fn lines(bytes: &[u8]) -> Vec<Value> {
    bytes
        .split_inclusive(|b| *b == b'\n')
        .map(|line| serde_json::from_slice(line).unwrap())
        .collect()
}

/// The bytes but for the one field that may differ.
fn without_seconds(bytes: &[u8]) -> Vec<u8> {
    let Some(at) = bytes.windows(10).rposition(|w| w == b"\"seconds\":") else {
        return bytes.to_vec();
    };
    let after = bytes[at..].iter().position(|b| b"},".contains(b)).unwrap();
    [&bytes[..at], &bytes[at + after..]].concat()
}

fn assert_same(a: &[u8], b: &[u8], what: &str) {
    assert!(without_seconds(a) == without_seconds(b), "{what}: the bytes differ");
}

#[test]
fn lines_validate_and_say_what_the_document_says() {
    let folder = Folder::new("lines");
    let (line_schema, head_schema) = (schema(&folder, "run-lines"), schema(&folder, "checkpoint"));
    let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 400 --noise 1e-5 --noise-spacing 0.5";
    for sampling in ["", "--sample-every 7", "--sample-at 399.5,20,400,33", "--sample-at 16.5"] {
        folder.prints(&format!("{run} {sampling} -o run.jsonl --checkpoint run.ck"));
        let written = lines(&folder.read("run.jsonl"));
        written.iter().for_each(|line| validate(&line_schema, line));
        let document = folder.prints_json(&format!("{run} {sampling}"));
        let (head, end) = (written.first().unwrap(), written.last().unwrap());
        for (line, fields) in [
            (head, &["software", "parameters", "steady_state"][..]),
            (end, &["regime", "oscillation", "interrupted"]),
        ] {
            fields.iter().for_each(|field| assert_eq!(line[field], document[field], "{field}"));
        }
        assert_eq!(end["end"], json!(400.0));
        assert_eq!(end["work"]["steps"], document["work"]["steps"]);
        let mut rows: Vec<Vec<Value>> = (0..document["samples"]["t"].as_array().unwrap().len())
            .map(|i| ["t", "l", "x0", "velocity"].map(|c| document["samples"][c][i].clone()).into())
            .collect();
        rows.sort_by(|a, b| a[0].as_f64().unwrap().total_cmp(&b[0].as_f64().unwrap()));
        let samples = &written[1..written.len() - 1];
        let found: Vec<Vec<Value>> = samples
            .iter()
            .map(|line| ["t", "l", "x0", "velocity"].map(|c| line[c].clone()).into())
            .collect();
        assert!(found == rows, "{sampling}: the samples differ");
        let checkpoint = folder.read("run.ck");
        let head = checkpoint.split(|b| *b == b'\n').next().unwrap();
        validate(&head_schema, &serde_json::from_slice(head).unwrap());
    }
    // Negative control: the schema is not one that accepts anything.
    for line in [json!({"t": 1.0}), json!({"end": 3.0}), json!({}), json!([1])] {
        assert!(!line_schema.is_valid(&line), "{line}");
    }
}

#[test]
fn a_run_without_its_history_says_all_else() {
    let folder = Folder::new("no_history");
    let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 200";
    let (whole, mut bare) =
        (folder.prints_json(run), folder.prints_json(&format!("{run} --history none")));
    validate(&schema(&folder, "run"), &bare);
    assert!(bare["history"].is_null());
    folder.write("bare.json", bare.to_string());
    folder.refuses("surface bare.json", &["RUN.json bare.json", "--history all"]);
    bare["history"] = whole["history"].clone();
    bare["work"]["seconds"] = whole["work"]["seconds"].clone();
    assert_eq!(bare, whole);
}

#[test]
#[ignore = "four million steps take half a minute: make survive"]
fn a_history_that_would_outgrow_memory_ends_with_advice() {
    let folder = Folder::new("outgrown");
    let line = "run --alpha 1 --r 1e10 --until 2 --tolerance 1e-2 -o run.json";
    let output = folder.command(line).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    for word in ["4000000 steps", "-o FILE.jsonl", "--history none", "--until 1"] {
        assert!(said(&output).contains(word), "{}", said(&output));
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

const INTERVAL: f64 = 50.0;
const LONGEST_STEP: f64 = 4.0;

/// Time of the last whole line of a part, where there is one.
fn written_until(folder: &Folder) -> f64 {
    let part = fs::read_to_string(folder.path("run.jsonl.part")).unwrap_or_default();
    let whole = part.rsplit_once('\n').map_or("", |(whole, _)| whole);
    let last: Option<Value> = whole.lines().last().and_then(|line| serde_json::from_str(line).ok());
    last.and_then(|line| line["t"].as_f64()).unwrap_or(0.0)
}

/// A run that takes a good part of a second, with many checkpoints, and where it writes.
struct Long {
    name: &'static str,
    line: String,
    output: &'static str,
}

fn longs() -> Vec<Long> {
    let run = |name, options: &str, output: &'static str| Long {
        name,
        line: format!(
            "run --r 1 --kick 0.05 --checkpoint run.ck --checkpoint-every {INTERVAL} {options} -o {output}"
        ),
        output,
    };
    vec![
        run("lines-auto", "--alpha 1.2 --until 4000 --sample-every 1", "run.jsonl"),
        run("lines-modes", "--alpha 1.2 --until 4000 --sample-every 1 --memory modes", "run.jsonl"),
        run(
            "lines-direct",
            "--alpha 1.2 --until 400 --tolerance 1e-6 --memory direct",
            "run.jsonl",
        ),
        run("json-fft", "--alpha 1.62 --until 2500 --memory fft", "run.json"),
        run("npz-none", "--alpha 1.62 --until 2500 --sample-every 2 --history none", "run.npz"),
        run("csv-noise", "--alpha 1.1 --until 700 --noise 1e-4 --sample-every 1", "run.csv"),
        run(
            "json-forced",
            "--alpha 0.9 --until 2000 --pulse=-8,25,0.5 --pulse=-8,900,0.5 --memory modes",
            "run.json",
        ),
    ]
}

fn checkpoint_time(folder: &Folder) -> f64 {
    let bytes = folder.read("run.ck");
    let head: Value = serde_json::from_slice(bytes.split(|b| *b == b'\n').next().unwrap()).unwrap();
    head["t"].as_f64().unwrap()
}

/// Kills the run again and again at random moments, resuming it each time, until it ends by itself or so
/// many kills have been made. Returns the number of kills.
fn killed_until_done(folder: &Folder, long: &Long, kills: u32, rng: &mut ChaCha8Rng) -> u32 {
    let whole_took = {
        let started = Instant::now();
        assert!(folder.command(&long.line).output().unwrap().status.success());
        started.elapsed()
    };
    let expected = folder.read(long.output);
    for name in folder.names() {
        fs::remove_file(folder.path(&name)).unwrap();
    }
    folder.write(long.output, "what was there before\n");
    let mut line = long.line.clone();
    let mut done = 0;
    let mut reached = 0.0;
    loop {
        let mut child = folder.command(&line);
        let mut child = child.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        if done < kills {
            sleep(whole_took.mul_f64(rng.random_range(0.0..1.0) * 1.6 / f64::from(kills)));
        }
        if done < kills && child.try_wait().unwrap().is_none() {
            child.kill().unwrap();
            done += 1;
        }
        let finished = child.wait().unwrap().success();
        let found = folder.read(long.output);
        if finished {
            assert_same(&found, &expected, long.name);
            return done;
        }
        // Whole, or what was there before; and never behind the last checkpoint.
        let is_whole = without_seconds(&found) == without_seconds(&expected);
        assert!(is_whole || found == b"what was there before\n", "{}: a half of it", long.name);
        if folder.path("run.ck").exists() {
            let t = checkpoint_time(folder);
            assert!(t >= reached, "{}: fell back from {reached} to {t}", long.name);
            assert!(written_until(folder) - t < INTERVAL + LONGEST_STEP, "{} {t}", long.name);
            reached = t;
            line = "run --resume run.ck".into();
        }
        if is_whole {
            line = "run --resume run.ck".into();
        }
    }
}

fn kill_all(kills_each: u32, seed: u64) -> u32 {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut total = 0;
    for long in longs() {
        let folder = Folder::new(&format!("killed_{}_{seed}", long.name));
        let kills = killed_until_done(&folder, &long, kills_each, &mut rng);
        println!("{}: {kills} kills", long.name);
        total += kills;
    }
    total
}

#[test]
fn killed_runs_resume_to_the_same_bytes() {
    let kills = kill_all(4, 1);
    assert!(kills >= 14, "only {kills} came before the end");
}

/// As many kills as the project promises to survive: some minutes.
#[test]
#[ignore = "200 kills take minutes: make survive"]
fn two_hundred_kills() {
    let mut kills = 0;
    for seed in 2.. {
        kills += kill_all(10, seed);
        println!("{kills} kills so far");
        if kills >= 200 {
            break;
        }
    }
}

#[test]
fn a_signal_leaves_whole_lines_and_a_checkpoint_to_go_on_from() {
    for (signal, status) in [("-INT", 130), ("-TERM", 143)] {
        let folder = Folder::new(&format!("lines_interrupted{signal}"));
        let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 25000 --sample-every 1 -o run.jsonl";
        let mut child = folder.command(&format!("{run} --checkpoint run.ck"));
        let child = child.stderr(Stdio::piped()).spawn().unwrap();
        sleep(Duration::from_millis(300));
        Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(status), "{}", said(&output));
        let written = lines(&folder.read("run.jsonl"));
        let line_schema = schema(&folder, "run-lines");
        for line in [&written[0], &written[1], written.last().unwrap()] {
            validate(&line_schema, line);
        }
        let end = written.last().unwrap();
        assert_eq!(end["interrupted"], json!(true));
        // Nothing is lost: the checkpoint was made where the run was stopped.
        assert_eq!(end["end"].as_f64(), Some(checkpoint_time(&folder)));
        assert_eq!(folder.names(), ["run.ck", "run.jsonl"]);
        let resumed = folder.command("run --resume run.ck").output().unwrap();
        assert!(resumed.status.success(), "{}", said(&resumed));
        let resumed = folder.read("run.jsonl");
        assert!(folder.command(run).output().unwrap().status.success());
        assert_same(&resumed, &folder.read("run.jsonl"), "after the signal");
    }
}

/// `stickslip` allowed to write files of so many blocks of 512 bytes: a write beyond fails, as on a full
/// disk.
fn with_files_up_to(folder: &Folder, blocks: u32, line: &str) -> Output {
    let inner = folder.command(line);
    let mut shell = Command::new("sh");
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$0\" \"$@\"");
    shell.current_dir(folder.path("")).arg("-c").arg(script);
    shell.arg(inner.get_program()).args(inner.get_args()).output().unwrap()
}

#[test]
fn where_no_more_can_be_written_the_last_whole_file_stays() {
    let folder = Folder::new("full");
    let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 4000 --sample-every 1";
    for output in ["run.json", "run.jsonl", "run.csv", "run.npz"] {
        folder.write(output, "before");
        let full = with_files_up_to(&folder, 100, &format!("{run} -o {output}"));
        assert_eq!(full.status.code(), Some(1), "{output}: {}", said(&full));
        assert!(said(&full).contains("cannot write"), "{}", said(&full));
        assert_eq!(folder.read(output), b"before", "{output}");
    }
    let names = ["run.csv", "run.json", "run.jsonl", "run.npz"];
    assert_eq!(folder.names(), names, "nothing else is left");

    for output in ["run.json", "run.jsonl"] {
        let line = format!("{run} -o {output} --checkpoint run.ck");
        let full = with_files_up_to(&folder, 500, &line);
        assert_eq!(full.status.code(), Some(1), "{output}: {}", said(&full));
        assert!(said(&full).contains("the last checkpoint, at t ="), "{}", said(&full));
        assert_eq!(folder.read(output), b"before", "{output}");
        folder.prints("run --resume run.ck");
        let resumed = folder.read(output);
        folder.prints(&format!("{run} -o {output}"));
        assert_same(&resumed, &folder.read(output), output);
    }
    for line in [run.to_string(), format!("{run} --format jsonl")] {
        let mut command = folder.command(&line);
        let full = fs::File::create("/dev/full").unwrap();
        let output = command.stdout(full).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(output.status.code(), Some(1));
        assert!(said(&output).contains("cannot write standard output"), "{}", said(&output));
    }
}

#[test]
fn a_run_that_cannot_go_on_leaves_the_lines_until_then_and_says_where() {
    let folder = Folder::new("broken_off");
    folder.write("run.jsonl", "before");
    let run = "run --alpha 1.2 --r 1 --until 60 --sample-every 1 --pulse 1e15,20,1e-9";
    let output = folder.stickslip(&format!("{run} -o run.jsonl"));
    assert_eq!(output.status.code(), Some(1));
    for words in ["cannot be met", "run.jsonl.part"] {
        assert!(said(&output).contains(words), "{}", said(&output));
    }
    assert_eq!(folder.read("run.jsonl"), b"before");
    let written = lines(&folder.read("run.jsonl.part"));
    assert!(written.len() == 5 && written[4]["t"].as_f64() > Some(19.0), "{written:?}");
}

#[test]
fn a_pipe_closed_in_the_middle_of_the_lines_is_told() {
    use std::io::Read;
    let folder = Folder::new("closed_lines");
    let mut child =
        folder.command("run --alpha 1.2 --r 1 --until 1e6 --sample-every 1 --format jsonl");
    let mut child = child.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    child.stdout.take().unwrap().read_exact(&mut [0; 10]).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("was closed before the end"), "{}", said(&output));
}

#[test]
fn checkpoints_that_cannot_be_gone_on_with_are_refused() {
    let folder = Folder::new("refused_checkpoints");
    let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 300";
    folder.prints(&format!("{run} -o run.jsonl --checkpoint run.ck"));
    let whole = folder.read("run.ck");
    // Any byte, anywhere.
    for i in (0..whole.len()).step_by(whole.len() / 40) {
        let mut damaged = whole.clone();
        damaged[i] ^= 4;
        folder.write("damaged.ck", damaged);
        folder.refuses("run --resume damaged.ck", &["--resume damaged.ck", "is damaged"]);
    }
    for length in [0, 3, 100, whole.len() / 2, whole.len() - 1] {
        folder.write("short.ck", &whole[..length]);
        folder.refuses("run --resume short.ck", &["--resume short.ck", "is"]);
    }
    let resealed = |from: &str, to: &str| {
        let end = whole.iter().position(|b| *b == b'\n').unwrap();
        let head = String::from_utf8(whole[..end].to_vec()).unwrap();
        assert!(head.contains(from), "{head}");
        let mut bytes = head.replace(from, to).into_bytes();
        bytes.extend(&whole[end..whole.len() - 4]);
        let sum = crc32fast::hash(&bytes);
        bytes.extend(sum.to_le_bytes());
        folder.write("other.ck", bytes);
    };
    for (from, to, words) in [
        ("\"version\":\"0", "\"version\":\"7", "only that version goes on"),
        ("\"format_version\":1", "\"format_version\":2", "only that version goes on"),
        ("\"words\":", "\"words\":1", "as many words as it says"),
        ("\"alpha\":1.2", "\"alpha\":-1", "0 or above, not -1"),
        ("\"memory\":\"auto\"", "\"memory\":\"modes\"", "cannot be taken up"),
        ("\"until\":300", "\"until\":30", "out of range"),
        ("\"format\":\"stickslip/checkpoint\"", "\"format\":\"stickslip/run\"", "stickslip/run"),
        ("\"kick\":", "\"kicks\":", "is damaged"),
        ("\"every\":", "\"every\":-", "not above 0"),
        ("\"checkpoint_every\":", "\"checkpoint_every\":-", "not above 0"),
    ] {
        resealed(from, to);
        folder.refuses("run --resume other.ck", &["--resume other.ck", words]);
    }
    // The output is not what it was.
    folder.write("run.jsonl", "something else");
    let output = folder.stickslip("run --resume run.ck");
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("run.jsonl"), "{}", said(&output));
    assert_eq!(folder.read("run.jsonl"), b"something else");

    for (line, words) in [
        ("run --resume none.ck", &["--resume none.ck", "cannot be read"][..]),
        ("run --resume run.ck --alpha 1", &["--resume"]),
        (&format!("{run} --checkpoint-every 1"), &["--checkpoint <FILE>"]),
        (
            &format!("{run} --checkpoint a.ck --checkpoint-every 0"),
            &["--checkpoint-every 0", "above 0"],
        ),
        (&format!("{run} --checkpoint no/a.ck"), &["--checkpoint", "a place that exists"]),
        (&format!("{run} --checkpoint /dev/null"), &["--checkpoint /dev/null", "must be a file"]),
        (
            &format!("{run} --checkpoint run.json -o run.json"),
            &["--checkpoint", "a name of its own"],
        ),
        (
            &format!("{run} --checkpoint a.ck --format jsonl"),
            &["--output -", "write them to a file"],
        ),
        (&format!("{run} --plot a.svg -o run.jsonl"), &["--plot a.svg", ".json, .csv or .npz"]),
    ] {
        folder.refuses(line, words);
    }
}

/// Ten million time units in one go and in four pieces: the same bytes, in memory that does not grow.
#[test]
#[ignore = "two runs of about a minute: make survive"]
fn ten_million_time_units_resumed_three_times() {
    let folder = Folder::new("ten_million");
    let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 1e7 --tolerance 1e-6 --sample-every 100 -o run.jsonl";
    let started = Instant::now();
    let status = folder.command(run).status().unwrap();
    assert!(status.success());
    println!("in one go: {:?}", started.elapsed());
    let whole = folder.read("run.jsonl");
    let mut line = format!("{run} --checkpoint run.ck");
    for part in [0.2, 0.3, 0.2] {
        let mut child = folder.command(&line).stderr(Stdio::null()).spawn().unwrap();
        sleep(started.elapsed().mul_f64(0.3 * part));
        let peak = peak_memory(child.id());
        child.kill().unwrap();
        child.wait().unwrap();
        println!("killed after t = {:.3e}, at most {peak} kB so far", checkpoint_time(&folder));
        assert!(peak < 64_000, "{peak} kB");
        line = "run --resume run.ck".into();
    }
    assert!(folder.command(&line).status().unwrap().success());
    assert_same(&whole, &folder.read("run.jsonl"), "ten million");
}

/// Largest resident set of a process, in kB.
fn peak_memory(process: u32) -> u64 {
    let status = fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    let line = status.lines().find(|line| line.starts_with("VmHWM:")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}
