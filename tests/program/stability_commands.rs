//! `stability`, `boundary`, `response` and `units` as a user meets them: documents that keep to their
//! schemas and agree with the library and with each other, figures that are there, and input that is
//! refused with a word of advice. What the figures are worth is judged in crates/tip/tests and in
//! stability_against_runs.rs.

use super::units_command::GIVEN;
use serde_json::Value;
use std::path::PathBuf;
use std::process::Output;
use stickslip_stability::{critical, onset, trapping_alpha};
use stickslip_tip::{TipFunction, Wider};

fn stickslip(arguments: &[&str]) -> Output {
    assert_cmd::Command::cargo_bin("stickslip").unwrap().args(arguments).output().unwrap()
}

/// The words of a command line without quotes.
fn words(line: &str) -> Vec<&str> {
    line.split_whitespace().collect()
}

/// Standard output of a command that succeeds.
fn printed(line: &str) -> String {
    let output = stickslip(&words(line));
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(output.status.success(), "{line}: {stderr}");
    assert!(stderr.is_empty(), "{line}: {stderr}");
    String::from_utf8(output.stdout).unwrap()
}

/// The document that a command prints, after its schema has judged it.
pub(super) fn document(line: &str) -> Value {
    let name = words(line)[0];
    let schema: Value = serde_json::from_str(&printed(&format!("schema {name}"))).unwrap();
    let document: Value = serde_json::from_str(&printed(line)).unwrap();
    let validator = jsonschema::validator_for(&schema).unwrap();
    let errors: Vec<String> = validator.iter_errors(&document).map(|e| e.to_string()).collect();
    assert!(errors.is_empty(), "{line}: {errors:?}");
    assert_eq!(document["format"], format!("stickslip/{name}"));
    assert_eq!(document["software"]["name"], "stickslip");
    document
}

fn numbers(column: &Value) -> Vec<f64> {
    column.as_array().unwrap().iter().map(|v| v.as_f64().unwrap()).collect()
}

pub(super) fn close(found: &Value, wanted: f64, tolerance: f64) {
    let found = found.as_f64().unwrap();
    assert!((found - wanted).abs() <= tolerance * wanted.abs(), "{found} for {wanted}");
}

/// A fresh place for a file of this test.
fn place(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("stability_commands");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    let _ = std::fs::remove_file(&path);
    path
}

pub(super) fn triple() -> TipFunction {
    TipFunction::triple_gaussian(1.0, 1.0).unwrap()
}

#[test]
fn without_alpha_the_roots_are_those_of_the_critical_point() {
    let found = document("stability --r 1");
    let (at, born) =
        (critical(&Wider::default(), &triple(), 1.0).unwrap(), onset(&triple(), 1.0).unwrap());
    close(&found["critical"]["alpha"], at.alpha, 0.0);
    close(&found["critical"]["omega"], at.omega, 0.0);
    close(&found["critical"]["period"], at.period, 0.0);
    close(&found["critical"]["wavelength"], at.wavelength, 0.0);
    close(&found["trapping"]["alpha"], trapping_alpha(&triple(), 1.0).unwrap(), 0.0);
    close(&found["onset"]["amplitude_squared_slope"], born.amplitude_squared_slope, 0.0);
    assert_eq!(found["onset"]["criticality"], "supercritical");
    assert_eq!(found["parameters"]["at_critical_point"], true);
    assert_eq!(found["stable"], false);
    assert!(found["roots"][0]["re"].as_f64().unwrap().abs() < 1e-14);
    close(&found["roots"][0]["im"], at.omega, 1e-14);
    assert_eq!(found["remarks"], serde_json::json!([]));
}

#[test]
fn solving_for_r_is_the_inverse_of_solving_for_alpha() {
    let at_alpha = document("stability --alpha 0.7 --solve-for r --tip gaussian");
    let r = at_alpha["critical"]["r"].as_f64().unwrap();
    let at_r = document(&format!("stability --r {r} --tip gaussian"));
    close(&at_r["critical"]["alpha"], 0.7, 1e-12);
    close(&at_alpha["parameters"]["r"], r, 0.0);
    // With r given as well, it is there that the roots are listed.
    let elsewhere = document("stability --alpha 0.7 --r 2 --solve-for r --tip gaussian");
    close(&elsewhere["critical"]["r"], r, 0.0);
    assert_eq!(elsewhere["stable"], true);
}

