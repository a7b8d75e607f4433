//! `raster`, `stability --pitch` and `surface` of a raster as a user meets them. What the numbers are worth is judged in
//! crates/raster/tests and crates/stability/tests.

use crate::folder::Folder;
use serde_json::Value;
use std::process::Stdio;
use std::time::Duration;
use stickslip_raster::{Path, Plan, Scanned, Scanning};
use stickslip_stability::{Raster, RasterPath};
use stickslip_tip::{Footprint, Model, TipFunction, Wider};

const GAUSSIAN: &str = "raster --tip gaussian --alpha 0.6 --r 1 --pitch 0.5";

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

fn round() -> Footprint {
    Footprint::separable(TipFunction::gaussian(1.0).unwrap(), 1.0).unwrap()
}

/// Samples, volume and heights are those of the library, in every format the same.
#[test]
fn a_raster_is_that_of_the_library() {
    let folder = Folder::new("raster_library");
    let line = format!("{GAUSSIAN} --path zigzag --lines 4 --length 20 --sample-at 0,7.5,20");
    let document = folder.prints_json(&line);
    let model = Model::new(round().path().clone(), 0.6, 1.0).unwrap();
    let plan = Plan::new(round(), model, Path::Zigzag, 0.5, 4, 20.0);
    let mut scanning = Scanning::new(&plan).unwrap();
    while scanning.next_line().unwrap().is_some() {}
    let lines = scanning.into_lines();
    for (n, line) in lines.iter().enumerate() {
        let found = &document["lines"][n];
        assert!((number(&found["y"]) - 0.5 * n as f64).abs() < 1e-15);
        for (i, t) in [0.0, 7.5, 20.0].into_iter().enumerate() {
            assert!((number(&found["samples"]["x0"][i]) - line.x0(t)).abs() < 1e-15);
            assert!((number(&found["samples"]["lag"][i]) - line.lag(t)).abs() < 1e-15);
        }
    }
    // On the way back the support is behind in x, and starts where the tip was.
    assert!(number(&document["lines"][1]["samples"]["lag"][2]) < 0.0);
    let ends =
        [&document["lines"][0]["samples"]["x0"][2], &document["lines"][1]["samples"]["x0"][0]];
    assert!((number(ends[0]) - number(ends[1])).abs() < 1e-12);
    let volume = -0.6 * 20.0 * 2.0 * std::f64::consts::PI * 4.0;
    assert!((number(&document["volume"]) - volume).abs() < 1e-9);
    folder.write("raster.json", document.to_string());
    let surface = folder.prints_json("surface raster.json --x 3,8.25 --y 0.1,1.5");
    let wanted = Scanned::new(&plan, &lines).heights(&[3.0, 8.25], &[0.1, 1.5]);
    for ((row, column), u) in wanted.indexed_iter() {
        assert!((number(&surface["surfaces"][0]["u"][row][column]) - u).abs() < 1e-12);
    }
    let schema = folder.prints_json("schema raster-surface");
    let validator = jsonschema::validator_for(&schema).unwrap();
    assert!(validator.is_valid(&surface));
}

/// Documents and what an interrupt leaves do not depend on the number of threads.
#[test]
fn a_raster_on_several_threads_is_the_same() {
    let folder = Folder::new("raster_threads");
    let line = format!("{GAUSSIAN} --lines 9 --length 60 --tolerance 1e-6");
    folder.prints(&format!("{line} --threads 1 -o 1.npz"));
    folder.prints(&format!("{line} --threads 3 -o 3.npz"));
    assert!(folder.read("1.npz") == folder.read("3.npz"));
    // With ripples, and a document of several pieces.
    let line = "raster --tip gaussian --alpha 0.46 --r 1 --pitch 0.5 --lines 64 --length 40";
    folder.prints(&format!("{line} --threads 1 -o 1.json"));
    folder.prints(&format!("{line} --threads 3 -o 3.json"));
    let document = folder.read("1.json");
    assert!(folder.json("1.json")["pattern"].is_object() && document.len() > 1_000_000);
    assert!(document == folder.read("3.json"));
    folder.refuses(&format!("{line} --threads 0"), &["--threads 0", "1 to"]);
}

