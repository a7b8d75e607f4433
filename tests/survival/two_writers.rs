//! What comes of two commands that write the same files at once? One wins; the other, if it was not all over before,
//! says so; and what they leave is the whole of one of them.

use crate::folder::{Folder, said};
use crate::runs::without_seconds;
use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use std::fs;
use std::process::{Child, Output, Stdio};
use std::thread::sleep;
use std::time::Duration;

/// Two commands, what both of them write, and what they need.
struct Pair {
    name: &'static str,
    before: Option<&'static str>,
    lines: [String; 2],
    written: &'static [&'static str],
}

const RUN: &str = "run --alpha 1.2 --r 1 --until 1500 --sample-every 0.2";

fn pairs() -> Vec<Pair> {
    let pair = |name, lines: [&str; 2], written| Pair {
        name,
        before: None,
        lines: lines.map(|line| line.replace("RUN", RUN)),
        written,
    };
    let sweep = "sweep --r 0.9:1.1:4 --alpha 1:1.5:8 --threads 1";
    let started = "run --alpha 1.2 --r 1 --until 1500 --sample-every 0.2 --checkpoint ck --checkpoint-every 700";
    let resumed = |name, before, written| Pair {
        name,
        before: Some(before),
        lines: ["run --resume ck", "run --resume ck"].map(String::from),
        written,
    };
    vec![
        pair("lines", ["RUN --kick 0.05 -o a.jsonl", "RUN --kick 0.06 -o a.jsonl"], &["a.jsonl"]),
        pair("documents", ["RUN --kick 0.05 -o a.json", "RUN --kick 0.06 -o a.json"], &["a.json"]),
        pair(
            "checkpoints",
            [
                "RUN --kick 0.05 -o a.csv --checkpoint ck",
                "RUN --kick 0.06 -o a.csv --checkpoint ck",
            ],
            &["a.csv"],
        ),
        pair(
            "sweeps",
            [sweep, "sweep --r 0.9:1.1:5 --alpha 1:1.5:6 --threads 1"].map(|line| {
                // The same output.
                &*Box::leak(format!("{line} -o m.json").into_boxed_str())
            }),
            &["m.json"],
        ),
        pair(
            "a run and a sweep",
            ["RUN --kick 0.05 -o m.csv", "sweep --r 0.9:1.1:4 --alpha 1:1.5:8 -o m.csv"],
            &["m.csv"],
        ),
        pair(
            "comparisons",
            [
                "compare --alpha 1.2 --r 1 --kick 0.05 --until 26 --spacing 0.1 -o c.csv",
                "compare --alpha 1.2 --r 1 --kick 0.06 --until 26 --spacing 0.1 -o c.csv",
            ],
            &["c.csv"],
        ),
        pair(
            "figures",
            ["figures --only fig2,fig6 --out-dir .", "figures --only fig2,fig6 --out-dir ."],
            &["fig2.svg", "fig6.json"],
        ),
        resumed(
            "resumed lines",
            Box::leak(format!("{started} -o a.jsonl").into_boxed_str()),
            &["a.jsonl"],
        ),
        resumed(
            "resumed documents",
            Box::leak(format!("{started} -o a.json").into_boxed_str()),
            &["a.json"],
        ),
        resumed(
            "resumed columns",
            Box::leak(format!("{started} -o a.csv").into_boxed_str()),
            &["a.csv"],
        ),
    ]
}

fn files(folder: &Folder, names: &[&str]) -> Vec<Vec<u8>> {
    names.iter().map(|name| without_seconds(&folder.read(name))).collect()
}

fn emptied(folder: &Folder) {
    for name in folder.names() {
        fs::remove_file(folder.path(&name)).unwrap();
    }
}

impl Pair {
    fn started(&self, folder: &Folder, which: usize) -> Child {
        let mut command = folder.command(&self.lines[which]);
        command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().unwrap()
    }

    /// What each of them writes, alone.
    fn alone(&self, folder: &Folder) -> Vec<Vec<Vec<u8>>> {
        let each = (0..2).map(|which| {
            emptied(folder);
            self.prepare(folder);
            assert!(self.started(folder, which).wait().unwrap().success(), "{}", self.name);
            files(folder, self.written)
        });
        each.collect()
    }

    /// A checkpoint amid the run, as a kill would leave it.
    fn prepare(&self, folder: &Folder) {
        if let Some(line) = self.before {
            assert!(folder.command(line).stderr(Stdio::null()).status().unwrap().success());
        }
    }

    /// Both at once; whether one was told of the other.
    fn race(&self, folder: &Folder, alone: &[Vec<Vec<u8>>], apart: Duration) -> bool {
        emptied(folder);
        self.prepare(folder);
        let first = self.started(folder, 0);
        sleep(apart);
        let second = self.started(folder, 1);
        let done: Vec<Output> =
            [first, second].into_iter().map(|child| child.wait_with_output().unwrap()).collect();
        let codes: Vec<_> = done.iter().map(|output| output.status.code()).collect();
        assert!(
            codes.contains(&Some(0)),
            "{}: {codes:?} {} {}",
            self.name,
            said(&done[0]),
            said(&done[1])
        );
        let found = files(folder, self.written);
        let winners = (0..2).filter(|which| codes[*which] == Some(0));
        assert!(
            winners.map(|which| &alone[which]).any(|alone| *alone == found),
            "{}: mixed",
            self.name
        );
        for output in done.iter().filter(|output| output.status.code() != Some(0)) {
            assert!(matches!(output.status.code(), Some(1 | 2)), "{}: {}", self.name, said(output));
            assert!(said(output).contains("another stickslip"), "{}: {}", self.name, said(output));
        }
        let odd = folder
            .names()
            .into_iter()
            .find(|name| name.starts_with(".stickslip") || name.ends_with(".part"));
        assert_eq!(odd, None, "{}", self.name);
        codes != [Some(0), Some(0)]
    }
}

fn race_all(each: u32, seed: u64) {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let (mut races, mut told) = (0, 0);
    for pair in pairs() {
        let folder = Folder::new(&format!("two_writers_{}_{seed}", pair.name.replace(' ', "_")));
        let alone = pair.alone(&folder);
        let mut here = 0;
        for _ in 0..each {
            let apart = Duration::from_micros(rng.random_range(0..20_000));
            here += u32::from(pair.race(&folder, &alone, apart));
        }
        println!("{}: {here} of {each} told", pair.name);
        (races, told) = (races + each, told + here);
    }
    println!("{races} pairs, {told} of them at work at once");
    assert!(3 * told > races, "too few met");
}

#[test]
fn of_two_writers_one_wins() {
    race_all(1, 1);
}

#[test]
#[ignore = "200 pairs take minutes: make survive"]
fn two_hundred_pairs_of_writers() {
    race_all(20, 2);
}
