//! `stickslip compare`: its differences are those of the motions that it prints, it tells a right grid
//! from a wrong one, and refuses what would take too long. The numbers themselves are judged in
//! `grids_converge.rs`.

use crate::folder::{Folder, said, wait_until_it_listens};
use serde_json::Value;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Duration;

const CASE: &str = "compare --alpha 1.2 --r 1 --kick 0.05 --until 36";

fn column(document: &Value, path: &str) -> Vec<f64> {
    let column = document.pointer(path).unwrap().as_array().unwrap();
    column.iter().map(|value| value.as_f64().unwrap()).collect()
}

fn number(document: &Value, path: &str) -> f64 {
    document.pointer(path).unwrap().as_f64().unwrap()
}

#[test]
fn every_grid_comes_near_and_the_difference_is_that_of_the_columns() {
    let folder = Folder::new("compare");
    for (options, most) in [
        ("", 1e-8),
        ("--grid sinc", 1e-7),
        ("--grid windowed --spacing 0.02", 1e-2),
        ("--grid uniform --spacing 0.02 --step 0.04", 1e-2),
        ("--grid spectral --grid-until 20 --tolerance 1e-11 --memory direct", 1e-9),
        ("--start flat --tip gaussian --width 0.7 --pulse 1,20,1", 1e-7),
    ] {
        let document = folder.prints_json(&format!("{CASE} {options}"));
        for (difference, column_name) in [("x0", "x0"), ("u", "u")] {
            let closed = column(&document, &format!("/closed/{column_name}"));
            let grid = column(&document, &format!("/grid/{column_name}"));
            assert!(closed.len() == grid.len() && closed.len() > 10);
            let largest = closed.iter().zip(&grid).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let said = number(&document, &format!("/max_difference/{difference}"));
            assert!((largest - said).abs() <= 1e-15, "{options}: {largest:e} {said:e}");
            assert!(said < most, "{options}: {said:e}");
            // Two motions that agree to the last digit would be one motion.
            assert!(said > 0.0, "{options}");
        }
    }
}

/// Noise, a profile and a measured force are met by both sides: each changes the motion by far more than the two
/// are apart, and the closed equation's is that of `run`.
#[test]
fn both_sides_meet_the_same_surface_and_force() {
    let folder = Folder::new("compare-disturbed");
    folder.write("bump.csv", "x,u\n29,0\n30,0.4\n31,-0.2\n32,0.6\n33,0\n");
    folder.write("force.csv", "t,force\n18,0\n20,0.9\n22,-0.3\n25,0\n");
    let at_the_end = |document: &Value| *column(document, "/closed/x0").last().unwrap();
    let plain = at_the_end(&folder.prints_json(CASE));
    for (grid, parts) in [
        ("--tolerance 1e-11", 1e-7),
        ("--tolerance 1e-11 --grid sinc", 1e-7),
        ("--grid windowed --spacing 0.02", 0.2),
        ("--grid uniform --spacing 0.02 --step 0.04", 0.2),
    ] {
        for options in [
            "--noise 0.1 --noise-spacing 0.5 --seed 3",
            "--initial-surface bump.csv",
            "--force-file force.csv",
        ] {
            let document = folder.prints_json(&format!("{CASE} {grid} {options}"));
            let changed = (at_the_end(&document) - plain).abs();
            for difference in ["x0", "u"] {
                let found = number(&document, &format!("/max_difference/{difference}"));
                println!("{grid} {options}: {difference} {found:.1e}, changed by {changed:.1e}");
                assert!(found < parts * changed, "{grid} {options}: {difference} {found:e}");
            }
        }
    }
    let all = "--noise 1e-3 --seed 8 --initial-surface bump.csv --force-file force.csv";
    let compared = folder.prints_json(&format!("{CASE} {all}"));
    let line = format!("{CASE} {all} --sample-at 36").replace("compare", "run");
    let run = folder.prints_json(&line);
    assert!((number(&run, "/samples/x0/0") - at_the_end(&compared)).abs() < 1e-12);
    for field in ["noise", "initial_surface", "pulses", "force"] {
        assert_eq!(run["parameters"][field], compared["parameters"][field], "{field}");
    }
}

/// A lattice too wide for the tip is seen to give another motion.
#[test]
fn a_coarse_grid_shows_in_the_difference() {
    let folder = Folder::new("compare-coarse");
    let document = folder.prints_json(&format!("{CASE} --spacing 0.9"));
    assert!(number(&document, "/max_difference/x0") > 1e-4);
}

/// All but the times of the clock.
fn without_clock(mut document: Value) -> Value {
    document["speedup"].take();
    for side in ["closed", "grid"] {
        document[side]["work"]["seconds"].take();
    }
    document
}

