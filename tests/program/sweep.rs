//! Sweeps: each point judged by a run or by the stability of steady motion, and the same bytes however the
//! points are shared out, whatever kills the program on the way.

use crate::acceptance::Acceptance;
use crate::folder::Folder;
use serde_json::Value;
use std::process::{Command, Stdio};
use std::time::Duration;
use stickslip_outcome::{Regime, run_and_judge};
use stickslip_tip::{Model, Scenario, TipFunction};

const SMALL: &str = "sweep --r 0.8:1.2:3 --alpha 0.5:4:8";

#[test]
fn points_are_what_long_runs_come_to() {
    // Runs at a tolerance of 1e-9 and started elsewhere are the oracle.
    const CLOSE: Acceptance = Acceptance { floor: 0.0, slack: 1.0 };
    let folder = Folder::new("sweep_points");
    let document = folder.prints_json(SMALL);
    let points = document["points"].as_array().unwrap();
    assert_eq!(points.len(), 24);
    for (index, point) in points.iter().enumerate() {
        assert_eq!(point["index"], index);
        let number = |name: &str| point[name].as_f64().unwrap();
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let model = Model::new(tip, number("alpha"), number("r")).unwrap();
        let until = 4000.0;
        let (_, outcome) =
            run_and_judge(&Scenario { kick: 0.1, ..Scenario::new(model, until) }).unwrap();
        let regime = match outcome.regime {
            Regime::Steady => "steady",
            Regime::StickSlip => "stick-slip",
            Regime::Trapped => "trapped",
            Regime::Drifting => "drifting",
            Regime::Transient => "transient",
        };
        assert_eq!(point["regime"], regime, "{point}");
        if let Some(motion) = outcome.oscillation.filter(|o| o.drift < 1e-8) {
            let errors = [
                motion.period / number("period") - 1.0,
                motion.amplitude_x0 / number("amplitude_x0") - 1.0,
            ];
            CLOSE.judge(&format!("{index}, period"), errors[0].abs(), 1e-7);
            CLOSE.judge(&format!("{index}, amplitude"), errors[1].abs(), 1e-7);
            assert_eq!(point["slips"], motion.slips, "{point}");
        }
    }
    let kinds: Vec<&str> = points.iter().filter_map(|p| p["regime"].as_str()).collect();
    for kind in ["steady", "stick-slip", "trapped"] {
        assert!(kinds.contains(&kind), "{kind} is among them: {kinds:?}");
    }
}

#[test]
fn alpha_above_is_counted_from_the_boundary_and_beta_varies_slowest() {
    let folder = Folder::new("sweep_above");
    let document = folder.prints_json("sweep --beta 0.5:1:2 --r 1 --alpha-above -0.1:0.1:2");
    let points = document["points"].as_array().unwrap();
    let of = |name: &str| points.iter().map(|p| p[name].as_f64().unwrap()).collect::<Vec<_>>();
    assert_eq!(format!("{:?}", of("beta")), "[0.5, 0.5, 1.0, 1.0]");
    let above: Vec<f64> = of("alpha")
        .iter()
        .zip(of("critical_alpha"))
        .map(|(alpha, critical)| alpha - critical)
        .collect();
    assert!(above.iter().zip([-0.1, 0.1, -0.1, 0.1]).all(|(a, b)| (a - b).abs() < 1e-12));
    let regimes: Vec<&Value> = points.iter().map(|p| &p["regime"]).collect();
    assert_eq!(regimes, ["steady", "stick-slip", "steady", "stick-slip"]);
}

#[test]
fn the_same_bytes_for_any_number_of_threads_and_of_parts() {
    let folder = Folder::new("sweep_parts");
    let alone = folder.prints(&format!("{SMALL} --threads 1"));
    assert_eq!(folder.prints(&format!("{SMALL} --threads 3")), alone);
    for part in 1..=3 {
        folder.prints(&format!("{SMALL} --shard {part}/3 -o part-{part}.json"));
    }
    assert_eq!(folder.prints("sweep merge part-2.json part-3.json part-1.json"), alone);
    folder.refuses("sweep merge part-2.json part-3.json", &["PART.json", "missing"]);
    folder.refuses("sweep merge part-1.json part-1.json", &["more than one part"]);
    folder.prints("sweep --r 1 --alpha 1.1 -o other.json");
    folder.refuses("sweep merge part-1.json other.json", &["other.json", "another sweep"]);
}

