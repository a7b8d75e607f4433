//! `stickslip fit --image` and `stickslip friction`: from files as instruments write them, with units, to numbers and pictures.

use crate::folder::{Folder, said};
use serde_json::Value;

/// Ripples of a raster at α = 0.9, r = 1, pitch 1, in an image with σ = 30 nm and kσ²/a = 18 nm.
fn scanned(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.prints(
        "raster --tip gaussian --alpha 0.9 --r 1 --pitch 1 --lines 90 --length 90 --tolerance 1e-6 -o raster.json",
    );
    let image = "surface raster.json --range 45:82:64 --y-range 46:84:64";
    let scales = "--sigma 30nm --stiffness 0.2N/m --slope-force 10nN";
    folder.prints(&format!("{image} {scales} -o scan.gsf"));
    folder.prints(&format!("{image} -o bare.gsf"));
    folder
}

fn holds(estimate: &Value, truth: f64) {
    let [low, high] = ["low", "high"].map(|end| estimate[end].as_f64().unwrap());
    assert!(low < truth && truth < high && high - low < 0.2 * truth, "{truth}: {estimate}");
}

const LINE: &str = "fit --image scan.gsf --tip gaussian";

#[test]
fn an_image_gives_back_alpha_and_r() {
    let folder = scanned("image_fit");
    folder.prints(&format!("{LINE} --width 30nm --pitch 30nm -o fit.json --plot fit.svg"));
    let fit = folder.json("fit.json");
    holds(&fit["alpha"], 0.9);
    holds(&fit["r"], 1.0);
    assert_eq!((&fit["scan"], &fit["slow_scan"]), (&"right".into(), &"up".into()));
    assert_eq!(fit["parameters"]["unit"], "nm");
    assert_eq!(fit["parameters"]["height_unit"], "nm");
    let picture = String::from_utf8(folder.read("fit.svg")).unwrap();
    assert_eq!(picture.matches("height (nm)").count(), 2, "colours and mean ripple");
    let gain = fit["height_gain"].as_f64().unwrap();
    assert!((gain / 0.02 - 1.0).abs() < 0.03, "{gain}");
    let critical = fit["critical_alpha"].as_f64().unwrap();
    assert!((critical / 0.8052 - 1.0).abs() < 0.02, "{critical}");
    // As saved, and in other units, to the last bit.
    folder.prints("plot fit.json -o again.svg");
    assert_eq!(folder.read("fit.svg"), folder.read("again.svg"));
    for lengths in ["--width 30 --pitch 30", "--width 0.03um --pitch 0.03um"] {
        let other = folder.prints_json(&format!("{LINE} {lengths}"));
        let close = |name: &str| {
            let [one, other] = [&fit, &other].map(|fit| fit[name]["value"].as_f64().unwrap());
            (one / other - 1.0).abs() < 1e-9
        };
        assert!(close("alpha") && close("r"), "{lengths}: {other}");
    }
    let table =
        String::from_utf8(folder.prints(&format!("{LINE} --width 30 --format csv"))).unwrap();
    assert!(table.starts_with("distance_nm,height_nm,error_nm,model_nm\n"), "{table}");
    // The same image as its own retrace: no shift, no difference, and the same numbers.
    folder
        .prints(&format!("{LINE} --width 30nm --pitch 30nm --retrace-image scan.gsf -o both.json"));
    let both = folder.json("both.json");
    for name in ["alpha", "r"] {
        let [one, two] = [&fit, &both].map(|fit| fit[name]["value"].as_f64().unwrap());
        assert!((one / two - 1.0).abs() < 1e-6, "{one} {two}");
    }
    let number = |name: &str| both["retrace"][name].as_f64().unwrap();
    assert!(number("shift").abs() < 1e-9 && number("agreement") > 0.99, "{}", both["retrace"]);
    // The fit is a set of scales.
    let found = folder.prints_json("stability --r 1 --tip gaussian --units fit.json");
    let length = found["physical"]["scales"]["length"].as_f64().unwrap();
    assert!((length / 30e-9 - 1.0).abs() < 1e-12, "{length}");
}

