//! What `run` says of the motion that it ends in: errors, prospects and remarks, in its document and to a person.

use crate::folder::{Folder, said};

#[test]
fn an_oscillation_is_printed_to_the_digits_that_hold() {
    let folder = Folder::new("digits");
    let line = "run --alpha 1.2 --r 1 --kick 0.1 --until 400 --tolerance 1e-6 -o run.json";
    let message = said(&folder.stickslip(line));
    let run = folder.json("run.json");
    let found = &run["oscillation"];
    let error = found["period_error"].as_f64().unwrap();
    assert!((found["period"].as_f64().unwrap() - 7.067_359_690_053_94).abs() <= error);
    assert!((1e-12..1e-4).contains(&error), "{error}");
    for name in ["wavelength_error", "amplitude_x0_error", "amplitude_u_error"] {
        assert!((1e-13..1e-3).contains(&found[name].as_f64().unwrap()), "{name}: {found}");
    }
    // As in 7.06736(2): no more decimals than the error has zeros.
    let printed = message.split("period ").nth(1).unwrap().split(',').next().unwrap();
    let (value, last) = printed.trim_end_matches(')').split_once('(').unwrap();
    let decimals = value.split_once('.').unwrap().1.len();
    let unit = 0.1_f64.powi(i32::try_from(decimals).unwrap());
    assert!(unit * last.parse::<f64>().unwrap() >= error && unit <= 10.0 * error, "{message}");
    assert!(run["transient"].is_null() && run["creep"].is_null());
}

#[test]
fn a_transient_says_where_to_and_for_how_long() {
    let folder = Folder::new("transient");
    let line = "run --alpha-above 1e-4 --r 1 --kick 0.001 --until 300 -o run.json";
    let message = said(&folder.stickslip(line));
    let run = folder.json("run.json");
    assert_eq!(run["regime"], "transient");
    assert_eq!(run["transient"]["towards"], "stick-slip");
    assert!(run["transient"]["time"].as_f64().unwrap() > 1e4);
    assert!(message.contains("transient, towards stick-slip in about"), "{message}");
}

/// The README's own run starts on unstable steady motion without a kick.
#[test]
fn what_round_off_decides_is_remarked() {
    let folder = Folder::new("remarks");
    let message = said(&folder.stickslip("run --alpha 4 --r 1 --until 100000 -o run.json"));
    let run = folder.json("run.json");
    assert_eq!(run["regime"], "trapped");
    assert!(run["creep"]["attracting"].as_f64().unwrap() > 1.0);
    let remarks = run["remarks"].as_array().unwrap();
    assert!(remarks.iter().any(|remark| remark.as_str().unwrap().contains("round-off")));
    assert!(message.contains("round-off"), "{message}");
    assert!(
        folder.prints_json("run --alpha 4 --r 1 --kick 0.01 --until 100")["remarks"]
            .as_array()
            .unwrap()
            .is_empty()
    );
}

/// A walk is drifting, with its velocity: v² = (2B - 1 - √(1 + 4B))/2 on J0.
#[test]
fn a_walk_is_drifting_and_printed_with_its_velocity() {
    let folder = Folder::new("walk");
    let line = "run --tip bessel --no-spring --alpha -3 --healing-time 1 --pulse 1,2,0.5 --until 60 -o walk.json";
    let message = said(&folder.stickslip(line));
    assert!(message.contains("drifting, velocity 0.834999"), "{message}");
    let walk = folder.json("walk.json");
    let exact = ((5.0 - 13.0_f64.sqrt()) / 2.0).sqrt();
    let found = walk["drifting"]["velocity"].as_f64().unwrap();
    assert!((found - exact).abs() <= walk["drifting"]["velocity_error"].as_f64().unwrap());
}

/// Whatever heals, swings or is compared: no line of what a person reads is filled with digits.
#[test]
fn no_number_in_words_has_hundreds_of_digits() {
    let folder = Folder::new("digits_in_words");
    for line in [
        "cycle --tip gaussian --r 0.428268 --alpha 0.803822 --healing-time 26.8123 --format text",
        "run --tip gaussian --r 0.428268 --alpha 0.803822 --kick 0.1 --healing-time 26.8123 --until 300 --format text",
        "compare --alpha 1.2 --r 1 --kick 0.05 --until 20 --format text",
    ] {
        let output = folder.stickslip(line);
        let text = String::from_utf8(output.stdout.clone()).unwrap() + &said(&output);
        let longest = text.split(|c: char| !(c.is_ascii_digit() || c == '.')).map(str::len).max();
        assert!(longest.unwrap() <= 18, "{line}: {text}");
        assert!(!line.starts_with("compare") || text.contains("per unit of time"), "{text}");
    }
}

#[test]
fn a_field_is_printed_by_the_end_of_its_path() {
    let folder = Folder::new("outcome_fields");
    let run = "run --alpha 1.2 --r 1 --kick 0.1 --until 200 --print";
    let print = |field: &str| folder.stickslip(&format!("{run} {field}"));
    assert_eq!(print("period").stdout, print("oscillation.period").stdout);
    assert!(!print("period").stdout.is_empty());
    assert!(said(&print("perod")).contains("did you mean oscillation.period"));
    let ensemble = "sweep --alpha 1 --r 1 --noise 1e-3 --seed 1:4:4 --until 60 --format text";
    let text = String::from_utf8(folder.stickslip(ensemble).stdout).unwrap();
    assert!(
        text.contains("mean of l") && text.contains("mean of 4: ") && text.contains("spread"),
        "{text}"
    );
}
