//! Results in nm, s and nN: every number is the dimensionless one times what `stickslip units` says of its unit, and
//! tables in nm are read back.
//!
//! Judge: the same command without units, times the scales of the units document, by a list of columns written down
//! here.

use crate::folder::Folder;
use serde_json::Value;

const UNITS: &str = "units --damping 3.2mNs/m --stiffness 0.2N/m --tip-width 20nm --slope-force 5nN --velocity 1um/s --alpha 1.3 -o units.json";
/// The same in single quantities.
const TYPED: &str = "--sigma 20nm --stiffness 0.2N/m --damping 3.2mNs/m --slope-force 5nN";

/// Columns and fields, what they end with, and their scale: length, time, height, force.
const NAMES: [(&str, &str, [i32; 4]); 20] = [
    ("t", "_s", [0, 1, 0, 0]),
    ("l", "_nm", [1, 0, 0, 0]),
    ("x", "_nm", [1, 0, 0, 0]),
    ("y", "_nm", [1, 0, 0, 0]),
    ("u", "_nm", [0, 0, 1, 0]),
    ("x0", "_nm", [1, 0, 0, 0]),
    ("lag", "_nm", [1, 0, 0, 0]),
    ("velocity", "_nm_per_s", [1, -1, 0, 0]),
    ("re", "_per_s", [0, -1, 0, 0]),
    ("im", "_per_s", [0, -1, 0, 0]),
    ("Omega", "_per_nm", [-1, 0, 0, 0]),
    ("period", "_s", [0, 1, 0, 0]),
    ("period_slope", "_s", [0, 1, 0, 0]),
    ("wavelength", "_nm", [1, 0, 0, 0]),
    ("amplitude_x0", "_nm", [1, 0, 0, 0]),
    ("amplitude_u", "_nm", [0, 0, 1, 0]),
    ("amplitude_squared_slope", "_nm2", [2, 0, 0, 0]),
    ("lyapunov", "_per_nm2_per_s", [-2, -1, 0, 0]),
    ("deviation", "_nm", [1, 0, 0, 0]),
    ("pitch", "_nm", [1, 0, 0, 0]),
];

fn furnished(name: &str) -> (Folder, [f64; 4]) {
    let folder = Folder::new(name);
    folder.prints(UNITS);
    let scales = folder.json("units.json")["scales"].clone();
    let nano = ["length", "time", "height", "force"].map(|s| scales[s].as_f64().unwrap());
    (folder, [nano[0] * 1e9, nano[1], nano[2] * 1e9, nano[3] * 1e9])
}

/// What a column becomes in units: its name, and by what it is multiplied.
fn in_units(name: &str, scales: [f64; 4]) -> (String, f64) {
    match NAMES.iter().find(|(dimensionless, ..)| *dimensionless == name) {
        Some((name, suffix, powers)) => {
            let factors = scales.iter().zip(powers).map(|(scale, power)| scale.powi(*power));
            (format!("{name}{suffix}"), factors.product())
        }
        None => (name.into(), 1.0),
    }
}

fn close(found: f64, wanted: f64, what: &str) {
    assert!((found - wanted).abs() <= 1e-14 * wanted.abs(), "{what}: {found} for {wanted}");
}

fn table(folder: &Folder, line: &str) -> Vec<Vec<String>> {
    folder.prints(&format!("{line} -o table.csv"));
    let text = String::from_utf8(folder.read("table.csv")).unwrap();
    text.lines().map(|line| line.split(',').map(String::from).collect()).collect()
}

const LINES: [&str; 8] = [
    "run --alpha 1.3 --r 0.8 --kick 0.3 --until 30 --sample-every 1",
    "cycle --alpha 1.3 --r 0.8 --points 1",
    "stability --alpha 1.3 --r 0.8",
    "boundary --r-range 0.5:1:3",
    "response --alpha 0.5 --r 0.8 --pulse 1e-3,30,0.5 --until 40 --sample-every 1",
    "sweep --r 0.8 --alpha 0.5,1.1",
    "surface run.json --range 5:15:7",
    "surface run.json --range 5:15:3 --y-range -1:1:2",
];

