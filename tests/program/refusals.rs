//! Bad input is refused at once: with status 2, nothing on standard output, and a message that names the option and the value
//! and says what would be accepted.

use crate::folder::{Folder, said};
use serde_json::json;

#[test]
fn parameters_out_of_range_are_refused() {
    let folder = Folder::new("parameters");
    let cases: [(&str, &[&str]); 26] = [
        ("--r 0 --alpha 1", &["--r 0", "above 0"]),
        ("--r -1 --alpha 1", &["--r -1", "above 0"]),
        ("--r nan --alpha 1", &["--r NaN", "finite"]),
        ("--r inf --alpha 1", &["--r inf", "finite"]),
        ("--r 0 --alpha-above 1", &["--r 0", "above 0"]),
        ("--r nan --alpha-above 1", &["--r NaN", "finite"]),
        ("--r one --alpha 1", &["'one'", "'--r <R>'"]),
        ("--alpha 1", &["--r"]),
        ("--r 1 --alpha -1", &["--alpha -1", "0 or above"]),
        ("--r 1 --alpha=-1e-9", &["--alpha -1e-9", "0 or above"]),
        ("--r 1 --alpha nan", &["--alpha NaN", "finite"]),
        ("--r 1 --alpha inf", &["--alpha inf"]),
        ("--r 1 --alpha-above nan", &["--alpha-above NaN", "finite"]),
        ("--r 1 --alpha-above -5", &["--alpha-above -5", "0 or above"]),
        ("--r 1 --alpha 1 --alpha-above 1", &["--alpha", "--alpha-above", "one of them"]),
        ("--r 1", &["--alpha", "missing", "--alpha-above"]),
        ("--r 1 --alpha 1 --tip round", &["--tip", "round", "triple-gaussian, gaussian, bessel"]),
        ("--r 1 --alpha 1 --tip gaussian --beta 1", &["--beta 1", "leave"]),
        ("--r 1 --alpha 1 --tip bessel --beta 0", &["--beta 0", "leave"]),
        ("--r 1 --alpha 1 --tip bessel --width 2", &["--width 2", "--tip bessel", "leave"]),
        ("--r 1 --alpha 1 --tip gaussian --tip-file f.csv", &["--tip-file f.csv", "leave"]),
        ("--r 1 --alpha 1 --width 0", &["--width 0", "above 0"]),
        ("--r 1 --alpha 1 --width -2", &["--width -2", "above 0"]),
        ("--r 1 --alpha 1 --width nan", &["--width NaN", "above 0"]),
        ("--r 1 --alpha 1 --beta nan", &["--beta NaN", "finite"]),
        ("--r 1 --alpha 1 --beta inf", &["--beta inf", "finite"]),
    ];
    for (options, words) in cases {
        folder.refuses(&format!("run {options} --until 60"), words);
    }
}

