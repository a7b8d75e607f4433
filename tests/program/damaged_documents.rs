//! What is said of run documents that were damaged. No oracle: the contract of the reader alone.

use crate::folder::Folder;
use serde_json::{Value, json};

/// A change to a document, and what is said about it.
type Damage = (&'static str, fn(&mut Value), &'static str);

const DAMAGES: [Damage; 22] = [
    ("format", |d| d["format"] = json!("other/run"), "\"stickslip/run\" is needed"),
    ("format", |d| d["format"] = json!(3), "not a complete JSON document"),
    ("format_version", |d| d["format_version"] = json!(2), "this program reads 1"),
    ("array", |d| *d = json!([1, 2]), "not a complete JSON document"),
    ("extra field", |d| d["more"] = json!(1), "unknown field `more`"),
    ("null", |d| d["history"]["extension"][3] = Value::Null, "invalid type: null"),
    ("short", |d| drop(list(d, "t").pop()), "matching lengths"),
    ("short", |d| drop(list(d, "extension").pop()), "matching lengths"),
    ("short", |d| drop(list(d, "displacement").pop()), "matching lengths"),
    (
        "stages",
        |d| d["history"]["displacement"][3] = json!([0.1]),
        "invalid length 1, expected an array of length 6",
    ),
    ("empty", forget, "matching lengths"),
    ("backwards", |d| list(d, "t").reverse(), "t does not increase"),
    ("nodes", |d| d["history"]["nodes"] = json!([0.5, 1.0]), "nodes and weights"),
    ("weights", |d| d["history"]["weights"][0] = json!(0.7), "nodes and weights"),
    ("a gap", |d| d["history"]["extension"][3] = json!(7.5), "does not begin where step 2 ends"),
    ("huge", |d| d["history"]["extension"][3] = json!(1e300), "step 3 has numbers beyond"),
    ("huge", |d| d["history"]["displacement"][3][0] = json!(-1e308), "step 3 has numbers beyond"),
    ("huge", |d| d["history"]["t"][0] = json!(-1.7e308), "step 0 has numbers beyond"),
    ("r", |d| d["parameters"]["r"] = json!(0), "above 0, not 0"),
    ("alpha", |d| d["parameters"]["alpha"] = json!(-1), "0 or above, not -1"),
    ("tip", |d| d["parameters"]["tip"]["gaussians"][0]["width"] = json!(0), "above 0"),
    ("until", |d| d["parameters"]["until"] = json!(1), "starts at"),
];

fn list<'a>(document: &'a mut Value, name: &str) -> &'a mut Vec<Value> {
    document["history"][name].as_array_mut().unwrap()
}

fn forget(document: &mut Value) {
    ["t", "extension", "displacement"].iter().for_each(|name| list(document, name).clear());
}

#[test]
fn damaged_run_documents_are_refused() {
    let folder = Folder::new("damaged");
    let whole = folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 30");
    for (what, damage, words) in DAMAGES {
        let mut document: Value = serde_json::from_slice(&whole).unwrap();
        damage(&mut document);
        folder.write("run.json", document.to_string());
        println!("{what}");
        folder.refuses("surface run.json", &["RUN.json run.json", words]);
    }
    let text = String::from_utf8(whole).unwrap();
    let texts = [
        (String::new(), "not a complete JSON document"),
        (text[..text.len() / 2].into(), "write it again"),
        (text[..text.len() - 3].into(), "write it again"),
        (text.repeat(2), "not a complete JSON document"),
        (text.replace("\"extension\":[", "\"extension\":[NaN,"), "not a complete JSON document"),
        (text.replace("\"extension\":[", "\"extension\":[1e999,"), "damaged"),
        ("[".repeat(100_000), "not a complete JSON document"),
    ];
    for (text, words) in texts {
        folder.write("run.json", text);
        folder.refuses("surface run.json", &["RUN.json run.json", words]);
    }
}