#[test]
fn every_column_in_units_is_the_dimensionless_one_times_its_scale() {
    let (folder, scales) = furnished("physical_tables");
    folder.prints(&format!("{} -o run.json", LINES[0]));
    for line in LINES {
        let plain = table(&folder, line);
        let told = table(&folder, &format!("{line} --units units.json"));
        assert_eq!(told.len(), plain.len(), "{line}");
        let mut converted = 0;
        for (i, name) in plain[0].iter().enumerate() {
            let (expected, factor) = in_units(name, scales);
            assert_eq!(told[0][i], expected, "{line}");
            converted += usize::from(expected != *name);
            for (told, plain) in told.iter().zip(&plain).skip(1) {
                match plain[i].parse::<f64>() {
                    Ok(wanted) => close(told[i].parse().unwrap(), wanted * factor, line),
                    Err(_) => assert_eq!(told[i], plain[i], "{line}"),
                }
            }
        }
        assert!(converted > 1, "{line}: {:?}", told[0]);
        // The lateral force is k times the lag.
        if let Some(lag) = plain[0].iter().position(|name| name == "lag") {
            assert_eq!(told[0].last().unwrap(), "lateral_force_nN");
            let (told, plain) = (told[1].last().unwrap(), plain[1][lag].parse::<f64>().unwrap());
            close(told.parse().unwrap(), plain * scales[3], line);
        }
    }
}

/// Numbers of a document, each under its path.
fn numbers(value: &Value, path: &str, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Object(fields) => fields.iter().for_each(|(name, value)| {
            numbers(value, &format!("{path}.{name}"), found);
        }),
        Value::Array(entries) => entries.iter().enumerate().for_each(|(i, value)| {
            numbers(value, &format!("{path}.{i}"), found);
        }),
        value => found.extend(value.as_f64().map(|number| (path.to_owned(), number))),
    }
}

#[test]
fn a_document_has_its_numbers_in_units_beside_and_is_what_it_was_but_for_them() {
    let (folder, scales) = furnished("physical_documents");
    let line = "cycle --alpha 1.3 --r 0.8 --points 1";
    let plain = folder.prints_json(line);
    for options in [
        "--units units.json",
        TYPED,
        "--sigma 20nm --stiffness 0.2N/m --velocity 1um/s --slope-force 5nN",
    ] {
        let mut told = folder.prints_json(&format!("{line} {options}"));
        let physical = told.as_object_mut().unwrap().remove("physical").unwrap();
        let mut plain = plain.clone();
        for document in [&mut told, &mut plain] {
            document["work"]["seconds"] = Value::Null;
        }
        assert_eq!(told, plain, "{options}");
        let time = if options.contains("velocity") { 0.8 * 20e-9 / 1e-6 } else { scales[1] };
        let scales = [scales[0], time, scales[2], scales[3]];
        // v0 and N are those that `units` takes r and α from.
        close(
            physical["support_velocity_nm_per_s"].as_f64().unwrap(),
            0.8 * scales[0] / time,
            options,
        );
        close(
            physical["indentation_rate_nm_per_s"].as_f64().unwrap(),
            1.3 * scales[2] / time,
            options,
        );
        let mut found = vec![];
        numbers(&plain["profile"], "", &mut found);
        for name in ["period", "wavelength", "amplitude_x0", "amplitude_u"] {
            found.push((format!(".{name}"), plain[name].as_f64().unwrap()));
        }
        for (path, number) in found {
            let mut names = path.trim_start_matches('.').split('.');
            let (name, factor) = in_units(names.next().unwrap(), scales);
            let told = match names.next() {
                Some(i) => &physical["profile"][&name][i.parse::<usize>().unwrap()],
                None => &physical[&name],
            };
            close(told.as_f64().unwrap(), number * factor, &path);
        }
    }
}