#[test]
fn options_of_a_run_out_of_range_are_refused() {
    let folder = Folder::new("options");
    let cases: [(&str, &[&str]); 42] = [
        ("", &["--until"]),
        ("--until 10", &["--until 10", "starts at t = 16.03", "after"]),
        ("--until -5", &["--until -5", "starts at"]),
        ("--until nan", &["--until NaN", "finite"]),
        ("--until inf", &["--until inf"]),
        ("--until 60 --start flat --start-position 61", &["--until 60", "starts at t = 61"]),
        ("--until 60 --start sideways", &["--start", "sideways", "steady, flat"]),
        ("--until 60 --start-position nan", &["--start-position NaN", "finite"]),
        ("--until 60 --kick inf", &["--kick inf"]),
        ("--until 60 --kick nan", &["--kick NaN", "finite"]),
        ("--until 60 --tolerance 0", &["--tolerance 0", "between 1e-13"]),
        ("--until 60 --tolerance -1e-9", &["--tolerance -1e-9", "between 1e-13"]),
        ("--until 60 --tolerance 1e-20", &["--tolerance 1e-20", "between 1e-13"]),
        ("--until 60 --tolerance 1", &["--tolerance 1", "and 0.01"]),
        ("--until 60 --tolerance nan", &["--tolerance NaN", "finite"]),
        ("--until 60 --memory lots", &["--memory", "lots", "auto, direct, fft"]),
        ("--until 60 --sample-every 0", &["--sample-every 0", "above 0"]),
        ("--until 60 --sample-every -1", &["--sample-every -1", "above 0"]),
        ("--until 60 --sample-every nan", &["--sample-every NaN", "finite"]),
        ("--until 60 --sample-every 1e-9", &["--sample-every 1e-9", "memory", "or more"]),
        ("--until 60 --sample-every 1e-300", &["--sample-every 1e-300", "or more"]),
        ("--until 60 --sample-at 1,20", &["--sample-at 1:", "from 16.03", "to 60"]),
        ("--until 60 --sample-at 20,61", &["--sample-at 61:", "to 60"]),
        ("--until 60 --sample-at nan", &["--sample-at", "finite"]),
        ("--until 60 --sample-at 20,", &["--sample-at"]),
        ("--until 60 --sample-at 20 --sample-every 1", &["--sample-at", "--sample-every"]),
        ("--until 60 --noise -1", &["--noise -1", "amplitude 0 or above"]),
        ("--until 60 --noise nan", &["--noise NaN", "finite"]),
        ("--until 60 --noise 1 --noise-spacing 0", &["--noise-spacing 0", "above 0"]),
        ("--until 60 --noise 1 --noise-spacing -1", &["--noise-spacing -1", "above 0"]),
        ("--until 60 --noise 1 --noise-spacing nan", &["--noise-spacing NaN", "above 0"]),
        ("--until 60 --noise 1 --noise-spacing 1e-12", &["--noise-spacing 1e-12", "at most"]),
        ("--until 60 --noise-spacing 1", &["--noise-spacing: ", "give --noise too"]),
        ("--until 60 --seed 2", &["--seed: ", "give --noise too"]),
        ("--until 60 --noise 1 --seed -1", &["'-1'", "'--seed <N>'"]),
        ("--until 60 --pulse 1", &["--pulse 1:", "A,T,W"]),
        ("--until 60 --pulse 1,2,3,4", &["--pulse 1,2,3,4", "A,T,W"]),
        ("--until 60 --pulse a,20,1", &["--pulse a,20,1", "A,T,W"]),
        ("--until 60 --pulse 1,20,0", &["--pulse 1,20,0", "width above 0"]),
        ("--until 60 --pulse 1,20,-1", &["--pulse 1,20,-1", "width above 0"]),
        ("--until 60 --pulse nan,20,1", &["--pulse nan,20,1", "finite"]),
        ("--until 60 --pulse 2,30,1 --pulse 1,inf,1", &["--pulse 1,inf,1", "finite"]),
    ];
    for (options, words) in cases {
        folder.refuses(&format!("run --alpha 1.2 --r 1 {options}"), words);
    }
}