/// Pixels of a .gsf file: its counts, and the heights row by row.
fn pixels(bytes: &[u8]) -> ([usize; 2], Vec<f32>) {
    let end = bytes.iter().position(|byte| *byte == 0).unwrap();
    let header = std::str::from_utf8(&bytes[..end]).unwrap();
    let count = |name: &str| {
        let line = header.lines().find_map(|line| line.strip_prefix(name));
        line.unwrap().trim_start_matches(" = ").parse::<usize>().unwrap()
    };
    let (words, _) = bytes[(end / 4 + 1) * 4..].as_chunks::<4>();
    ([count("XRes"), count("YRes")], words.iter().map(|word| f32::from_le_bytes(*word)).collect())
}

/// An image that is larger than a document may be goes to .gsf row by row: at every hundredth point it is the small
/// image.
#[test]
fn a_large_image_is_written_row_by_row() {
    let folder = Folder::new("raster_large_image");
    folder.prints(&format!("{GAUSSIAN} --lines 3 --length 10 -o raster.json"));
    folder.prints("run --tip gaussian --alpha 0.6 --r 1 --until 40 -o run.json");
    for (name, more) in [("raster", ""), ("run", "--far-behind")] {
        let surface = |points: usize, output: &str| {
            folder.prints(&format!(
                "surface {name}.json {more} --range=-3:12:{points} --y-range=-2:4:{points} -o {output}"
            ));
            pixels(&folder.read(output))
        };
        let (large, small) = (surface(3201, "large.gsf"), surface(33, "small.gsf"));
        assert_eq!((large.0, small.0), ([3201, 3201], [33, 33]));
        assert_eq!(large.1.len(), 3201 * 3201);
        for (row, heights) in small.1.chunks(33).enumerate() {
            for (column, u) in heights.iter().enumerate() {
                let same = large.1[100 * (3201 * row + column)];
                assert!((same - u).abs() < 1e-5, "{name} {row} {column}: {same} {u}");
            }
        }
        let line = format!("surface {name}.json --range=-3:12:3201 --y-range=-2:4:3201");
        folder.refuses(&format!("{line} -o large.json"), &["3", ".gsf"]);
        folder.refuses(&format!("{line} -o l.gsf --plot l.svg"), &["--plot l.svg", "1e7"]);
    }
}

#[test]
fn every_format_and_every_picture_is_written() {
    let folder = Folder::new("raster_formats");
    let line = format!("{GAUSSIAN} --lines 30 --length 30 --tolerance 1e-6");
    for name in ["a.json", "a.csv", "a.npz", "a.gsf"] {
        folder.prints(&format!("{line} -o {name} --plot {name}.svg"));
        assert!(folder.read(&format!("{name}.svg")).len() > 10_000, "{name}");
    }
    let csv = String::from_utf8(folder.read("a.csv")).unwrap();
    assert_eq!(csv.lines().next(), Some("line,y,t,x0,lag,velocity"));
    assert_eq!(csv.lines().count(), 1 + 30 * 121);
    assert!(csv.lines().last().unwrap().starts_with("30,14.5,30,"));
    let gsf = folder.read("a.gsf");
    assert!(gsf.starts_with(b"Gwyddion Simple Field 1.0\nXRes = 121\nYRes = 30\n"));
    for options in ["--x 1,2 --y 3", "--range 0:30:61 --y-range 0:15:31", "--range 2:9:8"] {
        folder.prints(&format!("surface a.json {options} -o s.csv --plot s.svg"));
        folder.prints(&format!("surface a.json {options} -o s.npz"));
    }
    folder.prints("surface a.json --range 0:30:61 --y-range 0:15:31 -o s.gsf");
    folder.prints("plot a.json -o again.svg");
    assert_eq!(folder.read("again.svg"), folder.read("a.json.svg"));
    folder.prints(
        "raster --alpha 0.4 --r 1 --path repeat --lines 3 --length 20 -o r.gsf --plot r.svg",
    );
    folder.prints("stability --tip gaussian --r 1 --pitch 0.5 --alpha 0.45 -o g.csv --plot g.svg");
    folder
        .prints("stability --tip gaussian --r 1 --path repeat --alpha 0.45 -o g.json --plot g.svg");
    assert!(!folder.names().iter().any(|name| name.contains("partial")));
}