/// Changes to a document, and what is said where it is read.
type Case = (&'static str, fn(&mut Value), &'static str, &'static str);

/// Numbers that sizes follow from: what once panicked, or asked for 53 GB and 3.9 TB.
const SIZES: [Case; 9] = [
    ("cycle.json", |d| d["history"]["displacement"][3][2] = json!(-1e9), PLOT, "within step 3"),
    (
        "run.json",
        |d| d["parameters"]["tip"]["gaussians"][0]["width"] = json!(1e10),
        "verify DOC",
        "more than fit in memory",
    ),
    (
        "run.json",
        |d| d["parameters"]["tip"]["gaussians"][0]["width"] = json!(1e10),
        PLOT,
        "more than fit in memory",
    ),
    (
        "raster.json",
        |d| d["history"]["lines"][1]["displacement"][3][2] = json!(-1e9),
        "surface DOC",
        "within step 3",
    ),
    ("raster.json", leave, "surface DOC", "GB"),
    ("raster.json", leave, PLOT, "GB"),
    (
        "path.json",
        |d| drop(d["parameters"]["support_path"]["R"].as_array_mut().unwrap().pop()),
        "verify DOC",
        "columns have 3 and 2 rows",
    ),
    (
        "path.json",
        |d| drop(d["parameters"]["support_path"]["R"].as_array_mut().unwrap().pop()),
        PLOT,
        "columns have 3 and 2 rows",
    ),
    ("figure.json", |d| d["panels"][0]["x_range"] = json!([0, 1e-310]), PLOT, "no axis goes"),
];

const PLOT: &str = "plot DOC -o out.svg";

/// Line 2 goes 1e9 to the left in one step, and every later one begins where the last one ended.
fn leave(document: &mut Value) {
    let line = &mut document["history"]["lines"][1];
    let count = line["extension"].as_array().unwrap().len();
    let by = 1e9;
    for number in line["displacement"][0].as_array_mut().unwrap() {
        *number = json!(number.as_f64().unwrap() - by);
    }
    for i in 1..count {
        let extension = &mut line["extension"][i];
        *extension = json!(extension.as_f64().unwrap() + by);
    }
}

#[test]
fn sizes_are_judged_before_they_are_allocated() {
    let folder = Folder::new("damaged_sizes");
    folder.write("path.csv", "t,R\n0,0\n10,10\n20,0\n");
    let raster = "--r 1 --alpha 1.2 --pitch 1 --width-y 1 --lines 3 --length 12 --tolerance 1e-5";
    for (name, line) in [
        ("run.json", "run --alpha 1.2 --r 1 --kick 0.05 --until 30 --tolerance 1e-6".to_owned()),
        ("cycle.json", "cycle --alpha 1.2 --r 1 --tolerance 1e-4 --points 40".to_owned()),
        ("raster.json", format!("raster {raster}")),
        (
            "path.json",
            "run --alpha 1.2 --r 1 --support-path path.csv --until 20 --tolerance 1e-6".to_owned(),
        ),
    ] {
        folder.prints(&format!("{line} -o {name}"));
    }
    folder.write(
        "figure.json",
        json!({"format": "stickslip/figure", "format_version": 1, "name": "f", "title": "",
            "software": {"name": "stickslip", "version": "0"}, "parameters": {"models": []},
            "remarks": [], "panels": [{"heading": "", "x_label": "x", "y_label": "y",
            "curves": [], "map": null, "y_range": null}]})
        .to_string(),
    );
    for (name, damage, line, words) in SIZES {
        let mut document = folder.json(name);
        folder.write("whole.json", document.to_string());
        folder.prints(&line.replace("DOC", "whole.json"));
        damage(&mut document);
        folder.write("damaged.json", document.to_string());
        println!("{name}: {line}");
        folder.refuses(&line.replace("DOC", "damaged.json"), &["damaged.json", words]);
    }
}

/// A picture shows what follows from the motion, whatever else the document says.
#[test]
fn a_cycle_is_drawn_from_its_motion() {
    let folder = Folder::new("damaged_cycle");
    folder.prints("cycle --alpha 1.2 --r 1 --tolerance 1e-4 --points 40 -o cycle.json");
    folder.prints("plot cycle.json -o whole.svg");
    for (field, value) in [
        ("amplitude_x0", -1e9),
        ("amplitude_x0", 1e300),
        ("wavelength", 1e-300),
        ("wavelength", -1.0),
    ] {
        let mut document = folder.json("cycle.json");
        document[field] = json!(value);
        folder.write("damaged.json", document.to_string());
        folder.prints("plot damaged.json -o damaged.svg");
        assert_eq!(folder.read("damaged.svg"), folder.read("whole.svg"), "{field} {value}");
    }
}

#[test]
fn ranges_that_no_axis_shows_are_refused() {
    let folder = Folder::new("damaged_ranges");
    folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 30 --tolerance 1e-6 -o run.json");
    for range in ["0:1e-310", "0:5e-324", "1:1.0000000000000002", "-1e-200:1e-200", "1e99:1e101"] {
        for option in ["--x-range", "--y-range"] {
            let line = format!("plot run.json -o run.svg {option}={range}");
            folder.refuses(&line, &[option, range]);
        }
    }
    folder.prints("plot run.json -o run.svg --x-range=20:20.000001 --y-range=0:1e-90");
    // A sweep over what no axis shows is drawn too, however little there is to see.
    folder.prints("sweep --r 1 --alpha 0:1e-320:3 --plot map.svg -o map.json");
    folder.prints("plot map.json -o again.svg");
}
