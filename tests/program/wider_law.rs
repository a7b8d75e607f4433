//! The wider law on the command line: what it writes, and what it refuses.

use crate::folder::Folder;
use crate::runs::{assert_same, schema, validate, without_seconds};

const PATH: &str = "t,R\n0,0\n10,12\n15,12\n25,0\n35,12\n45,0\n";

/// Runs under each extension and some together, which every format and every reader of runs takes.
const RUNS: [(&str, &str); 7] = [
    ("limit", "--alpha 2.6 --beta 0 --r 1 --depth-limit 20 --kick 0.05 --until 40"),
    ("corner", "--alpha 1.3 --r 1 --depth-limit 5 --kick 0.05 --until 40"),
    ("healing", "--alpha 1.5 --r 1 --healing-time 10 --kick 0.05 --until 40"),
    ("inertia", "--alpha 1.2 --r 1 --inertia 0.3 --kick 0.05 --until 40"),
    ("all", "--alpha 2 --r 1 --depth-limit 4 --healing-time 15 --inertia 0.3 --until 40"),
    ("loops", "--alpha 1.1 --beta 0 --r 1 --depth-limit 3 --support-path path.csv --until 45"),
    (
        "free",
        "--tip cosine --no-spring --alpha -28 --inertia 0.1 --healing-time 1 --start-velocity 1 --until 8",
    ),
];

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("path.csv", PATH);
    folder
}

#[test]
fn runs_are_documents_that_every_reader_takes() {
    let folder = folder("wider_documents");
    let run = schema(&folder, "run");
    for (name, line) in RUNS {
        folder.prints(&format!("run {line} -o {name}.json --plot {name}.svg"));
        let document = folder.json(&format!("{name}.json"));
        validate(&run, &document);
        let samples = &document["samples"];
        let limited = line.contains("--depth-limit");
        assert_eq!(samples["height"].is_array(), limited, "{name}");
        assert_eq!(samples["weight"].is_array(), limited, "{name}");
        assert_eq!(document["history"]["height"].is_array(), limited, "{name}");
        let dragged = !line.contains("--support-path") && !line.contains("--no-spring");
        assert_eq!(samples["l"].is_array(), dragged, "{name}");
        assert_eq!(samples["lag"].is_array(), !line.contains("--no-spring"), "{name}");
        assert_eq!(document["loops"].is_array(), line.contains("--support-path"), "{name}");
        let verified = folder.prints_json(&format!("verify {name}.json"));
        assert_eq!(verified["verification"]["kept"], true, "{name}: {verified}");
        let until = document["parameters"]["until"].as_f64().unwrap();
        if name != "free" {
            let surface =
                folder.prints_json(&format!("surface {name}.json --at {until} --x 20,30"));
            assert!(surface["surfaces"][0]["u"][0].is_number(), "{name}: {surface}");
        }
        folder.prints(&format!("run {line} -o {name}.jsonl --sample-every 0.5"));
        let verified = folder.prints_json(&format!("verify {name}.jsonl"));
        assert_eq!(verified["verification"]["kept"], true, "{name}: {verified}");
        for format in ["csv", "npz"] {
            folder.prints(&format!("run {line} -o {name}.{format}"));
        }
        folder.prints(&format!("plot {name}.json -o {name}.pdf"));
    }
    let path = folder.json("loops.json");
    let loops = path["loops"].as_array().unwrap();
    assert_eq!(loops.len(), 2, "{loops:?}");
    assert!(loops.iter().all(|found| found["work"].as_f64().unwrap() > 0.0), "{loops:?}");
    assert_eq!(folder.json("free.json")["steady_state"], serde_json::Value::Null);
}