/// Heights in V have their unit in document and picture, and no scale in metres follows from them.
#[test]
fn heights_keep_the_unit_of_the_image() {
    let folder = scanned("image_in_volts");
    let bytes = folder.read("scan.gsf");
    let at = bytes.windows(10).position(|word| word == b"ZUnits = m").unwrap();
    let volts = [&bytes[..at], b"ZUnits = V", &bytes[at + 10..]].concat();
    folder.write("volts.gsf", &volts);
    let line = "fit --image volts.gsf --tip gaussian --width 30nm --pitch 30nm";
    folder.prints(&format!("{line} -o volts.json --plot volts.svg"));
    assert_eq!(folder.json("volts.json")["parameters"]["height_unit"], "V");
    let picture = String::from_utf8(folder.read("volts.svg")).unwrap();
    assert_eq!(picture.matches("height (V)").count(), 2, "colours and mean ripple");
    let scales = |units: &str| {
        let line = format!("stability --r 1 --tip gaussian --units {units}");
        folder.prints_json(&line)["physical"]["scales"].clone()
    };
    folder.prints(&format!("{LINE} --width 30nm --pitch 30nm -o fit.json"));
    // kσ²/a = k²σ²/(force per slope) = 18 nm.
    let height = scales("fit.json")["height"].as_f64().unwrap();
    assert!((height / 18e-9 - 1.0).abs() < 0.03, "{height}");
    assert!(scales("volts.json")["height"].is_null());
}

/// Without a unit the lengths are those of the image; the pitch is that of the rows, with a remark.
#[test]
fn an_image_in_sigma_needs_no_units() {
    let folder = scanned("bare_image");
    let found = folder.prints_json("fit --image bare.gsf --tip gaussian --width 1 --pitch 1");
    holds(&found["alpha"], 0.9);
    holds(&found["r"], 1.0);
    let rows = folder.prints_json("fit --image bare.gsf --tip gaussian --width 1");
    let spacing = rows["parameters"]["pitch"].as_f64().unwrap();
    assert!((spacing - 38.0 / 63.0).abs() < 1e-6, "{spacing}");
    assert!(rows["remarks"].to_string().contains("no pitch is given"), "{}", rows["remarks"]);
}

#[test]
fn what_an_image_lacks_is_named() {
    let folder = scanned("image_fit_refusals");
    folder.write("loop.csv", "x,trace,retrace\n0,1,-1\n");
    for (line, words) in [
        (LINE, ["--width", "σ of the tip is needed"]),
        ("fit --image scan.gsf --width 0nm", ["--width 0", "above 0"]),
        ("fit --image scan.gsf --width 30nm --pitch=-3nm", ["--pitch", "above 0"]),
        (
            "fit --image scan.gsf --width 30nm --inertia 1",
            ["--inertia 1", "no meaning with --image"],
        ),
        ("fit --image scan.gsf --width 30nm --r=-1", ["--r -1", "above 0"]),
        (
            "fit --image scan.gsf --width 30nm --free-stiffness-across",
            ["--free-stiffness-across", "give --alpha or --r"],
        ),
        (
            "fit --image scan.gsf --width 30nm --lateral-image bare.gsf",
            ["--lateral-image bare.gsf", "unit"],
        ),
        ("fit --ripple loop.csv --stiffness-across 3", ["--stiffness-across 3", "no meaning"]),
        ("fit --image bare.gsf --width 30nm", ["--width", "--unit"]),
        (
            "fit --image scan.gsf --width 30nm --retrace-image bare.gsf",
            ["--retrace-image bare.gsf", "another unit"],
        ),
        ("fit --image loop.csv --width 30nm", ["loop.csv", "convert"]),
        ("fit --ripple scan.gsf", ["scan.gsf", "fit --image"]),
        ("fit --ripple loop.csv --slow-scan up", ["--slow-scan up", "no meaning"]),
        (
            "run --alpha 1 --r 1 --until 9 --tip gaussian --width 30nm",
            ["--width", "a unit needs the scales"],
        ),
    ] {
        folder.refuses(line, &words);
    }
    // A σ that is three times too large: no ripples of the model are as short.
    let output = folder.stickslip(&format!("{LINE} --width 90nm --pitch 30nm -o wrong.json"));
    let is_judged = !output.status.success() || folder.json("wrong.json")["explained"] == false;
    assert!(is_judged, "{}", said(&output));
}

