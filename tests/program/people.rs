//! What the program says to a person, and to a script that wants one number.

use crate::folder::{Folder, said};
use std::process::{Command, Stdio};

/// A command of every kind that has a result, quick ones; RUN is a saved run.
const COMMANDS: [(&str, &str); 10] = [
    ("run --alpha 1.2 --r 1 --kick 0.05 --until 60", "reached in"),
    ("verify RUN.json", "is kept"),
    ("surface RUN.json --range 20:40:50", "50 heights"),
    ("stability --r 1", "1.069036175"),
    ("boundary --r-range 0.5:2:5", "5 r from 0.5 to 2"),
    ("response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 40", "modes"),
    ("compare --alpha 1.2 --r 1 --kick 0.05 --until 30", "largest difference"),
    ("cycle --alpha 1.2 --r 1", "stable cycle of one slip"),
    ("continue --r 1 --over alpha --to 1.1", "branch 0: "),
    ("sweep --r 1 --alpha 0.9:1.2:3", "3 points: "),
];

fn folder(name: &str) -> Folder {
    let folder = Folder::new(name);
    folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 60 -o RUN.json --quiet");
    folder
}

#[test]
fn every_command_tells_what_it_found_in_aligned_lines() {
    let folder = folder("told");
    for (command, found) in COMMANDS {
        let text = String::from_utf8(folder.prints(&format!("{command} --format text"))).unwrap();
        let headline = text.lines().next().unwrap();
        assert!(headline.contains(found), "{command}\n{text}");
        assert!(text.lines().count() < 30 && !text.contains('{'), "{command}\n{text}");
        let rows: Vec<&str> = text.lines().filter(|line| line.starts_with("  ")).collect();
        assert!(!rows.is_empty(), "{command}\n{text}");
        if command != "verify RUN.json" {
            let next = text.lines().find(|line| line.starts_with("next: stickslip "));
            assert!(next.is_some_and(|next| !next.contains("--format")), "{command}\n{text}");
        }
    }
}

#[test]
fn beside_a_file_every_command_says_in_a_line_or_two_what_it_found_unless_it_is_to_be_quiet() {
    let folder = folder("said-beside-a-file");
    for (command, found) in COMMANDS {
        let output = folder.stickslip(&format!("{command} -o out.json"));
        let told = said(&output);
        assert!(output.status.success() && output.stdout.is_empty(), "{command}\n{told}");
        assert!(told.contains(found) && told.lines().count() <= 2, "{command}\n{told}");
        let quiet = folder.stickslip(&format!("{command} -o out.json --quiet"));
        assert_eq!(said(&quiet), "", "{command}");
        // A document on standard output speaks for itself.
        assert_eq!(said(&folder.stickslip(command)), "", "{command}");
    }
}

#[test]
fn the_formats_are_those_of_the_files_wherever_they_go() {
    let folder = folder("formats-anywhere");
    for command in ["stability --r 1", "cycle --alpha 1.2 --r 1", "surface RUN.json --x 20,21"] {
        folder.prints(&format!("{command} -o out.csv -q"));
        assert_eq!(folder.prints(&format!("{command} --format csv")), folder.read("out.csv"));
        folder.prints(&format!("{command} -o out.npz -q"));
        assert_eq!(folder.prints(&format!("{command} --format npz")), folder.read("out.npz"));
        folder.prints(&format!("{command} -o out.any --format csv -q"));
        assert_eq!(folder.read("out.any"), folder.read("out.csv"), "{command}");
    }
}

#[test]
fn a_script_gets_single_fields() {
    let folder = folder("fields");
    let lines = |line: &str| String::from_utf8(folder.prints(line)).unwrap();
    let document = folder.json("RUN.json");
    let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 60";
    let printed =
        lines(&format!("{run} --print parameters.alpha --print regime --print samples.l.3"));
    let expected = format!("1.2\n{}\n{}\n", "transient", document["samples"]["l"][3]);
    assert_eq!(printed, expected);
    assert_eq!(lines(&format!("{run} --print oscillation.period")), "null\n");
    // The document goes to a file all the same, and lines have their end.
    assert_eq!(lines(&format!("{run} -o kept.json -q --print work.steps")).lines().count(), 1);
    assert!(folder.json("kept.json")["history"].is_object());
    assert_eq!(lines(&format!("{run} -o kept.jsonl -q --print end")), "60.0\n");
    let critical = lines("stability --r 1 --print critical.alpha");
    assert!((critical.trim().parse::<f64>().unwrap() - 1.069_036_174_947).abs() < 1e-11);
    // Before the work, with what there is.
    let long = "run --alpha 1.2 --r 1 --until 1e8";
    folder.refuses(&format!("{long} --print perod"), &["--print perod", "oscillation"]);
    folder.refuses(
        &format!("{long} --print oscillation.perod"),
        &["there is no such field", "oscillation.period"],
    );
}

