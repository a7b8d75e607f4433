//! What the program is built from: no `unsafe` of our own, no feature that nobody asked for, notices of all that is in
//! it. The oracle is Cargo's own metadata and the lock file. Licences, sources and bans: `.ci/deny`.

use crate::folder::Folder;
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

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

#[test]
fn all_that_names_the_version_names_the_same() {
    let version = env!("CARGO_PKG_VERSION");
    for (file, line) in [
        ("CITATION.cff", format!("version: {version}")),
        ("packages/conda/recipe.yaml", format!("version: \"{version}\"")),
        ("crates/python/Cargo.toml", format!("version = \"{version}\"")),
        ("crates/python/stickslip/__init__.py", format!("__version__ = \"{version}\"")),
        ("crates/web/Cargo.toml", format!("version = \"{version}\"")),
        ("CHANGELOG.md", format!("## {version} - ")),
    ] {
        let text = fs::read_to_string(root().join(file)).unwrap();
        let is_there = text.lines().any(|l| l.trim_start().starts_with(&line));
        assert!(is_there, "{file}: no {line}");
    }
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

/// Against `cargo tree`, which resolves features where the list takes all that Cargo's metadata has.
#[cfg(target_os = "linux")]
#[test]
fn every_crate_that_is_linked_has_its_notice_and_is_listed() {
    let folder = Folder::new("contents");
    let target = &format!("{}-unknown-linux-gnu", std::env::consts::ARCH);
    let python =
        Command::new("python3").args(["-c", "import tomllib"]).stderr(Stdio::null()).status();
    if !python.is_ok_and(|status| status.success()) {
        eprintln!("no Python 3.11 or later: no list of the parts to compare");
        return;
    }
    let run = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).current_dir(root()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8(output.stdout).unwrap()
    };
    let place = folder.path(".").to_str().unwrap().to_owned();
    run("python3", &["packages/contents.py", "stickslip-cli", target, &place]);
    let notices = String::from_utf8(folder.read("THIRD-PARTY-NOTICES.txt")).unwrap();
    let listed = folder.json("stickslip-cli.cdx.json");
    let components = listed["components"].as_array().unwrap();
    let tree =
        ["tree", "--locked", "--package", "stickslip-cli", "--edges", "normal", "--target", target];
    let tree = [&tree[..], &["--prefix", "none", "--format", "{p}"]].concat();
    let tree = run(env!("CARGO"), &tree);
    let linked: Vec<(&str, &str)> = tree.lines().filter_map(|line| line.split_once(" v")).collect();
    assert!(linked.len() > 150, "{}", linked.len());
    for (name, version) in linked.into_iter().filter(|(name, _)| *name != "stickslip-cli") {
        let version = version.split(' ').next().unwrap();
        let is = |part: &&Value| part["name"] == name && part["version"] == version;
        let part = components.iter().find(is).unwrap_or_else(|| panic!("{name} {version}"));
        if !name.starts_with("stickslip") {
            assert!(notices.contains(&format!("\n{name} {version}: ")), "{name} {version}");
            assert_eq!(part["hashes"][0]["alg"], "SHA-256", "{name}");
        }
    }
    // The font within one of them has terms of its own.
    for words in ["Bitstream Vera", "Apache License", "Unicode, Inc."] {
        assert!(notices.contains(words), "{words}");
    }
}

/// Every action of a workflow is named by its commit, which nobody can move, and rights are asked for by each job.
#[test]
fn workflows_name_actions_by_commit_and_ask_for_few_rights() {
    for name in ["check", "release"] {
        let file = root().join(format!(".github/workflows/{name}.yml"));
        let text = fs::read_to_string(file).unwrap();
        assert!(text.contains("\npermissions: {}\n"), "{name}");
        let uses: Vec<&str> = text
            .lines()
            .filter_map(|line| line.split_once("uses: "))
            .map(|(_, action)| action)
            .collect();
        assert!(!uses.is_empty());
        for action in uses {
            let (commit, version) = action.split_once('@').unwrap().1.split_once(" # v").unwrap();
            assert!(
                commit.len() == 40 && commit.bytes().all(|b| b.is_ascii_hexdigit()),
                "{action}"
            );
            assert!(version.split('.').count() == 3, "{action}");
        }
        let writes = text.matches(": write").count();
        assert_eq!(
            writes,
            usize::from(name == "release"),
            "{name}: only the draft of a release writes"
        );
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
