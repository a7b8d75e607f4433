//! The structure of the sources: no two files of a crate import each other in a circle, and crates that are used without
//! files and arguments do not know of them. Judged by the sources and manifests themselves.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."))
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(path);
        }
    }
}

/// Folders that hold the root module of a crate.
fn crates() -> Vec<PathBuf> {
    let mut folders = vec![];
    for entry in fs::read_dir(root().join("crates")).unwrap() {
        let folder = entry.unwrap().path();
        let src = folder.join("src");
        folders.push(if src.is_dir() { src } else { folder });
    }
    folders.sort();
    folders
}

/// The modules of a crate by their path, such as `memory::modes::fit`, with their text.
struct Modules(BTreeMap<Vec<String>, String>);

impl Modules {
    fn of(folder: &Path) -> Self {
        let mut files = vec![];
        sources(folder, &mut files);
        let has_library = folder.join("lib.rs").is_file();
        let module = |file: PathBuf| {
            let inside = file.strip_prefix(folder).unwrap().with_extension("");
            let mut path: Vec<String> =
                inside.iter().map(|part| part.to_str().unwrap().to_owned()).collect();
            // The program beside a library is a file of its own.
            let is_root =
                |last: &str| ["mod", "lib"].contains(&last) || (last == "main" && !has_library);
            path.pop_if(|last| is_root(last));
            (path, code(&fs::read_to_string(file).unwrap()))
        };
        Self(files.into_iter().map(module).collect())
    }

    /// The module that an imported path leads to, through re-exports; `None` where it leads out of the crate.
    fn defines(&self, from: &[String], path: &str) -> Option<Vec<String>> {
        let mut words = path.split("::").peekable();
        let mut at: Vec<String> = match *words.peek()? {
            "crate" => words.next().map(|_| vec![])?,
            "self" => words.next().map(|_| from.to_vec())?,
            "super" => from.to_vec(),
            child => {
                let child = [from, &[child.to_owned()]].concat();
                self.0.contains_key(&child).then(|| from.to_vec())?
            }
        };
        while words.next_if_eq(&"super").is_some() {
            at.pop();
        }
        for word in words {
            let child = [&at[..], &[word.to_owned()]].concat();
            if self.0.contains_key(&child) {
                at = child;
                continue;
            }
            let exported = imports(self.0.get(&at)?, "pub use ")
                .chain(imports(self.0.get(&at)?, "pub(crate) use "))
                .find(|exported| exported.ends_with(&format!("::{word}")));
            return match exported {
                Some(exported) => self.defines(&at, &exported),
                None => Some(at),
            };
        }
        Some(at)
    }

    /// Which modules each one takes something from. What a file of a folder takes from the folder's own file is
    /// left out: they are one room.
    fn arrows(&self) -> BTreeMap<&Vec<String>, BTreeSet<Vec<String>>> {
        let taken = |(path, text): (&Vec<String>, &String)| {
            let inline = text.split(|c: char| !(c.is_alphanumeric() || "_:".contains(c)));
            let inline =
                inline.filter(|word| word.starts_with("crate::") || word.starts_with("super::"));
            let inline = inline.map(|word| word.trim_end_matches(':').to_owned());
            let used = imports(text, "use ").chain(inline);
            used.filter_map(|used| self.defines(path, &used))
                .filter(|other| !path.starts_with(other) && !is_one_type(path, other))
                .collect()
        };
        self.0.iter().map(|module| (module.0, taken(module))).collect()
    }
}

/// f(x) carries the f(x,y) that it is the section of, and f(x,y) is made of f(x): a recursive type in two folders.
fn is_one_type(a: &[String], b: &[String]) -> bool {
    let of = |path: &[String], name: &str| path.first().is_some_and(|first| first == name);
    of(a, "tip_function") && of(b, "footprint")
}

/// The text without comments and unit tests.
fn code(text: &str) -> String {
    let text = text.split("#[cfg(test)]\nmod tests").next().unwrap();
    let lines = text.lines().map(|line| line.split("//").next().unwrap());
    lines.collect::<Vec<_>>().join("\n")
}

/// The paths of all imports that begin a line with this keyword, trees taken apart.
fn imports<'a>(text: &'a str, keyword: &'a str) -> impl Iterator<Item = String> + 'a {
    let statements = text.split(';').filter_map(move |part| {
        let start = part.find(keyword)?;
        let begins = part[..start].chars().next_back().is_none_or(|c| c == '\n');
        begins.then(|| part[start + keyword.len()..].split_whitespace().collect::<String>())
    });
    statements.flat_map(|tree| leaves(&tree))
}

/// `a::{b, c::{d}}` as `a::b` and `a::c::d`.
fn leaves(tree: &str) -> Vec<String> {
    let Some((stem, rest)) = tree.split_once('{') else { return vec![tree.to_owned()] };
    let inside = rest.strip_suffix('}').unwrap_or(rest);
    let (mut depth, mut start, mut parts) = (0, 0, vec![]);
    for (i, c) in inside.char_indices() {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                parts.push(&inside[start..i]);
                start = i + 1;
            }
            _ => {}
        }
    }
    parts.push(&inside[start..]);
    let parts = parts.into_iter().filter(|part| !part.is_empty());
    parts.flat_map(|part| leaves(&format!("{stem}{part}"))).collect()
}