/// A shape is scanned line by line: its lines are those of the file, a pulse on the first is felt by all, and every format
/// holds lines of several lengths.
#[test]
fn a_shape_is_scanned_line_by_line() {
    let folder = Folder::new("raster_area");
    folder.write("l.csv", "y,start,length\n0,-3,20\n0.5,-3,20\n1,2,12\n1.5,2,12.5\n");
    let line = "raster --tip gaussian --alpha 0.6 --r 1 --area l.csv --path zigzag";
    let found = folder.prints_json(line);
    assert_eq!(
        (found["parameters"]["lines"].as_u64(), number(&found["parameters"]["pitch"])),
        (Some(4), 0.5)
    );
    let last = |n: usize, what: &str| {
        number(found["lines"][n]["samples"][what].as_array().unwrap().last().unwrap())
    };
    assert!((last(1, "t") - 20.0).abs() < 1e-12 && last(2, "t") <= 12.0 && last(2, "t") > 11.7);
    // On the way back of line 2 the support ends at -3, the tip behind it.
    assert!((last(1, "x0") + last(1, "lag") + 3.0).abs() < 1e-9 && last(1, "lag") < 0.0);
    let volume = -0.6 * 64.5 * 2.0 * std::f64::consts::PI;
    assert!((number(&found["volume"]) - volume).abs() < 1e-9);
    let pushed = folder.prints_json(&format!("{line} --pulse 0.1,5,0.5"));
    for n in 0..4 {
        let x0 = |document: &Value| number(&document["lines"][n]["samples"]["x0"][40]);
        assert!((x0(&pushed) - x0(&found)).abs() > 1e-6, "{n}");
    }
    folder.write("a.json", pushed.to_string());
    let again = folder.prints_json("surface a.json --range=-3:17:11 --y 0.5");
    assert_eq!(again["parameters"], pushed["parameters"]);
    let schema = folder.prints_json("schema raster");
    assert!(jsonschema::validator_for(&schema).unwrap().is_valid(&pushed));
    // Options that describe a rectangle replace the shape.
    let again = folder.prints_json("raster --parameters a.json --pitch 1 --lines 2 --length 9");
    assert_eq!(
        (number(&again["lines"][1]["y"]), &again["parameters"]["area"]),
        (1.0, &Value::Null)
    );
    for name in ["a.csv", "a.npz", "a.gsf"] {
        folder.prints(&format!("{line} -o {name} --plot {name}.svg"));
    }
    let csv = String::from_utf8(folder.read("a.csv")).unwrap();
    assert!(csv.lines().last().unwrap().starts_with("4,1.5,12.5,"), "{csv}");
    folder.write("uneven.csv", "0,0,10\n1,0,12\n1,0,12\n0.2,3,9\n");
    let uneven = "raster --tip gaussian --alpha 0.6 --r 1 --area uneven.csv";
    folder.prints(&format!("{uneven} -o u.json --plot u.svg"));
    folder.prints("surface u.json -o u.npz");
    for (text, words) in [
        ("0,0,10\n1,0,0\n", ["--area bad.csv", "line 2"]),
        ("0,0\n", ["--area bad.csv", "y,start,length"]),
        ("", ["--area bad.csv", "between 1 and"]),
    ] {
        folder.write("bad.csv", text);
        folder.refuses("raster --alpha 1 --r 1 --area bad.csv", &words);
    }
    folder.refuses("raster --alpha 1 --r 1 --area l.csv --pitch 1", &["--pitch", "--area"]);
    folder.refuses(&line.replace("zigzag", "repeat"), &["--path repeat", "area"]);
}

