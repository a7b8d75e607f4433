//! Is a user told whether a run keeps its promise? Whether that is the truth crates/verify/tests/promise.rs judges.

use crate::folder::{Folder, said};
use serde_json::{Value, json};

fn validate(folder: &Folder, name: &str, document: &Value) {
    let schema = jsonschema::validator_for(&folder.prints_json(&format!("schema {name}"))).unwrap();
    let errors: Vec<String> = schema.iter_errors(document).map(|e| e.to_string()).collect();
    assert!(errors.is_empty(), "{}", errors.join("\n"));
}

#[test]
fn a_user_is_told_by_document_and_exit_status() {
    let folder = Folder::new("verify");
    let good = "run --alpha 1.2 --r 1 --kick 0.05 --until 76";
    let document = folder.prints_json(&format!("{good} --verify"));
    validate(&folder, "run", &document);
    assert_eq!(document["verification"]["kept"], json!(true));
    folder.write("run.json", document.to_string());
    let saved = folder.prints_json("verify run.json");
    validate(&folder, "verify", &saved);
    assert_eq!(saved["verification"], document["verification"]);

    // A table has no room for it: it is said.
    let output = folder.stickslip(&format!("{good} --verify -o run.csv"));
    assert!(said(&output).contains("verified with direct: l is off by"), "{}", said(&output));

    // Without its history: by the samples.
    folder.prints(&format!("{good} --history none -o bare.json"));
    let bare = folder.prints_json("verify bare.json");
    assert_eq!(bare["verification"]["kept"], json!(true));
    assert!(bare["verification"]["u"].is_null());
    let mut wrong = folder.json("bare.json");
    wrong["samples"]["l"][700] = json!(wrong["samples"]["l"][700].as_f64().unwrap() + 1e-7);
    folder.write("wrong.json", wrong.to_string());
    let output = folder.stickslip("verify wrong.json");
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    let found: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(found["verification"]["l"]["at"], wrong["samples"]["t"][700]);

    let broken = "run --alpha 1.9 --r 1 --kick 0.01 --until 457 -o broken.json";
    let output = folder.stickslip(&format!("{broken} --verify"));
    assert_eq!(output.status.code(), Some(1), "{}", said(&output));
    for words in ["tolerance is not met", "it is correct until t =", "--tolerance"] {
        assert!(said(&output).contains(words), "{}", said(&output));
    }
    let document = folder.json("broken.json");
    validate(&folder, "run", &document);
    assert_eq!(document["verification"]["kept"], json!(false));
    assert_eq!(folder.stickslip("verify broken.json").status.code(), Some(1));
    // One with a history that is that of another run.
    let mut other = folder.json("run.json");
    other["parameters"]["alpha"] = json!(1.200_001);
    folder.write("other.json", other.to_string());
    folder.refuses("verify other.json", &["RUN.json other.json", "history: from"]);
    for name in ["abc", "verified.csv"] {
        folder.refuses(&format!("verify run.json -o {name}"), &["--output", name, ".json"]);
    }
    folder.refuses(&format!("{good} --verify -o run.jsonl"), &["--verify", ".json"]);
}

/// A document, what is changed in it, and the field that is named.
type Claim = (&'static str, fn(&mut Value), &'static str);

/// Adds to a number.
fn add(number: &mut Value, by: f64) {
    *number = json!(number.as_f64().unwrap() + by);
}

fn without_the_last_sample(document: &mut Value) {
    for column in document["samples"].as_object_mut().unwrap().values_mut() {
        column.as_array_mut().unwrap().pop();
    }
}

const CLAIMS: [Claim; 27] = [
    ("run", |d| add(&mut d["samples"]["l"][70], 2e-6), "samples.l"),
    ("run", |d| add(&mut d["samples"]["x0"][70], 2e-6), "samples.x0"),
    ("run", |d| add(&mut d["samples"]["lag"][70], 2e-6), "samples.lag"),
    ("run", |d| add(&mut d["samples"]["velocity"][70], 1e-6), "samples.velocity"),
    ("run", |d| d["regime"] = json!("steady"), "regime"),
    ("run", |d| d["regime"] = json!("transient"), "regime"),
    ("run", |d| add(&mut d["oscillation"]["period"], 0.1), "oscillation.period"),
    ("run", |d| add(&mut d["oscillation"]["amplitude_x0"], 0.1), "oscillation.amplitude_x0"),
    ("run", |d| d["oscillation"]["period_error"] = json!(10), "oscillation.period_error"),
    ("run", |d| d["oscillation"]["slips"] = json!(7), "oscillation.slips"),
    ("run", |d| d["oscillation"] = Value::Null, "oscillation"),
    ("run", |d| add(&mut d["steady_state"]["l"], 1e-6), "steady_state.l"),
    ("run", |d| d["remarks"] = json!(["all is well"]), "remarks"),
    ("run", |d| d["interrupted"] = json!(true), "interrupted"),
    ("run", |d| d["work"]["steps"] = json!(1), "work.steps"),
    ("run", |d| d["work"]["memory"] = json!("none"), "work.memory"),
    ("run", |d| add(&mut d["physical"]["samples"]["x0_nm"][70], 1e-3), "physical.samples.x0_nm"),
    ("run", |d| add(&mut d["parameters"]["alpha_above"], 1e-6), "parameters.alpha"),
    ("bare", |d| add(&mut d["samples"]["lag"][70], 2e-5), "samples.lag"),
    ("bare", |d| add(&mut d["samples"]["velocity"][70], 0.1), "samples.velocity"),
    ("bare", |d| d["regime"] = json!("trapped"), "regime"),
    ("bare", |d| d["parameters"]["sample_every"] = json!(1.5), "samples.t"),
    ("bare", without_the_last_sample, "samples.t"),
    ("limited", |d| add(&mut d["samples"]["height"][7], 1e-6), "samples.height"),
    ("limited", |d| add(&mut d["samples"]["weight"][7], 1e-6), "samples.weight"),
    ("path", |d| add(&mut d["loops"][0]["work"], 1e-3), "loops.work"),
    ("hold", |d| add(&mut d["holds"][0]["peak"]["lag"], 1e-3), "holds.peak.lag"),
];

