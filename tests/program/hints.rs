//! Commands that the program prints, each run as printed: the next step of a result, the remedy of a refusal, the examples of help.

use crate::folder::Folder;
use assert_cmd::cargo::cargo_bin;
use serde_json::Value;
use std::process::{Command, Output};
use stickslip_cli::hosted;

/// Processor time, in seconds, after which an example is at its work: bad input is found out before.
const AT_WORK: u32 = 1;

/// The output of a shell for a command line, which the system ends after a limit of processor time.
fn shell(folder: &Folder, line: &str, seconds: Option<u32>) -> Output {
    let limit = seconds.map_or(String::new(), |seconds| format!("ulimit -t {seconds}; "));
    let program = cargo_bin("stickslip");
    let script = format!("{limit}stickslip() {{ '{}' \"$@\"; }}\n{line}", program.display());
    Command::new("sh").current_dir(folder.path("")).args(["-c", &script]).output().unwrap()
}

fn assert_runs(folder: &Folder, line: &str, of: &str) {
    let output = shell(folder, line, None);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{of}\nprinted: {line}\n{said}");
    // What it names is written.
    let words: Vec<&str> = line.split(' ').collect();
    for pair in words.windows(2).filter(|pair| ["-o", "--plot"].contains(&pair[0])) {
        assert!(folder.path(pair[1]).exists(), "{of}\nprinted: {line}: no {}", pair[1]);
    }
}

/// Half a profile with its σ, a whole one in nm, and a noisy one.
fn write_tips(folder: &Folder) {
    let row = |(i, noise): (i32, f64)| {
        let x = f64::from(i) / 10.0;
        let wobble = noise * f64::from((i * 7919) % 101 - 50) / 50.0 * (-x * x / 4.0).exp();
        format!("{x},{}\n", (-x * x / 2.0).exp() + wobble)
    };
    let half = |noise: f64| (0..60).map(|i| row((i, noise))).collect::<String>();
    folder.write("my tip.csv", half(0.0));
    folder.write("tip.csv", half(0.0));
    folder.write("noisy tip's.csv", half(0.05));
    let deep =
        |i: i32| format!("{},{}\n", i * 2, -30.0 * (-f64::from((i - 25) * (i - 25)) / 98.0).exp());
    let whole = (0..50).map(deep).collect::<String>();
    folder.write("pit.csv", format!("x_nm,z_nm\n{whole}"));
    folder.write("pit.txt", whole);
}

/// A command of each kind, with inputs that its hint must repeat.
const RESULTS: [&str; 22] = [
    "run --tip-file 'my tip.csv' --alpha 1.2 --r 1 --kick 0.05 --until 40",
    "run --alpha 1.2 --r=1 --kick=0.05 --until=320ms --sigma 20nm --stiffness 0.2N/m --damping 1.6mNs/m",
    "run --alpha 0.5 --r 1 --until 40 --plot=before.svg",
    "run --parameters RUN.json --until 45",
    "run --walker --alpha=-3 --rotation 0.3 --until 5",
    "run --alpha 1.2 --r 1 --stiffness-across 0.5 --kick-across 0.1 --until 18 --tolerance 1e-4",
    "stability --r 1",
    "stability --alpha 1.2 --r 1",
    "stability --tip gaussian --r 1 --pitch 1",
    "stability --tip gaussian --r 1 --pitch 1 --alpha-above 0.1",
    "stability --tip gaussian --r 1 --pitch 1 --stiffness-across 0.8 --alpha 0.4",
    "stability --no-spring --tip bessel --alpha=-3 --healing-time 1",
    "boundary --r-range 0.5:2:5 --beta 0.5",
    "boundary --tip gaussian --pitch-range 1:2:2 --r 1",
    "boundary --stiffness-range 0.2:0.6:2 --r 1",
    "response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 40",
    "cycle --tip-file 'my tip.csv' --alpha 2.2 --r 1",
    "continue --r 1 --over alpha --to 1.1",
    "sweep --r 1 --alpha 0.9:1.2:3",
    "surface RUN.json --range 20:40:50",
    "compare --tip gaussian --alpha 1.2 --r 1 --start-position 2 --until 6 --tolerance 1e-4",
    "raster --tip gaussian --alpha 0.4 --r 1 --pitch 1 --lines 3 --length 6 --tolerance 1e-4",
];

#[test]
fn the_next_step_of_each_result_runs_as_printed() {
    let folder = Folder::new("hints_next");
    write_tips(&folder);
    folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 40 -o RUN.json");
    let measured =
        ["tip pit.csv --resamples 20", "tip pit.txt --unit nm --both-sides --resamples 20"];
    let units = "units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm --slope-force 5nN --indentation-rate 200nm/s --velocity 1um/s";
    for line in RESULTS.into_iter().chain(measured).chain([units]) {
        let output = shell(&folder, &format!("stickslip {line} --format text"), None);
        let text = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success(), "{line}\n{}", String::from_utf8_lossy(&output.stderr));
        let next: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("next: ")).collect();
        assert!(!next.is_empty(), "{line}\n{text}");
        for next in next {
            assert_runs(&folder, next, line);
            let same = next.split_once(" -o ").filter(|(_, behind)| behind.contains(".json"));
            if let Some((_, behind)) =
                same.filter(|_| next.split(' ').nth(1) == line.split(' ').next())
            {
                // The document of the same question.
                let written = folder.json(behind.split(' ').next().unwrap());
                let output = shell(&folder, &format!("stickslip {line} --format json"), None);
                let wanted: Value = serde_json::from_slice(&output.stdout).unwrap();
                assert_eq!(written["parameters"], wanted["parameters"], "{line}\n{next}");
            }
        }
    }
}

