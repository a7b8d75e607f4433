//! What comes from a file or from its name moves no cursor, renames no window and turns no text round, wherever it is printed.

use crate::folder::Folder;

/// ESC, BEL, CSI of one character, DEL, the right-to-left override.
const HOSTILE: &str = "a\u{1b}[31m\u{7}\u{9b}2J\u{7f}\u{202e}b";

fn is_harmless(bytes: &[u8]) -> bool {
    let text = String::from_utf8(bytes.to_vec()).unwrap();
    text.chars().all(|c| c == '\n' || !c.is_control() && c != '\u{202e}')
}

#[test]
fn text_of_foreign_origin_is_escaped() {
    let folder = Folder::new("terminal");
    let rows = |heading: &str| {
        let row = |i: i32| {
            let x = 5.0 * f64::from(i) - 150.0;
            format!(
                "{x},{}\n",
                -12.0 * (-0.5 * (x / 30.0_f64).powi(2)).exp() + 0.01 * f64::from((i * 7) % 5)
            )
        };
        heading.to_owned() + &(0..61).map(row).collect::<String>()
    };
    let profile = format!("{HOSTILE}.csv");
    folder.write(&profile, rows(&format!("x{HOSTILE}_nm,z\n")));
    let unit = format!("{HOSTILE}_unit.csv");
    folder.write(&unit, rows(&format!("x ({HOSTILE}),z\n")));
    let damaged = format!("{HOSTILE}_damaged.csv");
    folder.write(&damaged, rows("x_nm,z\n") + HOSTILE);
    folder.prints(&format!("tip {profile} --resamples 2 -o tip.json"));
    // A document of our kind that somebody else has written.
    let document = String::from_utf8(folder.read("tip.json")).unwrap();
    assert!(document.contains("\\u001b"), "{document}");
    let mut foreign: serde_json::Value = serde_json::from_str(&document).unwrap();
    foreign["remarks"] = serde_json::json!([HOSTILE]);
    folder.write("foreign.json", foreign.to_string());
    for line in [
        format!("tip {profile} --resamples 2 --format text"),
        format!("tip {profile} --resamples 2 --print parameters.source --print parameters"),
        format!("tip {profile} --resamples 2 --format csv"),
        format!("tip {profile} --resamples 2 --format json"),
        format!("tip {profile} --resamples 2 -o {HOSTILE}.json"),
        format!("tip {unit}"),
        format!("tip {damaged}"),
        format!("tip absent{HOSTILE}.csv"),
        format!("stability --r {HOSTILE}"),
        format!("stability --r 1 --tip-file {profile}"),
        format!("fit --ripple {profile} --friction {profile}"),
        "stability --r 1 --tip-file foreign.json --format text".into(),
        "plot foreign.json -o tip.svg".into(),
    ] {
        let output = folder.stickslip(&line);
        assert!(
            is_harmless(&output.stdout),
            "{line:?}: {}",
            String::from_utf8_lossy(&output.stdout).escape_debug()
        );
        assert!(
            is_harmless(&output.stderr),
            "{line:?}: {}",
            String::from_utf8_lossy(&output.stderr).escape_debug()
        );
    }
}
