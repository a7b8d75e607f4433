//! Rasters of a tip that is free to move across the lines, as a user meets them. The lines themselves are judged in
//! crates/raster/tests.

use crate::folder::Folder;
use crate::runs::{schema, validate};
use serde_json::Value;
use stickslip_raster::{Free, Path, Plan, Scanned, Scanning};
use stickslip_tip::{Footprint, Model, TipFunction};

const LINES: &str = "raster --tip gaussian --alpha 0.5 --r 1 --pitch 0.5 --lines 4 --length 16";

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Samples and heights are those of the library; formats, pictures and questions from documents know both coordinates.
#[test]
fn a_free_raster_is_that_of_the_library() {
    let folder = Folder::new("free_raster");
    let line = format!("{LINES} --path zigzag --stiffness-across 0.8 --kick-across 0.2");
    let line = format!("{line} --sample-at 0,7.5,16");
    folder.prints(&format!("{line} -o raster.json --plot raster.svg"));
    let document = folder.json("raster.json");
    validate(&schema(&folder, "raster"), &document);
    let footprint = Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap();
    let model = Model::new(footprint.path().clone(), 0.5, 1.0).unwrap();
    let plan = Plan::new(footprint, model, Path::Zigzag, 0.5, 4, 16.0);
    let plan = plan.with_free(Free { kick: 0.2, ..Free::new(0.8) });
    let mut scanning = Scanning::new(&plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    let lines = scanning.into_lines();
    for (n, line) in lines.iter().enumerate() {
        let samples = &document["lines"][n]["samples"];
        for (i, t) in [0.0, 7.5, 16.0].into_iter().enumerate() {
            assert!((number(&samples["x0"][i]) - line.x0(t)).abs() < 1e-15);
            assert!((number(&samples["y0"][i]) - line.y0(t)).abs() < 1e-15);
            assert!((number(&samples["velocity_y"][i]) - line.velocity_y(t)).abs() < 1e-15);
        }
    }
    // The tip goes on from where it was.
    let ends =
        [&document["lines"][0]["samples"]["y0"][2], &document["lines"][1]["samples"]["y0"][0]];
    assert!((number(ends[0]) - number(ends[1])).abs() < 1e-12);
    assert!((number(&document["lines"][0]["samples"]["y0"][0]) - 0.2).abs() < 1e-15);
    let surface = folder.prints_json("surface raster.json --x 3,8.25 --y 0.1,1.5");
    let wanted = Scanned::new(&plan, &lines).heights(&[3.0, 8.25], &[0.1, 1.5]);
    for ((row, column), u) in wanted.indexed_iter() {
        assert!((number(&surface["surfaces"][0]["u"][row][column]) - u).abs() < 1e-12);
    }
    for name in ["a.npz", "a.gsf", "a.csv --sigma 30nm"] {
        folder.prints(&format!("{line} -o {name}"));
    }
    let csv = String::from_utf8(folder.read("a.csv")).unwrap();
    let head = csv.lines().find(|line| !line.starts_with('#')).unwrap();
    assert!(head.contains("y0_nm") && head.contains("velocity_y"), "{head}");
    let again = folder.prints_json("raster --parameters raster.json");
    assert_eq!(again["lines"], document["lines"]);
    folder.prints("plot raster.json -o again.svg");
    assert_eq!(folder.read("again.svg"), folder.read("raster.svg"));
}

/// Tables have all columns of the samples in the document.
#[test]
fn a_table_of_a_raster_has_every_column_of_its_samples() {
    let folder = Folder::new("raster_columns");
    let line = format!("{LINES} --stiffness-across 0.8 --depth-limit 3");
    folder.prints(&format!("{line} -o raster.json"));
    folder.prints(&format!("{line} -o raster.csv"));
    let document = folder.json("raster.json");
    let samples = document["lines"][0]["samples"].as_object().unwrap();
    let csv = String::from_utf8(folder.read("raster.csv")).unwrap();
    let head: Vec<&str> = csv.lines().next().unwrap().split(',').collect();
    for name in samples.keys() {
        let column = head.iter().position(|head| head == name).expect(name);
        for (row, sample) in csv.lines().skip(1).zip(samples[name].as_array().unwrap()) {
            let written: f64 = row.split(',').nth(column).unwrap().parse().unwrap();
            assert_eq!(written.to_bits(), number(sample).to_bits(), "{name}");
        }
    }
}

/// Without the option documents say nothing of it, and pictures draw no path.
#[test]
fn a_held_raster_says_nothing_of_motion_across() {
    let folder = Folder::new("held_raster");
    folder.prints(&format!("{LINES} -o raster.json --plot raster.svg"));
    let text = String::from_utf8(folder.read("raster.json")).unwrap();
    for word in ["across", "y0", "velocity_y"] {
        assert!(!text.contains(word), "{word}");
    }
}

/// Thresholds of a sweep are those of both coordinates, and so are its rasters.
#[test]
fn a_sweep_of_free_rasters_knows_trenches() {
    let folder = Folder::new("free_sweep");
    let line = "sweep raster --tip gaussian --r 1 --pitch 2 --alpha 0.3:1:2 --lines 40 --length 40";
    let line = format!("{line} --tolerance 1e-5");
    folder.prints(&format!("{line} --stiffness-across 1 -o free.json --plot free.svg"));
    let free = folder.json("free.json");
    validate(&schema(&folder, "raster-sweep"), &free);
    assert_eq!(free["parameters"]["stiffness_across"], 1.0);
    assert!((number(&free["points"][0]["critical_alpha"]) - 0.4913).abs() < 5.1e-5);
    let regimes = [0, 1].map(|n: usize| free["points"][n]["regime"].clone());
    assert_eq!(regimes, [Value::from("steady"), Value::from("bunched")]);
    assert!((number(&free["points"][1]["pattern"]["wavelength"]) - 4.0).abs() < 0.1);
}

#[test]
fn what_a_free_raster_does_not_know_is_refused_by_name() {
    let folder = Folder::new("free_refusals");
    for (line, words) in [
        (format!("{LINES} --stiffness-across 0"), ["--stiffness-across 0", "above 0"]),
        (format!("{LINES} --stiffness-across -2"), ["--stiffness-across -2", "above 0"]),
        (format!("{LINES} --kick-across 1"), ["--kick-across 1", "--stiffness-across"]),
        (
            "sweep raster --tip gaussian --r 1 --pitch 2 --alpha 1 --lines 9 --length 20 --stiffness-across 0".into(),
            ["--stiffness-across 0", "above 0"],
        ),
    ] {
        folder.refuses(&line, &words);
    }
}