#[test]
fn the_certificate_is_complete_and_the_roots_fall() {
    for model in [
        "--r 1 --alpha 1.2",
        "--r 0.01 --alpha 0.002",
        "--r 100 --alpha-above 10 --beta 0.5",
        "--r 1 --alpha 0 --roots 1",
        "--r 1 --alpha 2.5 --re-above=-4",
        "--r 2 --alpha 3 --tip bessel --roots 1",
        "--r 1 --alpha 1.2 --roots 60",
    ] {
        let found = document(&format!("stability {model}"));
        let certificate = &found["certificate"];
        let roots = found["roots"].as_array().unwrap();
        assert_eq!(certificate["complete"], true, "{model}");
        assert_eq!(certificate["counted"], certificate["found"]);
        assert_eq!(certificate["counted"].as_u64().unwrap(), roots.len() as u64);
        let re: Vec<f64> = roots.iter().map(|z| z["re"].as_f64().unwrap()).collect();
        assert!(re.is_sorted_by(|a, b| a >= b), "{model}: {re:?}");
        assert!(re.iter().all(|re| *re >= certificate["re_min"].as_f64().unwrap()));
        assert_eq!(found["stable"], re[0] < 0.0, "{model}");
    }
}

#[test]
fn what_cannot_be_had_is_null_and_a_remark_says_why() {
    // α = 0: one root, and no oscillation is born at any r.
    let still = document("stability --r 1 --alpha 0");
    assert_eq!(still["roots"], serde_json::json!([{"re": -1.0, "im": 0.0}]));
    assert!(still["remarks"][0].as_str().unwrap().contains("1 of 10"), "{}", still["remarks"]);
    // J0 turned over: the spring and the surface pull the same way.
    let tip = place("inverted.json");
    let inverted = r#"{"gaussians":[{"amplitude":-1,"center":0,"width":1}]}"#;
    std::fs::write(&tip, inverted).unwrap();
    let inverted = document(&format!("stability --r 1 --alpha 1 --tip-file {}", tip.display()));
    for field in ["critical", "onset"] {
        assert!(inverted[field].is_null(), "{inverted}");
    }
    assert!(inverted["trapping"]["alpha"].is_null());
    assert!(inverted["remarks"][0].as_str().unwrap().contains("stable for every alpha"));
}

#[test]
fn a_boundary_is_the_critical_alpha_of_every_r() {
    let found = document("boundary --r-range 0.05,3 --points 7");
    let (r, alpha) = (numbers(&found["r"]), numbers(&found["alpha"]));
    assert_eq!(r.len(), 7);
    assert!((r[0] - 0.05).abs() < 1e-16 && (r[6] - 3.0).abs() < 1e-16);
    for i in 0..7 {
        let (at, born) = (
            critical(&Wider::default(), &triple(), r[i]).unwrap(),
            onset(&triple(), r[i]).unwrap(),
        );
        assert!((alpha[i] / at.alpha - 1.0).abs() < 1e-13);
        close(&found["Omega"][i], at.omega / r[i], 1e-13);
        let slope = &found["onset"]["amplitude_squared_slope"][i];
        close(slope, born.amplitude_squared_slope, 1e-11);
        assert_eq!(found["onset"]["criticality"][i], "supercritical");
    }
    let logarithmic = document("boundary --r-range 0.01,100 --points 5 --logarithmic");
    for (r, wanted) in numbers(&logarithmic["r"]).iter().zip([0.01, 0.1, 1.0, 10.0, 100.0]) {
        assert!((r / wanted - 1.0).abs() < 1e-14);
    }
}

#[test]
fn further_crossings_are_branches_above_the_boundary() {
    let found = document("boundary --beta=-1 --r-range 0.01,2 --points 100");
    let branches = found["branches"].as_array().unwrap();
    assert_eq!(branches.len(), 2);
    let tip = TipFunction::triple_gaussian(-1.0, 1.0).unwrap();
    for branch in branches {
        assert!(numbers(&branch["Omega"]).is_sorted());
        for (r, alpha) in numbers(&branch["r"]).iter().zip(numbers(&branch["alpha"])) {
            assert!(
                alpha >= critical(&Wider::default(), &tip, *r).unwrap().alpha * (1.0 - 1e-9),
                "{r} {alpha}"
            );
        }
    }
    assert_eq!(document("boundary --r-range 0.01,2")["branches"].as_array().unwrap().len(), 1);
}

