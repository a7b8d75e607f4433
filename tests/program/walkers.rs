//! `run --walker`: speeds, orbits, refusals.

use crate::folder::{Folder, said};
use serde_json::Value;

fn number(document: &Value, path: &str) -> f64 {
    document.pointer(path).and_then(Value::as_f64).unwrap_or(f64::NAN)
}

#[test]
fn a_free_walker_has_its_speed_from_any_start() {
    let folder = Folder::new("walker-free");
    for start in ["", "--start flat --pulse 1,2,0.5", "--kick 0.1 --kick-across 0.2"] {
        let line = format!("run --walker --alpha=-3 --until 120 {start}");
        let found = folder.prints_json(&line);
        assert_eq!(found["regime"], "straight", "{line}");
        let end = found["samples"]["velocity"].as_array().unwrap().len() - 1;
        let [x, y] =
            ["velocity", "velocity_y"].map(|v| number(&found, &format!("/samples/{v}/{end}")));
        assert!((x.hypot(y) - 0.834_999_618_1).abs() < 1e-9, "{line}: {x} {y}");
        assert!((number(&found, "/free_speed") - 0.834_999_618_1).abs() < 1e-10);
    }
}

/// Started on its orbit a walker stays there; started elsewhere it finds it, and its circle is that of theory.
#[test]
fn orbits_are_those_that_are_listed() {
    let folder = Folder::new("walker-orbits");
    for force in ["--rotation 0.3", "--rotation=-0.4 --inertia 0.5", "--trap 0.15"] {
        for start in ["", "--kick 0.3 --kick-across=-0.2"] {
            let line = format!("run --walker --alpha=-3 {force} {start} --until 800");
            let found = folder.prints_json(&line);
            assert_eq!(found["regime"], "circling", "{line}");
            let orbit = &found["orbits"][0];
            assert_eq!(orbit["stable"], true, "{line}");
            for name in ["radius", "omega"] {
                let (theory, told) = (
                    number(orbit, &format!("/{name}")),
                    number(&found["circle"], &format!("/{name}")),
                );
                assert!((theory - told).abs() < 1e-9, "{line}: {name} {theory} {told}");
            }
            assert!(number(&found, "/circle/deviation") < 1e-9, "{line}");
        }
    }
}

#[test]
fn a_saved_walker_is_asked_and_drawn_again() {
    let folder = Folder::new("walker-again");
    folder.prints("run --walker --alpha=-3 --trap 0.2 --until 30 -o walker.json --plot walker.svg");
    let first = folder.json("walker.json");
    let again = folder.prints_json("run --parameters walker.json");
    assert_eq!(first["samples"], again["samples"]);
    folder.prints("plot walker.json -o again.svg");
    assert_eq!(folder.read("walker.svg"), folder.read("again.svg"));
    folder.prints("run --walker --alpha=-3 --until 5 -o walker.csv");
    let csv = String::from_utf8(folder.read("walker.csv")).unwrap();
    assert!(csv.lines().any(|line| line == "t,x0,velocity,y0,velocity_y"), "{csv}");
}

#[test]
fn what_is_not_of_walkers_is_refused_by_name() {
    let folder = Folder::new("walker-refusals");
    for (options, why) in [
        (
            "--walker --alpha=-3 --until 5 --stiffness-across 1",
            "--stiffness-across 1: has no meaning with --walker",
        ),
        ("--walker --alpha=-3 --until 5 --beta 0", "--beta: is not available with --walker"),
        ("--walker --alpha=-3 --until 5 --tip gaussian", " --tip: is not available"),
        (
            "--walker --alpha=-3 --until 5 --depth-limit 1",
            "--depth-limit 1: has no meaning with --walker",
        ),
        (
            "--walker --alpha=-3 --until 5 --checkpoint c",
            "--checkpoint: is not available with --walker",
        ),
        ("--walker --alpha=-3 --until 5 --trap=-1", "--trap -1"),
        ("--walker --alpha=-3 --until 0", "--until 0"),
        ("--walker --alpha=-3 --until 5 --start-velocity 1", "--start-velocity 1"),
        ("--walker --alpha=-3 --until 5 --start paper", "--start"),
        ("--walker --alpha=-3 --until 5 --largest-radius 1e6", "--largest-radius"),
        ("--alpha 1 --r 1 --until 30 --rotation 2", "--rotation 2: has no meaning with"),
    ] {
        let output = folder.stickslip(&format!("run {options}"));
        assert_eq!(output.status.code(), Some(2), "{options}");
        assert!(said(&output).contains(why), "{options}: {}", said(&output));
    }
    let slow = folder.prints_json("run --walker --alpha=-1 --until 5");
    assert!(slow["remarks"][0].as_str().unwrap().contains("walks above"), "{slow}");
    assert_eq!(slow["regime"], "resting");
}
