//! What the program is built from: licences that may be shipped with it, crates from the registry and
//! nowhere else, no `unsafe` of our own, no feature that nobody asked for. The oracle is Cargo's own
//! metadata and the lock file.

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Licences that allow use, change and sale for a notice at most.
const LICENCES: [&str; 12] = [
    "0BSD",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
    "ISC",
];

/// Files that may say `unsafe`, each with a reason at its top. The lint `unsafe_code = "forbid"` has to
/// be lifted there too.
const UNSAFE: [&str; 0] = [];

/// Features that cost next to nothing, or without which a crate does nothing for us.
const PLAIN_FEATURES: [&str; 4] = ["std", "libm", "derive", "arch"];
/// Crates whose other default features are wanted.
const DEFAULTS_WANTED: [(&str, &str); 2] = [
    ("clap", "help, usage and suggestions are what a user sees"),
    ("tempfile", "names that nobody else has"),
];

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

/// Every package of the build, ours included.
fn packages() -> Vec<Value> {
    let mut cargo = Command::new(env!("CARGO"));
    cargo
        .args(["metadata", "--format-version", "1", "--locked", "--all-features"])
        .current_dir(root());
    let output = cargo.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let packages = metadata["packages"].as_array().unwrap().clone();
    assert!(packages.len() > 50, "{} packages", packages.len());
    packages
}

fn is_ours(package: &Value) -> bool {
    package["source"].is_null()
}

/// Whether a licence expression (SPDX, or with / as older crates write OR) can be met.
fn acceptable(expression: &str) -> bool {
    let spaced = expression.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    any_of(&words).is_some_and(|(accepted, rest)| accepted && rest.is_empty())
}

