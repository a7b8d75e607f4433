//! What is lost when a run is killed? Real processes, killed at random moments; what they leave is judged by the
//! bytes of the same run in one go, by how far they had come, and by the names of the files in their folder.

use crate::folder::Folder;
use crate::runs::{assert_same, checkpoint_time, without_seconds};
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use serde_json::Value;
use std::fs;
use std::process::Stdio;
use std::thread::sleep;
use std::time::{Duration, Instant};

const INTERVAL: f64 = 50.0;
const LONGEST_STEP: f64 = 4.0;

/// A run that takes a good part of a second, with many checkpoints, and where it writes.
struct Long {
    name: &'static str,
    line: String,
    output: &'static str,
    /// What grows as it goes on.
    growing: Growing,
}

/// What tells how far a run had come. Files get 8 kB at a time: between two of these there are 10 to 25 time units
/// in all of these runs, well below an interval.
#[derive(Clone, Copy)]
enum Growing {
    Lines,
    /// The journal beside the checkpoint holds steps: time, duration and seven numbers.
    Steps,
    /// It holds samples: time and three numbers.
    Samples,
}

/// The numbers of its last whole row.
fn last_row<const N: usize>(bytes: &[u8]) -> Option<[f64; N]> {
    let (words, _) = bytes.as_chunks::<8>();
    let (rows, _) = words.as_chunks::<N>();
    rows.last().map(|row| row.map(f64::from_le_bytes))
}

impl Growing {
    fn name(self) -> &'static str {
        match self {
            Self::Lines => "run.jsonl.part",
            Self::Steps | Self::Samples => "run.ck.journal",
        }
    }

    /// The time that a run is known to have reached, by what it left.
    fn reached(self, folder: &Folder) -> Option<f64> {
        let bytes = fs::read(folder.path(self.name())).ok()?;
        match self {
            Self::Steps => last_row::<16>(&bytes).map(|[t, h, ..]| t + h),
            Self::Samples => last_row::<7>(&bytes).map(|[t, ..]| t),
            Self::Lines => {
                let whole = &bytes[..bytes.iter().rposition(|b| *b == b'\n')?];
                let last = whole.rsplit(|b| *b == b'\n').next()?;
                serde_json::from_slice::<Value>(last).ok()?["t"].as_f64()
            }
        }
    }
}

fn longs() -> Vec<Long> {
    let run = |name, growing, options: &str, output: &'static str| Long {
        name,
        line: format!(
            "run --r 1 --kick 0.05 --checkpoint run.ck --checkpoint-every {INTERVAL} {options} -o {output}"
        ),
        output,
        growing,
    };
    use Growing::{Lines, Samples, Steps};
    let slips = "--alpha 1.2 --until 4000 --sample-every 0.2";
    let forced = "--pulse=-8,25,0.5 --pulse=-8,900,0.5 --memory modes";
    vec![
        run("lines-auto", Lines, slips, "run.jsonl"),
        run("lines-modes", Lines, &format!("{slips} --memory modes"), "run.jsonl"),
        run(
            "lines-direct",
            Lines,
            "--alpha 1.2 --until 400 --tolerance 1e-6 --memory direct",
            "run.jsonl",
        ),
        run("json-fft", Steps, "--alpha 1.62 --until 2500 --memory fft", "run.json"),
        run("json-forced", Steps, &format!("--alpha 1.2 --until 2000 {forced}"), "run.json"),
        run("npz-all", Steps, "--alpha 1.62 --until 2500", "run.npz"),
        run(
            "npz-none",
            Samples,
            "--alpha 1.62 --until 2500 --sample-every 0.1 --history none",
            "run.npz",
        ),
        run(
            "csv-noise",
            Samples,
            "--alpha 1.1 --until 700 --noise 1e-4 --sample-every 0.05",
            "run.csv",
        ),
    ]
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
    let (mut reached, mut lost) = (0.0, 0.0_f64);
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
            let is_temporary = |name: &String| name.starts_with(".stickslip-");
            assert!(!folder.names().iter().any(is_temporary), "{:?}", folder.names());
            println!("{}: {done} kills, at most {lost:.1} time units seen lost", long.name);
            return done;
        }
        // Whole, or what was there before; and never behind the last checkpoint.
        let is_whole = without_seconds(&found) == without_seconds(&expected);
        assert!(is_whole || found == b"what was there before\n", "{}: a half of it", long.name);
        if folder.path("run.ck").exists() {
            let t = checkpoint_time(folder);
            assert!(t >= reached, "{}: fell back from {reached} to {t}", long.name);
            let beyond = long.growing.reached(folder).map_or(0.0, |reached| reached - t);
            lost = lost.max(beyond);
            assert!(beyond < INTERVAL + LONGEST_STEP, "{}: {beyond} beyond {t} lost", long.name);
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
        total += kills;
    }
    total
}

#[test]
fn killed_runs_resume_to_the_same_bytes() {
    let kills = kill_all(2, 1);
    assert!(kills >= 7, "only {kills} came before the end");
}

/// As many kills as the project promises to survive: some minutes.
#[test]
#[ignore = "300 kills take minutes: make survive"]
fn three_hundred_kills() {
    let mut kills = 0;
    for seed in 2.. {
        kills += kill_all(10, seed);
        println!("{kills} kills so far");
        if kills >= 300 {
            break;
        }
    }
}

#[test]
fn a_run_killed_at_its_work_leaves_no_file() {
    let folder = Folder::new("killed_at_work");
    for output in ["run.json", "run.csv", "run.npz"] {
        let line =
            format!("run --alpha 1.2 --r 1 --kick 0.05 --until 1e6 -o {output} --plot run.svg");
        let mut child = folder.command(&line).stderr(Stdio::null()).spawn().unwrap();
        sleep(Duration::from_millis(200));
        assert!(child.try_wait().unwrap().is_none(), "it was over too early");
        child.kill().unwrap();
        child.wait().unwrap();
        assert_eq!(folder.names(), [""; 0], "{output}");
    }
}

#[test]
fn what_a_run_killed_as_it_writes_leaves_goes_with_the_next() {
    let folder = Folder::new("killed_writing");
    let line = "run --alpha 4 --r 1 --until 20000 --sample-every 0.1 -o run.json";
    let mut child = folder.command(line).stderr(Stdio::null()).spawn().unwrap();
    let is_writing = || folder.names().iter().any(|name| folder.read(name).len() > 100_000);
    while !is_writing() {
        assert!(child.try_wait().unwrap().is_none(), "it was not seen to write");
        sleep(Duration::from_millis(1));
    }
    child.kill().unwrap();
    child.wait().unwrap();
    let left = folder.names();
    assert!(left.len() == 1 && left[0].starts_with(".stickslip-"), "{left:?}");
    // What is written beside it does not matter to it.
    folder.prints("run --alpha 4 --r 1 --until 30 -o other.json");
    assert_eq!(folder.names(), [&*left[0], "other.json"]);
    folder.prints("run --alpha 4 --r 1 --until 30 -o run.json");
    assert_eq!(folder.names(), ["other.json", "run.json"]);
}
