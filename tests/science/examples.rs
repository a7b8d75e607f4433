//! The examples of the libraries, as they stand in `examples`: each runs, and what it asserts holds.

use std::path::Path;
use std::process::Command;

/// `cargo test` builds examples before it runs tests, beside the folder of this one.
#[test]
fn every_example_runs_and_holds_what_it_says() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/examples");
    let here = std::env::current_exe().unwrap();
    let built = here.ancestors().nth(2).unwrap().join("examples");
    let mut ran = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|extension| extension != "rs") {
            continue;
        }
        let name = path.file_stem().map(Path::new).unwrap();
        let program = built.join(name).with_extension(std::env::consts::EXE_EXTENSION);
        assert!(program.exists(), "cargo build --examples: {} is not there", program.display());
        let output = Command::new(program).output().unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{}: {said}", name.display());
        assert!(!output.stdout.is_empty(), "{} prints nothing", name.display());
        ran += 1;
    }
    assert!(ran >= 10, "{ran}");
}