#[test]
fn forces_that_nothing_feels_are_warned_of() {
    let folder = Folder::new("idle");
    folder.write("late.csv", "t,force\n70,0\n72,1\n75,0\n");
    folder.write("early.csv", "t,force\n1,0\n2,1\n3,0\n");
    let warned = |line: &str| said(&folder.stickslip(&format!("{line} -o out.json")));
    let run = "run --alpha 0.9 --r 1 --until 40";
    let compare = "compare --alpha 0.9 --r 1 --until 40";
    let response = "response --alpha 0.9 --r 1 --until 40";
    for (line, words) in [
        (&format!("{run} --pulse 1,60,0.5"), ["--pulse 1,60,0.5 has no", "--until above 60"]),
        (&format!("{compare} --pulse 1,60,0.5"), ["--pulse 1,60,0.5 has no", "--until above 60"]),
        (&format!("{response} --pulse 1,60,0.5"), ["--pulse 1,60,0.5 has no", "--until above 60"]),
        (
            &format!("{run} --pulse 1,20,1 --pulse=-2,5,1"),
            ["--pulse -2,5,1 has no", "start at t = 15.7"],
        ),
        (&format!("{run} --force-file late.csv"), ["--force-file late.csv", "--until above 70"]),
        (&format!("{run} --force-file early.csv"), ["--force-file early.csv", "start at t = 15.7"]),
    ] {
        let said = warned(line);
        assert!(words.iter().all(|word| said.contains(word)), "{line}\n{said}");
        assert_eq!(said.matches("has no effect").count(), 1, "{line}\n{said}");
    }
    // Quantities are named as they were typed.
    let scales = "--sigma 30nm --stiffness 0.2N/m --damping 1mNs/m";
    let said = warned(&format!("{run} --pulse 1nN,30ms,5ms {scales}"));
    assert!(said.contains("--pulse 1nN,30ms,5ms has no effect"), "{said}");
    assert!(said.contains("(1nN,30ms,5ms"), "{said}");
    // A part of these acts before the start at t = 15.7.
    folder.write("cut.csv", "t,force\n10,0\n14,1\n18,1\n22,0\n");
    folder.write("zeros.csv", "t,force\n10,0\n18,0\n19,1\n22,0\n");
    for (line, remedy) in [
        (&format!("{run} --pulse 1,12,0.5"), "a time of at least 17.33"),
        (&format!("{compare} --pulse 1,17,0.5"), "a time of at least 17.33"),
        (&format!("{run} --force-file cut.csv"), "later times"),
        (
            &"raster --alpha 0.3 --r 1 --pitch 1 --lines 2 --length 9 --pulse 1,1,1".into(),
            "a time of at least 3.09",
        ),
        (
            &"run --tip bessel --no-spring --alpha -3 --healing-time 1 --until 9 --pulse 1,1,0.5"
                .into(),
            "a time of at least 1.55",
        ),
    ] {
        let said = warned(line);
        let words = ["begins before the start at t = ", "left out", remedy];
        assert!(words.iter().all(|word| said.contains(word)), "{line}\n{said}");
    }
    // Of these at least a tail is felt, or an echo, or all but a thousandth.
    for line in [
        &format!("{run} --pulse 1,44,0.5"),
        &format!("{run} --pulse 1,17.5,0.5"),
        &format!("{run} --force-file zeros.csv"),
        &format!("{response} --pulse 1,5,0.5"),
    ] {
        let said = warned(line);
        assert!(!said.contains("no effect") && !said.contains("left out"), "{line}\n{said}");
    }
}

/// Files of two columns, and what is said about them.
const SERIES: [(&[u8], &str); 12] = [
    (b"", "0 rows were found: at least 3"),
    (b"x,y\n", "0 rows were found: at least 3"),
    (b"0,1\n1,2\n", "2 rows were found: at least 3"),
    (b"0,1\n1,2\n2\n", "line 3"),
    (b"x,y\n0,1\n1,2,3\n", "line 3"),
    (b"0 1\n1 2\n2 x\n", "line 3"),
    (b"0,1.2e\n1,2\n2,3\n3,4\n", "line 1"),
    (b"0,1\n2,2\n1,3\n", "row 3 has 1 in its first column: it must increase"),
    (b"0,1\n1,2\n1,3\n", "row 3 has 1 in its first column: it must increase"),
    (b"0,1\n1,nan\n2,3\n", "line 2"),
    (b"0,1\n1,2\n2,1e999\n", "line 3"),
    (b"\x89PNG\r\n\x1a\n\x00\x00\xff\xfe", "UTF-8"),
];

#[test]
fn series_that_are_no_function_are_refused() {
    let folder = Folder::new("series");
    for (contents, words) in SERIES {
        folder.write("series.csv", contents);
        for option in ["--initial-surface", "--force-file"] {
            let named = format!("{option} series.csv");
            folder.refuses(&format!("run --alpha 1.2 --r 1 --until 60 {named}"), &[&named, words]);
        }
    }
    for missing in ["--initial-surface none.csv", "--force-file none.csv", "--tip-file none.csv"] {
        let line = format!("run --alpha 1.2 --r 1 --until 60 {missing}");
        folder.refuses(&line, &[missing, "cannot be read"]);
    }
}

