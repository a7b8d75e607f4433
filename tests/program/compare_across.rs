//! `stickslip compare --stiffness-across`: both coordinates against cells of a plane. The solver of the cells is judged
//! in tests/science/planes_on_grids.rs; here it is whether both sides are given the same problem.

use crate::folder::Folder;
use crate::runs::{schema, validate};
use serde_json::Value;

const CASE: &str =
    "compare --alpha 1.2 --r 1 --stiffness-across 0.25 --kick 0.05 --kick-across 0.2 --until 24";

fn column(document: &Value, path: &str) -> Vec<f64> {
    let column = document.pointer(path).unwrap().as_array().unwrap();
    column.iter().map(|value| value.as_f64().unwrap()).collect()
}

fn number(document: &Value, path: &str) -> f64 {
    document.pointer(path).unwrap().as_f64().unwrap()
}

fn differences(document: &Value) -> [f64; 3] {
    ["x0", "y0", "u"].map(|name| {
        let [closed, grid] =
            ["closed", "grid"].map(|side| column(document, &format!("/{side}/{name}")));
        assert!(closed.len() == grid.len() && closed.len() > 10);
        let largest = closed.iter().zip(&grid).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        let said = number(document, &format!("/max_difference/{name}"));
        assert!((largest - said).abs() <= 1e-15, "{name}: {largest:e} {said:e}");
        said
    })
}

/// Every term of the law, start and kind of support.
#[test]
fn both_coordinates_are_those_of_the_cells() {
    let folder = Folder::new("compare-across");
    folder.write("back.csv", "t,R\n0,0\n4,4\n8,1\n24,9\n");
    for (options, most) in [
        ("", 1e-8),
        ("--grid sinc --width-y 1.4", 1e-8),
        ("--depth-limit 2 --healing-time 8 --inertia 0.5 --pulse 1,20,1", 1e-8),
        ("--start flat --tip gaussian --width 0.8 --grid-until 20", 1e-8),
        ("--support-path back.csv --grid-until 10", 1e-8),
    ] {
        let document = folder.prints_json(&format!("{CASE} {options}"));
        let found = differences(&document);
        let [x0, y0, u] = found;
        println!("{options}: {x0:.1e} {y0:.1e} {u:.1e}");
        // Two motions that agree to the last digit would be one motion.
        assert!(found.iter().all(|d| *d < most && *d > 0.0), "{options}: {found:?}");
        let y0 = column(&document, "/closed/y0");
        assert!(y0.iter().any(|y| y.abs() > 0.05), "{options}");
    }
}

/// Lobes across of another width, and a table that is no product of functions of x and y.
#[test]
fn footprints_of_several_products_are_those_of_the_cells() {
    let folder = Folder::new("compare-across-footprints");
    let lobe = |amplitude: f64, center: f64, center_y: f64, width_y: f64| {
        serde_json::json!({
            "amplitude": amplitude, "center": center, "width": 1.0, "center_y": center_y, "width_y": width_y
        })
    };
    let lobes = [
        lobe(1.0, 0.0, 0.0, 1.0),
        lobe(-0.4, 2.0, 0.0, 0.8),
        lobe(-0.4, -2.0, 0.0, 0.8),
        lobe(-0.2, 0.0, 1.8, 0.8),
        lobe(-0.2, 0.0, -1.8, 0.8),
    ];
    folder.write("star.json", serde_json::json!({ "gaussians": lobes }).to_string());
    let mut table = "x,y,f\n".to_string();
    for (i, j) in (0..18).flat_map(|j| (0..18).map(move |i| (i, j))) {
        let (x, y) = (0.5 * f64::from(i), 0.5 * f64::from(j));
        let f = (1.0 - 0.5 * x * x + 0.1 * x * x * y * y) * (-0.5 * x * x - y * y / 2.4).exp();
        table += &format!("{x},{y},{f:e}\n");
    }
    folder.write("saddle.csv", table);
    for (tip, most) in [("star.json", 1e-8), ("saddle.csv", 1e-8)] {
        let document = folder.prints_json(&format!("{CASE} --tip-file {tip}"));
        let found = differences(&document);
        println!("{tip}: {found:?}");
        assert!(found.iter().all(|d| *d < most && *d > 0.0), "{tip}: {found:?}");
    }
}

