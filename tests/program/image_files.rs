//! Can others open the images? A `.gsf` is read by the Python package `gsffile`, an `.npz` by NumPy, and
//! compared with the JSON document. The Python of `STICKSLIP_PYTHON` must have both; where that is not
//! set, `python3` is tried, and what it lacks is said and skipped.

use crate::folder::{Folder, said};
use serde_json::{Value, json};
use std::process::Command;

/// What `code` prints as JSON, or `None` where no Python can run it.
fn python(folder: &Folder, code: &str) -> Option<Value> {
    let asked = std::env::var("STICKSLIP_PYTHON").ok();
    let name = asked.clone().unwrap_or_else(|| "python3".into());
    let output = Command::new(name).current_dir(folder.path("")).args(["-c", code]).output();
    let output = match (output, asked) {
        (Ok(output), Some(_)) => output,
        (Err(error), Some(name)) => panic!("STICKSLIP_PYTHON {name}: {error}"),
        (Ok(output), None) if !said_missing(&output.stderr) => output,
        (_, None) => {
            println!("skipped: python3 with numpy and gsffile is needed to read the files");
            return None;
        }
    };
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Some(serde_json::from_slice(&output.stdout).unwrap())
}

fn said_missing(stderr: &[u8]) -> bool {
    String::from_utf8_lossy(stderr).contains("ModuleNotFoundError")
}

/// A run and the units that go with it.
fn furnished(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.prints("run --tip gaussian --alpha 2.1 --r 1 --kick 0.1 --until 80 -o run.json");
    folder.prints(
        "units --tip gaussian --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm --slope-force 5nN --alpha 2.1 --r 1 -o units.json",
    );
    folder
}

const IMAGE: &str = "surface run.json --at 70 --range 20,50 --spacing 0.25 --y-range -2,1.5";

fn numbers(value: &Value) -> Vec<f64> {
    match value {
        Value::Array(values) => values.iter().flat_map(numbers).collect(),
        number => vec![number.as_f64().unwrap()],
    }
}

fn agree(found: &Value, expected: &Value, factor: f64, tolerance: f64) {
    let (found, expected) = (numbers(found), numbers(expected));
    assert_eq!(found.len(), expected.len());
    let size = expected.iter().fold(0.0_f64, |m, v| m.max(v.abs())) * factor;
    for (found, expected) in found.iter().zip(expected) {
        assert!((found - factor * expected).abs() <= tolerance * size, "{found} {expected}");
    }
}

const READ_GSF: &str = "
import gsffile, json
data, about = gsffile.read_gsf('image.gsf')
print(json.dumps({'shape': data.shape, 'u': data.astype(float).tolist(), 'about': about}))";

#[test]
fn gsf_images_are_read_with_their_place_and_units() {
    let folder = furnished("gsf");
    let document = folder.prints_json(IMAGE);
    let image = &document["images"][0];
    let units = folder.json("units.json");
    let scale = |name: &str| units["scales"][name].as_f64().unwrap();
    for (options, length, height, unit) in [
        ("", 1.0, 1.0, Value::Null),
        ("--units units.json", scale("length"), scale("height"), json!("m")),
    ] {
        folder.prints(&format!("{IMAGE} {options} -o image.gsf"));
        let Some(read) = python(&folder, READ_GSF) else { return };
        assert_eq!(read["shape"], json!([15, 121]));
        agree(&read["u"], &image["u"], height, 1e-7);
        let about = &read["about"];
        for name in ["XYUnits", "ZUnits"] {
            assert_eq!(about[name], unit, "{about}");
        }
        // 121 by 15 pixels of 0.25, the first centered on (20, -2).
        for (name, value) in
            [("XReal", 30.25), ("YReal", 3.75), ("XOffset", 19.875), ("YOffset", -2.125)]
        {
            agree(&about[name], &json!(value), length, 1e-12);
        }
    }
}

const READ_NPZ: &str = "
import numpy, json
with numpy.load('image.npz') as read:
    print(json.dumps({name: read[name].tolist() for name in read.files}))";

