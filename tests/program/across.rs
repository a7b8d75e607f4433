//! `--stiffness-across` of linear theory as a user meets it: where a single line snakes, where lines of a raster ripple, bunch or
//! snake. The numbers are those of a prototype that shares no code with this project; crates/stability/tests judges more of them.

use crate::folder::Folder;
use serde_json::{Value, json};

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn words(folder: &Folder, line: &str) -> String {
    String::from_utf8(folder.prints(&format!("{line} --format text"))).unwrap()
}

#[test]
fn a_single_line_says_where_it_snakes() {
    let folder = Folder::new("snaking_line");
    let soft = "stability --r 1 --stiffness-across 0.25";
    let found = folder.prints_json(&format!("{soft} --alpha 0.9"));
    assert!((number(&found["snaking"]["alpha"]) - 0.830_541_012_7).abs() < 6e-11);
    assert!((number(&found["snaking"]["wavelength"]) - 17.1).abs() < 0.05);
    // Along the scan it is stable up to 1.069.
    assert_eq!(found["stable"], false);
    assert_eq!(folder.prints_json("stability --r 1 --alpha 0.9")["stable"], true);
    let said = words(&folder, &format!("{soft} --alpha 0.9"));
    for part in ["is unstable; along the scan it loses", "the line snakes above α = 0.8305410127"]
    {
        assert!(said.contains(part), "{said}");
    }
    assert!(words(&folder, &format!("{soft} --tip gaussian")).contains("no α"));
    // Where no α makes it stick and slip, it may snake.
    let healed = "--beta 2 --r 0.6 --healing-time 1 --stiffness-across 0.02";
    let refusal = ["--r 0.6", "stable for every alpha", "above alpha = 18.6856", "give --alpha"];
    folder.refuses(&format!("stability {healed}"), &refusal);
    let found = folder.prints_json(&format!("stability {healed} --alpha 18.6857"));
    assert_eq!((&found["stable"], &found["critical"]), (&json!(false), &Value::Null));
    folder.prints(&format!("{soft} --alpha 0.9 -o roots.csv --plot roots.svg"));
    let picture = String::from_utf8(folder.read("roots.svg")).unwrap();
    assert!(picture.contains("snakes") && picture.contains("along the scan"));
    let help = String::from_utf8(folder.prints("stability --help")).unwrap();
    assert!(help.contains("--stiffness-across <K>"));
}

/// Thresholds, angles and kinds of the table for a Gaussian at r = 1; pairs have no angle but that of straight lines.
#[test]
fn lines_ripple_or_bunch_where_the_table_has_it() {
    let folder = Folder::new("across_table");
    let schema = folder.prints_json("schema raster-stability");
    let schema = jsonschema::validator_for(&schema).unwrap();
    for (pitch, stiffness, (alpha, digit), angle, kind) in [
        (0.25, 10.0, (0.219_76, 5.1e-6), Some(42.4), "ripples"),
        (0.5, 3.0, (0.449_86, 5.1e-6), Some(35.7), "ripples"),
        (1.0, 3.0, (0.899_42, 5.1e-6), Some(35.7), "ripples"),
        (1.0, 1.0, (0.432_55, 5.1e-6), None, "bunching"),
        (2.0, 3.0, (1.474, 5.1e-4), Some(0.0), "bunching"),
        (2.0, 1.0, (0.4913, 5.1e-5), Some(0.0), "bunching"),
    ] {
        let line = format!("stability --tip gaussian --r 1 --pitch {pitch}");
        let line = format!("{line} --stiffness-across {stiffness}");
        let found = folder.prints_json(&line);
        let errors: Vec<String> = schema.iter_errors(&found).map(|e| e.to_string()).collect();
        assert!(errors.is_empty(), "{line}: {errors:?}");
        let critical = &found["critical"];
        assert!((number(&critical["alpha"]) - alpha).abs() < digit, "{line}");
        assert_eq!(critical["kind"], kind, "{line}");
        let found_angle = number(&critical["crest_angle"]);
        assert!(angle.map_or(found_angle < 5.0, |angle| (found_angle - angle).abs() < 0.05));
        let is_pair = angle == Some(0.0);
        assert_eq!(critical["wavelength_x"].is_null(), is_pair, "{line}");
        assert_eq!(critical["q"] == 0.0, is_pair);
        assert_eq!(words(&folder, &line).contains("bunch in pairs above α"), is_pair);
        // What comes later is found, but not certain.
        let all = found["thresholds"].as_array().unwrap();
        assert_eq!(&all[0], critical);
        assert!(all.is_sorted_by(|a, b| number(&a["alpha"]) < number(&b["alpha"])));
        assert!(number(&all[0]["certificate"]["tolerance"]) < 1e-9);
        assert!(all[1..].iter().all(|at| at["kind"] != kind));
        assert!(all[1..].iter().all(|at| at["certificate"]["tolerance"] == 1.0));
    }
}

