//! `stickslip fit`: what a run leaves and feels, with noise, in nanometres, gives back what it was made of.

use crate::folder::{Folder, said};
use serde_json::Value;

/// Numbers in [-1, 1] by a fixed rule.
fn random() -> impl FnMut() -> f64 {
    let mut state = 2_024_u32;
    move || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        2.0 * f64::from(state) / f64::from(u32::MAX) - 1.0
    }
}

fn rows(text: &[u8]) -> Vec<Vec<f64>> {
    let text = String::from_utf8_lossy(text).into_owned();
    let number = |word: &str| word.parse().unwrap();
    text.lines().skip(1).map(|line| line.split(',').map(number).collect()).collect()
}

fn number<'a>(fit: &'a Value, name: &str) -> &'a Value {
    let numbers = fit["numbers"].as_array().unwrap();
    &numbers.iter().find(|n| n["name"] == name).unwrap()["estimate"]
}

fn holds(fit: &Value, name: &str, truth: f64) {
    let estimate = number(fit, name);
    let [low, high] = ["low", "high"].map(|end| estimate[end].as_f64().unwrap());
    assert!(low < truth && truth < high, "{name} {truth}: {estimate}");
    assert!(high - low < 0.2 * truth, "{name}: {estimate}");
}

/// σ = 30 nm, heights of 0.02 σ² nm, 2 % of noise, a tilt; lag to force by 0.3 nN/nm.
fn measured(folder: &Folder) {
    folder.prints("run --alpha 1.3 --r 1 --kick 0.3 --until 300 --sample-every 0.1 -o run.csv");
    folder.prints("run --alpha 1.3 --r 1 --kick 0.3 --until 300 -o run.json");
    folder.prints("surface run.json --range 230:270:500 -o surface.csv");
    let mut random = random();
    let mut ripple = "x_nm,z_nm\n".to_owned();
    for row in rows(&folder.read("surface.csv")) {
        let (x, u) = (30.0 * row[1], 18.0 * (row[2] + 0.02 * row[1] + 0.04 * random()));
        ripple += &format!("{x},{u}\n");
    }
    folder.write("ripple.csv", ripple);
    let heading = String::from_utf8(folder.read("run.csv")).unwrap();
    let heading: Vec<&str> = heading.lines().next().unwrap().split(',').collect();
    let of = |name: &str| heading.iter().position(|h| *h == name).unwrap();
    let (t, lag) = (of("t"), of("lag"));
    let mut trace = "way_nm,force_nN\n".to_owned();
    for row in rows(&folder.read("run.csv")).iter().filter(|row| row[t] > 240.0) {
        trace += &format!("{},{}\n", 30.0 * row[t], 9.0 * (row[lag] + 0.02 * random()));
    }
    folder.write("trace.csv", trace);
}

#[test]
fn ripples_and_friction_give_back_what_they_were_made_of() {
    let folder = Folder::new("fit_command");
    measured(&folder);
    let output =
        folder.stickslip("fit --ripple ripple.csv --height-gain 0.02 -o fit.json --plot fit.svg");
    assert!(output.status.success(), "{}", said(&output));
    assert!(
        said(&output).contains("width = ") && said(&output).contains("nm"),
        "{}",
        said(&output)
    );
    let fit = folder.json("fit.json");
    for (name, truth) in [("alpha", 1.3), ("r", 1.0), ("width", 30.0)] {
        holds(&fit, name, truth);
    }
    let both = folder.prints_json(
        "fit --ripple ripple.csv --height-gain 0.02 --friction trace.csv --force-gain 0.3 --width 30",
    );
    for (name, truth) in [("alpha", 1.3), ("r", 1.0)] {
        holds(&both, name, truth);
    }
    assert_eq!(both["data"].as_array().unwrap().len(), 2);
    // The same trace over micrometres: files meet in the unit of the first.
    let mut trace = "way (µm);force (nN)\n".to_owned();
    for row in rows(&folder.read("trace.csv")) {
        trace += &format!("{};{}\n", 1e-3 * row[0], row[1]).replace('.', ",");
    }
    folder.write("trace_um.csv", trace);
    let mixed = folder.prints_json(
        "fit --ripple ripple.csv --height-gain 0.02 --friction trace_um.csv --force-gain 0.3 --width 30",
    );
    for name in ["alpha", "r"] {
        let value = |fit: &Value| number(fit, name)["value"].as_f64().unwrap();
        assert!((value(&mixed) / value(&both) - 1.0).abs() < 1e-6, "{name}");
    }
    folder
        .write("bare.csv", String::from_utf8(folder.read("trace.csv")).unwrap().replace("_nm", ""));
    folder.refuses("fit --ripple ripple.csv --friction bare.csv", &["bare.csv", "has no unit"]);
    folder.prints("plot fit.json -o again.svg");
    assert_eq!(folder.read("fit.svg"), folder.read("again.svg"));
    let table = String::from_utf8(folder.prints("fit --ripple ripple.csv --format csv"));
    assert!(table.unwrap().starts_with("number,value,low,high\nalpha,"));
}

