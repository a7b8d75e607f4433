//! `stickslip tip`: profiles as instruments write them, in, tip files that every command takes, out.

use crate::folder::{Folder, said};
use serde_json::json;

/// exp(-x²/2) of width 30 nm, 12 nm deep, off centre, tilted, with noise of 1 % made by a fixed rule.
fn profile(rows: i32, heading: &str) -> String {
    let mut state = 12_345_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        f64::from(state) / f64::from(u32::MAX) - 0.5
    };
    let mut text = format!("# AFM\n{heading}\n");
    for i in 0..rows {
        let x = 300.0 * f64::from(i) / f64::from(rows - 1) - 140.0 + random();
        let noise = 0.12 * 12_f64.sqrt() * random();
        let height = 3.0 + 0.01 * x - 12.0 * (-0.5 * ((x - 7.0) / 30.0_f64).powi(2)).exp() + noise;
        text += &format!("{x}\t{height}\n");
    }
    text
}

/// A pit with the widths 25 nm at positions above its apex and `below` at others, with noise of 1 %, on a slope.
fn lopsided(below: f64) -> String {
    let mut state = 99_u32;
    let mut random = || {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        12_f64.sqrt() * (f64::from(state) / f64::from(u32::MAX) - 0.5)
    };
    let mut text = String::from("x_nm,z_nm\n");
    for i in 0..301 {
        let x = f64::from(i) - 150.0;
        let width = if x > 12.0 { 25.0 } else { below };
        let pit = 10.0 * (-0.5 * ((x - 12.0) / width).powi(2)).exp();
        text += &format!("{x},{}\n", 3.0 + 0.004 * x - pit + 0.1 * random());
    }
    text
}

/// Judge: αc of Gaussians of these widths, by `stability`.
#[test]
fn both_sides_of_a_pit_are_footprints_of_their_own() {
    let folder = Folder::new("tip_sides");
    folder.write("pit.csv", lopsided(40.0));
    folder.write("even.csv", lopsided(25.0));
    let plain = folder.stickslip("tip pit.csv --resamples 20 -o plain.json");
    assert!(said(&plain).contains("--both-sides"), "{}", said(&plain));
    let even = folder.stickslip("tip even.csv --resamples 20 -o even.json");
    assert!(!said(&even).contains("--both-sides"), "{}", said(&even));
    let table = String::from_utf8(folder.prints("tip even.csv --resamples 5 --format csv"));
    assert!(table.unwrap().starts_with("x_nm,f_nm,fit_nm,residual_nm\n"));
    folder.prints("tip even.csv --resamples 5 -o short.json --plot tip.svg");
    assert!(String::from_utf8(folder.read("tip.svg")).unwrap().contains("data − fit (nm)"));
    let both = folder.stickslip("tip pit.csv --both-sides --resamples 20 -o tip.json");
    assert!(both.status.success() && !said(&both).contains("--both-sides"), "{}", said(&both));
    let (plain, tip) = (folder.json("plain.json"), folder.json("tip.json"));
    assert!(plain.get("sides").is_none() && plain["parameters"].get("both_sides").is_none());
    assert_eq!(plain["gaussians"], tip["gaussians"], "the even fit is the same");
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    assert!((number(&tip["sides"]["apex"]) - 12.0).abs() < 3.0, "{}", tip["sides"]["apex"]);
    let sigma = number(&tip["sigma"]["value"]);
    for (side, width) in [("trace", 25.0), ("retrace", 40.0)] {
        let own = format!("stability --tip gaussian --width {} --r 1", width / sigma);
        let truth = number(&folder.prints_json(&own)["critical"]["alpha"]);
        let found = number(&tip["sides"][side]["critical_alpha"]["value"]);
        eprintln!("{side}: {found} for {truth}");
        assert!((found / truth - 1.0).abs() < 0.08, "{side}: {found} for {truth}");
        // What is printed is a tip file.
        let field =
            format!("tip pit.csv --both-sides --resamples 20 --print sides.{side}.footprint");
        folder.write("side.json", folder.prints(&field));
        let again = folder.prints_json("stability --tip-file side.json --r 1");
        let at = number(&again["critical"]["alpha"]);
        assert!((at / found - 1.0).abs() < 1e-9, "{side}: {at} for {found}");
    }
    let again = folder.prints_json("tip pit.csv --parameters tip.json");
    assert_eq!(again["sides"]["asymmetry"], tip["sides"]["asymmetry"]);
    // The whole document is the tip of both.
    for (side, retrace) in [("trace", ""), ("retrace", " --retrace")] {
        let found = number(&tip["sides"][side]["critical_alpha"]["value"]);
        let again = folder.prints_json(&format!("stability --tip-file tip.json --r 1{retrace}"));
        let at = number(&again["critical"]["alpha"]);
        assert!((at / found - 1.0).abs() < 1e-3, "{side}: {at} for {found}");
    }
    folder
        .refuses("stability --tip-file even.json --r 1 --retrace", &["--retrace", "leave it out"]);
    folder.refuses("stability --tip bessel --r 1 --retrace", &["--tip-file"]);
}

