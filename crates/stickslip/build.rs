//! The commit that the library is built from, for documents and `--version`: `STICKSLIP_COMMIT` is its name,
//! `STICKSLIP_TREE` is `clean` or `changed` (both empty where the commit is unknown), `STICKSLIP_SOURCES` says it in words.
//!
//! A packaged crate has the commit in `.cargo_vcs_info.json`, a clone in Git. Builds without optimisation (development
//! and tests) do not look: they would be compiled anew at every commit.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

/// The files of a clone that a build depends on, relative to its root.
const SOURCES: [&str; 3] = [":/Cargo.toml", ":/Cargo.lock", ":/crates"];

/// A commit, and whether the sources are those of the commit.
#[derive(Debug, PartialEq)]
pub(crate) struct Origin {
    pub(crate) commit: String,
    pub(crate) is_clean: bool,
}

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    let package = PathBuf::from(env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let is_optimised = env::var_os("PROFILE").is_some_and(|profile| profile == "release");
    let found = of_package(&package).or_else(|| is_optimised.then(|| of_clone(&package))?);
    let (commit, tree, sources) = match &found {
        Some(Origin { commit, is_clean: true }) => {
            (&**commit, "clean", format!("commit {commit}, clean"))
        }
        Some(Origin { commit, .. }) => {
            (&**commit, "changed", format!("commit {commit}, with changes"))
        }
        None => ("", "", "commit unknown".into()),
    };
    println!("cargo::rustc-env=STICKSLIP_COMMIT={commit}");
    println!("cargo::rustc-env=STICKSLIP_TREE={tree}");
    println!("cargo::rustc-env=STICKSLIP_SOURCES={sources}");
}

/// The commit that Cargo packaged, if `package` is the folder of a packaged crate.
pub(crate) fn of_package(package: &Path) -> Option<Origin> {
    let text = fs::read_to_string(package.join(".cargo_vcs_info.json")).ok()?;
    let (_, after) = text.split_once("\"sha1\"")?;
    let commit = after.split('"').nth(1).filter(|commit| is_commit(commit))?;
    Some(Origin { commit: commit.into(), is_clean: !text.contains("\"dirty\": true") })
}

/// The commit of the clone that has `package` as its folder `crates/stickslip`.
pub(crate) fn of_clone(package: &Path) -> Option<Origin> {
    // Sources that lie in a clone of something else have no commit.
    if git(package, &["rev-parse", "--show-prefix"])?.trim() != "crates/stickslip/" {
        return None;
    }
    git(package, &["ls-files", "--error-unmatch", "build.rs"])?;
    let commit = git(package, &["rev-parse", "HEAD"])?.trim().to_owned();
    let mut status = vec!["status", "--porcelain", "--untracked-files=no", "--"];
    status.extend(SOURCES);
    let is_clean = git(package, &status)?.is_empty();
    watch(package);
    is_commit(&commit).then_some(Origin { commit, is_clean })
}

/// Lets Cargo ask again when the commit or a source changes.
fn watch(package: &Path) {
    let mut list = vec!["ls-files", "--"];
    list.extend(SOURCES);
    let sources = git(package, &list).unwrap_or_default();
    let branch = git(package, &["rev-parse", "--symbolic-full-name", "HEAD"]).unwrap_or_default();
    let heads =
        ["HEAD", "logs/HEAD", "packed-refs", branch.trim()].into_iter().filter_map(|name| {
            let path = git(package, &["rev-parse", "--git-path", name])?.trim().to_owned();
            package.join(&path).is_file().then_some(path)
        });
    for file in sources.lines().map(str::to_owned).chain(heads) {
        println!("cargo::rerun-if-changed={file}");
    }
}

fn is_commit(name: &str) -> bool {
    name.len() >= 40 && name.bytes().all(|byte| byte.is_ascii_hexdigit())
}

/// What Git prints about the clone around `folder`, and nothing else: not that of a hook which builds.
fn git(folder: &Path, arguments: &[&str]) -> Option<String> {
    let mut command = Command::new("git");
    command.args(arguments).current_dir(folder).env("GIT_OPTIONAL_LOCKS", "0");
    for name in ["GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_PREFIX"] {
        command.env_remove(name);
    }
    let output = command.output().ok().filter(|output| output.status.success())?;
    String::from_utf8(output.stdout).ok()
}