/// A way from a module back to it.
fn circle(arrows: &BTreeMap<&Vec<String>, BTreeSet<Vec<String>>>) -> Option<Vec<String>> {
    arrows.keys().find_map(|start| {
        let mut reached: BTreeMap<&Vec<String>, &Vec<String>> = BTreeMap::new();
        let mut front = vec![*start];
        while let Some(at) = front.pop() {
            for next in arrows.get(at).into_iter().flatten() {
                if next == *start {
                    let back = std::iter::successors(Some(at), |at| reached.get(at).copied());
                    let back = [*start].into_iter().chain(back);
                    return Some(back.map(|module| module.join("::")).collect());
                }
                if !reached.contains_key(next) {
                    reached.insert(next, at);
                    front.push(next);
                }
            }
        }
        None
    })
}

#[test]
fn no_files_of_a_crate_import_each_other_in_a_circle() {
    let mut circles = vec![];
    for folder in crates() {
        let modules = Modules::of(&folder);
        let found = circle(&modules.arrows());
        circles.extend(found.map(|found| format!("{}: {}", folder.display(), found.join(" <- "))));
    }
    assert!(circles.is_empty(), "{}", circles.join("\n"));
}

#[test]
fn a_circle_is_seen_through_a_re_export() {
    let module = |path: &str, text: &str| {
        (path.split("::").filter(|p| !p.is_empty()).map(str::to_owned).collect(), text.to_owned())
    };
    let there_and_back = Modules(BTreeMap::from([
        module("", "mod a;\npub use a::{One, deep::Two};\nmod b;\n"),
        module("a", "pub mod deep;\nuse super::b::Other;\n"),
        module("a::deep", ""),
        module("b", "use crate::{\n    One,\n};\n"),
    ]));
    assert!(circle(&there_and_back.arrows()).is_some());
    let there = Modules(BTreeMap::from([
        module("", "mod a;\npub use a::{One, deep::Two};\nmod b;\n"),
        module("a", "pub mod deep;\nuse super::b::Other;\n"),
        module("a::deep", ""),
        module("b", "use crate::Two;\nuse std::fs;\n"),
    ]));
    assert!(circle(&there.arrows()).is_none());
    assert_eq!(there.arrows()[&vec!["b".to_owned()]].len(), 1);
}

/// The crates of the workspace that a crate stands on, itself among them.
fn below(name: &str) -> BTreeSet<String> {
    let (mut found, mut front) = (BTreeSet::new(), vec![name.to_owned()]);
    while let Some(name) = front.pop() {
        let manifest = root().join("crates").join(&name).join("Cargo.toml");
        let manifest = fs::read_to_string(manifest).unwrap();
        let needed = manifest.split("[dev-dependencies]").next().unwrap().lines();
        let ours = needed.filter_map(|line| {
            let (name, _) =
                line.split_once(['.', ' ']).filter(|_| line.starts_with("stickslip"))?;
            Some(name.strip_prefix("stickslip-").unwrap_or(name).to_owned())
        });
        front.extend(ours.filter(|name| !found.contains(name)));
        found.insert(name);
    }
    found
}

/// `make wasm` compiles these two for a browser, which has neither.
#[test]
fn the_library_and_figures_know_neither_arguments_nor_files() {
    let crates: BTreeSet<String> = ["stickslip", "figures"].into_iter().flat_map(below).collect();
    assert!(crates.contains("tip") && crates.len() > 6, "{crates:?}");
    for name in crates {
        let folder = root().join("crates").join(&name);
        let manifest = fs::read_to_string(folder.join("Cargo.toml")).unwrap();
        let mut files = vec![];
        sources(&folder.join("src"), &mut files);
        let text = |file: &PathBuf| code(&fs::read_to_string(file).unwrap());
        let all: String = files.iter().map(text).chain([manifest]).collect();
        for word in ["clap", "tempfile", "std::fs", "std::env", "std::process", "std::net"] {
            assert!(!all.contains(word), "{name} knows {word}");
        }
    }
}

/// A library that is not compiled for tests of its own has none that would never run.
#[test]
fn no_unit_test_is_dead() {
    let mut without = 0;
    for folder in crates() {
        let manifest = folder.parent().unwrap().join("Cargo.toml");
        let Ok(manifest) = fs::read_to_string(manifest) else { continue };
        let library = manifest.split("[lib]").nth(1).and_then(|rest| rest.split("\n[").next());
        if !library.is_some_and(|library| library.lines().any(|line| line == "test = false")) {
            continue;
        }
        without += 1;
        let mut files = vec![];
        sources(&folder, &mut files);
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            assert!(!text.contains("#[test]"), "{}", file.display());
        }
    }
    assert!(without > 0);
}