/// The peaks of the table in docs/findings, and the largest of closely spaced samples.
#[test]
fn the_peak_after_a_hold_is_in_document_and_summary() {
    let folder = folder("hold");
    let line = "run --alpha 0.8 --beta 0 --r 1 --sample-every 0.005";
    for (law, hold, known) in [
        ("--depth-limit 1", 1, 1.525),
        ("--depth-limit 1", 10, 2.151),
        ("--depth-limit 1", 100, 3.308),
        ("", 10, 8.53),
    ] {
        let until = hold + 50;
        folder.prints(&format!("{line} {law} --hold 20,{hold} --until {until} -o h.json"));
        let document = folder.json("h.json");
        let [found] = &document["holds"].as_array().unwrap()[..] else { unreachable!("one hold") };
        assert_eq!(
            (&found["from"], &found["to"]),
            (&serde_json::json!(20.0), &serde_json::json!(20.0 + f64::from(hold)))
        );
        let (t, lag) = (&found["peak"]["t"], found["peak"]["lag"].as_f64().unwrap());
        assert!((lag - known).abs() < 6e-4 * known.max(5.0), "{law} {hold}: {lag} {known}");
        let column = |name: &str| document["samples"][name].as_array().unwrap().clone();
        let moving = column("t").iter().position(|t| t.as_f64() > found["to"].as_f64()).unwrap();
        let lags = column("lag").into_iter().skip(moving).filter_map(|lag| lag.as_f64());
        let largest = lags.fold(0.0, f64::max);
        assert!(largest <= lag && lag - largest < 2e-5, "{law} {hold}: {lag} {largest} at {t}");
    }
    let line = format!("{line} --hold 20,10");
    let text = folder.prints(&format!("{line} --until 60 --format text"));
    let text = String::from_utf8(text).unwrap();
    assert!(text.contains("peak after the hold") && text.contains("8.5256"), "{text}");
    let document = folder.prints_json(&format!("{line} --until 31"));
    assert_eq!(document["holds"][0]["peak"], serde_json::Value::Null);
}

/// The grid forms its own steady past, weights and fading.
#[test]
fn the_grids_solve_the_wider_law_too() {
    let folder = folder("wider_compare");
    for (name, line) in RUNS.into_iter().filter(|(name, _)| *name != "free") {
        // A grid does not see the corner of |h| that it steps over: at 1e-9 it errs by up to 6e-8 there.
        folder.prints(&format!("compare {line} --tolerance 1e-10 -o {name}.json"));
        let differences = &folder.json(&format!("{name}.json"))["max_difference"];
        for of in ["x0", "u"] {
            let largest = differences[of].as_f64().unwrap();
            println!("{name} {of} {largest:.1e}");
            assert!(largest < 5e-8, "{name} {of}: {largest:e}");
        }
        for grid in ["windowed", "uniform"] {
            let line = format!("compare {line} --grid {grid} --grid-until 20 -o {name}.json");
            folder.prints(&line);
            let differences = &folder.json(&format!("{name}.json"))["max_difference"];
            for of in ["x0", "u"] {
                let largest = differences[of].as_f64().unwrap();
                assert!(largest < 1e-3, "{name} {grid} {of}: {largest:e}");
            }
        }
    }
}

/// A run broken by a checkpoint writes what the run would have written.
#[test]
fn checkpoints_of_the_wider_law_go_on_to_the_same_bytes() {
    let folder = folder("wider_checkpoints");
    for (name, line) in RUNS {
        for output in ["json", "jsonl"] {
            let made = format!("run {line} -o {name}.{output} --checkpoint {name}.checkpoint");
            folder.prints(&made);
            let whole = folder.read(&format!("{name}.{output}"));
            folder.prints(&format!("run --resume {name}.checkpoint"));
            let resumed = folder.read(&format!("{name}.{output}"));
            assert_same(&without_seconds(&whole), &without_seconds(&resumed), name);
        }
    }
}

