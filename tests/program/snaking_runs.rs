//! Runs of a tip that gives way across the scan.

use crate::folder::{Folder, said};
use crate::runs::{schema, validate};
use serde_json::{Value, json};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Supercritical, of amplitude 1.55 σ √(α/α_y - 1), where α_y = 0.8305410127 and the wavelength there is 17.1 σ: figures of an
/// independent prototype (exponentials by Hermite-Gauss layers, direct sums, and a grid agree on them).
#[test]
fn a_line_snakes_above_its_threshold_and_not_below() {
    let folder = Folder::new("snaking_runs");
    let line = "run --r 1 --stiffness-across 0.25 --kick-across 0.02 --until 900";
    folder.prints(&format!("{line} --alpha 0.9 -o above.json"));
    let above = folder.json("above.json");
    validate(&schema(&folder, "run"), &above);
    assert_eq!(above["regime"], "snaking");
    let amplitude = 1.55 * (0.9_f64 / 0.830_541_012_7 - 1.0).sqrt();
    let found = &above["snaking"];
    assert!((number(&found["amplitude_y0"]) / amplitude - 1.0).abs() < 0.02, "{found}");
    assert!((number(&found["wavelength"]) - 17.3).abs() < 0.1, "{found}");
    // What is told of the end is within the errors of what a run of twice the length tells.
    let twice =
        folder.prints_json(&format!("{line} --alpha 0.9 --until 1800").replace("--until 900 ", ""));
    for name in ["period", "amplitude_y0"] {
        let difference = (number(&found[name]) - number(&twice["snaking"][name])).abs();
        let errors = number(&found[format!("{name}_error")])
            + number(&twice["snaking"][format!("{name}_error")]);
        assert!(difference <= errors, "{name}: {difference:e}, {errors:e}");
    }
    let below = folder.prints_json(&format!("{line} --alpha 0.7"));
    assert_eq!((&below["regime"], &below["snaking"]), (&json!("steady"), &Value::Null));
    // On its line by symmetry, which is said.
    let still = folder.prints_json("run --r 1 --stiffness-across 0.25 --until 60 --alpha 0.9");
    assert!(still["remarks"].to_string().contains("by symmetry"), "{}", still["remarks"]);
    assert!(still["samples"]["y0"].as_array().unwrap().iter().all(|y| number(y).abs() < 1e-300));
}

#[test]
fn samples_and_history_have_both_coordinates_and_documents_are_asked_again() {
    let folder = Folder::new("across_documents");
    let line = "run --alpha 1 --r 1 --stiffness-across 0.5 --kick-across 0.1 --kick 0.05 --until 40 --sample-every 2";
    folder.prints(&format!("{line} --sigma 30nm -o run.csv"));
    let csv = String::from_utf8(folder.read("run.csv")).unwrap();
    let head = csv.lines().find(|line| !line.starts_with('#')).unwrap();
    assert!(head.contains("y0_nm") && head.contains("velocity_y"), "{head}");
    folder.prints(&format!("{line} -o run.json --plot run.svg"));
    let run = folder.json("run.json");
    let steps = run["history"]["extension"].as_array().unwrap().len();
    let y0 = run["history"]["y0"].as_array().unwrap();
    assert!(y0.len() == steps && y0.iter().all(|row| row.as_array().unwrap().len() == 7));
    assert!((number(&y0[0][0]) - 0.1).abs() < 1e-300);
    let svg = String::from_utf8(folder.read("run.svg")).unwrap();
    assert!(svg.contains("y₀(t)") && svg.contains("path of the tip"));
    let again = folder.prints_json("run --parameters run.json");
    assert_eq!(again["samples"], run["samples"]);
    let stiffer = folder.prints_json("run --parameters run.json --stiffness-across 1");
    assert_ne!(stiffer["samples"]["y0"], run["samples"]["y0"]);
    // Held on its line it is the tip of one coordinate, and its document has nothing across.
    let held = folder.prints_json("run --alpha 1 --r 1 --kick 0.05 --until 40 --sample-every 2");
    assert_eq!(held["samples"].get("y0"), None);
    let stiff = folder.prints_json(&line.replace("0.5 --kick-across 0.1", "1e5"));
    let pairs = |name: &str| -> Vec<(f64, f64)> {
        let numbers = |run: &Value| -> Vec<f64> {
            run["samples"][name].as_array().unwrap().iter().map(number).collect()
        };
        numbers(&held).into_iter().zip(numbers(&stiff)).collect()
    };
    assert!(pairs("l").iter().all(|(a, b)| (a - b).abs() < 2e-9));
}

#[test]
fn what_is_not_there_across_the_scan_is_refused_by_name() {
    let folder = Folder::new("across_refused");
    let line = "run --alpha 1 --r 1 --until 40";
    folder.prints(&format!("{line} --stiffness-across 1 -o run.json"));
    for (options, words) in [
        ("--stiffness-across 0", ["--stiffness-across 0", "above 0"]),
        ("--stiffness-across nan", ["--stiffness-across NaN", "finite"]),
        ("--kick-across 0.1", ["--kick-across 0.1", "--stiffness-across"]),
        ("--width-y 2", ["--width-y 2", "--stiffness-across"]),
        ("--stiffness-across 1 --tip bessel", ["--width-y", "give the width"]),
        ("--stiffness-across 1 --verify", ["--verify", "not available"]),
        ("--stiffness-across 1 --checkpoint a.ck", ["--checkpoint", "not available"]),
        ("--stiffness-across 1 -o a.jsonl", ["--format jsonl", "not available"]),
    ] {
        folder.refuses(&format!("{line} {options}"), &words);
    }
    folder.refuses(
        "surface run.json --at 30 --range 0:10 --spacing 1",
        &["RUN.json run.json", "two coordinates"],
    );
    let compare = "compare --alpha 1 --r 1 --until 20 --stiffness-across 1";
    folder.refuses(compare, &["--stiffness-across 1", "no grid"]);
    folder.refuses("verify run.json", &["RUN run.json", "two coordinates"]);
    let remarks = said(&folder.stickslip(&format!("{line} --stiffness-across 1 -o other.json")));
    assert!(remarks.contains("steady"), "{remarks}");
}
