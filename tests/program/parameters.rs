//! `--parameters`: a saved document is a question that can be asked again, or be changed.

use crate::folder::{Folder, said};
use serde_json::{Value, json};

/// Without the one field that differs from run to run.
fn without_seconds(mut document: Value) -> Value {
    if let Some(seconds) = document.pointer_mut("/work/seconds") {
        *seconds = Value::Null;
    }
    document
}

#[test]
fn a_saved_document_asked_again_is_the_same_document() {
    let folder = Folder::new("asked_again");
    let table: String = (0..60)
        .map(|i| f64::from(i) * 0.1)
        .map(|x| format!("{x},{}\n", (-x * x / 2.0).exp()))
        .collect();
    folder.write("tip.csv", format!("x,f\n{table}"));
    folder.write("path.csv", "t,R\n0,0\n20,20\n40,0\n");
    for line in [
        "stability --r 1",
        "stability --alpha 1.2 --solve-for r",
        "stability --tip-file tip.csv --r 1 --alpha-above 0.1 --roots 4",
        "stability --tip gaussian --r 1 --pitch 1 --path zigzag",
        "stability --r 1 --alpha 0.9 --stiffness-across 0.25 --width-y 0.8",
        "stability --tip gaussian --r 1 --pitch 2 --stiffness-across 3",
        "stability --no-spring --tip bessel --alpha -3 --healing-time 1",
        "boundary --r-range 0.5:2:5 --logarithmic",
        "boundary --tip gaussian --pitch-range 0.5:1:3 --r 1",
        "boundary --tip gaussian --pitch-range 1:2:2 --r 1 --stiffness-across 3",
        "cycle --alpha-above 0.05 --r 1 --tolerance 1e-7",
        "response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 40 --sample-at 20,30",
        "run --alpha-above 0.2 --r 1 --kick 0.05 --noise 1e-4 --seed 3 --until 60 --sample-every 0.5",
        "run --alpha 1.2 --r 1 --start paper --until 40",
        "run --alpha 0.8 --r 1 --support-path path.csv --pulse 1,20,1 --until 40",
        "run --tip cosine --no-spring --alpha -28 --inertia 0.1 --healing-time 1 --start-velocity 1 --until 5",
        "raster --tip gaussian --alpha 0.45 --r 1 --pitch 0.5 --lines 4 --length 12 --pulse 1,5,1",
        "compare --alpha 1.2 --r 1 --kick 0.05 --until 20",
        "compare --tip gaussian --alpha 0.4 --r 1 --pitch 1 --lines 2 --length 5",
    ] {
        folder.prints(&format!("{line} -o first.json"));
        let command = line.split(' ').next().unwrap();
        if command == "compare" {
            // Its times are measured.
            let again = folder.prints_json("compare --parameters first.json");
            let first = folder.json("first.json");
            assert_eq!(first["parameters"], again["parameters"], "{line}");
            assert_eq!(first["max_difference"], again["max_difference"], "{line}");
            continue;
        }
        let again = folder.prints_json(&format!("{command} --parameters first.json"));
        let first = without_seconds(folder.json("first.json"));
        assert_eq!(first, without_seconds(again), "{line}");
    }
}

#[test]
fn options_take_the_place_of_parameters() {
    let folder = Folder::new("other_parameters");
    folder.prints("cycle --tip gaussian --alpha-above 0.1 --r 1 --depth-limit 20 -o cycle.json");
    let other = folder.prints_json("cycle --parameters cycle.json --r 0.95");
    let first = folder.json("cycle.json");
    // α stays as it was found, D does not.
    assert_eq!(other["parameters"]["alpha"], first["parameters"]["alpha"]);
    assert_eq!(other["parameters"]["alpha_above"], Value::Null);
    assert_eq!(other["parameters"]["depth_limit"], json!(20.0));
    assert_eq!(other["parameters"]["tip"], first["parameters"]["tip"]);
    let above = folder.prints_json("cycle --parameters cycle.json --alpha-above 0.2");
    assert_eq!(above["parameters"]["alpha_above"], json!(0.2));
    // Of a document of another kind what fits is taken, and that is said.
    folder.prints("run --alpha 1.3 --r 1 --kick 0.05 --until 60 -o run.json");
    let output = folder.stickslip("cycle --parameters run.json --print parameters.alpha");
    assert_eq!(String::from_utf8(output.stdout.clone()).unwrap().trim(), "1.3");
    assert!(
        said(&output).contains("a document stickslip/run: its parameters alpha"),
        "{}",
        said(&output)
    );
    // Parameters alone are a file too.
    folder.write(
        "asked.json",
        r#"{"alpha": 1.3, "r": 1, "tip": {"name": "gaussian", "width": 0.5}}"#,
    );
    let asked = folder.prints_json("stability --parameters asked.json --roots 2");
    assert_eq!(asked["parameters"]["tip"]["gaussians"][0]["width"], json!(0.5));
    assert_eq!(asked["parameters"]["alpha"], json!(1.3));
}

