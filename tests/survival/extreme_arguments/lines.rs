//! Command lines: what would do, with some of it replaced.

use super::values::{Kind, value};
use crate::folder::Folder;
use chacha20::ChaCha8Rng;
use rand::{RngExt, seq::IndexedRandom};
use std::collections::BTreeMap;

/// What is read by the lines.
pub(super) const PREPARED: [&str; 6] = [
    "run --alpha 1.2 --r 1 --kick 0.1 --until 40 -o run.json",
    "cycle --alpha 1.2 --r 1 -o cycle.json",
    "raster --alpha 1.2 --r 1 --pitch 1 --lines 3 --length 20 -o raster.json",
    "boundary --r-range 0.5:2:5 -o boundary.json",
    "sweep --r 1 --alpha 0.9:1.2:3 --threads 1 -o sweep.json",
    "units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm --slope-force 5nN --alpha 1.2 --r 1 -o units.json",
];

/// Tables that are read by the lines: a tip of width 1 in any unit, and onsets.
pub(super) const TABLES: [(&str, &str); 2] = [
    (
        "pit.csv",
        "0,1\n0.5,0.8825\n1,0.6065\n1.5,0.3247\n2,0.1353\n2.5,0.0439\n3,0.0111\n3.5,0.0022\n4,0.0003\n5,0\n",
    ),
    ("onsets.csv", "1,1.02\n2,2.5\n3,4.2\n4,6.5\n"),
];

/// Every command with what it cannot do without.
const LINES: [&str; 24] = [
    "run --alpha 1.2 --r 1 --until 30",
    "verify run.json",
    "surface run.json",
    "surface run.json --range 10:20 --y-range -2:2 --spacing 0.5",
    "stability --r 1",
    "stability --r 1 --alpha 1.2",
    "boundary --r-range 0.5:2:5",
    "compare --alpha 1.2 --r 1 --until 18",
    "response --alpha 0.9 --r 1 --pulse 1e-4,17,0.5 --until 20",
    "cycle --alpha 1.2 --r 1",
    "continue --over alpha --r 1 --most-points 3",
    "sweep --r 1 --alpha 0.9:1.2:3 --threads 1",
    "units --damping 1kg/s --stiffness 1N/m --tip-width 1m --slope-force 1N --indentation-rate 1m/s --velocity 1m/s",
    "plot run.json --output p.svg",
    "plot boundary.json --output p.png",
    "figures --only fig6 --out-dir figures",
    "raster --alpha 1.2 --r 1 --pitch 1 --lines 3 --length 20",
    "stability --r 1 --pitch 1",
    "compare --alpha 0.5 --r 1 --pitch 1 --lines 2 --length 8",
    "surface raster.json --range 5:15 --y-range 0:2 --spacing 0.5",
    "stability --no-spring --alpha -1",
    "tip pit.csv --resamples 20",
    "fit --onsets onsets.csv --tip gaussian",
    "friction pit.csv",
];
/// Has no numbers.
const WITHOUT: [&str; 3] = ["schema", "completions", "help"];

/// By command, its options, each with what it takes.
pub(super) struct Options(BTreeMap<String, Vec<(String, Kind)>>);

impl Options {
    pub(super) fn of_help(folder: &Folder) -> Self {
        let text = |line: &str| String::from_utf8(folder.prints(line)).unwrap();
        let top = text("--help");
        let commands = top.lines().skip_while(|line| *line != "Commands:").skip(1);
        let commands = commands.take_while(|line| !line.is_empty());
        let names = commands.filter_map(|line| line.strip_prefix("  ")?.split(' ').next());
        let names = names.filter(|name| !name.is_empty() && !WITHOUT.contains(name));
        let options = names.map(|name| {
            let known = LINES.iter().any(|line| line.split(' ').next() == Some(name));
            assert!(known, "{name}: give it a line in {}", file!());
            (name.to_owned(), options_of(name, &text(&format!("{name} --help"))))
        });
        Self(options.collect())
    }
}

/// `--name <VALUE>` at the beginning of lines.
fn options_of(command: &str, help: &str) -> Vec<(String, Kind)> {
    let option = |line: &str| {
        // Descriptions are indented further.
        let line = line.strip_prefix("  ").map(|l| l.strip_prefix("    ").unwrap_or(l))?;
        let long = &line[line.starts_with('-').then(|| line.find("--"))??..];
        let mut words = long.split_whitespace();
        let name = words.next()?.trim_end_matches("...").to_owned();
        let value = words.next().and_then(|word| word.strip_prefix('<')?.split('>').next());
        let is_name =
            name.len() > 2 && name[2..].chars().all(|c| c.is_ascii_alphabetic() || c == '-');
        (is_name && name != "--help" && name != "--version")
            .then(|| (name, Kind::of(command, value)))
    };
    let found: Vec<_> = help.lines().take_while(|l| *l != "Examples:").filter_map(option).collect();
    assert!(!found.is_empty(), "{command}: no options in its help");
    found
}

/// One of them, with one to three options that are extreme.
pub(super) fn line(options: &Options, rng: &mut ChaCha8Rng) -> Vec<String> {
    let known: Vec<_> = LINES
        .iter()
        .filter(|line| options.0.contains_key(line.split(' ').next().unwrap()))
        .collect();
    let mut words: Vec<String> = known.choose(rng).unwrap().split(' ').map(str::to_owned).collect();
    let of_command = &options.0[&words[0]];
    for _ in 0..rng.random_range(1..=3) {
        let (name, kind) = of_command.choose(rng).unwrap();
        let place = words.iter().position(|word| word == name);
        let value = value(*kind, rng);
        match (place, value) {
            (Some(at), Some(value)) if at + 1 < words.len() => words[at + 1] = value,
            (_, Some(value)) => words.extend([name.clone(), value]),
            (None, None) => words.push(name.clone()),
            (Some(_), None) => {}
        }
    }
    words
}