/// By single quantities what is known is told, and nothing else; and a document tells the next command its scales.
#[test]
fn scales_that_are_not_known_leave_out_what_needs_them() {
    let (folder, scales) = furnished("physical_scales");
    let line = "cycle --alpha 1.3 --r 0.8 --points 1";
    let told = folder.prints_json(&format!("{line} --sigma 20nm"));
    let names: Vec<&String> = told["physical"].as_object().unwrap().keys().collect();
    assert!(
        names.iter().all(|name| name.ends_with("_nm") || ["scales", "profile"].contains(&&***name))
    );
    assert!(told["physical"]["amplitude_u_nm"].is_null(), "{names:?}");
    folder.prints(&format!("{line} {TYPED} -o cycle.json"));
    let again = folder.prints(&format!("{line} --units cycle.json --print physical.period_s"));
    let period = told["period"].as_f64().unwrap() * scales[1];
    close(String::from_utf8(again).unwrap().trim().parse().unwrap(), period, "period_s");
    // In words too, with as many digits.
    let text = String::from_utf8(folder.prints(&format!("{line} {TYPED} --format text"))).unwrap();
    let row = text.lines().find(|line| line.contains("wavelength")).unwrap();
    assert!(row.contains(" σ = ") && row.ends_with(" nm"), "{row}");
    folder.refuses(&format!("{line} --velocity 1um/s"), &["--velocity", "--sigma"]);
    folder.refuses(&format!("{line} --units cycle.json --sigma 20nm"), &["--sigma"]);
    folder.refuses(&format!("{line} --units none.json"), &["--units none.json", "read"]);
    folder.refuses(&format!("{line} {TYPED} --velocity 2um/s"), &["--velocity", "r = Γ v0/(kσ)"]);
    folder.refuses(&format!("{line} --sigma 20 apples"), &["apples"]);
    folder.refuses("sweep --r 0.5:1:2 --alpha 1 --sigma 20nm --velocity 1um/s", &["--damping"]);
    folder
        .refuses("run --alpha 1 --r 1 --until 40 --sigma 20nm -o run.jsonl", &["--sigma", ".json"]);
    folder.refuses(&format!("{line} --sigma 20nm --print physical.perod_s"), &["perod", "period"]);
}

#[test]
fn a_table_in_nanometres_is_read_back_as_it_was() {
    let (folder, scales) = furnished("physical_round_trip");
    folder.prints("run --alpha 1.3 --r 0.8 --kick 0.3 --until 30 -o first.json");
    for (name, options) in [("plain", ""), ("nm", "--units units.json")] {
        folder.prints(&format!("surface first.json --range 0:40:300 {options} -o {name}.csv"));
    }
    let second = |name: &str| {
        let line =
            "run --alpha 1.3 --r 0.8 --start flat --until 30 --sample-every 1 --units units.json";
        folder.prints_json(&format!("{line} --initial-surface {name}.csv"))["samples"]["x0"].clone()
    };
    let (mut plain, mut told) = (vec![], vec![]);
    numbers(&second("plain"), "", &mut plain);
    numbers(&second("nm"), "", &mut told);
    assert!(plain.len() > 10);
    for ((_, plain), (_, told)) in plain.iter().zip(&told) {
        assert!((plain - told).abs() < 1e-9, "{plain} {told}");
    }
    let line = "run --alpha 1.3 --r 0.8 --start flat --until 30 --initial-surface nm.csv";
    folder.refuses(line, &["--initial-surface nm.csv", "x_nm", "--sigma"]);
    // A force in nN over seconds.
    let force = |unit: [&str; 2], [t, f]: [f64; 2]| {
        let rows: Vec<String> =
            (0..9).map(|i| format!("{},{}", t * (20.0 + f64::from(i)), f * 0.1)).collect();
        format!("t{},force{}\n{}\n", unit[0], unit[1], rows.join("\n"))
    };
    folder.write("force.csv", force(["", ""], [1.0, 1.0]));
    folder.write("nn.csv", force(["_s", "_nN"], [scales[1], scales[3]]));
    let pushed = |name: &str| {
        let line = "run --alpha 0.5 --r 0.8 --until 30 --sample-at 30 --units units.json --print samples.x0.0";
        String::from_utf8(folder.prints(&format!("{line} --force-file {name}.csv"))).unwrap()
    };
    let [plain, told] = ["force", "nn"].map(|name| pushed(name).trim().parse::<f64>().unwrap());
    assert!((plain - told).abs() < 1e-9, "{plain} {told}");
    // A raw table of a tip in nm is no tip in σ.
    folder.write("tip.csv", "x_nm,f\n0,1\n20,0.6\n40,0.1\n60,0\n");
    folder.refuses("stability --r 1 --tip-file tip.csv", &["x_nm", "stickslip tip"]);
}

