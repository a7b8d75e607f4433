//! Maps of ripples over load and velocity.
//!
//! Judge: `cycle` and `stability` with a footprint as wide as the contact at each load, in units of the measured point's σ.

use crate::folder::Folder;
use serde_json::Value;

fn close(found: &Value, wanted: &Value, within: f64, what: &str) {
    let [found, wanted] = [found, wanted].map(|value| value.as_f64().unwrap());
    assert!((found - wanted).abs() <= within * wanted.abs(), "{what}: {found} for {wanted}");
}

#[test]
fn each_point_is_that_of_a_footprint_as_wide_as_the_contact() {
    let folder = Folder::new("load_maps");
    for (exponent, law) in
        [(0.0, ""), (1.0 / 3.0, ""), (1.0 / 3.0, "--depth-limit 40 --healing-time 80")]
    {
        let line = format!(
            "boundary --tip gaussian --alpha 2.4 --r 1 --load 10 --load-range 6:12:4 --r-range 0.8:1.1:4 --width-exponent {exponent} {law}"
        );
        let map = folder.prints_json(&line);
        let mut ripples = 0;
        for (n, point) in map["points"].as_array().unwrap().iter().enumerate() {
            let number = |name: &str| point[name].as_f64().unwrap();
            let width = (number("load_nN") / 10.0).powf(exponent);
            let wide = format!("--tip gaussian --width {width} {law}");
            let critical =
                folder.prints_json(&format!("stability {wide} --r {}", number("velocity")));
            let alpha = 2.4 * number("load_nN") / 10.0;
            let is_unstable = alpha > critical["critical"]["alpha"].as_f64().unwrap();
            assert_eq!(point["regime"] != "steady", is_unstable, "{line}: {point}");
            let load = map["critical_load_nN"][n % 4].as_f64().unwrap();
            assert_eq!(number("load_nN") > load, is_unstable, "{line}: {point}");
            if exponent == 0.0 {
                let wanted = critical["critical"]["alpha"].as_f64().unwrap() / 2.4 * 10.0;
                close(&load.into(), &wanted.into(), 1e-12, &line);
            }
            if point["regime"] == "stick-slip" {
                let cycle = folder.prints_json(&format!(
                    "cycle {wide} --alpha {alpha} --r {}",
                    number("velocity")
                ));
                let slips = cycle["slips"].as_f64().unwrap_or(1.0);
                let apart = cycle["wavelength"].as_f64().unwrap() / slips;
                close(&point["wavelength"], &apart.into(), 1e-7, &line);
                ripples += 1;
            }
        }
        assert!(ripples >= 4, "{line}: {ripples}");
    }
}

/// At the critical load of a contact that grows the footprint of that width is critical.
#[test]
fn critical_loads_of_a_growing_contact_are_critical() {
    let folder = Folder::new("critical_loads");
    let line = "boundary --alpha 1.3 --r 0.8 --load 10 --load-range 2:20 --r-range 0.4:1.6:3 --width-exponent 0.3";
    let map = folder.prints_json(line);
    for (velocity, load) in [0.4, 1.0, 1.6].iter().zip(map["critical_load_nN"].as_array().unwrap())
    {
        let load = load.as_f64().unwrap();
        let width = (load / 10.0).powf(0.3);
        let found = folder.prints_json(&format!("stability --width {width} --r {velocity}"));
        close(&found["critical"]["alpha"], &(0.13 * load).into(), 1e-9, line);
    }
}