/// Heights and forces are labelled by the unit that their file names; those in V give no scale in metres.
#[test]
fn heights_and_forces_keep_their_unit() {
    let folder = Folder::new("fit_height_units");
    measured(&folder);
    let ripple = String::from_utf8(folder.read("ripple.csv")).unwrap();
    folder.write("volts.csv", ripple.replace("z_nm", "z (V)"));
    // kσ²/a = 18 nm; a gain that is given counts as one that is fitted.
    for (line, label, height) in [
        ("fit --ripple ripple.csv", "height (nm)", Some(18e-9)),
        ("fit --ripple ripple.csv --height-gain 0.02", "height (nm)", Some(18e-9)),
        ("fit --ripple volts.csv", "height (V)", None),
        ("fit --friction trace.csv", "lateral force (nN)", None),
    ] {
        folder.prints(&format!("{line} -o fit.json --plot fit.svg"));
        let picture = String::from_utf8(folder.read("fit.svg")).unwrap();
        assert!(picture.contains(label) && !picture.contains("unit of the data"), "{line}");
        let text = String::from_utf8(folder.prints(&format!("{line} --format text"))).unwrap();
        let unit = label.split_once('(').unwrap().1.trim_end_matches(')');
        let noise = text.lines().find(|row| row.trim().starts_with("noise")).unwrap();
        assert!(noise.ends_with(&format!(" {unit}")), "{noise}");
        let scales =
            folder.prints_json("stability --r 1 --units fit.json")["physical"]["scales"].clone();
        let found = scales["height"].as_f64();
        assert_eq!(found.is_some(), height.is_some(), "{line}: {scales}");
        if let Some((found, height)) = found.zip(height) {
            assert!((found / height - 1.0).abs() < 0.03, "{line}: {scales}");
        }
    }
}

/// The same heights over the mirrored positions: the tip came from the right.
#[test]
fn a_scan_from_right_to_left_is_recognised() {
    let folder = Folder::new("fit_mirrored");
    measured(&folder);
    let mut mirrored = "x_nm,z_nm\n".to_owned();
    for row in rows(&folder.read("ripple.csv")) {
        mirrored += &format!("{},{}\n", -row[0], row[1]);
    }
    folder.write("mirrored.csv", mirrored);
    let line = "fit --ripple mirrored.csv --height-gain 0.02";
    let fit = folder.prints_json(line);
    for (name, truth) in [("alpha", 1.3), ("r", 1.0), ("width", 30.0)] {
        holds(&fit, name, truth);
    }
    assert_eq!(fit["data"][0]["scan"], "left");
    assert_eq!(fit["explained"], true);
    let remarks = fit["remarks"].to_string();
    assert!(remarks.contains("no footprint is given"), "{remarks}");
    // In the wrong direction no motion of the model has this shape.
    let wrong = folder.prints_json(&format!("{line} --scan right --tip triple-gaussian"));
    assert_eq!(wrong["explained"], false);
    assert!(number(&wrong, "alpha")["low"].is_null() && number(&wrong, "alpha")["high"].is_null());
    let remarks = wrong["remarks"].to_string();
    assert!(remarks.contains("does not explain") && !remarks.contains("is given"), "{remarks}");
}

