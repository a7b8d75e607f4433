//! Documents: each validates against the schema that the program prints, its numbers come back to the
//! last bit, the same input gives the same bytes, and what is damaged is not read.

use crate::folder::Folder;
use jsonschema::Validator;
use ndarray::{Array1, Array2};
use ndarray_npy::NpzReader;
use serde_json::{Value, json};
use std::io::Cursor;

fn schema(folder: &Folder, name: &str) -> Validator {
    jsonschema::validator_for(&folder.prints_json(&format!("schema {name}"))).unwrap()
}

fn validate(schema: &Validator, document: &Value, line: &str) {
    let errors: Vec<String> = schema
        .iter_errors(document)
        .map(|error| format!("{}: {error}", error.instance_path()))
        .collect();
    assert!(errors.is_empty(), "{line}\n{}", errors.join("\n"));
}

const TIP: &str = "{\"gaussians\":[{\"amplitude\":1,\"center\":0,\"width\":0.9}]}";
const BUMP: &str = "x,u\n10,0\n16,0.01\n20,0\n";
const FORCE: &str = "# measured\nt,force\n0,0\n20,0.1\n30,0\n";

/// A folder with a tip, an initial surface and a force.
fn furnished(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.write("tip.json", TIP);
    folder.write("bump.csv", BUMP);
    folder.write("force.csv", FORCE);
    folder
}

/// Runs of every kind, and with every optional field.
const RUNS: [&str; 10] = [
    "run --alpha 0 --r 1 --until 30",
    "run --alpha-above 0.1 --r 1 --kick 0.5 --until 120",
    "run --alpha 4 --r 1 --until 60 --start flat",
    "run --tip gaussian --width 0.8 --alpha 0.5 --r 0.7 --until 40 --memory direct",
    "run --tip bessel --alpha 0.5 --r 1 --until 40 --memory fft --tolerance 1e-6",
    "run --tip-file tip.json --alpha 1 --r 1 --until 30",
    "run --alpha 1 --r 1 --until 30 --noise 1e-3 --noise-spacing 0.5 --seed 18446744073709551615",
    "run --alpha 1 --r 1 --until 30 --initial-surface bump.csv --force-file force.csv",
    "run --alpha 1 --r 1 --until 30 --pulse 1,20,1 --pulse -1,25,2 --start-position -3",
    "run --alpha 1 --r 1 --until 30 --sample-at 20",
];

#[test]
fn every_run_validates_against_its_schema_and_so_does_its_surface() {
    let folder = furnished("validation");
    let (run, surface) = (schema(&folder, "run"), schema(&folder, "surface"));
    for line in RUNS {
        let document = folder.prints_json(line);
        validate(&run, &document, line);
        folder.write("run.json", document.to_string());
        for options in ["", "--far-behind --x 20", "--at 25,30 --range 10,30 --spacing 0.5"] {
            let line = format!("surface run.json {options}");
            validate(&surface, &folder.prints_json(&line), &line);
        }
    }
}

/// One command line for each kind of document but runs and surfaces.
const OTHERS: [(&str, &str); 21] = [
    ("stability", "stability --r 1"),
    ("walking", "stability --no-spring --alpha=-1"),
    ("walker", "run --walker --alpha=-3 --rotation 0.3 --until 20"),
    ("boundary", "boundary --r-range 0.05,3 --points 20"),
    ("compare", "compare --alpha 1.2 --r 1 --kick 0.05 --pulse 1,20,1 --until 30"),
    ("response", "response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60"),
    ("cycle", "cycle --alpha 1.2 --r 1"),
    ("tip", "tip pit.csv --resamples 20"),
    ("fit", "fit --onsets onsets.csv --tip gaussian"),
    ("fit-image", "fit --image ripples.gsf --tip gaussian --width 30nm --pitch 30nm"),
    ("friction", "friction loop.csv"),
    ("continue", "continue --r 1 --over alpha --to 1.55 --switch"),
    ("sweep", "sweep --r 0.9:1:2 --alpha 0.9:2.3:4"),
    ("raster", "raster --alpha 0.5 --r 1 --pitch 1 --lines 3 --length 10"),
    (
        "raster-sweep",
        "sweep raster --tip gaussian --r 1 --pitch 1 --alpha 0.5:1:2 --lines 3 --length 10",
    ),
    ("raster-compare", "compare --tip gaussian --alpha 0.5 --r 1 --pitch 1 --lines 3 --length 10"),
    ("raster-boundary", "boundary --tip gaussian --pitch-range 0.5:2:4 --r 1"),
    ("snaking-boundary", "boundary --stiffness-range 0.3:0.5:2 --r 1"),
    ("load-map", "boundary --alpha 1.3 --r 0.8 --load 10 --load-range 2:20 --r-range 0.4:1.6:3"),
    ("raster-stability", "stability --r 1 --pitch 1 --alpha 0.5"),
    (
        "units",
        "units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm --slope-force 5nN --alpha 1.2 --r 1",
    ),
];

