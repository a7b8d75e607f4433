//! `sweep raster` as a user meets it: each point is the raster of its own command.

use crate::folder::Folder;
use serde_json::Value;

const GRID: &str =
    "sweep raster --tip gaussian --r 1 --pitch 0.5:1:2 --alpha 0.3:0.9:3 --lines 50 --length 40";

#[test]
fn every_point_is_the_raster_of_its_own_command() {
    let folder = Folder::new("raster_sweep");
    let found = folder.prints_json(GRID);
    let points = found["points"].as_array().unwrap();
    assert_eq!(points.len(), 6);
    let mut regimes = vec![];
    for point in points {
        let (pitch, alpha) = (&point["pitch"], &point["alpha"]);
        let size = "--lines 50 --length 40 --tolerance 1e-6 --tip gaussian --r 1";
        let line = format!("raster --pitch {pitch} --alpha {alpha} {size}");
        let alone = folder.prints_json(&line);
        assert_eq!(point["regime"], alone["regime"], "{point}");
        assert_eq!(point["pattern"], alone["pattern"], "{point}");
        let line = format!("stability --tip gaussian --r 1 --pitch {pitch}");
        assert_eq!(point["critical_alpha"], folder.prints_json(&line)["critical"]["alpha"]);
        regimes.push(point["regime"].as_str().unwrap().to_owned());
    }
    regimes.sort();
    regimes.dedup();
    assert!(regimes.len() >= 3, "{regimes:?}");
}

#[test]
fn parts_merge_to_the_same_bytes() {
    let folder = Folder::new("raster_sweep_parts");
    let grid = GRID.replace("--lines 50 --length 40", "--lines 12 --length 20");
    let alone = folder.prints(&grid);
    for part in 1..=4 {
        folder
            .prints(&format!("{grid} --shard {part}/4 -o part-{part}.json --plot part-{part}.svg"));
    }
    assert_eq!(folder.json("part-3.json")["points"].as_array().unwrap().len(), 1);
    assert_eq!(folder.prints("sweep merge part-4.json part-2.json part-1.json part-3.json"), alone);
    folder.refuses("sweep merge part-1.json part-3.json", &["--array=2,4", "slurm/4"]);
    folder.refuses(
        "sweep merge part-1.json part-1.json part-2.json part-3.json",
        &["more than one part"],
    );
    folder.prints("sweep --r 1 --alpha 0.3:0.9:3 -o other.json");
    folder.refuses("sweep merge part-1.json other.json", &["other.json", "stickslip/raster-sweep"]);
    let changed = String::from_utf8(folder.read("part-2.json"))
        .unwrap()
        .replace("\"alpha\":0.6", "\"alpha\":0.7");
    folder.write("changed.json", changed);
    folder.refuses("sweep merge part-1.json changed.json", &["changed.json", "checksum"]);
}

#[test]
fn it_is_written_drawn_and_taken_up_again() {
    let folder = Folder::new("raster_sweep_files");
    folder.prints(&format!("{GRID} -o a.json --plot a.svg --threads 1"));
    folder.prints(&format!("{GRID} -o b.json --threads 2"));
    assert_eq!(folder.read("a.json"), folder.read("b.json"));
    folder.prints(&format!("{GRID} -o a.csv --plot c.svg"));
    let csv = String::from_utf8(folder.read("a.csv")).unwrap();
    assert_eq!(csv.lines().count(), 7);
    assert!(csv.starts_with("pitch,alpha,critical_alpha,regime,q,kappa,wavelength,"));
    folder.prints(&format!("{} -o d.npz --plot d.svg", GRID.replace("0.5:1:2", "0.5")));
    folder.prints("plot a.json -o e.svg");
    assert_eq!(folder.read("e.svg"), folder.read("a.svg"));
    let limited = GRID.replace("--tip gaussian", "--tip gaussian --depth-limit 8");
    let limited = folder.prints_json(&limited);
    // The threshold of the wider law, far above the paper's 0.4188.
    let critical = limited["points"][0]["critical_alpha"].as_f64().unwrap();
    assert!((critical - 0.721_938).abs() < 1e-6, "{critical}");
    assert_eq!(limited["parameters"]["depth_limit"], Value::from(8.0));
    assert!(!folder.names().iter().any(|name| name.contains("partial")));
    for (line, words) in [
        (GRID.replace("0.5:1:2", "0:1:2"), ["--pitch 0", "above 0"]),
        (format!("{GRID} --path repeat"), ["--path repeat", "pitch"]),
        (GRID.replace("--lines 50", "--lines 0"), ["--lines 0", "between 1"]),
        (GRID.replace("0.3:0.9:3", "0.3:0.9:200000"), ["--alpha", "at most"]),
        (format!("{GRID} --no-spring"), ["--no-spring:", "no support"]),
    ] {
        folder.refuses(&line, &words);
    }
}