/// A table of f(x) at x = 0, 1/2, …, 6.
fn table(f: impl Fn(f64) -> f64) -> Vec<u8> {
    let row = |i: i32| format!("{},{}\n", 0.5 * f64::from(i), f(0.5 * f64::from(i)));
    (0..=12).map(row).collect::<String>().into_bytes()
}

fn gaussians(terms: &[[f64; 3]]) -> Vec<u8> {
    let term = |[a, c, w]: &[f64; 3]| json!({"amplitude": a, "center": c, "width": w});
    let terms: Vec<_> = terms.iter().map(term).collect();
    json!({ "gaussians": terms }).to_string().into_bytes()
}

#[test]
fn tips_that_are_no_footprint_are_refused() {
    let folder = Folder::new("tips");
    let sampled = |range: std::ops::Range<i32>| -> Vec<u8> {
        range.map(|x| format!("{x},{}\n", (-x * x).max(-5))).collect::<String>().into_bytes()
    };
    let cases: [(Vec<u8>, &str); 18] = [
        (vec![], "between 8 and 2000"),
        (b"\x00\xff\xfe".into(), "UTF-8"),
        (b"[1, 2]".into(), "line 1"),
        (b"{\"gaussians\":[".into(), "expected {\"gaussians\":["),
        (b"{\"gaussian\":[]}".into(), "expected `gaussians`"),
        (b"{\"gaussians\":[{\"amplitude\":1,\"center\":0}]}".into(), "missing field `width`"),
        (
            b"{\"gaussians\":[{\"amplitude\":1e999,\"center\":0,\"width\":1}]}".into(),
            "out of range",
        ),
        (gaussians(&[]), "zero everywhere"),
        (gaussians(&[[0.0, 0.0, 1.0]]), "zero everywhere"),
        (gaussians(&[[1.0, 0.0, 0.0]]), "width 0: a width must be above 0"),
        (gaussians(&[[1.0, 0.0, 1.0], [1.0, 0.0, -1.0]]), "number 2 has width -1"),
        (gaussians(&[[1.0, 0.5, 1.0]]), "not even: the Gaussian at center 0.5 lacks a twin"),
        (gaussians(&[[1.0, 0.5, 1.0], [1.0, -0.5, 1.1]]), "not even"),
        // Once an abort for want of memory, or an overflow.
        (gaussians(&[[1.0, 0.0, 1e6], [1.0, 0.0, 1e-3]]), "narrowest"),
        (gaussians(&[[1.0, 0.0, 1.0], [1.0, 1e90, 1.0], [1.0, -1e90, 1.0]]), "narrowest"),
        (table(|x| 1.0 / (1.0 + x)), "does not decay"),
        (table(|x| if x < 3.0 { 1.0 } else { f64::NAN }), "a value is missing"),
        (sampled(3..20), "must start at x = 0"),
    ];
    for (contents, words) in cases {
        folder.write("tip.csv", contents);
        let line = "run --alpha 1.2 --r 1 --until 60 --tip-file tip.csv";
        folder.refuses(line, &["--tip-file tip.csv", words]);
    }
}