/// Judge: the grid, which takes f as it is. The threshold of a zigzag is between those of both sides alone.
#[test]
fn a_raster_has_either_side_on_its_way() {
    let folder = Folder::new("tip_sides_raster");
    folder.write("pit.csv", lopsided(40.0));
    folder.prints("tip pit.csv --both-sides --resamples 0 -o tip.json");
    // Without resampled profiles there are no intervals to warn of.
    let remarks = folder.json("tip.json")["remarks"].to_string();
    assert!(remarks.contains("residual") && !remarks.contains("inf"), "{remarks}");
    let lines = "--tip-file tip.json --width-y 1 --r 1 --pitch 0.7";
    for path in ["one-way", "zigzag", "one-way --retrace"] {
        let line = format!(
            "compare {lines} --alpha 0.6 --lines 3 --length 15 --path {path} --tolerance 1e-9 --grid-tolerance 1e-10"
        );
        let found = folder.prints_json(&line);
        let off = found["max_difference"]["x0"].as_f64().unwrap();
        eprintln!("{path}: {off:e}");
        assert!(off < 1e-6, "{path}: {off}");
    }
    let alpha = |path: &str| {
        let found = folder.prints_json(&format!("stability {lines} --path {path}"));
        found["critical"]["alpha"].as_f64().unwrap()
    };
    let [trace, zigzag, retrace] = ["one-way", "zigzag", "one-way --retrace"].map(alpha);
    eprintln!("{trace} {zigzag} {retrace}");
    assert!((alpha("zigzag --retrace") / zigzag - 1.0).abs() < 1e-9);
    assert!((trace / retrace - 1.0).abs() > 0.02, "{trace} {retrace}");
    let swept = format!("boundary {} --pitch-range 0.7:1:2", lines.replace("--pitch 0.7", ""));
    let swept = folder.prints_json(&swept);
    for (name, one) in [("alpha", trace), ("alpha_zigzag", zigzag)] {
        assert!((swept[name][0].as_f64().unwrap() / one - 1.0).abs() < 1e-9, "{swept}");
    }
    let saved =
        format!("raster {lines} --alpha 0.6 --lines 3 --length 15 --path zigzag -o raster.json");
    folder.prints(&saved);
    folder.prints("surface raster.json --x 1,5,9 --y 0,0.7,1.4 -o surface.json");
    folder.prints("run --tip-file tip.json --r 1 --alpha 1.8 --kick 0.1 --until 60 -o run.json");
    folder.prints("verify run.json");
    let two = ["--tip-file tip.json:", "equal sides"];
    folder.refuses(
        &format!("raster {lines} --alpha 0.5 --lines 2 --length 9 --stiffness-across 1"),
        &two,
    );
    folder.refuses(&format!("stability {lines} --stiffness-across 1"), &two);
    folder.refuses(
        &format!("stability {lines} --path zigzag --depth-limit 5"),
        &["--tip-file tip.json:", "depth limit"],
    );
    folder.write("ripple.csv", "x,u\n0,0\n1,1\n2,0\n3,1\n4,0\n5,1\n6,0\n7,1\n8,0\n");
    folder.refuses(
        "fit --ripple ripple.csv --tip-file tip.json",
        &["--tip-file tip.json:", "sides.trace.footprint"],
    );
}