#[test]
fn ranges_are_typed_one_way_and_the_old_ways_are_understood() {
    let folder = folder("ranges");
    let boundary = folder.prints("boundary --r-range 0.5:2:7");
    assert_eq!(boundary, folder.prints("boundary --r-range 0.5,2 --points 7"));
    assert_eq!(boundary, folder.prints("boundary --r-range 0.5:2 --points 7"));
    let surface = folder.prints("surface RUN.json --range 20:30:41");
    assert_eq!(surface, folder.prints("surface RUN.json --range 20,30 --spacing 0.25"));
    let image = folder.prints("surface RUN.json --range 20:30:11 --y-range=-2:2:5");
    assert_eq!(
        image,
        folder.prints("surface RUN.json --range 20,30 --spacing 1 --y-range -2,2 --spacing-y 1")
    );
    folder.refuses("boundary --r-range 0.1:x", &["--r-range", "LO:HI:N"]);
    folder.refuses("boundary --r-range 0.5:2:7 --points 8", &["--r-range 0.5:2:7", "--points"]);
    folder.refuses("boundary --r-range 0.5:2:1", &["--r-range 0.5:2:1", "2 values"]);
    folder.refuses("surface RUN.json --range 20:30:41 --spacing 1", &["--range", "--spacing"]);
    folder.refuses("surface RUN.json --range 30:20", &["--range 30:20", "LO below HI"]);
}

/// Corrections, 13: the tip at 14, the support at 14 + r + α/r, the surface flat but for noise.
#[test]
fn the_papers_start_is_one_option() {
    let folder = Folder::new("papers-start");
    let paper = folder.prints_json("run --alpha 1.3 --r 1 --start paper --until 30");
    let typed = folder.prints_json(
        "run --alpha 1.3 --r 1 --start flat --start-position 16.3 --kick 2.3 --noise 1e-4 \
         --noise-spacing 0.05 --until 30",
    );
    assert_eq!(paper["parameters"], typed["parameters"]);
    assert_eq!(paper["samples"], typed["samples"]);
    let x0 = paper["samples"]["x0"][0].as_f64().unwrap();
    assert!((x0 - 14.0).abs() < 1e-12, "{x0}");
    // A Gaussian's f has a volume: its start is the steady state, as in Fig. 4; other noise may be asked for.
    let gaussian = folder
        .prints_json("run --tip gaussian --alpha 1.3 --r 1 --start paper --noise 1e-5 --until 30");
    assert_eq!(gaussian["parameters"]["start"], "steady");
    assert_eq!(gaussian["parameters"]["noise"]["amplitude"], 1e-5);
    folder.prints("compare --alpha 1.3 --r 1 --start paper --until 20");
}

#[test]
fn help_fits_a_terminal_and_names_what_is_required() {
    let folder = Folder::new("help-fits");
    for (command, required) in [
        ("run", "--alpha-above <D>) --r <R> --until <T>"),
        ("stability", "--r <R>"),
        ("sweep", "--r <RANGE>"),
        ("raster", "--pitch <D> --lines <N> --length <X>"),
        ("continue", "--over alpha --r <R>"),
        ("compare", "--until <T>"),
        ("units", "--damping"),
        ("verify", "<RUN>"),
    ] {
        let help = String::from_utf8(folder.prints(&format!("{command} --help"))).unwrap();
        let longest = help.lines().map(|line| line.chars().count()).max().unwrap();
        assert!(longest <= 120, "{command}: {longest}\n{help}");
        let usage = help.split("Usage:").nth(1).unwrap().split("\n\n").next().unwrap();
        assert!(usage.contains(required), "{command}: {usage}");
    }
}

/// On a terminal there is text. `script` of util-linux makes one; where there is none, so it is in other tests.
#[cfg(target_os = "linux")]
#[test]
fn a_terminal_is_told_in_words() {
    let folder = Folder::new("people_terminal");
    let has_script = Command::new("script").arg("--version").stdout(Stdio::null()).status();
    if !has_script.is_ok_and(|status| status.success()) {
        return;
    }
    let program = folder.command("").get_program().to_string_lossy().into_owned();
    let on_terminal = |line: &str| {
        let mut command = Command::new("script");
        command.args(["-qec", &format!("{program} {line}"), "/dev/null"]);
        let output = command.stdin(Stdio::null()).output().unwrap();
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(on_terminal("stability --r 1").contains("critical α"));
    assert!(on_terminal("stability --r 1 --format json").contains("{\"format\":"));
    let piped = folder.prints_json("stability --r 1");
    assert_eq!(piped["format"], "stickslip/stability");
}
