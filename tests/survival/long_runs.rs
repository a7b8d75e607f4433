//! Does a long run write what a short one does? As lines, without its history, stopped by a signal, on full disks
//! and closed pipes, in pieces; what it leaves is judged by the schemas that the program prints, and by the
//! bytes of the same run in one go. (Killed runs: tests/survival/killed_runs.rs; bad checkpoints: tests/program/checkpoints.rs.)

use crate::folder::{Folder, said};
use crate::runs::{assert_same, checkpoint_time, lines, schema, validate};
use serde_json::{Value, json};
use std::fs;
use std::process::{Command, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

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
    for word in ["1700000 steps", "-o FILE.jsonl", "--history none", "--until 1"] {
        assert!(said(&output).contains(word), "{}", said(&output));
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
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
    let script = format!("ulimit -f {blocks}; exec \"$0\" \"$@\"");
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