/// `compare` of a raster: another way to the same motion, and a looser grid farther from it; every option that means
/// nothing to lines is refused.
#[test]
fn a_raster_is_compared_with_rows_of_cells() {
    let folder = Folder::new("raster_compare");
    let line =
        "compare --tip gaussian --alpha 0.5 --r 1 --pitch 0.5 --lines 4 --length 15 --path zigzag";
    let found = folder.prints_json(&format!("{line} --pulse 0.2,5,1"));
    let apart = |found: &Value| number(&found["max_difference"]["x0"]);
    assert!(apart(&found) < 1e-7 && number(&found["max_difference"]["u"]) < 1e-7, "{found}");
    assert_eq!(found["lines"].as_array().unwrap().len(), 4);
    assert_eq!(found["grid_u"].as_array().unwrap().len(), 4);
    assert!(number(&found["speedup"]) > 0.0 && found["grid_work"]["steps"].as_u64() > Some(100));
    let loose = folder.prints_json(&format!("{line} --grid-tolerance 1e-5"));
    assert!(apart(&loose) > 10.0 * apart(&found), "{} {}", apart(&loose), apart(&found));
    let coarse = folder.prints_json(&format!("{line} --grid windowed --spacing 0.05"));
    assert!(apart(&coarse) > 1e-5 && apart(&coarse) < 1e-2, "{}", apart(&coarse));
    assert_eq!(coarse["parameters"]["grid"], "windowed");
    folder.write("a.json", found.to_string());
    folder.prints("plot a.json -o a.svg");
    folder.write("l.csv", "y,start,length\n0,-3,10\n0.5,-3,9\n");
    folder.prints("compare --alpha 1 --r 1 --area l.csv --depth-limit 3 -o b.npz --plot b.svg");
    for (option, words) in [
        ("--until 30", ["--until", "--lines"]),
        ("--kick 0.1", ["--kick", "--lines"]),
        ("--grid uniform", ["--grid uniform", "second order"]),
        ("--spacing 2", ["--spacing 2", "at most"]),
        ("--grid windowed --spacing 1e-8", ["--spacing: the grid has", "fewer lines"]),
        ("--time-limit 0", ["--time-limit 0", "above 0"]),
    ] {
        folder.refuses(&format!("{line} {option}"), &words);
    }
    folder
        .refuses("compare --alpha 1 --r 1 --until 20 --path zigzag", &["--path zigzag", "--lines"]);
    folder.refuses("compare --alpha 1 --r 1", &["is needed", "--until"]);
}

/// The parameters of a raster serve other rasters, its linear theory, and a run on one line.
#[test]
fn parameters_of_a_raster_serve_other_questions() {
    let folder = Folder::new("raster_parameters");
    folder.prints(&format!("{GAUSSIAN} --lines 2 --length 9 --sample-every 1 -o a.json"));
    let repeated = folder.prints_json("raster --parameters a.json --path repeat --sample-at 1,2");
    assert_eq!(repeated["lines"][1]["samples"]["t"], serde_json::json!([1.0, 2.0]));
    let theory = folder.prints_json("stability --parameters a.json");
    assert!((number(&theory["critical"]["alpha"]) - 0.418_787).abs() < 1e-6);
    let run = folder.prints_json("run --parameters a.json --until 40");
    assert_eq!(run["regime"], "steady");
}

/// Killed at whatever moment, it goes on from its last line and writes the same bytes.
#[cfg(unix)]
#[test]
fn a_raster_that_is_killed_goes_on_from_its_last_line() {
    let folder = Folder::new("raster_killed");
    let line = format!("{GAUSSIAN} --lines 150 --length 60 --tolerance 1e-7");
    folder.prints(&format!("{line} -o whole.json"));
    let mut kills = 0;
    for wait in [30, 60, 90, 120] {
        let mut child = folder.command(&format!("{line} -o killed.json"));
        let mut child = child.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(wait));
        kills += usize::from(child.try_wait().unwrap().is_none());
        child.kill().unwrap();
        child.wait().unwrap();
        if folder.names().contains(&"killed.json".into()) {
            break;
        }
    }
    assert!(kills > 0, "nothing was killed");
    folder.prints(&format!("{line} -o killed.json"));
    assert_eq!(folder.read("killed.json"), folder.read("whole.json"));
    assert_eq!(folder.names(), ["killed.json", "whole.json"]);
}

/// A line that was damaged is scanned again, and so is what follows it; those of another raster are refused.
#[test]
fn lines_kept_are_taken_up_where_they_are_whole_and_of_this_raster() {
    let folder = Folder::new("raster_damaged");
    let line = format!("{GAUSSIAN} --lines 6 --length 15");
    folder.prints(&format!("{line} -o a.json"));
    let whole = folder.read("a.json");
    // What a kill would leave: the file of the lines, by a command that cannot write its result.
    let signal =
        folder.command(&format!("{GAUSSIAN} --lines 100000 --length 15 -o b.json")).spawn();
    let mut child = signal.unwrap();
    std::thread::sleep(Duration::from_millis(400));
    child.kill().unwrap();
    child.wait().unwrap();
    let kept = String::from_utf8(folder.read("b.json.partial")).unwrap();
    let mut lines: Vec<String> = kept.lines().take(5).map(str::to_owned).collect();
    assert_eq!(lines.len(), 5, "too few lines in the time");
    lines[0] = lines[0].replace("\"lines\":100000", "\"lines\":6");
    lines[3] = lines[3].replacen('1', "2", 1);
    folder.write("a.json.partial", lines.join("\n") + "\n");
    let said = folder.stickslip(&format!("{line} -o a.json"));
    let words = String::from_utf8(said.stderr).unwrap();
    assert!(words.contains("1 lines of") && words.contains("2 of 6 lines are in"), "{words}");
    assert_eq!(folder.read("a.json"), whole);
    folder.refuses(&format!("{line} -o b.json"), &["--output", "another raster"]);
    // One that failed on its first line left none, and another takes its place.
    let failing = format!("{line} --width 0.7 --memory modes --tolerance 1e-13 -o c.json");
    assert_eq!(folder.stickslip(&failing).status.code(), Some(1));
    assert!(!folder.names().contains(&"c.json.partial".into()));
    folder.prints(&format!("{line} -o c.json"));
}

