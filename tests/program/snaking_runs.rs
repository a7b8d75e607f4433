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

/// Motions that ring while they settle: a maximum may hardly change in a period though the amplitude is far from its limit.
/// Judged by runs of twenty times the length.
#[test]
fn the_limit_of_a_snaking_line_lies_within_its_errors() {
    let folder = Folder::new("snaking_errors");
    let cases = [
        ("--r 1.685 --stiffness-across 0.312 --inertia 0.057 --alpha 2.7399", 150),
        (
            "--r 0.931 --stiffness-across 0.265 --inertia 0.243 --healing-time 25.71 --alpha 0.8995",
            400,
        ),
        ("--r 1.203 --stiffness-across 0.271 --alpha 1.2779", 150),
        ("--r 0.719 --stiffness-across 0.482 --alpha 0.6963", 700),
    ];
    for (case, until) in cases {
        let [short, long] = [1, 20].map(|times| {
            let line =
                format!("run {case} --kick-across 0.3 --history none --until {}", times * until);
            folder.prints_json(&line)
        });
        assert_eq!([&short["regime"], &long["regime"]], ["snaking"; 2], "{case}");
        for name in ["period", "amplitude_y0", "amplitude_x0"] {
            let difference =
                (number(&short["snaking"][name]) - number(&long["snaking"][name])).abs();
            let error = |run: &Value| number(&run["snaking"][format!("{name}_error")]);
            let part = difference / (error(&short) + error(&long));
            println!("{name}: {difference:e}, {part} of the error");
            assert!(part < 1.0, "{case}, {name}: {difference:e}, {part}");
        }
    }
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

/// A run without the time that it took.
fn timeless(mut document: Value) -> Value {
    document["work"]["seconds"] = Value::Null;
    document
}

/// With a depth limit and noise; resumed from its last checkpoint a run ends as it did.
#[test]
fn runs_across_are_written_as_lines_saved_and_resumed() {
    let folder = Folder::new("across_resumed");
    let line = "run --alpha 1.2 --r 1 --stiffness-across 0.3 --kick-across 0.1 --depth-limit 8 --noise 0.001 \
                --noise-spacing-across 0.7 --until 90 --sample-every 3 --checkpoint-every 17";
    for (name, options) in
        [("run.json", "--plot run.svg"), ("alone.json", "--history none"), ("run.jsonl", "")]
    {
        folder.prints(&format!("{line} -o {name} --checkpoint run.ck {options}"));
        let whole = String::from_utf8(folder.read(name)).unwrap();
        folder.prints("run --resume run.ck");
        let resumed = String::from_utf8(folder.read(name)).unwrap();
        let lines = |text: &str| -> Vec<Value> {
            let text =
                if name.ends_with("jsonl") { text.to_owned() } else { text.replace('\n', " ") };
            text.lines().map(|line| timeless(serde_json::from_str(line).unwrap())).collect()
        };
        assert!(lines(&whole) == lines(&resumed), "{name}");
    }
    let run = folder.json("run.json");
    validate(&schema(&folder, "run"), &run);
    let heights = run["samples"]["height"].as_array().unwrap();
    assert!(heights.len() == run["samples"]["y0"].as_array().unwrap().len());
    let lines = String::from_utf8(folder.read("run.jsonl")).unwrap();
    let lines: Vec<Value> = lines.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let y0: Vec<&Value> = lines[1..lines.len() - 1].iter().map(|line| &line["y0"]).collect();
    assert_eq!(y0, run["samples"]["y0"].as_array().unwrap().iter().collect::<Vec<_>>());
    let last = &lines[lines.len() - 1];
    assert_eq!((&last["regime"], last.get("snaking")), (&run["regime"], run.get("snaking")));
}

/// A ridge beside the line pushes the tip off it, and a table that does not depend on y is a profile.
#[test]
fn tables_across_are_read() {
    let folder = Folder::new("snaking_tables");
    let table = |height: &dyn Fn(f64, f64) -> f64| {
        let points =
            (0..30).flat_map(|i| (-4..=4).map(move |j| (f64::from(i) + 8.0, f64::from(j))));
        points.fold("x,y,u\n".to_owned(), |text, (x, y)| {
            text + &format!("{x},{y},{}\n", height(x, y))
        })
    };
    folder.write("ridge.csv", table(&|_, y| 0.5 * (-0.5 * (y - 1.0) * (y - 1.0)).exp()));
    folder.write("waves.csv", table(&|x, _| 0.2 * x.sin()));
    let waves: String =
        (0..30).map(|i| f64::from(i) + 8.0).map(|x| format!("{x},{}\n", 0.2 * x.sin())).collect();
    folder.write("profile.csv", waves);
    let line = "run --alpha 1 --r 1 --stiffness-across 0.5 --until 30 --sample-every 1";
    let ridge = folder.prints_json(&format!("{line} --initial-surface-across ridge.csv"));
    let y0 = |run: &Value| number(run["samples"]["y0"].as_array().unwrap().last().unwrap());
    assert!(y0(&ridge) < -0.05, "{}", y0(&ridge));
    folder.write("ridge.json", ridge.to_string());
    let again = folder.prints_json("run --parameters ridge.json");
    assert_eq!(again["samples"], ridge["samples"]);
    let [one, other] = ["--initial-surface-across waves.csv", "--initial-surface profile.csv"]
        .map(|option| folder.prints_json(&format!("{line} {option}")));
    let x0 = |run: &Value| -> Vec<f64> {
        run["samples"]["x0"].as_array().unwrap().iter().map(number).collect()
    };
    assert!(x0(&one).iter().zip(x0(&other)).all(|(a, b)| (a - b).abs() < 1e-8));
    folder.write("holes.csv", "x,y,u\n0,0,1\n1,0,1\n0,1,1\n");
    let holes = format!("{line} --initial-surface-across holes.csv");
    folder.refuses(&holes, &["--initial-surface-across holes.csv", "no grid"]);
}

/// Thresholds of the project's description of the wider law; without healing they are r² times a function of κ_y/r.
#[test]
fn the_boundary_of_snaking_is_that_of_its_thresholds() {
    let folder = Folder::new("snaking_boundary");
    let line = "boundary --stiffness-range 0.25:1:4 --r 1";
    folder.prints(&format!("{line} -o snaking.json --plot snaking.svg"));
    let found = folder.json("snaking.json");
    validate(&schema(&folder, "snaking-boundary"), &found);
    let column = |found: &Value, name: &str| -> Vec<f64> {
        found[name].as_array().unwrap().iter().map(number).collect()
    };
    let alpha = column(&found, "alpha");
    for (i, known) in [(0, 0.8305410127), (1, 1.0178937663), (3, 1.4162744581)] {
        assert!((alpha[i] - known).abs() < 1e-9, "{}", alpha[i]);
    }
    assert!((column(&found, "wavelength")[0] - 17.14).abs() < 0.01);
    let crossing = &found["crossings"][0];
    assert!((number(&crossing["stiffness"]) - 0.5662).abs() < 5e-5, "{crossing}");
    assert!((number(&crossing["alpha"]) - 1.069036174947).abs() < 1e-9, "{crossing}");
    let faster = folder.prints_json("boundary --r-range 1:2:2 --stiffness-across 0.5");
    let alpha = column(&faster, "alpha");
    assert!((alpha[0] - 1.0178937663).abs() < 1e-9 && (alpha[1] / 4.0 - 0.8305410127).abs() < 1e-9);
    let picture = String::from_utf8(folder.read("snaking.svg")).unwrap();
    assert!(picture.contains("stick-slip") && picture.contains("wavelength of snaking"));
    for (options, words) in [
        ("--stiffness-range 0.1:1:3", ["r", "needed"]),
        ("--stiffness-range 0.1:1:3 --r 1 --r-range 1:2:2", ["--stiffness-range", "--r-range"]),
        ("--r-range 1:2:2 --stiffness-across 1 --r 1", ["--r 1", "leave one of them out"]),
        ("--stiffness-range 0:1:3 --r 1", ["--stiffness-range 0:1:3", "above 0"]),
    ] {
        folder.refuses(&format!("boundary {options}"), &words);
    }
}

/// The surface under the tip has the height that the run knows, and an image on the line is the curve.
#[test]
fn surfaces_of_runs_across_are_those_that_their_tip_left() {
    let folder = Folder::new("across_surfaces");
    let line = "run --alpha 1.2 --r 1 --stiffness-across 0.3 --kick-across 0.3 --depth-limit 5 --until 40 --sample-at 30";
    folder.prints(&format!("{line} -o run.json"));
    let run = folder.json("run.json");
    let sample = |name: &str| number(&run["samples"][name][0]);
    let (x0, y0) = (sample("x0"), sample("y0"));
    assert!(y0.abs() > 0.01, "{y0}");
    let image = folder
        .prints_json(&format!("surface run.json --at 30 --x {x0} --y-range {y0}:{}:2", y0 + 1.0));
    validate(&schema(&folder, "surface"), &image);
    let height = number(&image["images"][0]["u"][0][0]);
    assert!((height - sample("height")).abs() < 2e-8, "{height} {}", sample("height"));
    let range = "surface run.json --at 30,40 --range 10:30 --spacing 0.5";
    let curve = folder.prints_json(range);
    folder.prints(&format!("{range} --y-range 0:1:3 -o image.json --plot image.svg"));
    let image = folder.json("image.json");
    assert_eq!(curve["surfaces"][1]["u"], image["images"][1]["u"][0]);
    folder.prints("surface run.json --at 30 --y-range -2:2:21 --spacing 0.2 -o image.gsf");
    let mut damaged = run;
    damaged["history"]["y0"][3][0] = json!(7.0);
    folder.write("damaged.json", damaged.to_string());
    folder.refuses("surface damaged.json", &["damaged", "y0 of step"]);
}

/// Other memories make other errors; each run is resumed, and verified by another one.
#[test]
fn each_memory_follows_a_tip_across_the_scan() {
    let folder = Folder::new("memories_across");
    let line = "run --alpha 1.2 --r 1 --stiffness-across 0.25 --kick-across 0.3 --until 40";
    let times = "--sample-at 20,30,40";
    let by_modes = folder.prints_json(&format!("{line} {times}"));
    assert_eq!(by_modes["work"]["memory"], "modes");
    for memory in ["direct", "fft"] {
        let line = format!("{line} --memory {memory}");
        folder.prints(&format!("{line} {times} --verify -o run.json"));
        let run = folder.json("run.json");
        assert_eq!(run["work"]["memory"], memory);
        assert_eq!(run["verification"]["kept"], true);
        let other = if memory == "fft" { "direct" } else { "fft" };
        assert_eq!(run["verification"]["memory"], other);
        for name in ["l", "y0"] {
            for i in 0..3 {
                let [a, b] = [&run, &by_modes].map(|run| number(&run["samples"][name][i]));
                assert!((a - b).abs() < 5e-9 && (a - b).abs() > 0.0, "{memory} {name}: {a} {b}");
            }
        }
        folder.prints(&format!("{line} -o whole.json --checkpoint run.ck --checkpoint-every 17"));
        let whole = timeless(folder.json("whole.json"));
        folder.prints("run --resume run.ck");
        assert!(whole == timeless(folder.json("whole.json")), "{memory}");
    }
}

#[test]
fn what_is_not_there_across_the_scan_is_refused_by_name() {
    let folder = Folder::new("snaking_refused");
    let line = "run --alpha 1 --r 1 --until 40";
    folder.prints(&format!("{line} --stiffness-across 1 -o run.json"));
    for (options, words) in [
        ("--stiffness-across 0", ["--stiffness-across 0", "above 0"]),
        ("--stiffness-across nan", ["--stiffness-across NaN", "finite"]),
        ("--kick-across 0.1", ["--kick-across 0.1", "--stiffness-across"]),
        ("--width-y 2", ["--width-y 2", "--stiffness-across"]),
        ("--stiffness-across 1 --tip bessel", ["--width-y", "give the width"]),
        ("--stiffness-across 1 --tip bessel --width-y 1 --start flat", ["--tip", "walkers"]),
        (
            "--noise 0.1 --noise-spacing-across 1",
            ["--noise-spacing-across 1", "--stiffness-across"],
        ),
        ("--stiffness-across 1 --noise-spacing-across 1", ["--noise-spacing-across 1", "--noise"]),
        (
            "--stiffness-across 1 --noise 0.1 --noise-spacing-across 0",
            ["--noise-spacing-across 0", "apart"],
        ),
    ] {
        folder.refuses(&format!("{line} {options}"), &words);
    }
    let mut rough = "x,y,f\n".to_string();
    for (i, j) in (0..69).flat_map(|j| (0..69).map(move |i| (i, j))) {
        let (x, y) = (0.125 * f64::from(i), 0.125 * f64::from(j));
        let noise = 1.0 + 0.05 * (1e4 * (12.9 * x + 78.2 * y).sin()).fract();
        rough += &format!("{x},{y},{:e}\n", noise * (-0.2 * (x * x + y * y)).exp());
    }
    folder.write("rough.csv", rough);
    folder.refuses(
        &format!("{line} --stiffness-across 1 --tip-file rough.csv"),
        &["products", "smooth its table"],
    );
    folder.refuses("surface run.json --far-behind", &["--far-behind", "held on its line"]);
    folder.refuses("surface run.json --y-range -1:1 --width-y 1", &["--width-y", "set by the run"]);
    let remarks = said(&folder.stickslip(&format!("{line} --stiffness-across 1 -o other.json")));
    assert!(remarks.contains("steady"), "{remarks}");
}
