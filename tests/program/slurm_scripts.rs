//! The scripts of examples/slurm, with a `sbatch` that runs each task at once: the same FILE with another grid, another
//! division, a damaged part. `make test-slurm` has Slurm itself.
//!
//! Judge: the bytes that one process writes for the same grid.

use crate::folder::{Folder, said};
use assert_cmd::cargo::cargo_bin;
use std::os::unix::fs::{MetadataExt, PermissionsExt};
use std::path::Path;
use std::process::{Command, Output};

/// Takes `--array=1-N`, as `submit.sh` gives it, and is done when it returns.
const SBATCH: &str = r#"#!/usr/bin/env bash
array=
while [[ $1 == --* ]]; do
  case $1 in --array=*) array=${1#*=} ;; esac
  shift
done
if [ -z "$array" ]; then
  bash "$@" >&2 || exit 1
else
  for ((i = ${array%-*}; i <= ${array#*-}; i++)); do
    SLURM_ARRAY_TASK_ID=$i SLURM_ARRAY_JOB_ID=7 SLURM_CPUS_PER_TASK=1 bash "$@" >&2 || exit 1
  done
fi
echo 7
"#;

fn submit(folder: &Folder, parts: &str, options: &str) -> Output {
    let sbatch = folder.path("sbatch");
    folder.write("sbatch", SBATCH);
    std::fs::set_permissions(&sbatch, PermissionsExt::from_mode(0o755)).unwrap();
    let path = std::env::var("PATH").unwrap();
    let script =
        Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("examples/slurm/submit.sh");
    Command::new(script)
        .args(["map.json", parts])
        .args(options.split(' '))
        .current_dir(folder.path(""))
        .env("PATH", format!("{}:{path}", folder.path("").display()))
        .env("STICKSLIP", cargo_bin("stickslip"))
        .output()
        .unwrap()
}

const FIRST: &str = "--r 1 --alpha 0.5:1:4";
const SECOND: &str = "--r 1 --alpha 0.6:1:4";

fn makes(folder: &Folder, parts: &str, options: &str) {
    let output = submit(folder, parts, options);
    assert!(output.status.success(), "{options}: {}", said(&output));
    folder.prints(&format!("sweep {options} -o alone.json"));
    assert!(folder.read("map.json") == folder.read("alone.json"), "{options}: the map of others");
}

#[test]
fn a_map_is_that_of_the_options_whatever_parts_there_were() {
    let folder = Folder::new("slurm_scripts");
    let inode = |part: &str| folder.path(part).metadata().unwrap().ino();
    makes(&folder, "4", FIRST);
    // Done already: nothing is written anew.
    let before = inode("map.json.parts/part-2.json");
    makes(&folder, "4", FIRST);
    assert_eq!(inode("map.json.parts/part-2.json"), before);
    makes(&folder, "4", SECOND);
    // Parts 3 and 4 of the division before are still there.
    makes(&folder, "2", SECOND);
    // Another tip under the same name.
    for width in ["1", "0.9"] {
        folder.write(
            "tip.json",
            format!("{{\"gaussians\":[{{\"amplitude\":1,\"center\":0,\"width\":{width}}}]}}"),
        );
        makes(&folder, "2", &format!("{FIRST} --tip-file tip.json"));
    }
    // Damage.
    let whole = folder.read("map.json.parts/part-1.json");
    folder.write("map.json.parts/part-1.json", &whole[..whole.len() / 2]);
    makes(&folder, "2", &format!("{FIRST} --tip-file tip.json"));
}