#[test]
fn places_that_cannot_be_written_are_found_before_the_run() {
    let folder = Folder::new("places");
    folder.write("file", "");
    std::fs::create_dir(folder.path("folder.json")).unwrap();
    std::fs::create_dir(folder.path("folder.svg")).unwrap();
    let long = format!("{}.json", "a".repeat(300));
    let cases = [
        ("--output", "none/run.json", "there is no such folder; choose a place that exists"),
        ("--output", "folder.json", "choose a place"),
        ("--output", "file/run.json", "choose a place"),
        ("--output", "run.json/", "choose a place"),
        ("--output", &long, "choose a place"),
        ("--output", "run.txt", ".json, .csv, .jsonl or .npz"),
        ("--output", "run", ".json, .csv, .jsonl or .npz"),
        ("--output", "folder", ".json, .csv, .jsonl or .npz"),
        ("--plot", "none/run.svg", "choose a place that exists"),
        ("--plot", "folder.svg", "choose a place"),
        ("--plot", "run.jpg", ".svg, .png or .pdf"),
        ("--plot", "-", ".svg, .png or .pdf"),
    ];
    for (option, place, advice) in cases {
        let named = format!("{option} {place}");
        // A run that would take long.
        folder.refuses(&format!("run --alpha 1.2 --r 1 --until 1e7 {named}"), &[&named, advice]);
    }
    if cfg!(target_os = "linux") {
        // Not even the superuser writes there.
        let line = "run --alpha 1.2 --r 1 --until 1e7 -o /proc/run.json";
        folder.refuses(line, &["--output /proc/run.json", "choose a place"]);
    }
    assert_eq!(folder.names(), ["file", "folder.json", "folder.svg"]);
}

#[test]
fn surfaces_that_cannot_be_had_are_refused() {
    let folder = Folder::new("surfaces");
    folder.prints("run --alpha 1.2 --r 1 --until 30 -o run.json");
    let cases: [(&str, &[&str]); 24] = [
        ("-o u.txt", &["--output u.txt", ".json, .csv, .gsf or .npz"]),
        ("--at 5", &["--at 5", "from 16.03", "to 30"]),
        ("--at 20,31", &["--at 31", "to 30"]),
        ("--at nan", &["--at NaN", "to 30"]),
        ("--at now", &["--at", "'now'"]),
        ("--x nan", &["--x NaN", "finite"]),
        ("--x 1,inf", &["--x inf", "finite"]),
        ("--x 1,a", &["--x", "'a'"]),
        ("--x 1 --range 1,2", &["--x", "--range"]),
        ("--x 1 --spacing 1", &["--x", "--spacing"]),
        ("--range 1", &["--range", "'1'", "LO:HI:N"]),
        ("--range 1,2,3", &["--range", "'1,2,3'", "LO:HI:N"]),
        ("--range 2,1", &["--range 2,1", "LO below HI"]),
        ("--range 1,1", &["--range 1,1", "LO below HI"]),
        ("--range nan,1", &["--range nan,1", "finite"]),
        ("--range 0,inf", &["--range 0,inf", "finite"]),
        ("--spacing 0", &["--spacing 0", "above 0"]),
        ("--spacing -1", &["--spacing -1", "above 0"]),
        ("--spacing nan", &["--spacing NaN", "above 0"]),
        ("--spacing 1e-300", &["--spacing 1e-300", "or more"]),
        ("--range -1e300,1e300", &["--spacing 0.05", "or more"]),
        ("--range 0:80:4000001", &["--range", "a spacing of", "or more"]),
        ("-o none/u.json", &["--output none/u.json", "choose a place"]),
        ("--plot u.jpg", &["--plot u.jpg", ".svg, .png or .pdf"]),
    ];
    for (options, words) in cases {
        folder.refuses(&format!("surface run.json {options}"), words);
    }
    folder.refuses("surface none.json", &["RUN.json none.json", "cannot be read"]);
}

