//! Numbers at the edges of floating point, in every option that takes one: each is taken or refused, with
//! a message that a person can read and the option that is at fault. No oracle: the contract of the
//! command line alone.

use crate::folder::{Folder, said};
use serde_json::Value;
use std::time::Duration;

const EXTREMES: [&str; 8] = ["1e300", "-1e300", "1e-300", "-1e-300", "1e17", "NaN", "inf", "0"];

/// Command lines with a gap for the extreme. What they say otherwise is admissible.
const LINES: [&str; 22] = [
    "run --r 1 --until 18 --alpha _",
    "run --alpha 1 --until 18 --r _",
    "run --r 1 --until 18 --alpha-above _",
    "run --alpha 1 --r 1 --until _",
    "run --alpha 1 --r 1 --until 18 --beta _",
    "run --alpha 1 --r 1 --until 18 --tolerance _",
    "run --alpha 1 --r 1 --until 18 --noise 1e-3 --noise-spacing _",
    "stability --r 1 --alpha _",
    "stability --alpha 1 --r _",
    "stability --r _",
    "stability --r 1 --alpha 1 --beta _",
    "stability --r 1 --alpha 1 --width _",
    "stability --solve-for r --alpha _",
    "stability --r 1 --alpha 1 --re-above _",
    "boundary --r-range _,1e300",
    "response --r 1 --until 18 --pulse 1,17,1 --alpha _",
    "response --alpha 1 --until 18 --pulse 1,17,1 --r _",
    "compare --alpha 1 --r 1 --until 18 --spacing _",
    "compare --alpha 1 --r 1 --until 18 --step _",
    "compare --alpha 1 --r 1 --until 18 --width _",
    "units --damping 1kg/s --stiffness 1N/m --tip-width 1m --slope-force 1N --indentation-rate 1m/s --velocity _m/s",
    "units --stiffness 1N/m --tip-width 1m --slope-force 1N --indentation-rate 1m/s --velocity 1m/s --damping _kg/s",
];

/// Digits in a row in the message.
fn longest_number(message: &str) -> usize {
    let runs = message.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    runs.map(str::len).max().unwrap_or(0)
}

#[test]
fn extreme_numbers_are_taken_or_refused_in_few_digits() {
    let folder = Folder::new("extremes");
    for line in LINES {
        for extreme in EXTREMES {
            let line = line.replace('_', extreme);
            let output = folder.stickslip(&line);
            let said = said(&output);
            let status = output.status.code();
            assert!(matches!(status, Some(0..=2)), "{line}: {status:?}\n{said}");
            assert!(longest_number(&said) <= 22, "{line}\n{said}");
            assert!(status == Some(0) || output.stdout.is_empty(), "{line}");
        }
    }
}

#[test]
fn the_option_at_fault_is_named() {
    let folder = Folder::new("extremes-named");
    for (line, option) in [
        ("run --alpha 1 --r 1 --until 30 --beta -1e80", "--beta -1e80"),
        ("run --alpha 1 --r 1 --until 30 --beta -1e300", "--beta -1e300"),
        ("run --alpha 1 --r 1 --until 30 --width 1e308", "--width 1e308"),
        ("run --alpha 1 --r 1e-300 --until 30", "--r 1e-300"),
        ("run --alpha 1e300 --r 1 --until 30", "--alpha 1e300"),
        ("response --alpha 1e300 --r 1 --pulse 1,1,1 --until 30", "--alpha 1e300"),
        ("stability --alpha 1e-300 --r 1", "--alpha 1e-300"),
        ("stability --alpha 1 --r 1e300", "--r 1e300"),
        ("stability --alpha 1e300 --r 1 --re-above -1", "--alpha 1e300"),
        (
            "units --damping 1e300kg/s --stiffness 1N/m --tip-width 1m --slope-force 1N --indentation-rate 1m/s --velocity 1m/s",
            "--damping, --stiffness, ",
        ),
    ] {
        folder.refuses(line, &[option]);
    }
}

