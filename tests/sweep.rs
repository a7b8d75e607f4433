//! Does a sweep give the same however it is done, and does it lose nothing? One sweep left alone is the yardstick for
//! the same sweep on one thread, in parts, and killed again and again (SIGKILL, at random moments, real processes).
//! What its points are worth is judged in cycles.rs; here, that they are those of the library.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod program;

use program::Folder;
use serde_json::Value;
use std::fs;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;
use stickslip_tip::cycle::{DEFAULT_TOLERANCE, cycle};
use stickslip_tip::stability::critical;
use stickslip_tip::{Model, TipFunction};

/// Every regime is in it.
const GRID: &str = "--r 0.7:1.3:5 --alpha 0.5:2.6:13";

fn points(document: &Value) -> &Vec<Value> {
    document["points"].as_array().unwrap()
}

#[test]
fn points_are_those_of_the_library() {
    let folder = Folder::new("sweep_library");
    let document = folder.prints_json(&format!("sweep {GRID}"));
    assert_eq!(points(&document).len(), 65);
    let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
    let mut regimes = vec![];
    for (i, point) in points(&document).iter().enumerate() {
        let (r, alpha) = (point["r"].as_f64().unwrap(), point["alpha"].as_f64().unwrap());
        assert!((r - (0.7 + 0.15 * (i / 13) as f64)).abs() < 1e-12);
        assert!((alpha - (0.5 + 0.175 * (i % 13) as f64)).abs() < 1e-12);
        let regime = point["regime"].as_str().unwrap();
        let is_steady = alpha <= critical(&tip, r).unwrap().alpha;
        assert_eq!(is_steady, regime == "steady", "{point}");
        if point["method"] == "cycle" {
            let known = cycle(&Model::new(tip.clone(), alpha, r).unwrap(), DEFAULT_TOLERANCE);
            let known = known.unwrap();
            assert!(known.is_stable());
            for (name, value) in [
                ("period", known.period()),
                ("amplitude_x0", known.amplitude_x0()),
                ("amplitude_u", known.amplitude_u()),
            ] {
                assert!((point[name].as_f64().unwrap() - value).abs() <= 1e-12 * value);
            }
            assert_eq!(point["slips"], known.slips());
        }
        regimes.push(format!("{regime} {}", point["slips"]));
    }
    for regime in ["steady null", "stick-slip 1", "stick-slip 2", "trapped null"] {
        assert!(regimes.iter().any(|r| r == regime), "{regime}");
    }
}

#[test]
fn threads_and_parts_make_no_difference() {
    let folder = Folder::new("sweep_parts");
    folder.prints(&format!("sweep {GRID} -o whole.json --plot whole.svg"));
    folder.prints(&format!("sweep {GRID} --threads 1 -o one.json"));
    assert_eq!(folder.read("whole.json"), folder.read("one.json"));
    for part in 1..=3 {
        folder.prints(&format!("sweep {GRID} --shard {part}/3 -o part{part}.json"));
    }
    folder.prints("sweep merge part2.json part3.json part1.json -o merged.json --plot merged.svg");
    assert_eq!(folder.read("whole.json"), folder.read("merged.json"));
    assert_eq!(folder.read("whole.svg"), folder.read("merged.svg"));
    assert!(folder.names().iter().all(|name| !name.contains("journal")));
    // Standard output has the same, and parts that do not fit are refused.
    assert_eq!(folder.read("whole.json"), folder.prints(&format!("sweep {GRID}")));
    folder.refuses("sweep merge part1.json part2.json", &["part1.json", "3 parts", "2 are given"]);
    folder.refuses("sweep merge part1.json part2.json part2.json", &["second time"]);
    folder.refuses("sweep merge whole.json", &["whole.json", "no part"]);
    folder.prints("sweep --r 1 --alpha 1.2:1.3:2 --shard 3/3 -o other.json");
    folder.refuses("sweep merge part1.json part2.json other.json", &["another sweep"]);
}