/// What a boundary computes, or varies, is not taken from the document of a motion; in a file of parameters it is refused.
#[test]
fn a_boundary_takes_its_model_from_a_motion() {
    let folder = Folder::new("boundary_of_a_motion");
    let tip = "--tip gaussian --alpha 0.45 --r 1";
    folder.prints(&format!(
        "raster {tip} --pitch 0.5 --lines 4 --length 10 --tolerance 1e-4 -o raster.json"
    ));
    folder.prints(&format!("run {tip} --stiffness-across 0.5 --until 20 -o run.json"));
    for (motion, range, like) in [
        ("raster", "--pitch-range 0.4:0.6:3", "--r 1"),
        ("raster", "--r-range 0.5:1:3", ""),
        ("run", "--stiffness-range 0.1:1:3", "--r 1"),
    ] {
        let of = format!("boundary --parameters {motion}.json {range}");
        let plain = format!("boundary --tip gaussian {range} {like}");
        let [of, plain] = [of, plain].map(|line| without_seconds(folder.prints_json(&line)));
        assert_eq!(of, plain, "{motion} {range}");
    }
    folder.write("alpha.json", r#"{"alpha": 1.2}"#);
    folder.refuses("boundary --parameters alpha.json --r-range 0.5:1:3", &["--alpha", "leave it"]);
}

#[test]
fn parameters_that_are_none_are_refused() {
    let folder = Folder::new("no_parameters");
    for (text, words) in [
        ("", ["--parameters asked.json", "is not JSON"]),
        ("[1]", ["--parameters asked.json", "needs an object"]),
        (r#"{"alpha": 1.2, "r": 1, "kicks": 1}"#, ["--kicks", "did you mean \"kick\"?"]),
        (r#"{"alpha": 1.2, "r": 1, "pulse": [1, 5, 1]}"#, ["--pulse", "did you mean \"pulses\"?"]),
        (r#"{"aplha": 1.2, "r": 1}"#, ["--aplha", "did you mean \"alpha\"?"]),
        (
            r#"{"alpha": 1.2, "r": 1, "depth-limit": 5}"#,
            ["--depth", "did you mean \"depth_limit\"?"],
        ),
        (r#"{"alpha": 1.2, "r": 1, "zzz": 1}"#, ["--zzz", "is no parameter here: leave it out"]),
        (
            r#"{"alpha": 1.2, "r": 1, "alpha": 1.3}"#,
            ["--parameters asked.json", "is ambiguous: \"alpha\" stands twice at line 1"],
        ),
        (
            r#"{"alpha": 1.2, "r": 1, "tip": {"name": "gaussian", "width": 1, "width": 2}}"#,
            ["--parameters asked.json", "\"width\" stands twice"],
        ),
        (r#"{"alpha": "1.2", "r": 1}"#, ["--alpha 1.2", "finite number"]),
        (r#"{"alpha": 1.2, "r": 1, "tip": {"name": "round"}}"#, ["--tip", "a tip has a name"]),
        (r#"{"alpha": 1.2, "r": 1, "memory": "good"}"#, ["--memory good", "auto, direct"]),
        (r#"{"format": "stickslip/run"}"#, ["--parameters asked.json", "without"]),
    ] {
        folder.write("asked.json", text);
        folder.refuses("run --parameters asked.json --until 30", &words);
    }
    folder.refuses("run --parameters none.json", &["--parameters none.json", "cannot be read"]);
}

#[test]
fn a_document_with_a_parameter_that_stands_twice_is_damaged() {
    let folder = Folder::new("parameter_twice");
    folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 20 -o run.json");
    let text = std::fs::read_to_string(folder.path("run.json")).unwrap();
    let twice = text.replacen("\"r\":", "\"r\":2.0,\"r\":", 1);
    assert_ne!(text, twice);
    folder.write("run.json", twice);
    folder.refuses("surface run.json --at 10", &["run.json", "\"r\" stands twice"]);
}