#[test]
fn every_schema_that_is_offered_is_that_of_some_document() {
    let folder = Folder::new("schemas");
    let pit = (-40..=40).map(|i: i32| format!("{i},{}\n", (-f64::from(i * i) / 72.0).exp()));
    folder.write("onsets.csv", "1,1.02\n2,2.5\n3,4.2\n4,6.5\n");
    folder.write("pit.csv", pit.collect::<String>());
    folder.write("ripples.gsf", include_bytes!("../../examples/measured/area.gsf"));
    let way = |x: f64| if x < 20.0 { x - 10.0 } else { 10.0 + x.sin() };
    let row = |i: u32| format!("{i},{},{}\n", way(f64::from(i)), -way(f64::from(200 - i)));
    folder.write("loop.csv", (0..=200).map(row).collect::<String>());
    for (name, line) in OTHERS {
        let document = folder.prints_json(line);
        assert_eq!(document["format"], format!("stickslip/{name}"));
        validate(&schema(&folder, name), &document, line);
    }
    let refusal = folder.stickslip("schema none");
    let said = crate::folder::said(&refusal);
    let offered = said.split("possible values: ").nth(1).unwrap().split(']').next().unwrap();
    // Judged in files of their own: lines and checkpoints, figures, verifications.
    let runs = ["run", "run-lines", "checkpoint", "surface"];
    let figures = ["figure", "reproduction", "raster-surface"];
    let others = OTHERS.map(|o| o.0);
    let mut tested: Vec<&str> =
        runs.into_iter().chain(others).chain(figures).chain(["verify"]).collect();
    let mut offered: Vec<&str> = offered.split(", ").collect();
    tested.sort_unstable();
    offered.sort_unstable();
    assert_eq!(offered, tested);
}

/// Paths of all properties that nothing is said about.
fn unexplained(schema: &Value, path: &str) -> Vec<String> {
    let below = |(name, value): (String, &Value)| unexplained(value, &format!("{path}/{name}"));
    match schema {
        Value::Object(entries) => {
            let properties = entries.get("properties").and_then(Value::as_object);
            let silent = properties.into_iter().flatten().filter(|(_, property)| {
                !["description", "const"].iter().any(|word| property.get(word).is_some())
            });
            let here = silent.map(|(name, _)| format!("{path}/{name}"));
            here.chain(entries.iter().flat_map(|(name, v)| below((name.clone(), v)))).collect()
        }
        Value::Array(values) => {
            values.iter().enumerate().flat_map(|(i, v)| below((i.to_string(), v))).collect()
        }
        _ => vec![],
    }
}

#[test]
fn every_field_of_every_document_is_explained() {
    let folder = Folder::new("explained");
    let runs = ["run", "run-lines", "checkpoint", "surface", "verify", "figure", "reproduction"];
    let runs = runs.into_iter().chain(["raster-surface"]);
    for name in runs.chain(OTHERS.map(|o| o.0)) {
        let schema = folder.prints_json(&format!("schema {name}"));
        let silent = unexplained(&schema, name);
        assert!(silent.is_empty(), "{silent:#?}");
    }
    let bare = json!({"properties": {"period": {"type": "number"}}});
    assert_eq!(unexplained(&bare, "bare"), ["bare/period"]);
}

