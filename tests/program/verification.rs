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
    for words in ["tolerance is not kept", "trust it until t =", "--tolerance"] {
        assert!(said(&output).contains(words), "{}", said(&output));
    }
    let document = folder.json("broken.json");
    validate(&folder, "run", &document);
    assert_eq!(document["verification"]["kept"], json!(false));
    assert_eq!(folder.stickslip("verify broken.json").status.code(), Some(1));
    // One whose samples are not those of its history.
    for field in ["l", "x0"] {
        let mut other = folder.json("run.json");
        let sample = &mut other["samples"][field][700];
        *sample = json!(sample.as_f64().unwrap() + 2e-9);
        folder.write("other.json", other.to_string());
        let t = other["samples"]["t"][700].to_string();
        folder.refuses("verify other.json", &["RUN.json other.json", &t, "those of the history"]);
    }
    // One with a history that is that of another run.
    let mut other = folder.json("run.json");
    other["parameters"]["alpha"] = json!(1.200_001);
    folder.write("other.json", other.to_string());
    folder.refuses("verify other.json", &["RUN.json other.json", "it lasts from"]);
    folder.refuses(&format!("{good} --verify -o run.jsonl"), &["--verify", ".json"]);
}