/// Noise, a profile and a table u0(x,y) change the motion by far more than the two sides are apart.
#[test]
fn both_sides_meet_the_same_surface() {
    let folder = Folder::new("compare-across-surface");
    folder.write("bump.csv", "x,u\n13,0\n15,0.4\n17,-0.2\n19,0.6\n21,0\n");
    let at_the_end = |document: &Value| {
        ["x0", "y0"].map(|name| *column(document, &format!("/closed/{name}")).last().unwrap())
    };
    let plain = folder.prints_json(CASE);
    let table = serde_json::json!({
        "x": [12.0, 15.0, 18.0, 21.0],
        "y": [-2.0, 0.0, 2.0],
        "u": [[0.0, 0.3, -0.2, 0.0], [0.0, -0.2, 0.4, 0.0], [0.0, 0.1, 0.2, 0.0]]
    });
    let mut asked = folder.prints_json(&CASE.replace("compare", "run"));
    asked["parameters"]["initial_surface_across"] = table;
    folder.write("table.json", asked.to_string());
    for line in [
        format!(
            "{CASE} --tolerance 1e-11 --noise 0.1 --noise-spacing 0.5 --noise-spacing-across 0.7 --seed 3"
        ),
        format!("{CASE} --tolerance 1e-11 --initial-surface bump.csv"),
        format!("{CASE} --tolerance 1e-11 --parameters table.json"),
    ] {
        let document = folder.prints_json(&line);
        let found = differences(&document);
        let ends = [&document, &plain].map(at_the_end);
        for (axis, name) in ["x0", "y0"].into_iter().enumerate() {
            let changed = (ends[0][axis] - ends[1][axis]).abs();
            println!("{line}: {name} {:.1e}, changed by {changed:.1e}", found[axis]);
            assert!(found[axis] < 1e-6 * changed, "{line}: {name} {:e}", found[axis]);
        }
        assert!(found[2] < 1e-7, "{line}: u {:e}", found[2]);
    }
}

/// Cells of second order come four times as near at half the spacing, and a lattice too wide for the tip is seen.
#[test]
fn the_difference_is_that_of_the_cells() {
    let folder = Folder::new("compare-across-orders");
    let of = |options: &str| differences(&folder.prints_json(&format!("{CASE} {options}")));
    let [wide, half] = ["0.2", "0.1"]
        .map(|spacing| of(&format!("--grid windowed --step 0.05 --spacing {spacing}")));
    for (wide, half) in wide.into_iter().zip(half) {
        let order = (wide / half).log2();
        println!("{wide:.1e} {half:.1e}, order {order:.2}");
        assert!((1.7..2.3).contains(&order), "{wide:e} {half:e}");
    }
    let coarse = of("--spacing 0.8");
    assert!(coarse[1] > 1e-5, "{coarse:?}");
}

/// The motion is that of `run`; tables, pictures and units have both coordinates, and without the option none has.
#[test]
fn the_document_has_both_coordinates() {
    let folder = Folder::new("compare-across-document");
    folder.prints(&format!("{CASE} -o c.json --plot c.svg"));
    let document = folder.json("c.json");
    validate(&schema(&folder, "compare"), &document);
    let run = folder.prints_json(&format!("{CASE} --sample-at 24").replace("compare", "run"));
    for name in ["x0", "y0"] {
        let end = *column(&document, &format!("/closed/{name}")).last().unwrap();
        assert!((number(&run, &format!("/samples/{name}/0")) - end).abs() < 1e-12, "{name}");
    }
    let picture = String::from_utf8(folder.read("c.svg")).unwrap();
    for label in ["y₀(t)", "|Δy₀|", "|Δx₀|", "|Δu|"] {
        assert!(picture.contains(label), "{label}");
    }
    folder.prints("plot c.json -o again.svg");
    assert_eq!(folder.read("again.svg"), folder.read("c.svg"));
    folder.prints(&format!("{CASE} -o c.csv --sigma 30nm"));
    let csv = String::from_utf8(folder.read("c.csv")).unwrap();
    let head = csv.lines().find(|line| !line.starts_with('#')).unwrap();
    assert!(head.contains("closed_y0_nm") && head.contains("grid_y0_nm"), "{head}");
    let said = String::from_utf8(folder.prints(&format!("{CASE} --format text"))).unwrap();
    assert!(said.contains(" in y0, ") && said.contains("difference in y0"), "{said}");
    let held = folder.prints_json("compare --alpha 1.2 --r 1 --kick 0.05 --until 20");
    assert!(!held.to_string().contains("y0"));
}

