//! Numbers that nobody means, in every option of every command: huge, tiny, no number, counts of which each costs room.
//! What is asked for is refused, or done within 2 s of processor time and 256 MB; or it shows progress, and SIGINT ends
//! it. No oracle: the contract of the command line alone. Options and commands are those that `--help` lists, so that
//! none is forgotten.

mod lines;
mod values;
mod watch;

use crate::folder::Folder;
use chacha20::ChaCha8Rng;
use lines::{Options, PREPARED, TABLES, line};
use rand::SeedableRng;
use std::collections::BTreeMap;
use std::fs;
use watch::watched;

/// So many lines from this seed on, each by a seed of its own.
fn judged(cases: std::ops::Range<u64>, seed: u64) {
    let folder = Folder::new(&format!("extreme_arguments_{seed}_{}", cases.start));
    TABLES.iter().for_each(|(name, table)| folder.write(name, table));
    PREPARED.iter().for_each(|line| drop(folder.prints(line)));
    let prepared = folder.names();
    let options = Options::of_help(&folder);
    let (mut wrong, mut counts) = (vec![], BTreeMap::<&str, u32>::new());
    for case in cases {
        let mut rng = ChaCha8Rng::seed_from_u64(1_000_000 * seed + case);
        let words = line(&options, &mut rng);
        let ended = watched(&folder, &words);
        *counts.entry(ended.told()).or_default() += 1;
        if std::env::var("TELL").is_ok() {
            println!("{case} {}: {ended:?}", words.join(" "));
        }
        if let Some(why) = ended.wrong() {
            let shown: String = words.join(" ").chars().take(300).collect();
            println!("WRONG case {case}: {why}: {shown}\n    {ended:?}");
            wrong.push(format!("case {case}: {why}: {shown}"));
        }
        for name in folder.names().iter().filter(|name| !prepared.contains(name)) {
            let path = folder.path(name);
            if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) }.unwrap();
        }
    }
    println!("{counts:?}");
    assert!(wrong.is_empty(), "{} wrong\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn thirty_extreme_lines_are_refused_or_done() {
    judged(0..30, 1);
}

#[test]
#[ignore = "3,000 lines take half an hour: make survive"]
fn three_thousand_extreme_lines_are_refused_or_done() {
    let number = |name: &str, otherwise: u64| {
        std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(otherwise)
    };
    let from = number("FROM", 0);
    judged(from..from + number("CASES", 3000), number("SEED", 2));
}