#[test]
fn a_sweep_killed_at_any_moment_goes_on_to_the_same_bytes() {
    let folder = Folder::new("sweep_killed");
    let line = "sweep --r 0.8:1.2:8 --alpha 1:2:24 --threads 2 -o map.json";
    folder.prints(line);
    let alone = folder.read("map.json");
    std::fs::remove_file(folder.path("map.json")).unwrap();
    let (mut kills, mut resumed, mut stalled) = (0, 0, 1);
    for moment in (1..).map(|n| 7 * n % 60) {
        let mut child = folder.command(line).stderr(Stdio::null()).spawn().unwrap();
        // A slow machine is given longer, until it finishes a point before it is killed.
        std::thread::sleep(Duration::from_millis(moment * stalled));
        child.kill().unwrap();
        let ended_well = child.wait().unwrap().success();
        if folder.path("map.json").exists() {
            // Killed, if at all, after all was done but for the removal of what was kept.
            folder.prints(line);
            break;
        }
        assert!(!ended_well, "ended well without a document");
        kills += 1;
        let kept = std::fs::read_to_string(folder.path("map.json.partial")).unwrap_or_default();
        // All lines but the last are whole.
        let whole = kept.split_inclusive('\n').filter(|line| line.ends_with('\n'));
        let points = whole.skip(1).filter(|l| serde_json::from_str::<Value>(l).is_ok()).count();
        assert!(points >= resumed, "{points} points are left of {resumed}");
        stalled = if points > resumed { 1 } else { stalled + 1 };
        resumed = points;
    }
    assert!(kills > 3, "{kills} kills");
    assert_eq!(folder.read("map.json"), alone);
    assert_eq!(folder.names(), ["map.json"]);
}

#[test]
fn an_interrupted_sweep_says_how_to_go_on() {
    let folder = Folder::new("sweep_interrupted");
    let line = "sweep --r 0.5:2:100 --alpha 1:2:100 --threads 1 -o map.json";
    let child = folder.command(line).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(300));
    Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    let said = crate::folder::said(&output);
    assert!(said.contains("map.json.partial") && said.contains("continues"), "{said}");
    assert_eq!(folder.names(), ["map.json.partial"]);
    // Another grid does not go on from these points.
    folder.refuses("sweep --r 1 --alpha 1:2:3 -o map.json", &["map.json.partial", "another sweep"]);
    // Damage ends what is read, not the sweep.
    let mut kept = folder.read("map.json.partial");
    kept.extend(b"{\"index\":3,\"r\":no");
    folder.write("map.json.partial", kept);
    let again = folder.command(line).stderr(Stdio::piped()).spawn().unwrap();
    std::thread::sleep(Duration::from_millis(300));
    Command::new("kill").args(["-TERM", &again.id().to_string()]).status().unwrap();
    let output = again.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(143), "{}", crate::folder::said(&output));
}

#[test]
fn what_cannot_be_swept_is_refused_by_name() {
    let folder = Folder::new("sweep_refused");
    for (line, words) in [
        ("sweep --alpha 1:2:3", ["--r", "LO:HI:N"]),
        ("sweep --r 1", ["--alpha", "LO:HI:N"]),
        ("sweep --r 1 --alpha 1 --alpha-above 1", ["--alpha-above", "not both"]),
        ("sweep --r -1:1:3 --alpha 1", ["--r -1", "above 0"]),
        ("sweep --r 1 --alpha -1", ["--alpha -1", "0 or above"]),
        ("sweep --r 1 --alpha 2:1:3", ["--alpha", "LO below HI"]),
        ("sweep --r 1 --alpha 1 --shard 3/2", ["--shard", "I/N"]),
        ("sweep --r 1 --alpha 1 --threads 0 -o map.json", ["--threads 0", "1 to"]),
        ("sweep --r 1 --alpha 1 --tolerance 1", ["--tolerance 1", "1e-4"]),
        ("sweep --tip gaussian --beta 1 --r 1 --alpha 1", ["--beta", "side lobes"]),
        ("sweep --r 1:2:10000 --alpha 1:2:10000", ["--alpha", "points"]),
    ] {
        folder.refuses(line, &words);
    }
    assert!(folder.names().is_empty(), "{:?}", folder.names());
}

#[test]
fn every_format_is_written() {
    let folder = Folder::new("sweep_formats");
    let line = "sweep --r 1 --alpha 1:1.2:3";
    for name in ["s.json", "s.csv", "s.npz"] {
        folder.prints(&format!("{line} -o {name} --plot {name}.svg"));
    }
    let csv = String::from_utf8(folder.read("s.csv")).unwrap();
    let rows: Vec<&str> = csv.lines().collect();
    assert!(rows[0].starts_with("beta,r,alpha,critical_alpha,period"));
    assert!(
        rows[1].ends_with("steady,stability") && rows[3].ends_with("stick-slip,cycle"),
        "{csv}"
    );
    let schema = jsonschema::validator_for(&folder.prints_json("schema sweep")).unwrap();
    assert!(schema.is_valid(&folder.json("s.json")));
    assert_eq!(folder.read("s.json.svg"), folder.read("s.npz.svg"));
}

#[test]
fn the_picture_of_a_row_shows_steady_and_trapped_tips_too() {
    let folder = Folder::new("sweep_row");
    folder.prints("sweep --r 1 --alpha 0.9:2.4:6 -o row.json --plot row.svg");
    let picture = String::from_utf8(folder.read("row.svg")).unwrap();
    for name in ["steady (no value)", "one slip a period", "trapped (no value)"] {
        assert!(picture.contains(name), "{name}");
    }
}
