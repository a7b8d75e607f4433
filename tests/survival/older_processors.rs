//! Documents have the same bits on every x86-64: compared with those that an emulated processor of 2008 writes, which
//! has neither wide vectors nor fused operations. Only what comes of an FFT may differ, for which rustfft
//! uses them: surfaces, rasters, the memory `fft`. Needs qemu-x86_64 (Debian: qemu-user), and says so where there is none.

use crate::folder::{Folder, said};
use serde_json::Value;
use std::process::Command;

const OLDER: [&str; 3] = ["qemu-x86_64", "-cpu", "Nehalem"];

const LINES: [&str; 11] = [
    "run --alpha 1.2 --r 1 --until 200 --tolerance 1e-9",
    "run --alpha 1.9 --r 1 --until 300",
    "run --alpha 1.2 --r 1 --until 100 --memory direct",
    "run --alpha 20 --r 1 --until 60 --depth-limit 10 --tolerance 1e-8",
    "run --alpha 2 --r 1 --until 60 --healing-time 10",
    "run --alpha 2 --r 1 --until 60 --inertia 0.2 --kick 0.3",
    "run --alpha 3 --r 0.5 --until 60 --beta 0 --pulse 0.5,10,1",
    "stability --alpha 1.2 --r 1",
    "cycle --alpha 1.4 --r 1",
    "cycle --alpha 1.9 --r 1",
    "continue --over alpha --r 1 --most-points 8",
];

/// Times that a machine took, and numbers of a surface, which is summed by FFT.
const MAY_DIFFER: [&str; 3] = ["seconds", "amplitude_u", "amplitude_u_error"];

fn comparable(document: Value) -> Value {
    match document {
        Value::Object(fields) => fields
            .into_iter()
            .filter(|(name, _)| !MAY_DIFFER.contains(&&**name))
            .map(|(name, value)| (name, comparable(value)))
            .collect(),
        Value::Array(items) => items.into_iter().map(comparable).collect(),
        number => number,
    }
}

#[test]
#[ignore = "needs qemu-x86_64, and takes minutes; see `make survive`"]
fn an_older_processor_writes_the_same_bits() {
    if Command::new(OLDER[0]).arg("--version").output().is_err() {
        println!("skipped: no {} here", OLDER[0]);
        return;
    }
    let folder = Folder::new("older_processors");
    for line in LINES {
        let here = folder.prints_json(&format!("-q {line}"));
        let program = folder.command(&format!("-q {line}"));
        let mut older = Command::new(OLDER[0]);
        older.args(&OLDER[1..]).arg(program.get_program()).args(program.get_args());
        let output = older.output().unwrap();
        assert!(output.status.success(), "{line}\n{}", said(&output));
        let there: Value = serde_json::from_slice(&output.stdout).unwrap();
        println!("{line}: {} bytes", output.stdout.len());
        assert!(comparable(here) == comparable(there), "{line}: the bits differ");
    }
}