#[test]
fn npz_images_are_read_by_numpy() {
    let folder = furnished("npz");
    let document = folder.prints_json(&IMAGE.replace("70", "60,70"));
    folder.prints(&format!("{} -o image.npz", IMAGE.replace("70", "60,70")));
    let Some(read) = python(&folder, READ_NPZ) else { return };
    let images = document["images"].as_array().unwrap();
    assert_eq!(read["t"], json!([60.0, 70.0]));
    for name in ["x", "y"] {
        agree(&read[name], &images[0][name], 1.0, 0.0);
    }
    for (read, image) in read["u"].as_array().unwrap().iter().zip(images) {
        agree(read, &image["u"], 1.0, 0.0);
    }
}

#[test]
fn csv_images_have_a_line_for_each_point() {
    let folder = furnished("csv");
    let document = folder.prints_json(IMAGE);
    folder.prints(&format!("{IMAGE} -o image.csv"));
    let text = String::from_utf8(folder.read("image.csv")).unwrap();
    let rows: Vec<&str> = text.lines().collect();
    assert_eq!(rows[0], "t,x,y,u");
    assert_eq!(rows.len(), 1 + 15 * 121);
    let image = &document["images"][0];
    for (j, i) in [(0, 0), (3, 7), (14, 120)] {
        let cells: Vec<f64> =
            rows[1 + 121 * j + i].split(',').map(|cell| cell.parse().unwrap()).collect();
        let expected = json!([70.0, image["x"][i], image["y"][j], image["u"][j][i]]);
        agree(&json!(cells), &expected, 1.0, 0.0);
    }
}

#[test]
fn height_maps_are_drawn_as_svg_and_png() {
    let folder = furnished("maps");
    folder.prints(&format!("{IMAGE} -o image.json --plot map.svg"));
    let svg = String::from_utf8(folder.read("map.svg")).unwrap();
    assert!(svg.contains("<image ") && svg.contains("data:image/png;base64,"));
    assert!(svg.contains("u (kσ²/a)") && svg.contains("y (σ)"), "axes and bar have labels");
    if cfg!(feature = "png") {
        folder.prints(&format!("{IMAGE} -o image.json --plot map.png"));
        assert!(folder.read("map.png").starts_with(b"\x89PNG\r\n\x1a\n"));
    }
}

#[test]
fn a_tip_that_may_leave_its_line_is_warned_of() {
    let folder = Folder::new("warned");
    folder.prints("run --alpha 1 --r 1 --until 40 -o run.json");
    let line = "surface run.json --range 20,30 --y-range -1,1 -o image.json";
    let output = folder.stickslip(line);
    assert!(output.status.success());
    assert!(said(&output).contains("f_yy(x,0) > 0"), "{}", said(&output));
    let needed = &folder.json("image.json")["parameters"]["across"]["transverse_stiffness_needed"];
    assert!(needed.as_f64().unwrap() > 0.5, "{needed}");
    folder.prints("run --tip gaussian --alpha 1 --r 1 --until 40 -o run.json");
    assert!(!said(&folder.stickslip(line)).contains("f_yy"));
}

