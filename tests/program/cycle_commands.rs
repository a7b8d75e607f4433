//! `cycle` and `continue` as a user meets them: documents that agree with the library and from which one can go on,
//! tables, pictures, and input that is refused with a word of advice. That documents keep to their schemas is
//! judged in documents.rs, what cycles are worth in cycles.rs and continuation.rs.

use crate::folder::{Folder, said};
use serde_json::Value;
use stickslip_cycles::{DEFAULT_TOLERANCE, cycle};
use stickslip_tip::{Model, TipFunction};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn numbers(column: &Value) -> Vec<f64> {
    column.as_array().unwrap().iter().map(number).collect()
}

fn close(found: f64, wanted: f64, bound: f64) {
    assert!((found - wanted).abs() <= bound, "{found} for {wanted}");
}

#[test]
fn a_cycle_is_that_of_the_library() {
    let folder = Folder::new("cycle_library");
    let document = folder.prints_json("cycle --alpha 1.4 --r 1");
    let model = Model::new(TipFunction::triple_gaussian(1.0, 1.0).unwrap(), 1.4, 1.0).unwrap();
    let known = cycle(&model, DEFAULT_TOLERANCE).unwrap();
    close(number(&document["period"]), known.period(), 0.0);
    close(number(&document["amplitude_x0"]), known.amplitude_x0(), 0.0);
    close(number(&document["amplitude_u"]), known.amplitude_u(), 0.0);
    close(number(&document["floquet"][1]["re"]), known.multipliers()[1].re, 0.0);
    assert_eq!(document["stable"], known.is_stable());
    let (t, l) = (numbers(&document["profile"]["t"]), numbers(&document["profile"]["l"]));
    assert_eq!(t.len(), l.len());
    assert!(t.is_sorted_by(|a, b| a < b));
    close(l[0], l[l.len() - 1], 1e-12);
    close(t[t.len() - 1], known.period(), 1e-12);
    assert!(l.iter().all(|l| *l <= known.extremes().1 + 1e-12));
    assert!(number(&document["floquet_error"]) < 1e-8);
}

/// Relaxation: T = 166, but the slip at 206 r lasts a few thousandths of it.
#[test]
fn the_profile_of_a_cycle_shows_its_fastest_slip() {
    let folder = Folder::new("cycle_profile");
    let largest = |options: &str| {
        let document = folder.prints_json(&format!("cycle --alpha 2 --r 1 {options}"));
        let velocity = numbers(&document["profile"]["velocity"]);
        (velocity.len(), velocity.into_iter().fold(0.0, f64::max))
    };
    let (_, fine) = largest("--points 200000");
    close(fine, 206.204, 1e-2);
    for options in ["", "--points 1 --tolerance 1e-4"] {
        let (rows, found) = largest(options);
        assert!(rows < 2000, "{rows} rows");
        close(found, fine, 0.01 * fine);
    }
}

#[test]
fn the_same_command_writes_the_same_bytes_but_for_seconds() {
    let folder = Folder::new("cycle_bytes");
    let cycles = [(); 2].map(|()| {
        let mut document = folder.prints_json("cycle --alpha 1.62 --r 1");
        document["work"]["seconds"] = Value::Null;
        document.to_string()
    });
    assert_eq!(cycles[0], cycles[1]);
    let line = "continue --r 1 --over alpha --to 1.12";
    assert_eq!(folder.prints(line), folder.prints(line));
}

#[test]
fn one_goes_on_from_a_document() {
    let folder = Folder::new("cycle_from");
    folder.prints("cycle --tip gaussian --alpha 2.6 --r 1 -o first.json");
    // All from the document, and α in its place.
    let again = folder.prints_json("cycle --from first.json");
    close(number(&again["period"]), number(&folder.json("first.json")["period"]), 1e-9);
    let further = folder.prints_json("cycle --from first.json --alpha 2.61");
    let direct = folder.prints_json("cycle --tip gaussian --alpha 2.61 --r 1");
    close(number(&further["period"]), number(&direct["period"]), 1e-9);
    let branch = folder.prints_json("continue --from first.json --over r --to 1.02");
    close(number(&branch["branches"][0]["r"][0]), 1.0, 0.0);
    let last = numbers(&branch["branches"][0]["period"]);
    let alone = folder.prints_json("cycle --tip gaussian --alpha 2.6 --r 1.02");
    close(*last.last().unwrap(), number(&alone["period"]), 1e-8);
    assert_eq!(branch["branches"][0]["end"], "reached");
}