/// αc(r) of `boundary`, as loads over velocities: α = 0.5 load, r = 2 velocity.
#[test]
fn onsets_give_alpha_per_load_and_r_per_velocity() {
    let folder = Folder::new("fit_onsets");
    folder.prints("boundary --r-range 0.4:1.6:13 -o boundary.csv");
    let mut random = random();
    let mut onsets = "v,N\n".to_owned();
    for row in rows(&folder.read("boundary.csv")) {
        onsets += &format!("{},{}\n", 0.5 * row[1], 2.0 * row[2] * (1.0 + 0.01 * random()));
    }
    folder.write("onsets.csv", onsets);
    let fit = folder.prints_json("fit --onsets onsets.csv");
    holds(&fit, "alpha_per_load", 0.5);
    holds(&fit, "r_per_velocity", 2.0);
    // The units of the columns label the picture and the parameters.
    let onsets = String::from_utf8(folder.read("onsets.csv")).unwrap();
    folder.write("onsets.csv", onsets.replace("v,N", "v (um/s),load (nN)"));
    let fit = folder.prints_json("fit --onsets onsets.csv --plot fit.svg");
    assert_eq!([&fit["data"][0]["x_unit"], &fit["data"][0]["y_unit"]], ["um/s", "nN"]);
    let units = ["1/nN", "s/um"];
    assert_eq!([0, 1].map(|i| fit["numbers"][i]["unit"].as_str().unwrap()), units);
    let picture = String::from_utf8(folder.read("fit.svg")).unwrap();
    for label in [
        "velocity (um/s)",
        "load at onset (nN)",
        "α/load (1/nN)",
        "r/velocity (s/um)",
        "data − model (nN)",
    ] {
        assert!(picture.contains(label), "{label}");
    }
    assert!(!picture.contains("unit of the data"));
}

#[test]
fn what_cannot_be_fitted_is_refused_with_what_would_do() {
    let folder = Folder::new("fit_refusals");
    folder.write("two.csv", "0,1\n1,2\n2,1\n3,2\n4,1\n5,2\n6,1\n");
    folder.write("below.csv", "1,1\n-2,2\n3,3\n4,4\n");
    folder.write("same.csv", "v,N\n1,2\n1,2\n1,2\n");
    let mut random = random();
    let noise: String = (0..500).map(|i| format!("{i},{}\n", random() + random())).collect();
    folder.write("noise.csv", noise);
    for (line, status, words) in [
        ("fit", 2, ["--ripple", "data files"]),
        ("fit --ripple absent.csv", 2, ["absent.csv", "cannot be read"]),
        ("fit --wavelengths two.csv", 2, ["two.csv", "3 are needed"]),
        ("fit --onsets below.csv", 2, ["row 2", "above 0"]),
        ("fit --ripple two.csv --free gamma", 2, ["gamma", "depth-limit"]),
        ("fit --ripple two.csv --free beta --tip gaussian", 2, ["--free beta", "--tip"]),
        ("fit --ripple two.csv --r -1", 2, ["--r -1", "above 0"]),
        ("fit --ripple two.csv --healing-time 10", 2, ["--healing-time", "have faded"]),
        ("fit --ripple two.csv --free healing-time", 2, ["--free", "have faded"]),
        ("fit --ripple two.csv", 2, ["two.csv", "too few"]),
        ("fit --ripple noise.csv", 2, ["noise.csv", "no significant ripple"]),
        ("fit --onsets same.csv", 2, ["same.csv", "different velocities"]),
        ("fit --ripple noise.csv --scan up", 2, ["--scan", "right"]),
    ] {
        let output = folder.stickslip(line);
        assert_eq!(output.status.code(), Some(status), "{line}: {}", said(&output));
        assert!(output.stdout.is_empty(), "{line}");
        for word in words {
            assert!(said(&output).contains(word), "{line}: {}", said(&output));
        }
    }
}