/// Judge: the surface of the same run without units, in the units given again.
#[test]
fn a_surface_is_in_the_units_of_its_document() {
    let (folder, _) = furnished("physical_own");
    let motions = [
        ("run", "run --alpha 1.3 --r 0.8 --kick 0.3 --until 30"),
        ("across", "run --alpha 1.3 --r 0.8 --kick 0.3 --until 25 --stiffness-across 0.5"),
        ("raster", "raster --alpha 1.3 --r 0.8 --length 20 --pitch 1 --lines 3"),
    ];
    for (name, line) in motions {
        folder.prints(&format!("{line} -o plain.json"));
        folder.prints(&format!("{line} --units units.json -o own.json"));
        folder.prints(&format!("{line} --sigma 20nm -o length.json"));
        let image = "--range 0:10 --spacing 1 --y-range -1:1 --spacing-y 1";
        let of = |options: &str| {
            let table = table(&folder, &format!("surface {options} {image}"));
            folder.prints(&format!("surface {options} {image} -o image.gsf"));
            (table, folder.read("image.gsf"))
        };
        let (plain, own, length) = (of("plain.json"), of("own.json"), of("length.json"));
        assert_ne!(own.0, plain.0, "{name}");
        assert_eq!(own, of("plain.json --units units.json"), "{name}");
        assert_eq!(length.0, table(&folder, &format!("surface plain.json --sigma 20nm {image}")));
        // Without a scale of heights an image has no unit.
        assert_eq!(length.1, plain.1, "{name}");
    }
}

/// A measured tip brings its σ along, and a saved document is drawn in units.
/// The values along the axes of sweeps, times σ = 20 nm, Γ/k and kσ²/a.
#[test]
fn axes_of_sweeps_are_in_units() {
    let (folder, scales) = furnished("physical_axes");
    let [length, time, height, _] = scales;
    let units = "--units units.json";
    let runs = folder.prints_json(&format!(
        "sweep --r 1 --alpha 0.5:1:2 --depth-limit 3,5 --healing-time 10,20 {units}"
    ));
    let rasters = folder.prints_json(&format!(
        "sweep raster --tip gaussian --r 1 --alpha 0.1:0.2:2 --pitch 0.5,1 --lines 2 --length 9 {units}"
    ));
    for (document, name, values, scale) in [
        (&runs, "depth_limit_nm", [3.0, 5.0], height),
        (&runs, "healing_time_s", [10.0, 20.0], time),
        (&rasters, "pitch_nm", [0.5, 1.0], length),
    ] {
        let axis = document["physical"]["axes"][name].as_array().unwrap();
        for (found, value) in axis.iter().zip(values) {
            let found = found.as_f64().unwrap();
            assert!((found / (value * scale) - 1.0).abs() < 1e-14, "{name}: {found}");
        }
        assert_eq!(axis.len(), 2, "{name}");
    }
    assert!(folder.prints_json("sweep --r 1 --alpha 0.5:1:2")["physical"]["axes"].is_null());
}