#[test]
fn a_map_is_in_nanonewtons_and_nanometres_and_refuses_by_name() {
    let folder = Folder::new("load_units");
    let line =
        "boundary --alpha 1.3 --r 0.8 --load 10nN --load-range 2nN:20nN --r-range 0.5um/s:2um/s:3";
    let scales = "--sigma 20nm --stiffness 0.2N/m --damping 3.2mNs/m";
    folder.prints(&format!("{line} {scales} -o map.csv --plot map.svg"));
    let table = String::from_utf8(folder.read("map.csv")).unwrap();
    assert!(
        table.starts_with(
            "load_nN,velocity_nm_per_s,alpha,width_nm,regime,wavelength_nm,critical_load_nN\n2,500,"
        ),
        "{table}"
    );
    let picture = String::from_utf8(folder.read("map.svg")).unwrap();
    for words in
        ["velocity (nm/s)", "load (nN)", "distance of ripples (nm)", "critical load", "lever"]
    {
        assert!(picture.contains(words), "{words}");
    }
    let plain = "boundary --alpha 1.3 --r 0.8 --r-range 0.4:1.6:3";
    folder.refuses(&format!("{plain} --load 10"), &["--load-range", "is needed"]);
    folder.refuses(&format!("{plain} --load -1 --load-range 2:20"), &["--load -1", "above 0"]);
    folder.refuses(&format!("{plain} --load 10 --load-range 20:2"), &["--load-range 20:2"]);
    let exponent = format!("{plain} --load 10 --load-range 2:20 --width-exponent 1");
    folder.refuses(&exponent, &["--width-exponent 1", "0.333 by Hertz"]);
    folder.refuses(
        &format!("{plain} --load 10 --load-range 2:20 --pitch-range 1:2:2"),
        &["--pitch-range"],
    );
}

/// A power of the load connects the rows of a table, so that one of Hertz's widths gives his map; units cancel.
#[test]
fn a_table_of_widths_takes_the_place_of_an_exponent() {
    let folder = Folder::new("load_widths");
    let line = "boundary --tip gaussian --alpha 2.4 --r 1 --load 10 --load-range 6:12:4 --r-range 0.8:1.1:4";
    let wanted = folder.prints_json(&format!("{line} --width-exponent 0.3333333333333333"));
    let rows = |unit: f64, per: f64| {
        let row = |load: &f64| format!("{};{}\n", load * unit, per * load.cbrt());
        [3.0, 7.0, 10.0, 20.0].iter().rev().map(row).collect::<String>()
    };
    folder.write("widths.csv", format!("load (nN);width (nm)\n{}", rows(1.0, 13.0)));
    folder.write("other.csv", format!("load_uN;width\n{}", rows(1e-3, 0.4)));
    for name in ["widths.csv", "other.csv"] {
        let found = folder.prints_json(&format!("{line} --load-widths {name} --plot loads.svg"));
        for (found, wanted) in
            found["points"].as_array().unwrap().iter().zip(wanted["points"].as_array().unwrap())
        {
            close(&found["width"], &wanted["width"], 1e-12, name);
            assert_eq!(found["regime"], wanted["regime"], "{found}");
            if found["wavelength"].is_number() {
                close(&found["wavelength"], &wanted["wavelength"], 1e-8, name);
            }
        }
        close(&found["lever_critical_load_nN"], &wanted["lever_critical_load_nN"], 1e-12, name);
    }
    let picture = String::from_utf8(folder.read("loads.svg")).unwrap();
    assert!(picture.contains("σ by a table"));
    // A contact that does not grow is that of an exponent of 0.
    folder.write("level.csv", "load_nN,width_nm\n1,20\n100,20\n");
    let level = folder.prints_json(&format!("{line} --load-widths level.csv"));
    let constant = folder.prints_json(line);
    close(&level["lever_critical_load_nN"], &constant["lever_critical_load_nN"], 1e-9, "level");
    folder.write("short.csv", "load_nN,width_nm\n7,20\n100,30\n");
    for (options, words) in [
        ("--load-widths short.csv", ["--load-widths short.csv", "from 7 to 100 nN"]),
        ("--load-widths level.csv --width-exponent 0.3", ["--width-exponent", "--load-widths"]),
        ("--load-widths none.csv", ["--load-widths none.csv", "No such file"]),
    ] {
        folder.refuses(&format!("{line} {options}"), &words);
    }
    folder.refuses("boundary --r-range 1:2:3 --load-widths level.csv", &["--alpha", "needed"]);
}