/// Kinetic force 6 nN, static peak 9 nN, stiffness 0.25 N/m, a zero of 1.5 nN and noise.
fn lateral(folder: &Folder) {
    let mut state = 7_u32;
    let mut random = move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        0.1 * (f64::from(state) / f64::from(u32::MAX) - 0.5)
    };
    let force = |x: f64| match x - 60.0 {
        before if before < 0.0 => -6.0 + 0.25 * x,
        beyond => {
            let decay = (-beyond / 30.0).exp();
            6.0 + 0.6 * (1.0 - decay) * (beyond / 17.0).sin() + 3.0 * decay
        }
    };
    let (length, rows) = (2000.0, 1500);
    let [mut trace, mut retrace] = ["x_nm,force_nN\n".to_owned(), "x (um);force (nN)\n".into()];
    let [mut bent, mut volts] =
        ["x_nm,trace_nm,retrace_nm\n".to_owned(), "x (nm);trace (V);retrace (V)\n".into()];
    for i in 0..rows {
        let x = length * f64::from(i) / f64::from(rows - 1);
        let (there, back) = (force(x) + 1.5 + random(), 1.5 + random() - force(length - x));
        trace += &format!("{x},{there}\n");
        // Backwards, in µm, with decimal commas.
        let row = format!("{};{}\n", 1e-3 * (length - x), 1.5 + random() - force(x));
        retrace += &row.replace('.', ",");
        bent += &format!("{x},{},{}\n", there / 0.2, back / 0.2);
        volts += &format!("{x};{};{}\n", there / 25.0, back / 25.0);
    }
    for (name, table) in
        [("trace.csv", trace), ("retrace.csv", retrace), ("bent.csv", bent), ("volts.csv", volts)]
    {
        folder.write(name, table);
    }
}