/// A schema that accepts anything would pass the tests above.
#[test]
fn the_schemas_refuse_what_is_no_document() {
    let folder = Folder::new("negative_controls");
    let validator = schema(&folder, "run");
    let whole = folder.prints_json("run --alpha 1.2 --r 1 --until 30");
    let damages: [fn(&mut Value); 7] = [
        |d| drop(d.as_object_mut().unwrap().remove("format")),
        |d| drop(d["work"].as_object_mut().unwrap().remove("steps")),
        |d| d["more"] = json!(1),
        |d| d["samples"]["l"][0] = Value::Null,
        |d| d["history"]["extension"][0] = json!("1"),
        |d| d["regime"] = json!("asleep"),
        |d| d["parameters"]["tip"] = json!({"name": "round"}),
    ];
    validate(&validator, &whole, "the whole document");
    for (i, damage) in damages.iter().enumerate() {
        let mut document = whole.clone();
        damage(&mut document);
        assert!(!validator.is_valid(&document), "damage {i} passed");
    }
}

/// Bits of all numbers: -0 and 0 differ, NaN would not hide.
fn bits(values: impl IntoIterator<Item = f64>) -> Vec<u64> {
    values.into_iter().map(f64::to_bits).collect()
}

fn column(document: &Value, pointer: &str) -> Vec<u64> {
    let values = document.pointer(pointer).unwrap().as_array().unwrap();
    bits(values.iter().map(|value| value.as_f64().unwrap()))
}

/// The columns of a CSV file under these headings.
fn csv(folder: &Folder, name: &str, headings: &str) -> Vec<Vec<u64>> {
    let text = String::from_utf8(folder.read(name)).unwrap();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some(headings));
    let mut columns = vec![vec![]; headings.split(',').count()];
    for line in lines {
        for (column, cell) in columns.iter_mut().zip(line.split(',')) {
            column.push(cell.parse::<f64>().unwrap().to_bits());
        }
    }
    columns
}

/// Positions of a height map are in nm if its heights are.
#[test]
fn arrays_of_a_raster_have_one_unit_of_length() {
    let folder = Folder::new("raster_arrays");
    let scan =
        "raster --tip gaussian --alpha 0.4 --r 1 --pitch 0.5 --lines 3 --length 6 --tolerance 1e-4";
    folder.prints(&format!("{scan} --sigma 20nm --stiffness 0.2N/m --slope-force 5nN -o area.npz"));
    let mut npz = NpzReader::new(Cursor::new(folder.read("area.npz"))).unwrap();
    let mut positions = |name: &str| -> Array1<f64> { npz.by_name(name).unwrap() };
    let (x, y) = (positions("u_x_nm"), positions("u_y_nm"));
    let u: Array2<f64> = npz.by_name("u_nm").unwrap();
    assert_eq!(u.dim(), (y.len(), x.len()));
    assert!((x[x.len() - 1] - 120.0).abs() < 1e-9 && (y[2] - 20.0).abs() < 1e-9, "{x} {y}");
}

#[test]
fn numbers_are_the_same_in_json_csv_and_npz() {
    let folder = Folder::new("round_trip");
    let line = "run --alpha 1.2 --r 0.7 --kick 0.05 --until 60";
    let text = folder.prints(line);
    let document: Value = serde_json::from_slice(&text).unwrap();
    folder.write("run.json", &text);
    folder.prints(&format!("{line} -o run.csv"));
    folder.prints(&format!("{line} -o run.npz"));
    let mut npz = NpzReader::new(Cursor::new(folder.read("run.npz"))).unwrap();
    let mut vector = |name: &str| -> Vec<u64> {
        let array: Array1<f64> = npz.by_name(name).unwrap();
        bits(array)
    };
    let columns = csv(&folder, "run.csv", "t,l,x0,velocity,lag");
    for (name, in_csv) in ["t", "l", "x0", "velocity", "lag"].iter().zip(&columns) {
        let in_json = column(&document, &format!("/samples/{name}"));
        assert_eq!(&in_json, in_csv, "{name}");
        assert_eq!(in_json, vector(name), "{name}");
    }
    for name in ["nodes", "weights", "t", "extension"] {
        let in_json = column(&document, &format!("/history/{name}"));
        assert_eq!(in_json, vector(&format!("history_{name}")), "{name}");
    }
    let displacement: Array2<f64> = npz.by_name("history_displacement").unwrap();
    let rows = document["history"]["displacement"].as_array().unwrap();
    assert_eq!(displacement.nrows(), rows.len());
    for (i, row) in displacement.rows().into_iter().enumerate() {
        let pointer = format!("/history/displacement/{i}");
        assert_eq!(bits(row.to_vec()), column(&document, &pointer));
    }

    let line = "surface run.json --at 30,60 --range 20,40 --spacing 0.1";
    let document = folder.prints_json(line);
    folder.prints(&format!("{line} -o u.csv"));
    folder.prints(&format!("{line} -o u.npz"));
    let curves =
        [0, 1].map(|i| ["x", "u"].map(|c| column(&document, &format!("/surfaces/{i}/{c}"))));
    let columns = csv(&folder, "u.csv", "t,x,u");
    assert_eq!(columns[1], [&curves[0][0][..], &curves[1][0]].concat());
    assert_eq!(columns[2], [&curves[0][1][..], &curves[1][1]].concat());
    let mut npz = NpzReader::new(Cursor::new(folder.read("u.npz"))).unwrap();
    let u: Array2<f64> = npz.by_name("u").unwrap();
    assert_eq!(bits(u), columns[2]);
}