#[test]
fn the_same_input_gives_the_same_document() {
    let folder = Folder::new("compare-twice");
    let [a, b] = [(); 2].map(|()| without_clock(folder.prints_json(CASE)));
    assert_eq!(a, b);
    folder.prints(&format!("{CASE} -o c.csv"));
    let csv = String::from_utf8(folder.read("c.csv")).unwrap();
    assert_eq!(csv.lines().count(), 1 + column(&a, "/t").len());
    assert_eq!(csv.lines().next(), Some("t,closed,grid"));
}

#[test]
fn both_motions_and_their_distance_are_drawn() {
    let folder = Folder::new("compare-drawn");
    let pictures = ["a.svg", "b.svg"].map(|name| {
        folder.prints(&format!("{CASE} -o c.json --plot {name}"));
        String::from_utf8(folder.read(name)).unwrap()
    });
    assert_eq!(pictures[0], pictures[1]);
    for label in ["closed equation", "grid", "|Δx₀|", "|Δu|"] {
        assert!(pictures[0].contains(label), "{label}");
    }
    folder.refuses(&format!("{CASE} -o c.svg --plot c.svg"), &["--output", "c.svg"]);
    folder.refuses(&format!("{CASE} --plot c.jpg"), &["--plot c.jpg", ".svg"]);
}

#[test]
fn what_would_take_too_long_is_refused_with_what_would_do() {
    let folder = Folder::new("compare-long");
    let paper = "compare --alpha 1.2 --r 1 --until 457 --grid uniform --spacing 0.001 --step 0.04";
    let output = folder.stickslip(&format!("{paper} --time-limit 0.2"));
    let said = said(&output);
    assert_eq!(output.status.code(), Some(2), "{said}");
    assert!(output.stdout.is_empty() && said.contains("--grid-until"), "{said}");
}

#[test]
fn unusable_options_are_refused_by_name() {
    let folder = Folder::new("compare-refusals");
    folder.write("back.csv", "1,0\n0,1\n2,1\n3,1\n");
    for (options, words) in [
        ("--spacing 0", ["--spacing 0", "above 0"]),
        ("--spacing NaN", ["--spacing NaN", "above 0"]),
        ("--spacing 1e-9", ["--spacing 1e-9", "memory"]),
        ("--step -1", ["--step -1", "above 0"]),
        ("--step 100", ["--step 100", "at most"]),
        ("--grid-tolerance 0", ["--grid-tolerance 0", "above 0"]),
        ("--grid-until 3", ["--grid-until 3", "--until"]),
        ("--grid-until 37", ["--grid-until 37", "--until"]),
        ("--time-limit 0", ["--time-limit 0", "seconds"]),
        ("--tolerance 1", ["--tolerance 1", "1e-13"]),
        ("--tip bessel", ["--tip bessel", "decays"]),
        ("--pulse 1,2", ["--pulse 1,2", "A,T,W"]),
        ("--noise 1e-3 --noise-spacing 0", ["--noise 0.001 --noise-spacing 0", "above 0"]),
        ("--noise inf", ["--noise inf", "finite"]),
        ("--noise-spacing 1", ["--noise-spacing", "give --noise too"]),
        ("--force-file none.csv", ["--force-file none.csv", "cannot be read"]),
        ("--force-file back.csv", ["--force-file back.csv", "increas"]),
        ("--initial-surface back.csv", ["--initial-surface back.csv", "increas"]),
    ] {
        folder.refuses(&format!("{CASE} {options}"), &words);
    }
}

/// The grid looks at every step for a signal, and nothing half done is written.
#[cfg(unix)]
#[test]
fn an_interrupted_comparison_writes_nothing() {
    let folder = Folder::new("compare-interrupted");
    let long = "compare --alpha 1.2 --r 1 --until 457 --grid uniform --spacing 0.001 --time-limit 1e9 -o c.json";
    for (signal, status) in [("-INT", 130), ("-TERM", 143)] {
        let mut child =
            folder.command(long).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        wait_until_it_listens(&mut child);
        sleep(Duration::from_millis(300));
        Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(status));
        assert!(folder.names().is_empty(), "{:?}", folder.names());
    }
}

/// The samples of one run are those of the grid; rasters have them where they are requested.
#[test]
fn samples_that_are_not_taken_are_warned_of() {
    let folder = Folder::new("compare_samples");
    for (line, warns) in [
        ("--until 17 --sample-every 0.5", true),
        ("--until 17 --sample-at 16.5", true),
        ("--until 17", false),
        ("--pitch 0.5 --lines 2 --length 5 --sample-every 0.5", false),
    ] {
        let line = format!("compare --tip gaussian --alpha 0.5 --r 1 {line} -o out.json");
        let said = said(&folder.stickslip(&line));
        assert_eq!(said.contains("has no effect on one run"), warns, "{line}: {said}");
    }
}