#[test]
fn friction_forces_and_work_come_in_nanonewtons_and_femtojoules() {
    let folder = Folder::new("friction_command");
    lateral(&folder);
    folder.prints("friction trace.csv retrace.csv -o friction.json --plot friction.svg");
    let found = folder.json("friction.json");
    for (name, truth) in
        [("kinetic", 6.0), ("static_peak", 9.0), ("stiffness", 0.25), ("offset", 1.5)]
    {
        holds(&found[name], truth);
    }
    // ∮ F dx by hand: rises from -6 to 9 within 60 nm, then 6 nN, and 3 nN times the decay of 30 nm; 1 nN nm is 1e-3 fJ.
    let work = 2.0 * (1.5 * 60.0 + 6.0 * 1940.0 + 3.0 * 30.0) * 1e-3;
    holds(&found["work"], work);
    assert_eq!((&found["force_unit"], &found["work_unit"]), (&"nN".into(), &"fJ".into()));
    let [mean, hysteresis] =
        ["mean", "hysteresis"].map(|name| found[name]["value"].as_f64().unwrap());
    assert!((hysteresis / (2.0 * mean) - 1.0).abs() < 1e-12);
    assert!((mean * 2.0 * 2.0 / found["work"]["value"].as_f64().unwrap() - 1.0).abs() < 1e-6);
    folder.prints("plot friction.json -o again.svg");
    assert_eq!(folder.read("friction.svg"), folder.read("again.svg"));
    // Deflections and voltages of the same loop.
    for line in ["friction bent.csv --stiffness 0.2N/m", "friction volts.csv --sensitivity 25nN/V"]
    {
        let other = folder.prints_json(line);
        for (name, truth) in [("kinetic", 6.0), ("work", work)] {
            holds(&other[name], truth);
        }
        assert_eq!(other["force_unit"], "nN");
    }
    // Forces with different prefixes, in the unit of the first; 1 pN is 1e-3 nN.
    let retrace = String::from_utf8(folder.read("retrace.csv")).unwrap();
    let rows = retrace.lines().skip(1).map(|row| row.replace(',', "."));
    let in_pn = rows.map(|row| {
        let (x, force) = row.split_once(';').unwrap();
        format!("{x};{}\n", 1e3 * force.parse::<f64>().unwrap())
    });
    folder.write("pn.csv", "x (um);force (pN)\n".to_owned() + &in_pn.collect::<String>());
    folder.write("bare.csv", retrace.replace(" (nN)", ""));
    let mixed = folder.prints_json("friction trace.csv pn.csv");
    let millivolts = folder.prints_json("friction volts.csv --sensitivity 25pN/mV");
    for (other, expected) in [
        (mixed, &found),
        (millivolts, &folder.prints_json("friction volts.csv --sensitivity 25nN/V")),
    ] {
        for name in ["kinetic", "static_peak", "work"] {
            let [other, expected] = [&other, expected].map(|f| f[name]["value"].as_f64().unwrap());
            assert!((other / expected - 1.0).abs() < 1e-12, "{name}: {other} {expected}");
        }
        assert_eq!(other["force_unit"], "nN");
    }
    let table = String::from_utf8(folder.prints("friction trace.csv pn.csv --format csv"));
    assert!(table.unwrap().starts_with("x_nm,trace_nN,retrace_nN\n"));
    let bare = folder.prints_json("friction volts.csv");
    assert_eq!((&bare["force_unit"], &bare["work_unit"]), (&"V".into(), &Value::Null));
    assert!(bare["remarks"].to_string().contains("not in fJ"));
    // A retrace that ends half way has no second reversal.
    let half: String = String::from_utf8(folder.read("retrace.csv"))
        .unwrap()
        .split_inclusive('\n')
        .take(750)
        .collect();
    folder.write("half.csv", half);
    let part = folder.prints_json("friction trace.csv half.csv")["remarks"].to_string();
    assert!(part.contains("from 1002 to 2000 in common"), "{part}");
    assert_eq!(found["remarks"], serde_json::json!([]));
    for (line, words) in [
        ("friction trace.csv", ["trace.csv", "3 are needed"]),
        ("friction trace.csv trace.csv", ["trace.csv", "exchanged"]),
        ("friction volts.csv --stiffness 0.2N/m", ["--stiffness 0.2N/m", "unit of length"]),
        ("friction volts.csv --sensitivity 25nN", ["--sensitivity 25nN", "25nN/V"]),
        ("friction trace.csv retrace.csv --force-unit V", ["--force-unit V", "have nN"]),
        ("friction volts.csv bent.csv", ["volts.csv", "2 are needed"]),
        (
            "friction trace.csv bare.csv",
            ["bare.csv", "`force` has no unit, and `force_nN` is in nN"],
        ),
        (
            "friction bare.csv trace.csv",
            ["trace.csv", "`force_nN` is in nN, and `force` has no unit"],
        ),
    ] {
        folder.refuses(line, &words);
    }
}

/// The measured example with rows and columns exchanged: its lines have offsets, and its columns have none.
#[test]
fn a_transposed_image_is_reported() {
    let folder = Folder::new("image_transposed");
    let example = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/measured/area.gsf");
    let mut image = std::fs::read(example).unwrap();
    folder.write("area.gsf", image.clone());
    let first = image.len() - 4 * 96 * 96;
    let pixels = image.split_off(first);
    for i in 0..96 * 96 {
        let from = 4 * (96 * (i % 96) + i / 96);
        image.extend_from_slice(&pixels[from..from + 4]);
    }
    folder.write("exchanged.gsf", image);
    for (name, is_transposed) in [("area.gsf", false), ("exchanged.gsf", true)] {
        let line = format!("fit --image {name} --tip gaussian --width 30nm --pitch 30nm");
        let said = said(&folder.stickslip(&format!("{line} -o fit.json")));
        assert_eq!(said.contains("seems to be transposed"), is_transposed, "{name}: {said}");
    }
}