#[test]
fn no_file_is_written_over_another_of_the_same_command() {
    let folder = Folder::new("apart");
    folder.prints("run --alpha 1.2 --r 1 --until 30 -o run.json");
    folder.prints("cycle --alpha 1.2 --r 1 -o cycle.json");
    folder.write("tip.csv", table(|x| (-0.5 * x * x).exp()));
    std::fs::create_dir(folder.path("sub")).unwrap();
    let before = (folder.names(), folder.read("run.json"));
    let run = "run --alpha 1.2 --r 1 --until 30";
    for (line, words) in [
        ("verify run.json -o run.json", ["--output run.json", "of RUN:"]),
        ("surface run.json -o ./sub/../run.json", ["--output ./sub/../run.json", "RUN.json"]),
        (&format!("{run} --format json -o a.svg --plot ./a.svg"), ["--plot ./a.svg", "--output"]),
        (&format!("{run} --tip-file tip.csv -o tip.csv"), ["--output tip.csv", "--tip-file"]),
        (
            &format!("{run} -o a.json --plot a.svg --checkpoint a.svg"),
            ["--checkpoint a.svg", "--plot"],
        ),
        ("stability --r 1 --tip-file tip.csv -o tip.csv", ["--output tip.csv", "--tip-file"]),
        ("sweep --r 1 --alpha 1 --tip-file tip.csv -o tip.csv", ["--output", "--tip-file"]),
        (
            "boundary --r-range 1,2 --plot b.svg --plot-onset b.svg",
            ["--plot-onset b.svg", "--plot"],
        ),
        ("continue --from cycle.json --over alpha -o cycle.json", ["--output", "--from"]),
    ] {
        folder.refuses(line, &[words[0], words[1], "a name of its own"]);
    }
    assert!((folder.names(), folder.read("run.json")) == before);
    // A cycle may take the place of the one that it came from, and a device may be named twice.
    folder.prints("cycle --from cycle.json --alpha 1.21 -o cycle.json");
    if cfg!(unix) {
        folder.prints(&format!("{run} --format json -o /dev/null --verify"));
    }
}

/// An option that a command does not have, and that resembles none of its own, is named alone.
#[test]
fn no_usage_of_another_option_is_shown() {
    let folder = Folder::new("no_usage");
    let said = said(&folder.stickslip("surface run.json --tip-file f.csv"));
    assert!(said.contains("--tip-file") && !said.contains("--sigma"), "{said}");
}

/// The option at fault is named, not the one that was read first; what has no effect is refused.
#[test]
fn refusals_name_the_option_at_fault() {
    let folder = Folder::new("at_fault");
    folder.write("ripple.csv", "x_nm,z_nm\n0,0\n1,1\n2,0\n3,1\n4,0\n5,1\n6,0\n7,1\n8,0\n");
    folder.write("pit.csv", (0..40).map(|i| format!("{i},{}\n", i % 3)).collect::<String>());
    let rasters = "sweep raster --tip gaussian --r 1";
    for (line, words) in [
        ("stability --r 1 --depth-limit -1", ["--depth-limit -1:", "above 0, from 1e-100"]),
        ("stability --r 1 --inertia 1e300", ["--inertia 1e300:", "to 1e100"]),
        ("boundary --load 1nN --load-range 1nN:2nN --r-range 1:2:3", ["--alpha:", "load --load;"]),
        (
            &format!("{rasters} --pitch 0.5 --alpha 0.3 --lines 4 --length -1"),
            ["--length -1:", "above 0"],
        ),
        (
            &format!("{rasters} --pitch 0.5 --alpha 0.3 --lines 0 --length 9"),
            ["--lines 0:", "1 and"],
        ),
        (
            &format!("{rasters} --pitch 0.5 --alpha 0.3 --lines 4 --length 9 --tolerance 1"),
            ["--tolerance 1:", "1e-13"],
        ),
        (
            &format!("{rasters} --pitch 0.5 --alpha 0.3 --lines 4 --length 9 --healing-time 0"),
            ["--healing-time 0:", "above 0"],
        ),
        (
            &format!("{rasters} --pitch 0 --alpha 0.3 --lines 4 --length 9"),
            ["--pitch 0:", "above 0"],
        ),
        ("tip pit.csv --centre nan", ["--centre NaN:", "finite"]),
        ("fit --ripple ripple.csv --width inf", ["--width inf:", "finite"]),
        ("fit --ripple ripple.csv --height-gain 0", ["--height-gain 0:", "above 0"]),
        ("fit --ripple ripple.csv --force-gain 1", ["--force-gain:", "without --friction"]),
        ("fit --ripple ripple.csv --pitch 30nm", ["--pitch:", "without --image"]),
        ("fit --ripple ripple.csv --lateral-image a.gsf", ["--lateral-image:", "without --image"]),
    ] {
        folder.refuses(line, &words);
    }
}