/// One period of an unstable cycle can be had from a branch only by continuing to it, and from there on.
#[test]
fn a_branch_is_told_in_full() {
    let folder = Folder::new("branch");
    let line = "continue --r 1 --over alpha --to 1.82 --switch -o branch.json --plot branch.svg";
    folder.prints(line);
    let document = folder.json("branch.json");
    let kinds: Vec<&str> = document["special"]
        .as_array()
        .unwrap()
        .iter()
        .map(|special| special["kind"].as_str().unwrap())
        .collect();
    assert_eq!(kinds, ["hopf", "period-doubling", "period-doubling", "period-halving"]);
    // The branch that leaves at the first doubling comes back at the second: it is followed once.
    let branches = document["branches"].as_array().unwrap();
    assert_eq!(branches.len(), 2);
    assert_eq!(branches[1]["from"], 1);
    assert_eq!((&branches[0]["end"], &branches[1]["end"]), (&"reached".into(), &"halved".into()));
    close(number(&document["trapping"]), 2.086_841, 1e-6);
    for branch in branches {
        let columns = ["r", "period", "amplitude_x0", "amplitude_u", "stable", "multiplier_re"];
        let length = branch["alpha"].as_array().unwrap().len();
        assert!(columns.iter().all(|c| branch[c].as_array().unwrap().len() == length));
    }
    let picture = String::from_utf8(folder.read("branch.svg")).unwrap();
    for word in
        ["unstable cycles", "stable, branch 1", "period doubling", "Hopf", "stroke-dasharray"]
    {
        assert!(picture.contains(word), "{word}");
    }
    // Onset is supercritical: there are no cycles on the way to an α below it.
    let output =
        folder.stickslip("continue --r 1 --over alpha --to 0.9 --longest-period 7 -o away.json");
    assert!(
        said(&output).contains("where the period exceeds --longest-period"),
        "{}",
        said(&output)
    );
    let output = folder.stickslip("continue --r 1 --over alpha --to 1.1 -o branch.csv");
    assert!(output.status.success());
    assert!(said(&output).contains(" to 1.1, the value of --to"), "{}", said(&output));
    let table = String::from_utf8(folder.read("branch.csv")).unwrap();
    assert!(table.starts_with("branch,alpha,r,period,amplitude_x0,amplitude_u,stable,"));
}

#[test]
fn pictures_and_tables_of_a_cycle_are_made() {
    let folder = Folder::new("cycle_files");
    folder.prints("cycle --alpha 1.9 --r 1 --points 50 -o cycle.csv --plot cycle.svg");
    let table = String::from_utf8(folder.read("cycle.csv")).unwrap();
    // No fewer intervals than asked for, and two in each of some 150 steps.
    assert!((52..400).contains(&table.lines().count()), "{} lines", table.lines().count());
    let picture = String::from_utf8(folder.read("cycle.svg")).unwrap();
    assert!(picture.starts_with("<svg") && picture.contains("u far behind the tip"));
    let output = folder.stickslip("cycle --alpha 1.2 --r 1 -o cycle.npz");
    let told = "stable cycle of one slip, period 7.06735969005";
    assert!(output.status.success() && said(&output).contains(told), "{}", said(&output));
    assert_eq!(folder.names(), ["cycle.csv", "cycle.npz", "cycle.svg"]);
}

#[test]
fn what_cannot_be_used_is_refused() {
    let folder = Folder::new("cycle_refusals");
    folder.prints("cycle --alpha 1.2 --r 1 -o cycle.json");
    folder.write("run.json", r#"{"format":"stickslip/run","format_version":1}"#);
    folder.write("half.json", r#"{"format":"stickslip/cycle","#);
    let damaged = String::from_utf8(folder.read("cycle.json")).unwrap();
    folder.write("damaged.json", damaged.replace("\"extension\":[", "\"extension\":[7,"));
    for (line, words) in [
        ("cycle --alpha 1.2", &["--r", "is needed"][..]),
        ("cycle --alpha 1.2 --r 1 --tolerance 1", &["--tolerance 1", "1e-4"]),
        ("cycle --alpha 1.2 --r 1 --points 0", &["--points 0"]),
        ("cycle --alpha 1.2 --r 1 --tip bessel", &["bessel", "decays"]),
        ("cycle --from none.json", &["--from none.json"]),
        ("cycle --from run.json", &["--from run.json", "stickslip/cycle"]),
        ("cycle --from half.json", &["--from half.json", "stickslip cycle"]),
        ("cycle --from damaged.json", &["--from damaged.json", "history"]),
        ("cycle --from cycle.json --tip gaussian", &["--from", "footprint"]),
        ("continue --over alpha", &["--r", "missing"]),
        ("continue --over r", &["--alpha", "missing"]),
        ("continue --over r --alpha=-1", &["--alpha -1", "> 0"]),
        ("continue --over alpha --r 1 --to -2", &["--to -2", "above 0"]),
        ("continue --over alpha --r 1 --longest-step 0", &["--longest-step 0"]),
        ("continue --over alpha --r 1 --longest-period nan", &["--longest-period NaN"]),
        ("continue --over alpha --r 1 --most-points 0", &["--most-points 0"]),
        ("continue --over beta --r 1", &["beta"]),
        ("cycle --alpha 1.2 --r 1 -o cycle.txt", &["cycle.txt", ".json"]),
    ] {
        folder.refuses(line, words);
    }
}

#[test]
fn where_there_is_no_cycle_that_is_said() {
    let folder = Folder::new("no_cycle");
    for (line, words) in [
        ("cycle --alpha 1 --r 1", &["no small cycle", "1.0690361749467843", "--from"][..]),
        ("cycle --alpha-above=-1e-6 --r 1", &["no small cycle"]),
        ("cycle --alpha 2.3 --r 1", &["trapped"]),
        (
            "continue --over alpha --r 1 --width 1e-13",
            &["where the branch begins", "--alpha ", "--from"],
        ),
    ] {
        let output = folder.stickslip(line);
        let said = said(&output);
        assert_eq!(output.status.code(), Some(1), "{line}: {said}");
        assert!(output.stdout.is_empty());
        assert!(words.iter().all(|word| said.contains(word)), "{line}: {said}");
    }
}