#[test]
fn tips_tell_their_width_and_pictures_are_in_units() {
    let (folder, scales) = furnished("physical_pictures");
    folder.write(
        "profile.csv",
        (-40..=40).fold("x_nm,z_nm\n".into(), |text: String, i| {
            let x = 4.0 * f64::from(i);
            text + &format!("{x},{}\n", -12.0 * (-x * x / 1800.0).exp())
        }),
    );
    folder.prints("tip profile.csv --resamples 100 -o tip.json");
    let sigma = folder.json("tip.json")["sigma"]["value"].as_f64().unwrap();
    let line = "stability --r 0.8 --tip-file tip.json";
    let plain = folder.prints_json(line)["critical"]["wavelength"].as_f64().unwrap();
    for options in ["--units tip.json", "--stiffness 0.2N/m"] {
        let told = folder.prints_json(&format!("{line} {options}"));
        close(
            told["physical"]["critical"]["wavelength_nm"].as_f64().unwrap(),
            plain * sigma,
            options,
        );
    }
    folder.prints("run --alpha 1.3 --r 0.8 --kick 0.3 --until 30 -o run.json");
    folder.prints("plot run.json --units units.json -o run.svg");
    let drawn = String::from_utf8(folder.read("run.svg")).unwrap();
    for label in ["t (s)", "(nm/s)", "x (nm)", "u (nm)"] {
        assert!(drawn.contains(label), "{label}");
    }
    assert!(!drawn.contains("σ"));
    // A range is in the units drawn: the axis of seconds begins and ends where it was asked to.
    let range = |from: f64, to: f64| format!("{}:{}", from * scales[1], to * scales[1]);
    folder.prints(&format!(
        "plot run.json --units units.json --x-range {} -o part.svg",
        range(20.0, 25.0)
    ));
    folder.prints("plot run.json --x-range 20:25 -o plain.svg");
    let points = |name: &str| {
        let text = String::from_utf8(folder.read(name)).unwrap();
        text.matches(' ').count()
    };
    let (part, plain) = (points("part.svg") as f64, points("plain.svg") as f64);
    assert!((part / plain - 1.0).abs() < 0.05, "{part} {plain}");
}

/// r and α are velocities of the support, r kσ/Γ, and indentation rates, α k²σ²/(aΓ), as `units` computes them.
#[test]
fn axes_of_r_and_alpha_are_velocities_and_indentation_rates_in_units() {
    let (folder, _) = furnished("physical_axes_of_boundaries");
    let at = |r: f64, alpha: f64| {
        let lever = "--damping 3.2mNs/m --stiffness 0.2N/m --tip-width 20nm --slope-force 5nN";
        let found = folder.prints_json(&format!("units {lever} --r {r} --alpha {alpha}"));
        ["velocity", "indentation_rate"].map(|name| 1e9 * found["physical"][name].as_f64().unwrap())
    };
    folder.prints("boundary --r-range 0.4:2:40 -o boundary.json");
    let drawn = |options: &str| {
        folder.prints(&format!("plot boundary.json {options} -o drawn.svg"));
        String::from_utf8(folder.read("drawn.svg")).unwrap()
    };
    let text = drawn("--units units.json");
    for label in ["(nm/s)", "velocity of the support", "indentation rate"] {
        assert!(text.contains(label), "{label}");
    }
    let ([v1, n1], [v2, n2]) = (at(0.5, 0.3), at(1.5, 2.0));
    // The points of the longest curve, in the unit of the picture.
    let boundary = |text: &str| -> Vec<f64> {
        let curves = text.split("<path d=\"M").filter(|path| path.contains("stroke=\"#0072b2\""));
        let longest = curves.max_by_key(|path| path.find('"')).unwrap().split('"').next().unwrap();
        let numbers = longest.split([' ', 'C', 'L', 'M']).filter(|n| !n.is_empty());
        numbers.map(|number| number.parse().unwrap()).collect()
    };
    // From side to side and from top to bottom: margins depend on the lengths of numbers.
    let within = |numbers: &[f64], first: usize| -> Vec<f64> {
        let of_axis = || numbers.iter().skip(first).step_by(2).copied();
        let (least, most) =
            (of_axis().fold(f64::MAX, f64::min), of_axis().fold(f64::MIN, f64::max));
        of_axis().map(|x| (x - least) / (most - least)).collect()
    };
    let options = format!("--units units.json --x-range {v1}:{v2} --y-range {n1}:{n2}");
    let same = boundary(&drawn(&options));
    let plain = boundary(&drawn("--x-range 0.5:1.5 --y-range 0.3:2"));
    assert!(plain.len() > 20 && same.len() == plain.len(), "{same:?} {plain:?}");
    for (a, b) in
        [0, 1].iter().flat_map(|axis| within(&same, *axis).into_iter().zip(within(&plain, *axis)))
    {
        assert!((a - b).abs() < 1e-3, "{same:?} {plain:?}");
    }
}