/// The wider law on the command line: heights in samples, lines that take away less, and the same bytes after a resume.
#[test]
fn a_raster_under_the_wider_law_is_one_too() {
    let folder = Folder::new("raster_wider");
    let line = "raster --alpha 1.5 --r 1 --depth-limit 3 --pitch 1 --lines 3 --length 15";
    let limited = folder.prints_json(line);
    let height = number(&limited["lines"][1]["samples"]["height"][30]);
    assert!(height.abs() > 1e-3, "{height}");
    assert_eq!(limited["parameters"]["depth_limit"], 3.0);
    folder.write("a.json", limited.to_string());
    let surface = folder.prints_json("surface a.json --range 0:15:31 --y 0.5");
    assert_eq!(surface["surfaces"][0]["u"][0].as_array().unwrap().len(), 31);
    let free = folder.prints_json(&line.replace("--depth-limit 3 ", ""));
    // A triple Gaussian of β = 1 has no volume.
    assert!(number(&free["volume"]).abs() < 1e-12 && number(&limited["volume"]).abs() < 1e-12);
    let healed = line.replace("--depth-limit 3", "--tip gaussian --healing-time 5 --inertia 0.2");
    let healed = folder.prints_json(&format!("{healed} --path zigzag"));
    let never = -1.5 * 15.0 * 2.0 * std::f64::consts::PI * 3.0;
    assert!(number(&healed["volume"]) > 0.5 * never, "{}", healed["volume"]);
    folder.refuses(
        "raster --alpha -1 --no-spring --pitch 1 --lines 3 --length 15",
        &["--no-spring", "nothing drags"],
    );
    // β = 1 has its corner there, other tips have a linear theory.
    folder.refuses("stability --r 1 --pitch 1 --depth-limit 3", &["--depth-limit", "corner"]);
    let line = "stability --tip gaussian --r 1 --pitch 1 --depth-limit 8";
    let limited = folder.prints_json(line);
    let wider = Wider { depth_limit: Some(8.0), ..Wider::default() };
    let wanted = Raster::new(&round(), wider, (1.0, 1.0), 1.0).unwrap();
    let wanted = wanted.critical(RasterPath::OneWay).unwrap();
    assert!((number(&limited["critical"]["alpha"]) - wanted.alpha).abs() < 1e-12);
    assert_eq!(limited["parameters"]["depth_limit"], 8.0);
    let healing = "stability --tip gaussian --r 1 --pitch 1 --healing-time 100";
    let growing = folder.prints_json(&format!("{healing} --length 60 --alpha 1.7"));
    assert_eq!(growing["stable"], false);
    folder.refuses(healing, &["--length", "heals"]);
    folder.refuses(&format!("{line} --length 60"), &["--length", "does not heal"]);
    let zigzag = folder.prints_json(&format!("{line} --path zigzag --inertia 0.2"));
    let wider = Wider { inertia: Some(0.2), ..wider };
    let wanted = Raster::new(&round(), wider, (1.0, 1.0), 1.0).unwrap();
    let wanted = wanted.critical(RasterPath::Zigzag).unwrap();
    assert!((number(&zigzag["critical"]["alpha"]) - wanted.alpha).abs() < 1e-12);
    let healing = format!("{healing} --length 60 --path zigzag");
    folder.refuses(&healing, &["--path zigzag", "healing surface"]);
    let repeat = "stability --tip gaussian --r 1 --path repeat --depth-limit 8 --alpha 1";
    folder.refuses(repeat, &["--path repeat", "basic model"]);
}

