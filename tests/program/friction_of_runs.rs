//! `friction` of runs.
//!
//! Judge: tables of the same samples, split here into trace and retrace; and the work of the dense history.

use crate::folder::Folder;
use serde_json::Value;

/// Two loops of 50 σ each.
const RUN: &str = "run --tip gaussian --alpha 1.5 --r 1 --healing-time 30 --support-path path.csv --until 200 --sample-every 0.05";
const SCALES: &str = "--sigma 30nm --stiffness 0.2N/m --damping 3mNs/m";

fn column(document: &Value, name: &str) -> Vec<f64> {
    let values = document["samples"][name].as_array().unwrap();
    values.iter().map(|value| value.as_f64().unwrap()).collect()
}

/// Positions of the support and lags of the samples after one time and up to another, as a table.
fn table(
    run: &Value,
    heading: &str,
    [after, until]: [f64; 2],
    [length, force]: [f64; 2],
) -> String {
    let [t, x0, lag] = ["t", "x0", "lag"].map(|name| column(run, name));
    let rows = (0..t.len()).filter(|i| t[*i] > after && t[*i] <= until);
    let row = |i: usize| format!("{:e},{:e}\n", length * (x0[i] + lag[i]), force * lag[i]);
    format!("{heading}\n{}", rows.map(row).collect::<String>())
}

const NUMBERS: [&str; 7] =
    ["kinetic", "mean", "static_peak", "hysteresis", "work", "offset", "stiffness"];

#[track_caller]
fn same(found: &Value, wanted: &Value, within: f64) {
    for name in NUMBERS {
        let scale = wanted["kinetic"]["value"].as_f64().unwrap().abs();
        for part in ["value", "low", "high"] {
            let [a, b] = [found, wanted].map(|one| one[name][part].as_f64().unwrap());
            assert!((a - b).abs() <= within * b.abs().max(scale), "{name} {part}: {a} {b}");
        }
    }
}

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("path.csv", "t,R\n0,0\n50,50\n100,0\n150,50\n200,0\n");
    folder
}

#[test]
fn a_run_has_the_numbers_of_a_table_of_its_last_loop() {
    let folder = folder("friction_of_runs");
    folder.prints(&format!("{RUN} -o run.json"));
    let run = folder.json("run.json");
    let ways = |heading: &str, units: [f64; 2]| {
        folder.write("trace.csv", table(&run, heading, [100.0, 150.0], units));
        folder.write("retrace.csv", table(&run, heading, [150.0, 200.0], units));
    };
    ways("x,force", [1.0, 1.0]);
    let found = folder.prints_json("friction run.json");
    same(&found, &folder.prints_json("friction trace.csv retrace.csv"), 1e-12);
    let units = [&found["length_unit"], &found["force_unit"], &found["work_unit"]];
    assert_eq!(units, ["σ", "kσ", "kσ²"]);
    assert_eq!(found["parameters"]["source"], "run.json");
    assert_eq!(found["remarks"].as_array().unwrap().len(), 0, "{}", found["remarks"]);
    // The trapezoidal rule of the samples against the dense history; forces jump at the turns.
    let work = run["loops"][1]["work"].as_f64().unwrap();
    let ratio = found["work"]["value"].as_f64().unwrap() / work;
    assert!((ratio - 1.0).abs() < 0.02, "{ratio}");
    // In nN and fJ, as the tables in these units.
    folder.prints(&format!("{RUN} {SCALES} -o scaled.json"));
    ways("x_nm,force_nN", [30.0, 6.0]);
    let scaled = folder.prints_json("friction scaled.json --plot loop.svg");
    same(&scaled, &folder.prints_json("friction trace.csv retrace.csv"), 1e-12);
    let units = [&scaled["length_unit"], &scaled["force_unit"], &scaled["work_unit"]];
    assert_eq!(units, ["nm", "nN", "fJ"]);
    // With σ alone lags are deflections.
    folder.prints(&format!("{RUN} --sigma 30nm -o bent.json"));
    same(&folder.prints_json("friction bent.json --stiffness 0.2N/m"), &scaled, 1e-12);
}

/// A trace and a retrace of two runs.
#[test]
fn two_runs_are_two_tracks() {
    let folder = folder("friction_of_two_runs");
    folder.write("back.csv", "t,R\n0,0\n25,-25\n50,-50\n");
    let run = "run --tip gaussian --alpha 1.5 --r 1 --until 50 --sample-every 0.05 --start flat";
    folder.write("there.csv", "t,R\n0,0\n25,25\n50,50\n");
    folder.prints(&format!("{run} --support-path there.csv -o there.json"));
    folder.prints(&format!("{run} --support-path back.csv --start-position 64 -o back.json"));
    for name in ["there", "back"] {
        let run = folder.json(&format!("{name}.json"));
        let rows = table(&run, "x,force", [-1.0, 50.0], [1.0, 1.0]);
        folder.write(&format!("{name}_table.csv"), rows);
    }
    let found = folder.prints_json("friction there.json back.json");
    same(&found, &folder.prints_json("friction there_table.csv back_table.csv"), 1e-12);
    folder.refuses("friction there.json", &["there.json", "no closed loop", "--support-path"]);
    let mixed = "friction there.json back_table.csv";
    folder.refuses(mixed, &["back_table.csv", "is no run"]);
    folder.prints("run --alpha 1 --r 1 --until 50 -o steady.json");
    folder.refuses("friction steady.json", &["steady.json", "no closed loop"]);
    folder.prints("run --tip cosine --no-spring --alpha -28 --inertia 0.1 --healing-time 1 --until 5 -o free.json");
    folder.refuses("friction free.json", &["free.json", "no spring"]);
    folder.refuses("friction there.json back.json --stiffness 1N/m", &["--stiffness", "unit"]);
}
