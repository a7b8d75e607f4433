//! What a command does to files that are not its own: those of a user, those of another stickslip at work, and those
//! that somebody planted under the names that it derives.

use crate::folder::{Folder, said};
use std::fs;
use std::process::{Child, Output, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

const RUN: &str = "run --alpha 1.2 --r 1 --kick 0.05 --until 60";
/// Takes minutes.
const LONG: &str = "run --alpha 1.2 --r 1 --kick 0.05 --until 1e7 --tolerance 1e-12";

/// A command at its work, until it is dropped.
struct AtWork(Child);

impl AtWork {
    fn new(folder: &Folder, line: &str, until: impl Fn() -> bool) -> Self {
        let child = folder.command(line).stdout(Stdio::null()).stderr(Stdio::null()).spawn();
        let mut work = Self(child.unwrap());
        crate::folder::wait_until_it_listens(&mut work.0);
        let started = Instant::now();
        while !until() {
            assert!(work.0.try_wait().unwrap().is_none(), "{line}: it was over too early");
            assert!(started.elapsed() < Duration::from_secs(10), "{line}");
            sleep(Duration::from_millis(5));
        }
        work
    }
}

impl Drop for AtWork {
    fn drop(&mut self) {
        self.0.kill().ok();
        self.0.wait().ok();
    }
}

fn refused_as_in_use(output: &Output, line: &str) {
    assert_eq!(output.status.code(), Some(2), "{line}: {}", said(output));
    assert!(said(output).contains("by another stickslip"), "{line}: {}", said(output));
    assert!(!said(output).contains("remove"), "{line}: {}", said(output));
}

#[test]
fn the_second_to_write_a_file_is_told() {
    let folder = Folder::new("second_writer");
    let always = || true;
    for (first, second) in [
        (format!("{LONG} -o a.jsonl"), format!("{RUN} -o a.jsonl")),
        (format!("{LONG} -o a.json"), format!("{RUN} -o ./a.json")),
        (format!("{LONG} -o a.json --plot a.svg"), format!("{RUN} -o b.json --plot a.svg")),
        (format!("{LONG} -o a.csv --checkpoint ck"), format!("{RUN} -o b.csv --checkpoint ck")),
        (format!("{LONG} -o a.json"), "sweep --r 1 --alpha 1 -o a.json".into()),
        (
            "sweep --r 0.5:2:300 --alpha 1:2:300 -o m.json".into(),
            "sweep --r 0.5:2:300 --alpha 1:2:300 -o m.json".into(),
        ),
        ("sweep --r 0.5:2:300 --alpha 1:2:300 -o m.csv".into(), format!("{RUN} -o m.csv")),
        (
            "compare --alpha 1.2 --r 1 --until 5000 -o c.json".into(),
            "compare --alpha 1.2 --r 1 --until 20 -o c.json".into(),
        ),
    ] {
        let at_work = AtWork::new(&folder, &first, always);
        refused_as_in_use(&folder.stickslip(&second), &second);
        drop(at_work);
        for name in folder.names() {
            fs::remove_file(folder.path(&name)).unwrap();
        }
    }
}

#[test]
fn a_checkpoint_is_gone_on_with_by_one_process_alone() {
    let folder = Folder::new("resumed_twice");
    for (output, written) in [("a.jsonl", "a.jsonl.part"), ("a.json", "ck.journal")] {
        let has_begun = || folder.path("ck").exists() && folder.path(written).exists();
        let at_work =
            AtWork::new(&folder, &format!("{LONG} -o {output} --checkpoint ck"), has_begun);
        refused_as_in_use(&folder.stickslip("run --resume ck"), "while it is made");
        drop(at_work);
        let at_work = AtWork::new(&folder, "run --resume ck", || true);
        refused_as_in_use(&folder.stickslip("run --resume ck"), "while it is resumed");
        refused_as_in_use(&folder.stickslip(&format!("{RUN} -o {output}")), "its output");
        drop(at_work);
    }
}

#[test]
fn a_lock_ends_with_its_process() {
    let folder = Folder::new("lock_of_the_dead");
    for line in [format!("{LONG} -o a.json"), "figures --out-dir .".to_string()] {
        drop(AtWork::new(&folder, &format!("{LONG} -o a.json"), || true));
        drop(folder.command(&line).stderr(Stdio::null()).spawn().map(|mut child| {
            sleep(Duration::from_millis(100));
            child.kill().unwrap();
            child.wait().unwrap()
        }));
        folder.prints(&format!("{RUN} -o a.json"));
    }
}

#[test]
fn files_of_a_user_are_not_taken_for_ours() {
    let folder = Folder::new("foreign");
    let sweep = "sweep --r 1 --alpha 1:1.1:2 -o s.json";
    folder.prints(&format!("{RUN} -o c.json --checkpoint ck"));
    for (line, name) in [
        (format!("{RUN} -o a.jsonl"), "a.jsonl.part"),
        (format!("{RUN} -o a.json --checkpoint other"), "other.journal"),
        (sweep.into(), "s.json.partial"),
    ] {
        for notes in ["my notes", "two lines\nof notes\n", "{\"software\":{\"name\":\"other\"}}\n"]
        {
            folder.write(name, notes);
            folder.refuses(&line, &[name, "was not written by"]);
            assert_eq!(folder.read(name), notes.as_bytes());
        }
        folder.write(name, "");
        folder.prints(&line);
    }
    // What was once the name under which a checkpoint was written.
    folder.write("ck.new", "my notes");
    folder.prints("run --resume ck");
    assert_eq!(folder.read("ck.new"), b"my notes");
}

#[cfg(unix)]
#[test]
fn planted_links_are_not_followed() {
    use std::os::unix::fs::symlink;
    let folder = Folder::new("planted");
    let begins = [
        ("a.jsonl.part", "{\"format\":\"stickslip/run-lines\", precious"),
        ("ck.journal", "stickslip/journal precious"),
        ("s.json.partial", "{\"software\":{\"name\":\"stickslip\" precious"),
    ];
    let lines = [
        format!("{RUN} -o a.jsonl"),
        format!("{RUN} -o a.json --checkpoint ck"),
        "sweep --r 1 --alpha 1:1.1:2 -o s.json".into(),
    ];
    for ((name, precious), line) in begins.into_iter().zip(&lines) {
        folder.write("precious", precious);
        for target in ["precious", "absent"] {
            symlink(folder.path(target), folder.path(name)).unwrap();
            folder.refuses(line, &[name, "was not written by"]);
            assert_eq!(folder.read("precious"), precious.as_bytes());
            assert!(!folder.path("absent").exists());
            fs::remove_file(folder.path(name)).unwrap();
        }
        // Another name of the same contents keeps them.
        fs::hard_link(folder.path("precious"), folder.path(name)).unwrap();
        folder.stickslip(line);
        assert_eq!(folder.read("precious"), precious.as_bytes(), "{line}");
        fs::remove_file(folder.path(name)).ok();
    }
}

#[cfg(unix)]
#[test]
fn modes_are_kept() {
    use std::os::unix::fs::PermissionsExt;
    let folder = Folder::new("modes");
    let mode = |name: &str| folder.path(name).metadata().unwrap().permissions().mode() & 0o777;
    let outputs = ["a.json", "a.csv", "a.npz", "a.jsonl", "a.svg", "ck", "s.json"];
    for name in outputs {
        folder.write(name, "");
        fs::set_permissions(folder.path(name), fs::Permissions::from_mode(0o600)).unwrap();
    }
    folder.prints(&format!("{RUN} -o a.json --plot a.svg --checkpoint ck"));
    for line in ["-o a.csv", "-o a.npz", "-o a.jsonl"] {
        folder.prints(&format!("{RUN} {line}"));
    }
    folder.prints("sweep --r 1 --alpha 1 -o s.json");
    for name in outputs.into_iter().chain(["ck.journal"]) {
        assert!(!folder.read(name).is_empty());
        assert_eq!(mode(name), 0o600, "{name}");
    }
}

#[test]
fn standard_error_may_fail() {
    let folder = Folder::new("deaf");
    folder.write("tip.csv", "not a tip");
    for (line, status) in [
        (format!("{RUN} -o a.json"), 0),
        ("cycle --alpha 1.2 --r 1 -o c.json".into(), 0),
        ("compare --alpha 1.2 --r 1 --until 20 -o d.json".into(), 0),
        ("figures --only fig3 --out-dir .".into(), 0),
        ("sweep --r 1 --alpha 1:1.2:3 -o s.json".into(), 0),
        ("surface a.json --y-range -1,1 --spacing 1 -o u.npz".into(), 0),
        ("run --alpha 1.2 --r 1 --until 60 --pulse 1,900,1 -o e.json".into(), 0),
        ("stability --r 1 --tip-file tip.csv".into(), 2),
        ("stability --no-such-option".into(), 2),
    ] {
        let (reader, closed) = std::io::pipe().unwrap();
        drop(reader);
        let mut sinks: Vec<Stdio> = vec![closed.into()];
        if cfg!(target_os = "linux") {
            sinks.push(fs::OpenOptions::new().write(true).open("/dev/full").unwrap().into());
        }
        for sink in sinks {
            let done = folder.command(&line).stdout(Stdio::null()).stderr(sink).status().unwrap();
            assert_eq!(done.code(), Some(status), "{line}");
        }
    }
    for name in ["a.json", "c.json", "d.json", "fig3.json", "s.json", "e.json"] {
        folder.json(name);
    }
}

#[cfg(unix)]
#[test]
fn a_pipe_gets_all_or_is_refused_at_once() {
    use std::io::Read;
    let folder = Folder::new("pipes");
    let status = std::process::Command::new("mkfifo").arg(folder.path("pipe")).status().unwrap();
    assert!(status.success());
    let sweep = "sweep --r 1 --alpha 1:1.2:3";
    folder.refuses(&format!("{sweep} -o pipe"), &["--output pipe", "nobody reads"]);
    let expected = folder.prints(sweep);
    for line in [sweep, "sweep --r 1 --alpha 1:1.2:3 --threads 1"] {
        let path = folder.path("pipe");
        let reader = std::thread::spawn(move || {
            let mut all = vec![];
            fs::File::open(path).unwrap().read_to_end(&mut all).unwrap();
            all
        });
        folder.prints(&format!("{line} -o pipe"));
        assert!(reader.join().unwrap() == expected);
    }
    assert_eq!(folder.names(), ["pipe"]);
}

#[test]
fn what_is_printed_does_no_harm() {
    let folder = Folder::new("harmless");
    let key = format!("{{\"gaussians\":[],\"{}\\u001b[31m\":1}}", "k".repeat(10 << 20));
    folder.write("tip.json", key);
    folder.write("\x1b]0;renamed\x07.json", "{\"\x1b[2J\":1}");
    for line in [
        "stability --r 1 --tip-file tip.json",
        "stability --r 1 --tip-file \x1b]0;renamed\x07.json",
        "verify \x1b[31m.json",
        "run --alpha 1 --r 1 --until 60 -o \x1b[31m",
        "run --alpha \x1b[31m",
    ] {
        let output = folder.stickslip(line);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.len() < 4000, "{} bytes", said.len());
        assert!(said.chars().all(|c| c == '\n' || !c.is_control()), "{said:?}");
    }
}