#[test]
fn what_is_read_back_is_what_was_written() {
    let folder = Folder::new("read_back");
    let text = folder.prints("run --alpha-above 0.1 --r 1 --kick 0.5 --until 60");
    let document: Value = serde_json::from_slice(&text).unwrap();
    let again: Value = serde_json::from_str(&document.to_string()).unwrap();
    assert_eq!(document, again);
    // Every number in its shortest form: printed again, it is the same text.
    let text = String::from_utf8(text).unwrap();
    let numbers = |text: &str| -> Vec<String> {
        let digits = |c: char| c.is_ascii_digit() || "+-.e".contains(c);
        let words = text.split(|c| !digits(c)).filter(|w| w.parse::<f64>().is_ok());
        let mut words: Vec<String> = words.map(String::from).collect();
        words.sort();
        words
    };
    assert_eq!(numbers(&text), numbers(&document.to_string()));
    // The model in the document is the one that was run.
    let alpha = document["parameters"]["alpha"].as_f64().unwrap();
    let line = format!("run --alpha {alpha} --r 1 --kick 0.5 --until 60");
    assert_eq!(folder.prints_json(&line)["history"], document["history"]);
}

/// The document without the one field that may differ.
fn without_seconds(text: &[u8]) -> String {
    let text = String::from_utf8(text.to_vec()).unwrap();
    let (before, after) = text.split_once("\"seconds\":").unwrap();
    let rest = after.find(['}', ',']).unwrap();
    format!("{before}{}", &after[rest..])
}

#[test]
fn the_same_input_gives_the_same_bytes_whatever_the_threads() {
    let folder = furnished("determinism");
    let files = ["run.json", "run.npz", "run.csv", "run.svg", "u.json", "u.npz", "u.csv", "u.svg"];
    let run = "run --alpha-above 0.1 --r 1 --kick 0.5 --noise 1e-4 --until 120";
    let surface = "surface run.json --at 60,120 --range 0,130 --spacing 0.002";
    let lines = [
        format!("{run} -o run.json --plot run.svg"),
        format!("{run} -o run.npz"),
        format!("{run} -o run.csv"),
        format!("{surface} -o u.json --plot u.svg"),
        format!("{surface} -o u.npz"),
        format!("{surface} -o u.csv"),
    ];
    let with_threads = |threads: &str| {
        for line in &lines {
            let status =
                folder.command(line).env("RAYON_NUM_THREADS", threads).output().unwrap().status;
            assert!(status.success(), "{line}");
        }
        files.map(|name| folder.read(name))
    };
    let first = with_threads("1");
    for threads in ["2", "2", "3"] {
        let next = with_threads(threads);
        assert_eq!(without_seconds(&first[0]), without_seconds(&next[0]), "run.json");
        for ((name, one), other) in files.iter().zip(&first).zip(&next).skip(1) {
            assert!(one == other, "{name} differs with {threads} threads");
        }
    }
}
