//! Is a user told whether a run in two coordinates keeps its promise? Whether that is the truth
//! crates/verify/tests/across.rs judges.

use crate::folder::{Folder, said};
use serde_json::{Value, json};

const RUN: &str =
    "run --alpha 1.2 --r 1 --stiffness-across 0.3 --kick-across 0.1 --depth-limit 8 --until 60";

fn validate(folder: &Folder, name: &str, document: &Value) {
    let schema = jsonschema::validator_for(&folder.prints_json(&format!("schema {name}"))).unwrap();
    let errors: Vec<String> = schema.iter_errors(document).map(|e| e.to_string()).collect();
    assert!(errors.is_empty(), "{}", errors.join("\n"));
}

#[test]
fn runs_across_are_verified_from_history_samples_and_lines() {
    let folder = Folder::new("verify_across");
    let document = folder.prints_json(&format!("{RUN} --verify"));
    validate(&folder, "run", &document);
    let verification = &document["verification"];
    assert_eq!((&verification["kept"], &verification["memory"]), (&json!(true), &json!("fft")));
    assert!(verification["y0"]["largest"].as_f64().unwrap() > 0.0 && verification["u"].is_null());
    folder.write("run.json", document.to_string());
    let saved = folder.prints_json("verify run.json");
    validate(&folder, "verify", &saved);
    // A history has y0 itself, rounded; in a run it is a sum.
    let mut again = saved["verification"].clone();
    let largest = |of: &Value| of["y0"]["largest"].as_f64().unwrap();
    assert!((largest(&again) - largest(verification)).abs() < 1e-15);
    again["y0"]["largest"] = verification["y0"]["largest"].clone();
    assert_eq!(&again, verification);
    let output = folder.stickslip(&format!("{RUN} --verify -o run.csv"));
    assert!(said(&output).contains("verified with fft: l is off by"), "{}", said(&output));
    let text = String::from_utf8(folder.prints("verify run.json --format text")).unwrap();
    assert!(text.contains("y0"), "{text}");

    folder.prints(&format!("{RUN} --history none -o bare.json"));
    folder.prints(&format!("{RUN} -o run.jsonl"));
    let bare = folder.prints_json("verify bare.json");
    let lines = folder.prints_json("verify run.jsonl");
    for found in [&saved, &bare, &lines] {
        assert_eq!(
            (&found["verification"]["kept"], &found["differences"]),
            (&json!(true), &json!([]))
        );
    }
    assert_eq!(bare["verification"], lines["verification"]);
    assert_eq!(lines["lines"]["wrong"], 0);

    // Of a tip that is held on its line nothing is said of y0.
    let held = folder.prints_json("run --alpha 1.2 --r 1 --until 40 --verify");
    assert!(held["verification"].get("y0").is_none());
}

fn off(value: &mut Value, by: f64) {
    *value = json!(value.as_f64().unwrap() + by);
}

/// What is changed in a document, and what is named.
type Change = (&'static str, fn(&mut Value), &'static str);

#[test]
fn changed_runs_across_are_found_out() {
    let folder = Folder::new("changed_across");
    folder.prints(&format!("{RUN} -o run.json"));
    folder.prints(&format!("{RUN} --history none -o bare.json"));
    folder.prints(&format!("{RUN} -o run.jsonl"));
    let changes: [Change; 6] = [
        ("bare.json", |run| off(&mut run["samples"]["y0"][200], 1e-6), "y0 is off by 1.0e-6"),
        (
            "bare.json",
            |run| off(&mut run["samples"]["velocity_y"][200], 1e-3),
            "samples.velocity_y",
        ),
        ("run.json", |run| off(&mut run["samples"]["y0"][200], 1e-6), "samples.y0"),
        ("run.json", |run| run["regime"] = json!("steady"), "regime"),
        ("run.json", |run| off(&mut run["history"]["y0"][0][0], 1e-3), "the motion begins at y0"),
        ("run.json", |run| off(&mut run["parameters"]["stiffness_across"], 1e-5), "is off by"),
    ];
    for (name, change, words) in changes {
        let mut run = folder.json(name);
        change(&mut run);
        folder.write("changed.json", run.to_string());
        let output = folder.stickslip("verify changed.json");
        assert!(!output.status.success() && said(&output).contains(words), "{}", said(&output));
    }
    let lines = String::from_utf8(folder.read("run.jsonl")).unwrap();
    let mut lines: Vec<String> = lines.lines().map(str::to_owned).collect();
    let mut sample: Value = serde_json::from_str(&lines[40]).unwrap();
    off(&mut sample["y0"], 1e-6);
    lines[40] = sample.to_string();
    folder.write("changed.jsonl", lines.join("\n") + "\n");
    let output = folder.stickslip("verify changed.jsonl");
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("y0 is off by 1.0e-6"), "{}", said(&output));
    assert!(said(&output).contains("line 41"), "{}", said(&output));
}