#[test]
fn the_run_and_its_image_use_one_description_of_the_tip() {
    let folder = Folder::new("one_tip");
    let pair = "{\"gaussians\":[
        {\"amplitude\":1,\"center\":0,\"width\":1,\"width_y\":0.5},
        {\"amplitude\":0.4,\"center\":0,\"width\":0.8,\"center_y\":1.5,\"width_y\":0.6},
        {\"amplitude\":0.4,\"center\":0,\"width\":0.8,\"center_y\":-1.5,\"width_y\":0.6}]}";
    folder.write("tip.json", pair);
    let run = "run --tip-file tip.json --alpha 1 --r 1 --start flat --until 40";
    folder.prints(&format!("{run} -o run.json"));
    let lobe = 0.8 * (-0.5 * (1.5_f64 / 0.6).powi(2)).exp();
    let plane = format!(
        "{{\"gaussians\":[{{\"amplitude\":1,\"center\":0,\"width\":1}},
        {{\"amplitude\":{lobe},\"center\":0,\"width\":0.8}}]}}"
    );
    folder.write("tip.json", plane);
    let x0 = |document: Value| numbers(&document["samples"]["x0"]);
    let (in_3d, in_2d) = (x0(folder.json("run.json")), x0(folder.prints_json(run)));
    assert!(in_3d.iter().zip(&in_2d).all(|(a, b)| (a - b).abs() < 1e-10));
    let curve = folder.prints_json("surface run.json --x 20,25,30");
    let image =
        folder.prints_json("surface run.json --x 20,25,30 --y-range -1.5,1.5 --spacing-y 1.5");
    agree(&image["images"][0]["u"][1], &curve["surfaces"][0]["u"], 1.0, 1e-12);
    // Beside the path it is the other Gaussians that carve.
    let beside = numbers(&image["images"][0]["u"][2]);
    assert!(beside.iter().all(|u| *u < -0.5), "{beside:?}");
}

/// A grid of f(x,y) as CSV.
fn table(f: impl Fn(f64, f64) -> f64) -> String {
    let mut text = String::from("x,y,f\n");
    for i in 0..30 {
        for j in 0..30 {
            let (x, y) = (0.25 * f64::from(i), 0.25 * f64::from(j));
            text += &format!("{x},{y},{}\n", f(x, y));
        }
    }
    text
}

#[test]
fn a_table_of_the_tip_gives_the_image_of_its_formula() {
    let folder = Folder::new("table_3d");
    folder.write("tip.csv", table(|x, y| (-0.5 * (x * x + y * y)).exp()));
    folder.prints("run --tip-file tip.csv --alpha 1 --r 1 --until 40 -o table.json");
    folder.prints("run --tip gaussian --alpha 1 --r 1 --until 40 -o formula.json");
    let u = |name: &str| {
        let line = format!("surface {name} --range 10,40 --spacing 1 --y-range -2,2");
        folder.prints_json(&line)["images"][0]["u"].clone()
    };
    agree(&u("table.json"), &u("formula.json"), 1.0, 1e-6);
}

#[test]
fn what_does_not_go_together_is_refused() {
    let folder = furnished("image_refusals");
    let cases: [(&str, &[&str]); 12] = [
        ("--y-range 1,-1", &["--y-range 1,-1", "LO below HI"]),
        ("--y-range -1,1 --spacing-y 0", &["--spacing-y 0", "above 0"]),
        ("--y-range -1,1 --spacing 1e-4 --spacing-y 1e-4", &["--spacing 0.0001", "or more"]),
        ("--y-range -1,1 --width-y -2", &["--width-y -2", "above 0"]),
        ("--spacing-y 0.1", &["--y-range"]),
        ("-o image.gsf", &["--output image.gsf", "--y-range"]),
        ("--y-range -1,1 --x 20,21 -o image.gsf", &["--output image.gsf", "--range"]),
        ("--y-range -1,1 --at 40,50 -o image.gsf", &["--output image.gsf", "one image"]),
        ("--y-range -1,1 --sigma 20nm -o image.gsf", &["--output", "--slope-force"]),
        ("--y-range -1,1 --units none.json -o image.gsf", &["--units none.json", "read"]),
        ("--y-range -1,1 --units run.json -o image.gsf", &["--units run.json", "stickslip units"]),
        ("--y-range -1,1 --x 20,21 --plot map.svg", &["--x", "--range"]),
    ];
    for (options, words) in cases {
        folder.refuses(&format!("surface run.json {options}"), words);
    }
    folder.prints("run --tip bessel --alpha 0.5 --r 1 --until 40 -o bessel.json");
    folder.refuses("surface bessel.json --y-range -1,1", &["--width-y", "f(x,y)"]);
    folder.write(
        "tip.json",
        "{\"gaussians\":[{\"amplitude\":1,\"center\":0,\"width\":1,\"width_y\":2}]}",
    );
    folder.prints("run --tip-file tip.json --alpha 0.5 --r 1 --until 40 -o own.json");
    folder.refuses("surface own.json --y-range -1,1 --width-y 1", &["--width-y 1", "its own"]);
    folder.write(
        "tip.json",
        "{\"gaussians\":[{\"amplitude\":1,\"center\":0,\"width\":1,\"center_y\":0}]}",
    );
    folder.refuses("run --tip-file tip.json --alpha 1 --r 1 --until 40", &["tip.json", "width_y"]);
}