#[test]
fn what_makes_no_sense_is_refused_by_name() {
    let folder = folder("wider_refusals");
    for option in ["--depth-limit", "--healing-time", "--inertia"] {
        for value in ["0", "-1", "nan", "inf"] {
            let line = format!("run --alpha 1 --r 1 --until 30 {option} {value}");
            let is_finite = value.parse::<f64>().unwrap().is_finite();
            folder.refuses(&line, &[option, if is_finite { "above 0" } else { "finite" }]);
        }
    }
    folder.refuses("run --alpha -1 --r 1 --until 30", &["--alpha", "without a spring"]);
    folder.refuses("run --alpha -1 --r 1 --no-spring --until 30", &["--r", "leave it out"]);
    let path = "--support-path path.csv";
    folder.refuses(&format!("run --alpha 1 --r 1 --until 50 {path}"), &["--support-path", "45"]);
    folder.refuses(&format!("run --alpha 1 --no-spring --until 30 {path}"), &["--support-path"]);
    folder.write("back.csv", "t,R\n0,0\n10,1\n10,2\n40,3\n");
    let back = "run --alpha 1 --r 1 --until 30 --support-path back.csv";
    folder.refuses(back, &["--support-path back.csv", "row 3"]);
    folder.write("late.csv", "t,R\n1,0\n10,1\n40,3\n");
    let late = "run --alpha 1 --r 1 --until 30 --support-path late.csv";
    folder.refuses(late, &["--support-path late.csv", "0,0"]);
    folder.refuses("run --alpha 1 --r 1 --until 30 --tip cosine", &["--start steady", "flat"]);
    folder.refuses("run --alpha 1 --r 1 --until 30 --start-velocity 2", &["--start-velocity"]);
}

/// `stability` under the wider law: reference values found by two prototypes, a spectral PDE and direct
/// sums.
#[test]
fn linear_theory_knows_the_wider_law() {
    let folder = folder("wider_stability");
    let stability = schema(&folder, "stability");
    let critical = |line: &str| {
        let document = folder.prints_json(&format!("stability --r 1 {line}"));
        validate(&stability, &document);
        let critical = document["critical"].clone();
        (critical["alpha"].as_f64().unwrap(), critical["kind"].clone())
    };
    for (line, alpha, kind) in [
        ("--beta 0 --depth-limit 20", 2.300_070, "smooth"),
        ("--beta 0 --depth-limit 5", 5.197_881, "smooth"),
        ("--healing-time 10", 1.340_504, "smooth"),
        ("--beta 0 --healing-time 10", 2.403_020, "smooth"),
        ("--depth-limit 5", 1.073_134, "non-smooth"),
    ] {
        let found = critical(line);
        assert!((found.0 - alpha).abs() < 1e-6, "{line}: {}", found.0);
        assert_eq!(found.1, kind, "{line}");
    }
    folder.refuses("stability --r 1 --beta 0 --depth-limit 1.6", &["--r 1"]);
    folder.refuses("boundary --no-spring --r-range 1:2:3", &["--no-spring"]);
    // --alpha-above counts from the onset of the law asked for.
    let run = folder.prints_json(
        "run --r 1 --beta 0 --depth-limit 20 --alpha-above 0.3 --kick 0.05 --until 600",
    );
    let alpha = run["parameters"]["alpha"].as_f64().unwrap();
    assert!((alpha - 2.600_070).abs() < 1e-6, "{alpha}");
    assert_eq!(run["regime"], "stick-slip", "{}", run["transient"]);
    // A small response, against a run with the pulse and one without.
    let pulse = "--alpha 2 --beta 0 --r 1 --depth-limit 20 --until 40 --sample-every 1";
    let linear = folder.prints_json(&format!("response {pulse} --pulse 1e-4,20,0.5"));
    let run = folder.prints_json(&format!("run {pulse} --pulse 1e-4,20,0.5 --tolerance 1e-12"));
    let column = |of: &serde_json::Value| -> Vec<f64> {
        of.as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let (l, by_theory) = (column(&run["samples"]["l"]), column(&linear["samples"]["l"]));
    for (l, by_theory) in l.iter().zip(&by_theory) {
        assert!((l - by_theory).abs() < 1e-7, "{l} {by_theory}");
    }
}
