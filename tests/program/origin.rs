//! The commit that documents name: that of a clone or of a packaged crate, and none where sources have none.

#[path = "../../crates/stickslip/build.rs"]
#[allow(dead_code, reason = "what it says to Cargo is for Cargo")]
mod build;

use build::{Origin, of_clone, of_package};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tempfile::TempDir;

/// Runs Git, and returns what it prints.
fn git(folder: &Path, arguments: &[&str]) -> String {
    let settings =
        ["-c", "user.name=A", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false"];
    let mut command = Command::new("git");
    command.args(settings).args(arguments).current_dir(folder).env_remove("GIT_DIR");
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().trim().into()
}

/// A clone with one commit that has this crate in `crates/stickslip` below `parent`.
fn clone(parent: &str) -> (TempDir, PathBuf) {
    let clone = tempfile::tempdir().unwrap();
    let package = clone.path().join(parent).join("crates/stickslip");
    fs::create_dir_all(&package).unwrap();
    for file in ["build.rs", "../../Cargo.toml", "../../Cargo.lock", "../../README.md"] {
        fs::write(package.join(file), "one\n").unwrap();
    }
    git(clone.path(), &["init", "--quiet"]);
    git(clone.path(), &["add", "."]);
    git(clone.path(), &["commit", "--quiet", "--message", "First"]);
    (clone, package)
}

#[test]
fn a_clone_is_clean_until_a_source_changes() {
    let (clone, package) = clone("");
    let commit = git(clone.path(), &["rev-parse", "HEAD"]);
    let of = |is_clean| Some(Origin { commit: commit.clone(), is_clean });
    assert_eq!(of_clone(&package), of(true));
    // The program is not made of these.
    fs::write(clone.path().join("README.md"), "two\n").unwrap();
    fs::write(package.join("notes.txt"), "not in Git\n").unwrap();
    assert_eq!(of_clone(&package), of(true));
    for file in ["crates/stickslip/build.rs", "Cargo.lock", "Cargo.toml"] {
        let file = clone.path().join(file);
        fs::write(&file, "two\n").unwrap();
        assert_eq!(of_clone(&package), of(false), "{}", file.display());
        fs::write(&file, "one\n").unwrap();
        assert_eq!(of_clone(&package), of(true), "{}", file.display());
    }
    fs::remove_file(package.join("build.rs")).unwrap();
    assert_ne!(of_clone(&package), of(true));
    git(clone.path(), &["commit", "--quiet", "--all", "--message", "Second"]);
    assert_eq!(of_clone(&package), None, "no build script is tracked");
}

#[test]
fn sources_within_a_clone_of_something_else_have_no_commit() {
    let (_clone, package) = clone("vendored/stickslip");
    assert_eq!(of_clone(&package), None);
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(of_clone(folder.path()), None);
}

#[test]
fn a_packaged_crate_has_the_commit_that_cargo_noted() {
    let package = tempfile::tempdir().unwrap();
    let commit = "0123456789abcdef0123456789abcdef01234567";
    let noted = |git: &str| {
        let text =
            format!("{{\n  \"git\": {{{git}}},\n  \"path_in_vcs\": \"crates/stickslip\"\n}}");
        fs::write(package.path().join(".cargo_vcs_info.json"), text).unwrap();
        of_package(package.path())
    };
    assert_eq!(of_package(package.path()), None);
    let of = |is_clean| Some(Origin { commit: commit.into(), is_clean });
    assert_eq!(noted(&format!("\"sha1\": \"{commit}\"")), of(true));
    assert_eq!(noted(&format!("\"sha1\": \"{commit}\", \"dirty\": true")), of(false));
    assert_eq!(noted("\"sha1\": \"$(id)\""), None);
}