#[test]
fn one_half_has_no_two_sides() {
    let folder = Folder::new("tip_one_half");
    let half: String =
        (0..80).map(|i| format!("{i},{}\n", (-0.002 * f64::from(i * i)).exp())).collect();
    folder.write("half.csv", half);
    folder.refuses("tip half.csv --unit nm --both-sides", &["--both-sides", "--half"]);
}

/// An image in metres, 2 nm a pixel along x and 3 nm across, of a pit of width 20 nm and 35 nm.
fn image(noise: f64) -> Vec<u8> {
    image_of(|x, y| (-0.5 * ((x / 20.0).powi(2) + (y / 35.0).powi(2))).exp(), noise)
}

/// The same of any pit.
fn image_of(pit: impl Fn(f64, f64) -> f64, noise: f64) -> Vec<u8> {
    let (columns, rows) = (100_i32, 90_i32);
    let mut header = String::from("Gwyddion Simple Field 1.0\n");
    for (name, value) in [
        ("XRes", columns.to_string()),
        ("YRes", rows.to_string()),
        ("XReal", "2e-7".into()),
        ("YReal", "2.7e-7".into()),
        ("XYUnits", "m".into()),
        ("ZUnits", "m".into()),
    ] {
        header += &format!("{name} = {value}\n");
    }
    let mut bytes = header.into_bytes();
    bytes.resize((bytes.len() / 4 + 1) * 4, 0);
    let mut state = 1_u32;
    for j in 0..rows {
        for i in 0..columns {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let random = 12_f64.sqrt() * (f64::from(state) / f64::from(u32::MAX) - 0.5);
            let (x, y) = (2.0 * f64::from(i) + 1.0 - 104.0, 3.0 * f64::from(j) + 1.5 - 130.0);
            let height = 4.0 + 0.01 * x - 9.0 * (pit(x, y) + noise * random);
            bytes.extend(((1e-9 * height) as f32).to_le_bytes());
        }
    }
    bytes
}

#[test]
fn an_image_becomes_a_tip_of_two_dimensions() {
    let folder = Folder::new("tip_image");
    folder.write("pit.gsf", image(0.02));
    folder.prints("tip pit.gsf --resamples 40 -o tip.json --plot tip.svg");
    let tip = folder.json("tip.json");
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    let sigma = number(&tip["sigma"]["value"]);
    assert!((sigma - 20.0).abs() < 0.6, "{sigma}");
    assert!((number(&tip["sigma_metres"]) * 1e9 / sigma - 1.0).abs() < 1e-12);
    assert!((number(&tip["image"]["centre"]) - 130.0).abs() < 1.0, "{}", tip["image"]);
    for width in tip["image"]["widths"].as_array().unwrap() {
        assert!((number(width) * sigma - 35.0).abs() < 1.0, "{}", tip["image"]);
    }
    // It is f(x,y) to every command, so that none asks for --width-y.
    let line = "raster --tip-file tip.json --alpha 0.3 --r 1 --pitch 1 --lines 3 --length 20";
    folder.prints(&format!("{line} -o raster.json"));
    folder.refuses(&format!("{line} --width-y 2"), &["--width-y 2", "its own"]);
    folder.write("pit.gsf", &image(0.02)[..5000]);
    folder.refuses("tip pit.gsf", &["pit.gsf", "100 × 90"]);
}