/// Whether the expression at the start is met, and the words after it; `None` where there is none.
type Read<'a> = Option<(bool, &'a [&'a str])>;

/// A OR B OR …
fn any_of<'a>(words: &'a [&'a str]) -> Read<'a> {
    let (accepted, rest) = all_of(words)?;
    match rest.split_first() {
        Some((&"OR", after)) => any_of(after).map(|(other, rest)| (accepted || other, rest)),
        _ => Some((accepted, rest)),
    }
}

/// A AND B AND …
fn all_of<'a>(words: &'a [&'a str]) -> Read<'a> {
    let (accepted, rest) = one(words)?;
    match rest.split_first() {
        Some((&"AND", after)) => all_of(after).map(|(other, rest)| (accepted && other, rest)),
        _ => Some((accepted, rest)),
    }
}

/// A licence, perhaps with an exception, or an expression in parentheses.
fn one<'a>(words: &'a [&'a str]) -> Read<'a> {
    match words {
        ["(", inner @ ..] => match any_of(inner)? {
            (accepted, [")", rest @ ..]) => Some((accepted, rest)),
            _ => None,
        },
        [name, "WITH", exception, rest @ ..] => {
            Some((LICENCES.contains(&format!("{name} WITH {exception}").as_str()), rest))
        }
        [name, rest @ ..] => Some((LICENCES.contains(name), rest)),
        [] => None,
    }
}

#[test]
fn licence_expressions_are_read_as_they_are_meant() {
    for good in ["MIT", "MIT/Apache-2.0", "(MIT OR GPL-3.0) AND Unicode-3.0", "GPL-3.0 OR Zlib"] {
        assert!(acceptable(good), "{good}");
    }
    for bad in ["GPL-3.0", "MIT AND GPL-3.0", "(MIT", "MIT OR", "", "MIT WITH something", "MIT GPL"]
    {
        assert!(!acceptable(bad), "{bad}");
    }
}

#[test]
fn every_dependency_has_a_licence_that_may_be_shipped() {
    for package in packages() {
        let licence = package["license"].as_str().unwrap_or_default();
        assert!(acceptable(licence), "{}: {licence:?}", package["name"]);
    }
}

#[test]
fn every_dependency_comes_from_the_registry_with_a_checksum() {
    for package in packages().iter().filter(|package| !is_ours(package)) {
        let source = package["source"].as_str().unwrap();
        assert!(source.starts_with("registry+"), "{}: {source}", package["name"]);
    }
    let lock = fs::read_to_string(root().join("Cargo.lock")).unwrap();
    let count = |words: &str| lock.lines().filter(|line| line.starts_with(words)).count();
    assert_eq!(count("source = "), count("checksum = "));
}

#[test]
fn default_features_are_asked_for_only_where_they_are_wanted() {
    let all = packages();
    let defaults = |name: &Value| -> Vec<String> {
        let package = all.iter().rfind(|package| package["name"] == *name).unwrap();
        let features = package["features"]["default"].as_array().cloned().unwrap_or_default();
        features.iter().map(|feature| feature.as_str().unwrap().to_owned()).collect()
    };
    for package in all.iter().filter(|package| is_ours(package)) {
        for dependency in package["dependencies"].as_array().unwrap() {
            let name = &dependency["name"];
            let wanted = DEFAULTS_WANTED.iter().any(|(wanted, _)| *name == *wanted);
            if wanted || dependency["uses_default_features"] == false {
                continue;
            }
            let idle: Vec<String> = defaults(name)
                .into_iter()
                .filter(|feature| !PLAIN_FEATURES.contains(&feature.as_str()))
                .collect();
            assert!(idle.is_empty(), "{} takes {idle:?} of {name}", package["name"]);
        }
    }
}

/// Rust files of the project below a folder.
fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

#[test]
fn nothing_of_ours_is_unsafe_but_the_files_named() {
    let workspace = fs::read_to_string(root().join("Cargo.toml")).unwrap();
    assert!(workspace.contains("unsafe_code = \"forbid\""));
    for package in packages().iter().filter(|package| is_ours(package)) {
        let manifest = fs::read_to_string(package["manifest_path"].as_str().unwrap()).unwrap();
        assert!(manifest.contains("[lints]\nworkspace = true"), "{}", package["name"]);
    }
    let mut files = vec![];
    for folder in ["crates", "tests", "benches", "peers"] {
        sources(&root().join(folder), &mut files);
    }
    assert!(files.len() > 100, "{} files", files.len());
    for file in files {
        let name = file.strip_prefix(root()).unwrap().to_str().unwrap().to_owned();
        let text = fs::read_to_string(&file).unwrap();
        // Keyword, not a word in a comment or in this file's own lines.
        let keyword = ["unsafe {", "unsafe fn", "unsafe impl", "unsafe extern"];
        let says =
            name != "tests/program/supply_chain.rs" && keyword.iter().any(|k| text.contains(k));
        assert!(!says || UNSAFE.contains(&name.as_str()), "{name}");
    }
}

#[test]
fn every_verb_builds_what_the_lock_file_says() {
    let makefile = fs::read_to_string(root().join("Makefile")).unwrap();
    let builds = ["test", "clippy", "doc", "bench", "install", "run", "build"];
    let calls = |line: &&str| builds.iter().any(|verb| line.contains(&format!("$(CARGO) {verb}")));
    let lines: Vec<&str> = makefile.lines().filter(calls).collect();
    assert!(lines.len() > 5, "{lines:?}");
    for line in lines {
        assert!(line.contains("--locked"), "{line}");
    }
}

/// Name, version and what it depends on, of each package in a lock file.
fn locked(file: &Path) -> Vec<(String, String, Vec<String>)> {
    let text = fs::read_to_string(file).unwrap();
    let word = |entry: &str, key: &str| {
        let line = entry.lines().find_map(|line| line.strip_prefix(&format!("{key} = ")));
        line.unwrap_or_default().trim_matches('"').to_owned()
    };
    let needs = |entry: &str| {
        let lines = entry.lines().filter_map(|line| line.strip_prefix(" \"")?.strip_suffix("\","));
        lines.map(|line| line.split(' ').next().unwrap().to_owned()).collect()
    };
    let packages = text.split("[[package]]").skip(1);
    packages.map(|entry| (word(entry, "name"), word(entry, "version"), needs(entry))).collect()
}

/// The crates below `[dependencies]` in a manifest that are always there.
fn needed(manifest: &Path) -> Vec<String> {
    let text = fs::read_to_string(manifest).unwrap();
    let lines = text.lines().skip_while(|line| *line != "[dependencies]").skip(1);
    let lines = lines.take_while(|line| !line.starts_with('['));
    let lines = lines.filter(|line| !line.contains("optional = true"));
    let names = lines.filter_map(|line| line.split_once(['=', '.'])).map(|(name, _)| name.trim());
    names.filter(|name| !name.starts_with('#')).map(str::to_owned).collect()
}

/// Its lock file is its own: it must not fall behind, nor compute with other versions than the program.
#[test]
fn the_python_package_is_built_from_the_programs_own_crates() {
    let (ours, its) = (root().join("Cargo.lock"), root().join("crates/python/Cargo.lock"));
    let (ours, its) = (locked(&ours), locked(&its));
    assert!(its.len() > 100, "{} packages", its.len());
    for (name, version, needs) in &its {
        let mut here = ours.iter().filter(|(other, _, _)| other == name).peekable();
        let is_shared = here.peek().is_some();
        let same = here.any(|(_, other, _)| other == version);
        assert!(!is_shared || same, "{name} {version}: copy Cargo.lock to crates/python and build");
        if let Some(folder) = name.strip_prefix("stickslip").filter(|rest| *rest != "-python") {
            let folder = folder.strip_prefix('-').map(|folder| root().join("crates").join(folder));
            let manifest = folder.unwrap_or(root().into()).join("Cargo.toml");
            for wanted in needed(&manifest) {
                assert!(needs.contains(&wanted), "crates/python/Cargo.lock: {name} lacks {wanted}");
            }
        }
    }
    let manifest = fs::read_to_string(root().join("crates/python/Cargo.toml")).unwrap();
    assert!(manifest.contains("unsafe_code = \"forbid\""));
}