/// A range in which nothing is unstable has no picture, and no first and last threshold.
#[test]
fn a_result_without_thresholds_says_so_and_has_no_next_step() {
    let folder = Folder::new("hints_nothing");
    for line in [
        "boundary --r-range 0.05:0.2:3 --healing-time 2",
        "boundary --tip gaussian --pitch-range 0.5:1:2 --r 0.5 --healing-time 1 --length 40",
        "boundary --tip gaussian --stiffness-range 0.1:0.5:2 --r 0.3",
        "boundary --tip gaussian --stiffness-across 0.2 --r-range 0.3:1:2",
    ] {
        let text = String::from_utf8(folder.prints(&format!("{line} --format text"))).unwrap();
        assert!(text.contains("left out"), "{line}\n{text}");
        assert!(!text.contains("0 to 0") && !text.contains("next: "), "{line}\n{text}");
    }
}

/// The command in backticks, or behind words, of a message.
#[test]
fn the_remedies_of_refusals_run_as_printed() {
    let folder = Folder::new("hints_remedies");
    write_tips(&folder);
    folder.prints("run --alpha 1.2 --r 1 --kick 0.05 --until 40 -o RUN.json");
    let noisy = "stickslip stability --tip-file \"noisy tip's.csv\" --r 1";
    let said = String::from_utf8(shell(&folder, noisy, None).stderr).unwrap();
    let remedy = said.split('`').nth(1).unwrap_or_else(|| panic!("{said}"));
    assert_runs(&folder, remedy, noisy);
    assert_runs(&folder, "stickslip stability --tip-file tip.json --r 1", noisy);
    // A run that is interrupted names the command that goes on with it.
    let animation = "stickslip run --alpha 1.2 --r 1 --until 40 --plot run.gif";
    let said = String::from_utf8(shell(&folder, animation, None).stderr).unwrap();
    let remedy = said.split(" use ").nth(1).unwrap_or_else(|| panic!("{said}")).trim();
    assert!(
        shell(&folder, "stickslip run --alpha 1.2 --r 1 --until 40 -o RUN.json", None)
            .status
            .success()
    );
    let output = shell(&folder, remedy, Some(AT_WORK));
    assert_ne!(output.status.code(), Some(2), "{remedy}");
}

/// The examples of a command's help, each on one line.
fn examples(help: &str) -> Vec<String> {
    let joined = help.replace("\\\n", " ");
    let behind = joined.rsplit_once("\nExample").map_or("", |(_, behind)| behind);
    let commands = behind.lines().map(str::trim).filter(|line| line.starts_with("stickslip "));
    commands.map(str::to_owned).collect()
}

#[test]
fn the_examples_of_help_run_as_printed() {
    let folder = Folder::new("hints_examples");
    write_tips(&folder);
    // The files that examples read, small ones in place of those that other examples write.
    let profile = |i: i32| format!("{},{}\n", f64::from(i) * 0.8, 3.0 * (f64::from(i) / 5.0).sin());
    folder
        .write("ripples.csv", format!("x_nm,z_nm\n{}", (0..300).map(profile).collect::<String>()));
    folder.write("path.csv", "t,R\n0,0\n10,10\n12,10\n40,38\n");
    for line in [
        "run --alpha-above 0.01 --r 1 --kick 0.01 --until 457 -o run.json",
        "run --alpha 1.2 --r 1 --until 1e3 --sample-every 10 -o long.jsonl --checkpoint long.checkpoint",
        "cycle --alpha 1.3 --r 1 -o cycle.json",
        "boundary --r-range 0.5:2:9 -o boundary.json",
        "tip pit.csv -o tip.json --resamples 20",
        "units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm --slope-force 5nN --indentation-rate 200nm/s --velocity 1um/s -o units.json",
        "raster --tip gaussian --alpha 0.45 --r 1 --pitch 0.5 --lines 4 --length 20 --tolerance 1e-4 -o raster.json",
    ] {
        folder.prints(line);
    }
    folder.prints("tip pit.csv --both-sides --resamples 20 -o sides.json");
    let kept: Vec<_> = folder.names().into_iter().map(|name| (folder.read(&name), name)).collect();
    let mut tried = 0;
    let commands = hosted::commands().into_iter().map(|(name, _)| name);
    for command in commands.chain(["sweep raster".into(), "sweep merge".into(), String::new()]) {
        let help = String::from_utf8(folder.prints(&format!("{command} --help"))).unwrap();
        for example in examples(&help) {
            // Each reads what is there, not what one before it has cut off.
            for name in folder.names() {
                std::fs::remove_file(folder.path(&name)).ok();
            }
            kept.iter().for_each(|(bytes, name)| folder.write(name, bytes));
            let output = shell(&folder, &example, Some(AT_WORK));
            let said = String::from_utf8_lossy(&output.stderr).into_owned();
            let misses =
                ["No such file", "cannot be opened"].iter().any(|words| said.contains(words));
            assert!(
                output.status.code() != Some(2) || misses,
                "{command} --help\n{example}\n{said}"
            );
            tried += usize::from(!misses);
        }
    }
    assert!(tried > 80, "{tried}");
}