/// From an image to lines and rasters of a tip that gives way across them: those of the footprint itself.
#[test]
fn an_image_of_a_tip_is_followed_across_the_scan() {
    let folder = Folder::new("tip_image_across");
    // Center and width along, width across, in units of 20 nm.
    let lobes = [(1.0, 0.0, 1.0, 1.5), (-0.3, 1.8, 0.8, 1.2), (-0.3, -1.8, 0.8, 1.2)];
    let f = |x: f64, y: f64| -> f64 {
        let term = |(a, c, w, v): (f64, f64, f64, f64)| {
            a * (-0.5 * (((x - c) / w).powi(2) + (y / v).powi(2))).exp()
        };
        lobes.map(term).iter().sum()
    };
    folder.write("pit.gsf", image_of(|x, y| f(x / 20.0, y / 20.0), 0.0));
    folder.prints("tip pit.gsf --sigma 20nm --resamples 2 -o image.json");
    let apex = f(0.0, 0.0);
    let gaussians: Vec<_> = lobes
        .map(|(a, c, w, v)| json!({"amplitude": a / apex, "center": c, "width": w, "width_y": v}))
        .into();
    folder.write("formula.json", json!({"gaussians": gaussians}).to_string());
    let farthest = |line: &str, name: &str| {
        let [image, formula] = ["image", "formula"].map(|tip| {
            folder.prints_json(&format!("{line} --tip-file {tip}.json --sample-every 1"))
        });
        let samples = |document: &serde_json::Value| -> Vec<f64> {
            let lines = document["lines"].as_array().cloned().unwrap_or(vec![document.clone()]);
            let of = |line: &serde_json::Value| line["samples"][name].as_array().unwrap().clone();
            lines.iter().flat_map(of).map(|x| x.as_f64().unwrap()).collect()
        };
        let pairs = samples(&image).into_iter().zip(samples(&formula));
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    let across = "--stiffness-across 0.4 --kick-across 0.3 --r 1";
    let line = format!("run --alpha 1.3 {across} --until 36");
    let raster = format!("raster --alpha 0.4 {across} --pitch 1 --lines 4 --length 15");
    // Widths of the image are right to 7e-6; lines amplify that to 2.3e-5 here, and those of the raster to 2.7e-4.
    for (line, allowed) in [(line, 1e-4), (raster, 1e-3)] {
        for name in ["x0", "y0"] {
            let miss = farthest(&line, name);
            println!("{line} {name}: {miss:e}");
            assert!(miss < allowed, "{line} {name}: {miss:e}");
        }
    }
    let [a, b] = ["image", "formula"].map(|tip| {
        let line = format!("stability --tip-file {tip}.json --r 1 --pitch 1 --stiffness-across 1");
        folder.prints_json(&line)["critical"]["alpha"].as_f64().unwrap()
    });
    assert!((a / b - 1.0).abs() < 1e-5, "{a} {b}");
}

/// One image in other units, of which the header may be in Latin-1.
#[test]
fn the_units_of_an_image_are_read_or_asked_for() {
    let folder = Folder::new("tip_image_units");
    let plain = image(0.02);
    let end = plain.iter().position(|byte| *byte == 0).unwrap();
    let data = (end / 4 + 1) * 4;
    let with = |changes: &[(&str, &str)], latin: bool| {
        let mut header = String::from_utf8(plain[..end].to_vec()).unwrap();
        changes.iter().for_each(|(old, new)| header = header.replace(old, new));
        let mut bytes: Vec<u8> = match latin {
            true => header.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect(),
            false => header.into_bytes(),
        };
        bytes.resize((bytes.len() / 4 + 1) * 4, 0);
        bytes.extend(&plain[data..]);
        bytes
    };
    let sigma = |bytes: &[u8]| {
        folder.write("pit.gsf", bytes);
        let printed = folder.prints("tip pit.gsf --resamples 2 --print sigma_metres");
        String::from_utf8(printed).unwrap().trim().parse::<f64>().unwrap()
    };
    let metres = sigma(&plain);
    for (real, unit, latin) in [
        (["0.2", "0.27"], "µm", false),
        (["0.2", "0.27"], "µm", true),
        (["0.2", "0.27"], "um", false),
        (["200", "270"], "nm", false),
        (["2000", "2700"], "Å", true),
    ] {
        let unit = format!("XYUnits = {unit}");
        let changes = [("2e-7", real[0]), ("2.7e-7", real[1]), ("XYUnits = m", &*unit)];
        let found = sigma(&with(&changes, latin));
        assert!((found / metres - 1.0).abs() < 1e-9, "{unit}: {found} for {metres}");
    }
    folder.write("pit.gsf", with(&[("XYUnits = m", "XYUnits = furlong")], false));
    folder.refuses("tip pit.gsf", &["XYUnits = furlong", "not a unit of length"]);
    let mut missing = plain.clone();
    missing[data + 4000..data + 4004].copy_from_slice(&f32::NAN.to_le_bytes());
    folder.write("pit.gsf", missing);
    folder.refuses(
        "tip pit.gsf",
        &["MEASURED.csv pit.gsf", "row 11 has a height that is not finite: interpolate it"],
    );
    folder.write("flat.csv", (0..20).map(|i| format!("{i},1\n")).collect::<String>());
    folder.refuses("tip flat.csv", &["MEASURED.csv flat.csv", "all heights are 1"]);
    for (unit, label) in [("m", "height (nm)"), ("V", "height (V)")] {
        folder.write("pit.gsf", with(&[("ZUnits = m", &format!("ZUnits = {unit}"))], false));
        folder.prints("tip pit.gsf --resamples 2 -o tip.json --plot tip.svg");
        assert!(String::from_utf8(folder.read("tip.svg")).unwrap().contains(label), "{label}");
    }
}

/// Of a table f(x,y) the noise on the path of the tip is judged, as it is of one f(x).
#[test]
fn a_noisy_table_of_two_dimensions_is_refused() {
    let folder = Folder::new("noisy_table_2d");
    let table = |noise: f64| {
        let mut state = 7_u32;
        let mut text = String::from("x,y,f\n");
        for i in 0..40 {
            for j in 0..12 {
                state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let random = f64::from(state) / f64::from(u32::MAX) - 0.5;
                let (x, y) = (0.15 * f64::from(i), 0.5 * f64::from(j));
                // A table must decay.
                let within = if x < 4.0 && y < 4.0 { 1.0 } else { 0.0 };
                text += &format!(
                    "{x},{y},{}\n",
                    (-0.5 * (x * x + y * y)).exp() + within * noise * random
                );
            }
        }
        text
    };
    folder.write("clean.csv", table(0.0));
    folder.prints("stability --tip-file clean.csv --r 1");
    folder.write("noisy.csv", table(0.1));
    folder
        .refuses("stability --tip-file noisy.csv --r 1", &["noisy.csv", "noise dominates", ".gsf"]);
}

#[test]
fn a_profile_becomes_a_tip_file_that_every_command_takes() {
    let folder = Folder::new("tip_command");
    folder.write("pit.txt", profile(150, "x_nm\tz_nm"));
    let output = folder.stickslip("tip pit.txt --resamples 60 -o tip.json --plot tip.svg");
    assert!(output.status.success(), "{}", said(&output));
    let tip = folder.json("tip.json");
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    assert!((number(&tip["sigma"]["value"]) - 30.0).abs() < 1.0, "{}", tip["sigma"]);
    assert!((number(&tip["sigma_metres"]) * 1e9 - number(&tip["sigma"]["value"])).abs() < 1e-9);
    assert!((number(&tip["centre"]) - 7.0).abs() < 1.0);
    assert!((number(&tip["apex"]) + 12.0).abs() < 0.5);
    let alpha = &tip["critical_alpha"];
    assert!(number(&alpha["low"]) <= 1.879_427 && number(&alpha["high"]) >= 1.879_426, "{alpha}");
    assert!(String::from_utf8(folder.read("tip.svg")).unwrap().contains("height (nm)"));
    // f(0) = 1 to the last digits, and the onset said is that of the file.
    let stability = folder.prints_json("stability --tip-file tip.json --r 1");
    let at = number(&stability["critical"]["alpha"]);
    assert!((at / number(&alpha["value"]) - 1.0).abs() < 1e-12, "{at} {alpha}");
    for line in [
        "run --tip-file tip.json --alpha-above 0.1 --r 1 --kick 0.1 --until 40",
        "cycle --tip-file tip.json --alpha-above 0.1 --r 1",
        "boundary --tip-file tip.json --r-range 0.5:1:3",
        "sweep --tip-file tip.json --r 1 --alpha 1:2:2",
        "plot tip.json -o again.svg",
    ] {
        let output = folder.stickslip(line);
        assert!(output.status.success(), "{line}: {}", said(&output));
    }
    assert_eq!(folder.read("tip.svg"), folder.read("again.svg"));
    // The file's σ is that of `units`, unless another is given.
    let quantities = "--damping 1mNs/m --stiffness 0.05N/m --slope-force 5nN \
                      --indentation-rate 200nm/s --velocity 1um/s --tip-file tip.json";
    let units = folder.prints_json(&format!("units {quantities}"));
    assert_eq!(units["physical"]["tip_width"], tip["sigma_metres"]);
    let other = folder.prints_json(&format!("units {quantities} --tip-width 20nm"));
    assert!((number(&other["physical"]["tip_width"]) - 20e-9).abs() < 1e-22);
    // The same input, the same bytes.
    folder.prints("tip pit.txt --resamples 60 -o again.json");
    assert_eq!(folder.read("tip.json"), folder.read("again.json"));
}

#[test]
fn what_is_no_profile_is_refused_with_what_would_do() {
    let folder = Folder::new("tip_refusals");
    folder.write("pit.csv", profile(60, "x,z"));
    folder.write("three.csv", "1,2,3\n4,5,6\n");
    folder.write("few.csv", "0,1\n1,0.5\n2,0\n");
    let noise: String = (0..60).map(|i| format!("{i},{}\n", (i * 7919) % 13)).collect();
    folder.write("noise.csv", noise);
    for (line, words) in [
        ("tip three.csv", ["three.csv", "2 are needed"]),
        ("tip few.csv", ["3 rows", "12"]),
        ("tip noise.csv", ["no footprint", "noise.csv"]),
        ("tip pit.csv --sigma 30nm", ["--sigma 30nm", "--unit"]),
        ("tip pit.csv --unit apples", ["--unit apples", "nm"]),
        ("tip pit.csv --r 0", ["--r 0", "above 0"]),
        ("tip pit.csv --terms 0", ["--terms 0", "1 or more"]),
        ("tip absent.csv", ["absent.csv", "cannot be read"]),
    ] {
        let output = folder.stickslip(line);
        assert_eq!(output.status.code(), Some(2), "{line}: {}", said(&output));
        assert!(output.stdout.is_empty(), "{line}");
        for word in words {
            assert!(said(&output).contains(word), "{line}: {}", said(&output));
        }
    }
}

/// A Gaussian with 2 % of noise, its last row 0: as a table it would have αc = 0.5 or so for 1.88.
#[test]
fn a_table_that_noise_decides_is_refused_with_the_command_that_helps() {
    let folder = Folder::new("noisy_table");
    let mut state = 4_321_u32;
    let mut table = |noise: f64| {
        let row = |i: i32| {
            let x = 0.1 * f64::from(i);
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let off = noise * (2.0 * f64::from(state) / f64::from(u32::MAX) - 1.0);
            format!("{x},{}\n", if i == 80 { 0.0 } else { (-0.5 * x * x).exp() + off })
        };
        (0..=80).map(row).collect::<String>()
    };
    folder.write("noisy.csv", table(0.04));
    folder.write("clean.csv", table(0.0));
    for line in ["stability --r 1", "run --alpha 1 --r 1 --until 20", "cycle --alpha 2 --r 1"] {
        let output = folder.stickslip(&format!("{line} --tip-file noisy.csv"));
        assert_eq!(output.status.code(), Some(2), "{line}: {}", said(&output));
        for word in ["noise", "stickslip tip noisy.csv"] {
            assert!(said(&output).contains(word), "{}", said(&output));
        }
    }
    folder.prints("tip noisy.csv --half --resamples 40 -o tip.json");
    let fitted = folder.prints_json("stability --r 1 --tip-file tip.json");
    let clean = folder.prints_json("stability --r 1 --tip-file clean.csv");
    let alpha = |document: &serde_json::Value| document["critical"]["alpha"].as_f64().unwrap();
    // σ is found from the profile: a Gaussian has the same αc in its own.
    assert!((alpha(&fitted) / alpha(&clean) - 1.0).abs() < 0.05, "{}", alpha(&fitted));
}