/// Judged by the document that the program wrote: all of it follows, and each value that is changed does not.
#[test]
fn every_value_that_does_not_follow_is_named() {
    let folder = Folder::new("claims");
    folder.write("path.csv", "t,R\n0,0\n10,10\n20,0\n");
    let run =
        "run --alpha-above 0.331 --r 1 --kick 0.3 --until 110 --sample-every 1 --tolerance 1e-6";
    for (name, line) in [
        ("run", format!("{run} --sigma 30nm")),
        ("bare", format!("{run} --history none")),
        (
            "limited",
            "run --alpha 1.2 --r 1 --kick 0.05 --depth-limit 2 --until 30 --sample-every 1".into(),
        ),
        ("path", "run --alpha 1.2 --r 1 --support-path path.csv --until 20".into()),
        ("hold", "run --alpha 1.2 --r 1 --depth-limit 2 --hold 5,5 --until 40".into()),
    ] {
        folder.prints(&format!("{line} -o {name}.json"));
        let found = folder.prints_json(&format!("verify {name}.json"));
        assert_eq!(found["differences"], json!([]), "{name}");
        validate(&folder, "verify", &found);
    }
    for (name, damage, field) in CLAIMS {
        let mut document = folder.json(&format!("{name}.json"));
        damage(&mut document);
        folder.write("claims.json", document.to_string());
        let output = folder.stickslip("verify claims.json --format json");
        assert_eq!(output.status.code(), Some(1), "{name} {field}: {}", said(&output));
        let is_named = |line: &str| line.contains(field) && line.contains("computed");
        assert!(said(&output).lines().any(is_named), "{field}: {}", said(&output));
        let found: Value = serde_json::from_slice(&output.stdout).unwrap();
        validate(&folder, "verify", &found);
        let named = |d: &Value| d["field"] == json!(field);
        let all = found["differences"].as_array().unwrap();
        assert!(all.iter().any(named), "{name} {field}: {all:?}");
        assert!(all.len() <= 2, "{name} {field}: {all:?}");
    }
}

/// A change to a document.
type Damage = fn(&mut Value);

/// The same of lines: of the head, of a sample, and of the end.
#[test]
fn every_value_of_lines_that_does_not_follow_is_named() {
    let folder = Folder::new("claims_of_lines");
    folder.prints(
        "run --alpha 1.4 --r 1 --kick 0.3 --until 110 --sample-every 1 --tolerance 1e-6 -o run.jsonl",
    );
    let text = String::from_utf8(folder.read("run.jsonl")).unwrap();
    let lines: Vec<Value> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let last = lines.len() - 1;
    let changes: [(usize, &str, Damage); 8] = [
        (0, "steady_state.lag", |d| add(&mut d["steady_state"]["lag"], 1e-6)),
        (0, "samples.t", |d| d["parameters"]["sample_every"] = json!(1.5)),
        (30, "samples.t", |d| add(&mut d["t"], 0.25)),
        (30, "samples.lag", |d| add(&mut d["lag"], 2e-5)),
        (30, "samples.velocity", |d| add(&mut d["velocity"], 0.1)),
        (last, "regime", |d| d["regime"] = json!("steady")),
        (last, "oscillation.wavelength", |d| add(&mut d["oscillation"]["wavelength"], 0.1)),
        (last, "interrupted", |d| d["interrupted"] = json!(true)),
    ];
    for (line, field, damage) in changes {
        let mut lines = lines.clone();
        damage(&mut lines[line]);
        folder.write(
            "claims.jsonl",
            lines.iter().map(|line| format!("{line}\n")).collect::<String>(),
        );
        let output = folder.stickslip("verify claims.jsonl");
        assert_eq!(output.status.code(), Some(1), "{field}: {}", said(&output));
        assert!(said(&output).contains(field), "{field}: {}", said(&output));
    }
}