/// Finite, but no tip was ever like that. Whatever comes of it, it comes soon and it is honest.
#[test]
fn absurd_numbers_end_in_a_whole_document_or_a_refusal() {
    let folder = Folder::new("absurd");
    folder.write("huge.csv", "0,1e300\n10,-1e300\n20,1e300\n40,0\n");
    folder.write("close.csv", "0,0\n5e-324,1\n1e-323,0\n20,1\n20.000000000000004,-1\n40,0\n");
    let cases = [
        "--alpha 1e300 --r 1 --until 60",
        "--alpha 1e300 --r 1 --until 1e301",
        "--alpha 1e300 --r 1 --until 60 --start flat",
        "--alpha 1e308 --r 1e-3 --until 1e5 --start flat",
        "--alpha 1e10 --r 1 --until 60 --start flat --plot run.svg",
        "--alpha 1 --r 1e300 --until 2",
        "--alpha 1 --r 1e300 --until 2 --start flat",
        "--alpha 1 --r 1e-300 --until 2",
        "--alpha 1 --r 1e-300 --until 2 --start flat --start-position 0",
        "--alpha 1 --r 1e-12 --until 2 --start flat --start-position 0 --plot run.svg",
        "--alpha-above 0.01 --r 1e300 --until 2",
        "--alpha-above 1e300 --r 1 --until 60",
        "--alpha 1 --r 1 --until 1e300",
        "--alpha 4 --r 1 --until 1e300",
        "--alpha 1 --r 1 --until 60 --kick 1e300",
        "--alpha 1 --r 1 --until 60 --kick -1e300",
        "--alpha 1 --r 1 --until 60 --start-position 1e300",
        "--alpha 1 --r 1 --until 60 --start-position -1e300",
        "--alpha 1 --r 1 --until 60 --pulse 1e300,20,1",
        "--alpha 1 --r 1 --until 60 --pulse 1e300,20,1e300",
        "--alpha 1 --r 1 --until 60 --pulse 1,1e300,1",
        "--alpha 1 --r 1 --until 60 --pulse 1,20,1e-300",
        "--alpha 1 --r 1 --until 60 --noise 1e300",
        "--alpha 1 --r 1 --until 60 --noise 1 --noise-spacing 1e300",
        "--alpha 1 --r 1 --until 60 --width 1e300",
        "--alpha 1 --r 1 --until 60 --width 5e-324",
        "--alpha 1 --r 1 --until 60 --beta -1e300",
        "--alpha 1 --r 1 --until 60 --sample-every 1e300",
        "--alpha 1 --r 1 --until 60 --initial-surface huge.csv",
        "--alpha 1 --r 1 --until 60 --force-file huge.csv",
        "--alpha 1 --r 1 --until 60 --initial-surface close.csv",
        "--alpha 1 --r 1 --until 60 --force-file close.csv",
    ];
    for options in cases {
        let (output, took) = folder.stickslip_timed(&format!("run {options}"));
        let said = said(&output);
        assert!(took < Duration::from_secs(2), "{options}\ntook {took:?}");
        if output.status.success() {
            let document: Value = serde_json::from_slice(&output.stdout).unwrap();
            let numbers = |name: &str| document["samples"][name].as_array().unwrap().clone();
            let columns = ["t", "l", "x0", "velocity"].map(numbers);
            assert!(columns.iter().flatten().all(Value::is_f64), "{options}");
        } else {
            assert!(matches!(output.status.code(), Some(1 | 2)), "{options}\n{said}");
            assert!(
                output.stdout.is_empty() && said.starts_with("stickslip: "),
                "{options}\n{said}"
            );
        }
    }
}

/// Motions that overflow end with an error: no document contains a missing number in place of NaN.
#[test]
fn no_motion_contains_numbers_that_overflowed() {
    let folder = Folder::new("extremes-overflow");
    for line in [
        "--r 1.359e-3 --alpha 1.319e-5 --inertia 1.527e-5 --noise 3.873e29 --tip gaussian --until 60",
        "--r 1.266e-4 --alpha 2.037e-4 --inertia 1.055e27 --noise 5.035e88 --healing-time 33.62 \
         --depth-limit 314.4 --until 25",
    ] {
        let line =
            format!("run {line} --start flat --start-position 0 --memory modes --tolerance 1e-6");
        let output = folder.stickslip(&format!("{line} -o run.json"));
        assert_eq!(output.status.code(), Some(1), "{line}: {}", said(&output));
        assert!(said(&output).contains("tolerance"), "{line}: {}", said(&output));
        assert!(!folder.path("run.json").exists(), "{line}");
    }
}