#[test]
fn points_that_were_changed_are_not_merged() {
    let folder = Folder::new("changed_points");
    let sweep = "sweep --r 1 --alpha 1:1.4:4";
    folder.prints(&format!("{sweep} --shard 1/2 -o a.json"));
    folder.prints(&format!("{sweep} --shard 2/2 -o b.json"));
    let whole = folder.prints("sweep merge a.json b.json");
    assert!(whole == folder.prints(sweep));
    let part = folder.json("b.json");
    for change in ["period", "amplitude_x0", "r", "alpha", "multiplier"] {
        let mut changed = part.clone();
        let value = changed["points"][1][change].as_f64().unwrap();
        changed["points"][1][change] = value.next_up().into();
        folder.write("c.json", changed.to_string());
        folder.refuses("sweep merge a.json c.json", &["PART.json c.json", "was changed"]);
    }
    let mut changed = part.clone();
    changed["arithmetic"] = serde_json::Value::Null;
    folder.write("c.json", changed.to_string());
    folder.refuses("sweep merge a.json c.json", &["PART.json c.json", "was changed"]);
    let mut changed = part.clone();
    changed.as_object_mut().unwrap().remove("crc32");
    folder.write("c.json", changed.to_string());
    folder.refuses("sweep merge a.json c.json", &["PART.json c.json", "no checksum"]);
    // How it is laid out does not matter.
    folder.write("c.json", serde_json::to_string_pretty(&part).unwrap());
    assert!(folder.prints("sweep merge a.json c.json") == whole);
}