#[test]
fn a_sweep_that_is_killed_goes_on_where_it_was() {
    let folder = Folder::new("sweep_killed");
    folder.prints(&format!("sweep {GRID} -o whole.json"));
    let line = format!("sweep {GRID} --threads 1 -o killed.json");
    let start = |line: &str| -> std::process::Child {
        let mut command: Command = folder.command(line);
        command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap()
    };
    let finished = || {
        let journal = fs::read_to_string(folder.path("killed.json.journal")).unwrap_or_default();
        journal.matches('\n').count()
    };
    // Moments without a pattern, from a fixed seed: as good as random, and the same again.
    let mut seed = 12_345_u64;
    let mut kills = 0;
    let mut before = 0;
    while kills < 25 && !folder.path("killed.json").exists() {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let mut child = start(&line);
        sleep(Duration::from_millis(5 + (seed >> 33) % 40));
        child.kill().unwrap();
        child.wait().unwrap();
        kills += 1;
        assert!(finished() >= before || folder.path("killed.json").exists(), "a point was lost");
        before = finished();
    }
    println!("{kills} kills, {before} lines");
    // A line that was cut in the middle is computed again.
    if let Ok(journal) = fs::read(folder.path("killed.json.journal")) {
        folder.write("killed.json.journal", [journal.as_slice(), b"{\"index\":3,\"po"].concat());
    }
    folder.prints(&line);
    assert_eq!(folder.read("whole.json"), folder.read("killed.json"));
    assert!(kills > 2, "killed too late to tell");
}

#[test]
fn a_signal_leaves_what_is_finished_and_nothing_else() {
    let folder = Folder::new("sweep_interrupted");
    let line = "sweep --r 0.7:1.3:30 --alpha 0.5:2.6:60 --threads 1 -o out.json";
    let mut child = folder.command(line).stderr(Stdio::piped()).spawn().unwrap();
    while fs::metadata(folder.path("out.json.journal")).map_or(0, |m| m.len()) < 2000 {
        sleep(Duration::from_millis(2));
    }
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(folder.names(), ["out.json.journal"]);
    // Another sweep does not take it for its own.
    let other = "sweep --r 0.7:1.3:30 --alpha 0.5:2.6:61 -o out.json";
    folder.refuses(other, &["out.json.journal", "another sweep"]);
}

#[test]
fn ranges_that_make_no_grid_are_refused() {
    let folder = Folder::new("sweep_refusals");
    for (line, words) in [
        ("sweep --alpha 1:2:3", &["--r", "missing"][..]),
        ("sweep --r 1", &["--alpha", "missing"]),
        ("sweep --r 1:0.5:3 --alpha 1", &["--r", "not above"]),
        ("sweep --r 1:2 --alpha 1", &["--r", "LO:HI:N"]),
        ("sweep --r 1:2:1 --alpha 1", &["--r", "2 or above"]),
        ("sweep --r nan --alpha 1", &["--r", "finite"]),
        ("sweep --r 0:1:3 --alpha 1", &["--r 0", "above 0"]),
        ("sweep --r 1 --alpha=-1:1:3", &["--alpha -1"]),
        ("sweep --r 1:2:2000 --alpha 1:2:2000", &["1000000 points"]),
        ("sweep --r 1 --alpha 1:2:3 --plot x.svg", &["--plot", "range"]),
        ("sweep --r 1 --alpha 1:2:3 --shard 3/2", &["--shard", "I/N"]),
        ("sweep --r 1 --alpha 1:2:3 --threads 0", &["--threads 0"]),
        ("sweep --r 1 --alpha 1:2:3 --tolerance 1", &["--tolerance 1"]),
        ("sweep --r 1 --alpha 1:2:3 -o x.npz", &["x.npz", ".csv"]),
        ("sweep --r 1 --alpha 1:2:3 --tip gaussian --beta 0.5", &["--beta 0.5"]),
        ("sweep --r 1 --alpha 1:2:3 --alpha-above 1", &["--alpha"]),
    ] {
        folder.refuses(line, words);
    }
}

#[test]
fn a_table_has_a_row_for_every_point() {
    let folder = Folder::new("sweep_table");
    folder.prints("sweep --r 1 --alpha-above=-0.1:0.1:5 --beta 0.9:1:2 -o table.csv");
    let table = String::from_utf8(folder.read("table.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows.len(), 11);
    assert!(rows[1].starts_with("0.9,1,") && rows[1].contains("steady"));
    assert!(rows[10].starts_with("1,1,") && rows[10].contains("stick-slip"));
}