#[test]
fn the_modes_of_a_response_add_up_to_its_samples() {
    let line = "response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --pulse=-2e-4,34,0.3 --until 60 \
                --sample-every 0.5";
    let found = document(line);
    let of = |name: &str| numbers(&found["samples"][name]);
    let (t, l, deviation) = (of("t"), of("l"), of("deviation"));
    let (origin, from) = (found["origin"].as_f64().unwrap(), found["valid_from"].as_f64().unwrap());
    assert!((origin - 34.0).abs() < 1e-15 && from > 34.0 && from < 40.0, "{from}");
    let part = |mode: &Value, t: f64| {
        let of = |name: &str, part: &str| mode[name][part].as_f64().unwrap();
        let since = t - origin;
        let (sine, cosine) = (of("lambda", "im") * since).sin_cos();
        (of("lambda", "re") * since).exp()
            * (of("residue", "re") * cosine - of("residue", "im") * sine)
    };
    let steady = found["steady_state"]["l"].as_f64().unwrap();
    for i in 0..t.len() {
        assert!((l[i] - steady - deviation[i]).abs() < 1e-15);
        let sum: f64 = found["modes"].as_array().unwrap().iter().map(|mode| part(mode, t[i])).sum();
        if t[i] > from {
            assert!((sum - deviation[i]).abs() < 1e-11, "{} {sum} {}", t[i], deviation[i]);
        }
        if t[i] < 25.0 {
            assert!(deviation[i].abs() < 1e-15, "nothing happens before the pulse");
        }
    }
}

#[test]
fn a_response_and_a_run_are_sampled_at_the_same_times() {
    let options = "--alpha 0.9 --r 1 --pulse 1e-5,30,0.5 --until 45 --sample-every 0.5";
    let found = document(&format!("response {options}"));
    let run: Value =
        serde_json::from_str(&printed(&format!("run {options} --tolerance 1e-12"))).unwrap();
    assert_eq!(found["samples"]["t"], run["samples"]["t"]);
    let from = found["valid_from"].as_f64().unwrap();
    let (t, l) = (numbers(&found["samples"]["t"]), numbers(&found["samples"]["l"]));
    for ((t, response), run) in t.iter().zip(l).zip(numbers(&run["samples"]["l"])) {
        // 1e-5 of a response of 1e-5 is of second order in the pulse.
        assert!(*t < from || (response - run).abs() < 1e-9, "{t}: {response} {run}");
    }
}

/// The modes that follow those listed, from which `valid_from` comes, belong to lobes of height 5e-9; and
/// α/r² above 1e5 was refused.
#[test]
fn roots_far_from_each_other_are_found_by_the_commands() {
    let response = document(
        "response --beta 1e-8 --alpha 1 --r 1 --pulse 0.01,5,1 --until 40 --sample-every 1",
    );
    assert_eq!(response["certificate"]["complete"], true);
    close(&response["valid_from"], 10.5, 1e-12);
    let large = document("stability --alpha 1e6 --r 1");
    assert_eq!(large["certificate"]["complete"], true);
    assert_eq!(large["stable"], false);
    close(&large["roots"][1]["re"], 1.0 / (1e6 * triple().value(0.0) - 1.0), 1e-11);
}

#[test]
fn a_late_pulse_overflows_nothing() {
    let found =
        document("response --alpha 0.9 --r 1 --pulse 1e-4,5000,0.5 --until 5100 --modes 40");
    assert!(!found["samples"]["l"].as_array().unwrap().iter().any(Value::is_null));
    // A growing one does in time, and says so by null.
    let growing = document("response --alpha 2 --r 1 --pulse 1e-4,20,0.5 --until 9000");
    let l = growing["samples"]["l"].as_array().unwrap();
    assert!(l.last().unwrap().is_null() && l[0].is_number());
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    for line in [
        "stability --r 0.7 --roots 30",
        "boundary --r-range 0.1,2 --points 50",
        "response --alpha 1.1 --r 1 --pulse 1e-4,30,0.5 --until 60",
    ] {
        assert_eq!(printed(line), printed(line), "{line}");
    }
}