/// Two hundred flips, one at a time, in what an interrupted sweep left.
#[test]
fn flipped_bits_of_finished_points_are_computed_again() {
    let folder = Folder::new("flipped_points");
    let line = "sweep --r 1 --alpha 0.9:1.4:4 -o s.json";
    folder.prints(line);
    let whole = folder.read("s.json");
    // Stopped by the folder of its output, which a file of that name is no longer.
    let kept = {
        let long = "sweep --r 1 --alpha 0.9:1.4:4 -o s.json --threads 1";
        let mut kept = vec![];
        while kept.split(|b| *b == b'\n').count() < 4 {
            let mut child = folder.command(long).stderr(Stdio::null()).spawn().unwrap();
            while child.try_wait().unwrap().is_none() {
                if let Ok(bytes) = fs::read(folder.path("s.json.partial"))
                    && bytes.split(|b| *b == b'\n').count() > 3
                {
                    child.kill().unwrap();
                }
            }
            kept = fs::read(folder.path("s.json.partial")).unwrap_or_default();
        }
        kept
    };
    for i in 0..40 {
        let mut flipped = kept.clone();
        let at = (i * 7919 + 13) % flipped.len();
        flipped[at] ^= 1 << (i % 8);
        folder.write("s.json.partial", flipped);
        folder.write("s.json", "before");
        let output = folder.stickslip(line);
        match output.status.code() {
            Some(0) => assert!(folder.read("s.json") == whole, "byte {at}"),
            Some(2) => assert_eq!(folder.read("s.json"), b"before"),
            other => panic!("{other:?}: {}", said(&output)),
        }
        fs::remove_file(folder.path("s.json.partial")).ok();
    }
}

