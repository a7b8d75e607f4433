//! Do the commands of docs/experiment.md print what the page says?
//!
//! Judge: the page. Each line after `$ ` is run by a shell in one folder; numbers are compared to nine
//! digits, as the last ones depend on the machine, and all else exactly.

use crate::folder::Folder;
use assert_cmd::cargo::cargo_bin;
use std::process::Command;

/// Commands of the page with the lines that follow them.
fn commands(page: &str) -> Vec<(String, Vec<String>)> {
    let mut found: Vec<(String, Vec<String>)> = vec![];
    for block in page.split("```console\n").skip(1) {
        for line in block.split("```").next().unwrap().lines() {
            match line.strip_prefix("$ ") {
                Some(command) => found.push((command.into(), vec![])),
                None => found.last_mut().unwrap().1.push(line.into()),
            }
        }
    }
    found
}

/// Numbers apart from what stands between them.
fn parts(line: &str) -> (Vec<f64>, String) {
    let is_number = |c: char| c.is_ascii_digit() || ".-+e".contains(c);
    let (mut numbers, mut rest) = (vec![], String::new());
    for token in line.split_inclusive(|c: char| !is_number(c)) {
        let text = token.trim_end_matches(|c: char| !is_number(c));
        match text.parse::<f64>() {
            Ok(number) => {
                numbers.push(number);
                rest.push_str(&token[text.len()..]);
            }
            Err(_) => rest.push_str(token),
        }
    }
    (numbers, rest)
}

#[test]
fn the_page_prints_what_it_says() {
    let folder = Folder::new("experiment");
    let bin = cargo_bin!("stickslip").parent().unwrap().to_path_buf();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let page = include_str!("../../docs/experiment.md");
    let all = commands(page);
    assert!(all.len() >= 10, "{}", all.len());
    for (command, expected) in all {
        let mut shell = Command::new("sh");
        shell.args(["-c", &command]).current_dir(folder.path("")).env("PATH", &path);
        let output = shell.output().unwrap();
        assert!(output.status.success(), "{command}\n{}", crate::folder::said(&output));
        let printed = String::from_utf8_lossy(&output.stdout).into_owned();
        let printed: Vec<&str> = printed.lines().collect();
        assert_eq!(printed.len(), expected.len(), "{command}\n{}", printed.join("\n"));
        for (found, expected) in printed.into_iter().zip(&expected) {
            let ((found_numbers, found_rest), (numbers, rest)) = (parts(found), parts(expected));
            assert_eq!(found_rest, rest, "{command}");
            for (found, expected) in found_numbers.iter().zip(&numbers) {
                assert!((found - expected).abs() <= 1e-9 * expected.abs(), "{found} {expected}");
            }
        }
    }
}
