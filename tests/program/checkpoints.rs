//! Which checkpoints are gone on with? Those that are whole, of this version of the program, and beside the output
//! that they were made with; all others are refused.

use crate::folder::{Folder, said};

#[test]
fn checkpoints_that_cannot_be_gone_on_with_are_refused() {
    let folder = Folder::new("refused_checkpoints");
    let run = "run --alpha 1.2 --r 1 --kick 0.05 --until 300";
    folder.prints(&format!("{run} -o run.jsonl --checkpoint run.ck"));
    let whole = folder.read("run.ck");
    // Any byte, anywhere.
    for i in (0..whole.len()).step_by(whole.len() / 40) {
        let mut damaged = whole.clone();
        damaged[i] ^= 4;
        folder.write("damaged.ck", damaged);
        folder.refuses("run --resume damaged.ck", &["--resume damaged.ck", "is damaged"]);
    }
    for length in [0, 3, 100, whole.len() / 2, whole.len() - 1] {
        folder.write("short.ck", &whole[..length]);
        folder.refuses("run --resume short.ck", &["--resume short.ck", "is"]);
    }
    let resealed = |from: &str, to: &str| {
        let end = whole.iter().position(|b| *b == b'\n').unwrap();
        let head = String::from_utf8(whole[..end].to_vec()).unwrap();
        assert!(head.contains(from), "{head}");
        let mut bytes = head.replace(from, to).into_bytes();
        bytes.extend(&whole[end..whole.len() - 4]);
        let sum = crc32fast::hash(&bytes);
        bytes.extend(sum.to_le_bytes());
        folder.write("other.ck", bytes);
    };
    for (from, to, words) in [
        ("\"version\":\"0", "\"version\":\"7", "only that version reproduces"),
        ("\"format_version\":1", "\"format_version\":2", "only that version reproduces"),
        ("\"words\":", "\"words\":1", "its length does not match"),
        ("\"alpha\":1.2", "\"alpha\":-1", "0 or above, not -1"),
        ("\"memory\":\"auto\"", "\"memory\":\"modes\"", "cannot be used"),
        ("\"until\":300", "\"until\":30", "out of range"),
        ("\"format\":\"stickslip/checkpoint\"", "\"format\":\"stickslip/run\"", "stickslip/run"),
        ("\"kick\":", "\"kicks\":", "is damaged"),
        ("\"every\":", "\"every\":-", "not above 0"),
        ("\"checkpoint_every\":", "\"checkpoint_every\":-", "not above 0"),
    ] {
        resealed(from, to);
        folder.refuses("run --resume other.ck", &["--resume other.ck", words]);
    }
    // The output is not what it was.
    folder.write("run.jsonl", "something else");
    let output = folder.stickslip("run --resume run.ck --quiet");
    assert_eq!(output.status.code(), Some(1));
    assert!(said(&output).contains("run.jsonl"), "{}", said(&output));
    assert_eq!(folder.read("run.jsonl"), b"something else");

    for (line, words) in [
        ("run --resume none.ck", &["--resume none.ck", "cannot be read"][..]),
        ("run --resume run.ck --alpha 1", &["--resume"]),
        (&format!("{run} --checkpoint-every 1"), &["--checkpoint <FILE>"]),
        (
            &format!("{run} --checkpoint a.ck --checkpoint-every 0"),
            &["--checkpoint-every 0", "above 0"],
        ),
        (&format!("{run} --checkpoint no/a.ck"), &["--checkpoint", "a place that exists"]),
        (&format!("{run} --checkpoint /dev/null"), &["--checkpoint /dev/null", "must be a file"]),
        (
            &format!("{run} --checkpoint run.json -o run.json"),
            &["--checkpoint", "a name of its own"],
        ),
        (
            &format!("{run} --checkpoint a.ck --format jsonl"),
            &["--output -", "write them to a file"],
        ),
        (&format!("{run} --plot a.svg -o run.jsonl"), &["--plot a.svg", ".json, .csv or .npz"]),
    ] {
        folder.refuses(line, words);
    }
}