/// Thresholds and angles, in the document as in the library.
#[test]
fn thresholds_of_a_raster_are_those_of_the_library() {
    let folder = Folder::new("raster_stability");
    for (pitch, alpha, angle) in [(0.5, 0.418_787, 46.0), (1.0, 0.805_167, 48.3)] {
        let line = format!("stability --tip gaussian --r 1 --pitch {pitch}");
        let found = folder.prints_json(&line);
        let critical = &found["critical"];
        let wanted = Raster::new(&round(), Wider::default(), (1.0, pitch), 1.0).unwrap();
        let wanted = wanted.critical(RasterPath::OneWay).unwrap();
        assert!((number(&critical["alpha"]) - wanted.alpha).abs() < 1e-15);
        assert!((number(&critical["alpha"]) - alpha).abs() < 5e-7);
        assert!((number(&critical["crest_angle"]) - angle).abs() < 0.05);
        let kappa = number(&critical["phase_per_line"]) / pitch;
        assert!((number(&critical["kappa"]) - kappa).abs() < 1e-14);
        assert_eq!(found["growth"], Value::Null);
        let certificate = &critical["certificate"];
        assert_eq!(
            (&certificate["growing_below"], &certificate["growing_above"]),
            (&0.into(), &1.into())
        );
        let schema = folder.prints_json("schema raster-stability");
        assert!(jsonschema::validator_for(&schema).unwrap().is_valid(&found));
    }
    // A search that ended on a sample found 1.070297773, more than that of a single line.
    let wide = folder.prints_json("stability --beta 1 --r 1 --pitch 3 --path zigzag");
    assert!((number(&wide["critical"]["alpha"]) - 1.050_997_0).abs() < 1e-7);
    folder
        .refuses("stability --tip bessel --width-y 1 --r 1 --pitch 1", &["--tip", "wave number 1"]);
    let zigzag = folder.prints_json("stability --tip gaussian --r 1 --pitch 0.5 --path zigzag");
    assert!((number(&zigzag["critical"]["alpha"]) - 0.457_309).abs() < 5e-7);
    assert_eq!(zigzag["critical"]["kappa"], Value::Null);
    let over = folder.prints_json("boundary --tip gaussian --pitch-range 0.5:1:2 --r 1");
    for (n, alpha) in [(0, 0.418_787), (1, 0.805_167)] {
        assert!((number(&over["alpha"][n]) - alpha).abs() < 5e-7);
    }
    folder.prints("boundary --tip gaussian --pitch-range 0.5:3:9 --r 1 -o p.csv --plot p.svg");
    for (alpha, stable) in [(0.4, true), (0.44, false)] {
        let line = format!("stability --tip gaussian --r 1 --pitch 0.5 --alpha {alpha}");
        let found = folder.prints_json(&line);
        assert_eq!(found["stable"], stable);
        let factors = found["growth"]["factor"].as_array().unwrap();
        let largest = factors.iter().map(number).fold(0.0, f64::max);
        assert_eq!(largest < 1.0, stable, "{largest}");
    }
}