#[test]
fn what_has_no_cells_in_a_plane_is_refused_by_name() {
    let folder = Folder::new("compare-across-refusals");
    for (options, words) in [
        ("--grid uniform", ["--grid uniform", "across"]),
        ("--spacing 1e-4", ["--spacing 0.0001", "memory"]),
        ("--grid windowed --spacing 0.02 --time-limit 0.1", ["--time-limit 0.1", "--spacing"]),
    ] {
        folder.refuses(&format!("{CASE} {options}"), &words);
    }
    folder.refuses(&CASE.replace("0.25", "0"), &["--stiffness-across 0", "above 0"]);
}

/// Lines of a raster, where the one before ends or from the start, with the same law on both sides.
#[test]
fn lines_of_a_raster_are_those_of_the_cells() {
    let folder = Folder::new("compare-across-raster");
    let raster = "compare --tip gaussian --alpha 0.6 --r 1 --pitch 0.8 --lines 3 --length 8 --stiffness-across 0.8";
    for options in [
        "--kick-across 0.2 -o r.json --plot r.svg",
        "--kick-across 0.2 --path zigzag --healing-time 20 --inertia 0.4 --depth-limit 3 -o r.json",
        "--path zigzag --grid sinc --sample-at 2,7 -o r.json",
    ] {
        folder.prints(&format!("{raster} {options}"));
        let document = folder.json("r.json");
        validate(&schema(&folder, "raster-compare"), &document);
        let mut largest = [0.0_f64; 2];
        let mut off = 0.0_f64;
        for n in 0..3 {
            for (axis, name) in ["x0", "y0"].into_iter().enumerate() {
                let of = |side: &str| column(&document, &format!("/lines/{n}/{side}_{name}"));
                for (a, b) in of("closed").into_iter().zip(of("grid")) {
                    largest[axis] = largest[axis].max((a - b).abs());
                }
            }
            let y = number(&document, &format!("/lines/{n}/y"));
            let y0 = column(&document, &format!("/lines/{n}/grid_y0"));
            off = y0.iter().fold(off, |most, y0| most.max((y0 - y).abs()));
        }
        let u = number(&document, "/max_difference/u");
        println!(
            "{options}: {:.1e} {:.1e} {u:.1e}, off their line by {off:.2}",
            largest[0], largest[1]
        );
        for (largest, name) in largest.into_iter().zip(["x0", "y0"]) {
            let said = number(&document, &format!("/max_difference/{name}"));
            assert!((largest - said).abs() <= 1e-15, "{name}: {largest:e} {said:e}");
            assert!(said > 0.0 && said < 3e-8, "{options}: {name} {said:e}");
        }
        assert!(u > 0.0 && u < 3e-8 && off > 0.05, "{options}: {u:e} {off}");
    }
    let picture = String::from_utf8(folder.read("r.svg")).unwrap();
    assert!(picture.contains("|Δx₀|") && picture.contains("|Δy₀|"));
    folder.refuses(&format!("{raster} --grid uniform"), &["--grid uniform", "across"]);
    let held = raster.replace(" --stiffness-across 0.8", "");
    assert!(!folder.prints_json(&held).to_string().contains("y0"));
}