/// Thresholds as a table have one row for each kind; growth at a given α agrees with the threshold.
#[test]
fn thresholds_and_growth_are_tables() {
    let folder = Folder::new("across_tables");
    let line = "stability --tip gaussian --r 1 --pitch 1 --stiffness-across 1";
    folder.prints(&format!("{line} -o t.csv"));
    let table = String::from_utf8(folder.read("t.csv")).unwrap();
    let rows: Vec<&str> = table.lines().collect();
    assert_eq!(rows[0], "alpha,q,kappa,crest_angle,wavelength_x,phase_per_line,kind");
    assert!(rows[1].ends_with(",bunching") && rows[2].ends_with(",ripples"), "{table}");
    let threshold = 0.432_547_7;
    for (part, stable) in [(0.99, true), (1.01, false)] {
        let found = folder.prints_json(&format!("{line} --alpha {}", part * threshold));
        assert_eq!(found["stable"], stable);
        let factors = found["growth"]["factor"].as_array().unwrap();
        let largest = factors.iter().map(number).fold(0.0, f64::max);
        assert_eq!(largest < 1.0, stable, "{largest}");
    }
    folder.prints(&format!("{line} --alpha 0.5 -o growth.csv --plot growth.svg"));
}

#[test]
fn the_boundary_has_a_column_for_each_kind() {
    let folder = Folder::new("across_boundary");
    let line = "boundary --tip gaussian --pitch-range 1:2:2 --r 1 --stiffness-across 3";
    let found = folder.prints_json(line);
    let schema = folder.prints_json("schema raster-boundary");
    assert!(jsonschema::validator_for(&schema).unwrap().is_valid(&found));
    let columns = &found["thresholds"];
    assert_eq!(columns["kind"], json!(["ripples", "bunching"]));
    assert_eq!(columns["ripples"][0], found["alpha"][0]);
    assert_eq!(columns["bunching"][1], found["alpha"][1]);
    assert!(number(&columns["ripples"][1]) > number(&found["alpha"][1]));
    assert_eq!(columns["snaking"], json!([null, null]));
    folder.prints(&format!("{line} -o b.csv --plot b.svg"));
    let table = String::from_utf8(folder.read("b.csv")).unwrap();
    assert!(
        table
            .lines()
            .next()
            .unwrap()
            .ends_with("crest_angle,alpha_zigzag,kind,alpha_ripples,alpha_bunching,alpha_snaking")
    );
    assert!(words(&folder, line).contains("bunching first"));
}

/// Without the option a document has nothing of it, and a stiff spring comes to it as 1/κ_y.
#[test]
fn a_stiff_spring_holds_the_tip_on_its_lines() {
    let folder = Folder::new("across_stiff");
    let line = "stability --tip gaussian --r 1 --pitch 0.5";
    let held = folder.prints_json(line);
    for (part, name) in
        [("/parameters", "stiffness_across"), ("", "thresholds"), ("/critical", "kind")]
    {
        assert!(held.pointer(part).unwrap().get(name).is_none(), "{name}");
    }
    let difference = |stiffness: f64| {
        let found = folder.prints_json(&format!("{line} --stiffness-across {stiffness}"));
        number(&found["critical"]["alpha"]) - number(&held["critical"]["alpha"])
    };
    let [near, far] = [1e3, 1e2].map(difference);
    assert!((0.95..1.05).contains(&(far / (10.0 * near))), "{far} {near}");
    // Where the depth limit lets no ripple grow, lines on a spring may still bunch.
    let limited = "stability --tip gaussian --r 1 --pitch 1 --depth-limit 0.1 --alpha 1";
    assert!(words(&folder, limited).starts_with("nothing grows from line to line"));
    let bunched = words(&folder, &format!("{limited} --stiffness-across 2"));
    assert!(bunched.starts_with("lines bunch in pairs above α = 1171"), "{bunched}");
}

#[test]
fn what_has_no_theory_across_is_refused_with_advice() {
    let folder = Folder::new("across_refused");
    for (line, words) in [
        ("stability --r 1 --stiffness-across 0", ["--stiffness-across 0", "above 0"]),
        ("stability --r 1 --pitch 1 --stiffness-across -1", ["--stiffness-across -1", "above 0"]),
        (
            "stability --r 1 --path repeat --alpha 1 --stiffness-across 1",
            ["--stiffness-across 1", "leave the option out"],
        ),
        (
            "stability --no-spring --tip bessel --alpha -3 --stiffness-across 1",
            ["--stiffness-across 1", "--no-spring"],
        ),
        (
            "stability --tip bessel --width-y 1 --r 1 --pitch 1 --stiffness-across 1",
            ["--tip", "sums of Gaussians"],
        ),
        (
            "stability --tip gaussian --r 1 --pitch 1 --path zigzag --healing-time 9 --length 9 --stiffness-across 1",
            ["--path zigzag", "waves e^(iqx)"],
        ),
        (
            "stability --r 1 --pitch 1 --depth-limit 3 --stiffness-across 1",
            ["--depth-limit", "corner"],
        ),
        ("boundary --r-range 1:2:3 --width-y 1", ["--width-y", "--pitch-range"]),
        (
            "boundary --pitch-range 1:2:3 --r 1 --stiffness-across 0",
            ["--stiffness-across 0", "above 0"],
        ),
    ] {
        folder.refuses(line, &words);
    }
}