#[test]
fn what_no_raster_can_be_made_of_is_refused_with_advice() {
    let folder = Folder::new("raster_refused");
    for (line, words) in [
        ("raster --alpha 1 --r 1 --lines 3 --length 10", ["--pitch", "is needed: the distance"]),
        ("raster --alpha 1 --r 1 --pitch 0 --lines 3 --length 10", ["--pitch 0", "above 0"]),
        ("raster --alpha 1 --r 1 --pitch 1 --lines 0 --length 10", ["--lines 0", "between 1"]),
        ("raster --alpha 1 --r 1 --pitch 1 --lines 3 --length -10", ["--length -10", "above 0"]),
        (
            "raster --tip bessel --alpha 1 --r 1 --pitch 1 --lines 3 --length 10",
            ["--width-y", "give"],
        ),
        (
            "raster --tip bessel --width-y 1 --alpha 1 --r 1 --pitch 1 --lines 3 --length 10",
            ["--tip", "decays"],
        ),
        (
            "raster --alpha 1 --r 1 --path repeat --pitch 1 --lines 3 --length 10",
            ["--pitch 1", "leave one"],
        ),
        (
            "raster --alpha 1 --r 1 --pitch 1 --lines 3 --length 10 --tolerance 1",
            ["--tolerance 1", "between"],
        ),
        (
            "raster --alpha 1 --r 1 --pitch 1 --lines 3 --length 10 --sample-at 11",
            ["--sample-at 11", "each line"],
        ),
        ("boundary --pitch-range -1:1:3 --r 1", ["--pitch-range -1:1:3", "above 0"]),
        ("boundary --pitch-range 1:2:3", ["--r", "support velocity"]),
        ("stability --r 1 --pitch -1", ["--pitch -1", "above 0"]),
        ("stability --r 1 --path zigzag", ["--pitch", "distance"]),
        ("stability --r 1 --path repeat", ["--alpha", "growth"]),
        ("stability --r 1 --width-y 1", ["--width-y 1", "--pitch"]),
    ] {
        folder.refuses(line, &words);
    }
    folder.prints("raster --alpha 0.5 --r 1 --pitch 1 --lines 2 --length 8 -o a.json");
    folder.refuses("surface a.json --at 3", &["--at", "last line"]);
    folder.refuses("surface a.json --y 1 -o a.gsf", &["--output a.gsf", "--y-range"]);
    folder.prints("run --alpha 1 --r 1 --until 20 -o run.json");
    folder.refuses("surface run.json --y 1", &["--y 1", "raster"]);
}

/// What is reported of a pattern: numbers with errors, the same in words and in the document; where several waves compete null,
/// and a remark that names them. Wave vectors are judged in crates/raster.
#[test]
fn a_pattern_is_reported_with_its_errors_or_with_a_reason() {
    let folder = Folder::new("raster_pattern");
    let schema = folder.prints_json("schema raster");
    let validator = jsonschema::validator_for(&schema).unwrap();
    let line = "raster --tip gaussian --r 1 --tolerance 1e-6 --length 60 --lines 80";
    let clear = folder.prints_json(&format!("{line} --alpha 0.9 --pitch 1"));
    assert!(validator.is_valid(&clear));
    let found = &clear["pattern"];
    let (angle, error) = (number(&found["crest_angle"]), number(&found["crest_angle_error"]));
    assert!((angle - 51.7).abs() < error && error < 7.0, "{found}");
    assert!(number(&found["wavelength_error"]) < 1.0 && number(&found["coherence_error"]) < 0.05);
    let words =
        String::from_utf8(folder.prints(&format!("{line} --alpha 0.9 --pitch 1 --format text")));
    assert!(
        words.unwrap().contains(&format!("crests at {angle:.1} ± {error:.1}° to the scan axis"))
    );
    let mixed = folder.prints_json(&format!("{line} --alpha 0.5 --pitch 0.5"));
    assert!(validator.is_valid(&mixed));
    assert_eq!(mixed["regime"], "ripples");
    for name in ["q", "kappa", "wavelength", "wavelength_error", "crest_angle"] {
        assert_eq!(mixed["pattern"][name], Value::Null, "{name}");
    }
    let remarks = mixed["remarks"].as_array().unwrap();
    assert!(
        remarks.iter().any(|remark| remark.as_str().unwrap().contains("as strong")),
        "{remarks:?}"
    );
    // Of too few lines, how many would do.
    let few = folder
        .prints_json("raster --tip gaussian --alpha 0.5 --r 1 --pitch 0.5 --lines 20 --length 40");
    assert_eq!((few["regime"].as_str(), &few["pattern"]), (Some("unknown"), &Value::Null));
    assert!(few["remarks"][0].as_str().unwrap().contains("55 would be enough"), "{few}");
    // A map keeps what its rasters remark, and has no angle where there is none.
    let map = "sweep raster --tip gaussian --r 1 --pitch 0.5:1:2 --alpha 0.5:0.9:2 --lines 80 --length 60 --tolerance 1e-6";
    let map = folder.prints_json(&format!("{map} --plot map.svg"));
    assert_eq!(map["points"][0]["pattern"]["crest_angle"], Value::Null);
    assert_eq!(map["points"][0]["remarks"], mixed["remarks"]);
    assert!((number(&map["points"][3]["pattern"]["crest_angle"]) - angle).abs() < 1e-9);
    let drawn = String::from_utf8(folder.read("map.svg")).unwrap();
    assert!(drawn.contains(&format!("{angle:.0}°")));
}