#[cfg(unix)]
#[test]
fn a_sweep_whose_folder_vanishes_says_so_and_saves_its_points() {
    let folder = Folder::new("vanished");
    fs::create_dir(folder.path("gone")).unwrap();
    let line = "sweep --r 0.9:1.1:6 --alpha 1:1.5:40 --threads 1";
    let child = folder.command(&format!("{line} -o gone/s.json")).stderr(Stdio::piped()).spawn();
    let child = child.unwrap();
    while !folder.path("gone/s.json.partial").exists() {
        sleep(Duration::from_millis(2));
    }
    fs::remove_dir_all(folder.path("gone")).unwrap();
    let output = child.wait_with_output().unwrap();
    let told = said(&output);
    assert_eq!(output.status.code(), Some(1), "{told}");
    assert!(told.contains("s.json.partial was removed"), "{told}");
    let kept = told.trim_end().rsplit(" is in ").next().unwrap();
    assert!(fs::read(kept).unwrap() == folder.prints(line), "{kept}");
    fs::remove_file(kept).unwrap();
}

#[cfg(unix)]
#[test]
fn beyond_the_limit_on_the_size_of_files_a_write_fails() {
    let folder = Folder::new("limited");
    folder.write("run.json", "before");
    let inner = folder.command(&format!("{RUN} -o run.json"));
    let mut shell = std::process::Command::new("sh");
    shell.current_dir(folder.path("")).arg("-c").arg("ulimit -f 8; exec \"$0\" \"$@\"");
    let output = shell.arg(inner.get_program()).args(inner.get_args()).output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    assert!(said(&output).contains("cannot write run.json"), "{}", said(&output));
    assert_eq!(folder.read("run.json"), b"before");
    assert_eq!(folder.names(), ["run.json"]);
}