#[test]
fn tables_and_figures_are_written() {
    let response = "response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60";
    let csv = |line: &str, name: &str| {
        let path = place(name);
        let all = printed(&format!("{line} --quiet -o {}", path.display()));
        assert!(all.is_empty(), "the result is in the file");
        std::fs::read_to_string(path).unwrap()
    };
    let boundary = csv("boundary --r-range 0.1,1 --points 9", "boundary.csv");
    assert_eq!(boundary.lines().count(), 10);
    assert!(boundary.starts_with("Omega,r,alpha,amplitude_squared_slope,period_slope,lyapunov\n"));
    assert!(boundary.lines().skip(1).all(|line| line.split(',').all(|v| v.parse::<f64>().is_ok())));
    assert!(csv("stability --r 1", "roots.csv").starts_with("re,im\n"));
    assert!(csv(response, "response.csv").starts_with("t,l,deviation\n"));
    let units = csv(&format!("units {GIVEN} --alpha 1 --r 1"), "units.csv");
    assert!(units.contains("velocity,1e-6,m/s\n"), "{units}");
    for (line, name) in [
        ("stability --r 1", "roots.npz"),
        ("boundary --r-range 0.1,1", "boundary.npz"),
        (response, "response.npz"),
    ] {
        let path = place(name);
        printed(&format!("{line} --quiet -o {}", path.display()));
        assert!(std::fs::read(path).unwrap().starts_with(b"PK"), "{name}");
    }
    for (line, option, name) in [
        ("stability --r 1", "--plot", "roots.svg"),
        ("boundary --r-range 0.1,1", "--plot", "boundary.svg"),
        ("boundary --r-range 0.1,1", "--plot-onset", "onset.svg"),
        (response, "--plot", "response.svg"),
    ] {
        let path = place(name);
        printed(&format!("{line} {option} {}", path.display()));
        let svg = std::fs::read_to_string(path).unwrap();
        assert!(svg.starts_with("<svg") && svg.len() > 2000, "{name}");
        assert!(!svg.contains("NaN"), "{name}");
    }
    // At the critical point a pair of exponents neither grows nor decays, whatever round-off says.
    for critical in ["stability --r 1", "stability --alpha 1 --solve-for r"] {
        let path = place("critical.svg");
        printed(&format!("{critical} --plot {}", path.display()));
        let svg = std::fs::read_to_string(path).unwrap();
        assert!(svg.contains("neither") && svg.contains("decaying") && !svg.contains("growing"));
    }
}

#[test]
fn unusable_input_is_refused_by_name_with_advice_and_nothing_on_standard_output() {
    let response = "response --r 1 --alpha 1";
    let cases = [
        ("stability", "--r", "give --r, or --alpha"),
        ("stability --solve-for r", "--alpha", "rc is a function of α: give --alpha"),
        ("stability --solve-for r --alpha-above 0.1", "--alpha-above 0.1", "give --alpha"),
        ("stability --r -1", "--r -1", "> 0"),
        ("stability --r nan", "--r NaN", "finite"),
        ("stability --r 1 --alpha -1", "--alpha -1", "0 or above"),
        ("stability --r 1 --roots 0", "--roots 0", "1 to 1000"),
        ("stability --r 1 --re-above=-1e9", "--re-above -1e9", "-50.000 or above"),
        ("stability --r 1 --plot roots.jpg", "--plot roots.jpg", ".svg, .png or .pdf"),
        ("stability --r 1 -o roots.txt", "--output roots.txt", ".json, .csv or .npz"),
        ("stability --r 1e-12 --alpha 1", "--alpha 1 --r 1e-12", "alpha/r²"),
        ("boundary --r-range 3,1", "--r-range 3,1", "LO below HI"),
        ("boundary --r-range 0,1", "--r-range 0:1:200", "above 0"),
        ("boundary --r-range 1,2 --points 1", "--points 1", "2 to 100000"),
        (&format!("{response} --pulse 1,2 --until 30"), "--pulse 1,2", "three"),
        (&format!("{response} --pulse 1,2,0 --until 30"), "--pulse 1,2,0", "above 0"),
        (&format!("{response} --pulse 1,2,3 --until 3"), "--until 3", "15.86"),
        (&format!("{response} --pulse 1,2,3 --until 30 --sample-at 5"), "--sample-at 5", "15.86"),
        (&format!("{response} --pulse 1,2,3 --until 30 --modes 0"), "--modes 0", "1 to 1000"),
        (&format!("units {GIVEN}"), "--indentation-rate and --velocity", "--alpha or --r"),
        (&format!("units {GIVEN} --v0 1um/s --N 1um/s --r 1"), "--r", "leave out 1"),
        (&format!("units {GIVEN} --v0 1um --N 1um/s"), "--velocity 1um", "1um/s"),
        (&format!("units {GIVEN} --v0 0m/s --N 1um/s"), "--velocity 0m/s", "above 0"),
        (&format!("units {GIVEN} --alpha 1 --r 1 -o units.npz"), "--output units.npz", ".csv"),
        (
            "units --gamma 1kg/s --a 1N --N 1m/s --v0 1m/s --alpha 1 --r 1",
            "--stiffness and --tip-width",
            "leave",
        ),
    ];
    for (line, named, advice) in cases {
        let output = stickslip(&words(line));
        let stderr = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{line}: {stderr}");
        assert!(output.stdout.is_empty(), "{line}");
        assert!(stderr.starts_with(&format!("stickslip: {named}: ")), "{line}: {stderr}");
        assert!(stderr.contains(advice), "{line}: {stderr}");
    }
}
