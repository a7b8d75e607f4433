//! Does the book say what holds: do its commands print what it shows, do its links and paths lead somewhere, do its options exist?
//!
//! Judges: the program, run by a shell; the files of the project; the help of all commands as docs/reference/commands.md has it.
//! Numbers are compared to nine digits, as the last ones depend on the machine, and all else exactly but for times.

use crate::folder::Folder;
use assert_cmd::cargo::cargo_bin;
use std::collections::BTreeSet;
use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Files below a folder of the project whose names end so, without what is built, fetched, or no text of ours.
fn files(folder: &str, endings: &[&str]) -> Vec<PathBuf> {
    let mut found = vec![];
    let mut left = vec![Path::new(ROOT).join(folder)];
    while let Some(folder) = left.pop() {
        for entry in fs::read_dir(folder).unwrap().map(Result::unwrap) {
            let (path, name) = (entry.path(), entry.file_name().into_string().unwrap());
            if path.is_dir() {
                let skipped = name.starts_with('.')
                    || ["target", "node_modules", "corpus", "venv"].contains(&name.as_str());
                left.extend((!skipped).then_some(path));
            } else if endings.iter().any(|ending| name.ends_with(ending)) {
                found.push(path);
            }
        }
    }
    found.sort();
    found
}

fn text(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn named(path: &Path) -> String {
    path.strip_prefix(ROOT).unwrap().display().to_string()
}

/// The lines of a page outside of its code blocks.
fn prose(page: &str) -> String {
    let mut is_code = false;
    let lines = page.lines().filter(|line| {
        let fence = line.trim_start().starts_with("```");
        is_code ^= fence;
        !is_code && !fence
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Every other part between backquotes.
fn inline_code(prose: &str) -> impl Iterator<Item = &str> {
    prose.split('`').skip(1).step_by(2)
}

/// The anchor that a heading gets.
fn anchor(heading: &str) -> String {
    let heading = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// Targets of the links and pictures of a page.
fn targets(prose: &str) -> impl Iterator<Item = &str> {
    prose.split("](").skip(1).filter_map(|rest| rest.split(')').next())
}

#[test]
fn links_lead_somewhere() {
    let mut dead = vec![];
    let mut count = 0;
    // The table of contents of the site has the paths of the site.
    let ours = |file: &PathBuf| !file.parent().unwrap().ends_with("web/book");
    for file in files("", &[".md"]).into_iter().filter(ours) {
        let page = prose(&text(&file));
        for target in targets(&page)
            .filter(|target| !target.contains("://") && !target.starts_with("mailto:"))
        {
            let (path, part) = target.split_once('#').unwrap_or((target, ""));
            let there =
                if path.is_empty() { file.clone() } else { file.parent().unwrap().join(path) };
            let has_part = || {
                let page = prose(&text(&there));
                page.lines().any(|line| line.starts_with('#') && anchor(line) == part)
            };
            if !there.exists() || !part.is_empty() && !has_part() {
                dead.push(format!("{}: {target}", named(&file)));
            }
            count += 1;
        }
    }
    assert!(dead.is_empty(), "dead links:\n{}", dead.join("\n"));
    assert!(count > 250, "{count} links");
}

/// A path of the project, if a word in backquotes looks like one.
fn path_in(word: &str) -> Option<&str> {
    const FOLDERS: [&str; 9] = [
        "benches/",
        "crates/",
        "data/",
        "docs/",
        "examples/",
        "notes/",
        "packages/",
        "peers/",
        "tests/",
    ];
    let plain = !word.contains([' ', '*', '…', '{', '(', '<', '>', '=']);
    (plain && FOLDERS.iter().any(|folder| word.starts_with(folder))).then_some(word)
}

#[test]
fn paths_lead_somewhere() {
    let mut stale = vec![];
    for file in files("", &[".md"]).into_iter().filter(|file| !file.ends_with("CHANGELOG.md")) {
        let page = prose(&text(&file));
        for path in inline_code(&page).filter_map(path_in) {
            if !Path::new(ROOT).join(path).exists() && !file.parent().unwrap().join(path).exists() {
                stale.push(format!("{}: {path}", named(&file)));
            }
        }
    }
    // Pages that comments, messages and notebooks name.
    for file in files("", &[".rs", ".py", ".mjs", ".toml", ".ipynb", ".sh", ".md", "Makefile"]) {
        let source = text(&file);
        for rest in source.split("docs/").skip(1) {
            let end = rest
                .find(|c: char| !(c.is_alphanumeric() || "/_-.".contains(c)))
                .unwrap_or(rest.len());
            let path = rest[..end].trim_end_matches('.');
            if path.ends_with(".md") && !Path::new(ROOT).join("docs").join(path).exists() {
                stale.push(format!("{}: docs/{path}", named(&file)));
            }
        }
    }
    assert!(stale.is_empty(), "stale paths:\n{}", stale.join("\n"));
}

/// Words of a text that begin with two hyphens.
fn options(text: &str) -> impl Iterator<Item = String> + '_ {
    text.split("--").skip(1).filter_map(|rest| {
        let name: String =
            rest.chars().take_while(|c| c.is_ascii_alphanumeric() || *c == '-').collect();
        name.starts_with(|c: char| c.is_ascii_lowercase()).then_some(name)
    })
}

#[test]
fn options_exist() {
    let known: BTreeSet<_> =
        options(&text(&Path::new(ROOT).join("docs/reference/commands.md"))).collect();
    assert!(known.len() > 100, "{}", known.len());
    let pages = files("docs", &[".md"]).into_iter().chain([Path::new(ROOT).join("README.md")]);
    for file in pages {
        let page = prose(&text(&file));
        let ours = inline_code(&page)
            .filter(|code| code.starts_with("--") || code.starts_with("stickslip "));
        for option in ours.flat_map(options) {
            assert!(known.contains(&option), "{}: no --{option}", named(&file));
        }
    }
}

/// Pages are written for readers who have little time, and history is in the changelog.
#[test]
fn the_book_is_short_and_no_diary() {
    let made = ["commands.md", "documents.md", "parameters.md"];
    let mut words = 0;
    for folder in ["tutorials", "how-to", "reference", "explanation"] {
        for file in files(&format!("docs/{folder}"), &[".md"]) {
            if !made.iter().any(|name| file.ends_with(name)) {
                words += text(&file).split_whitespace().count();
            }
        }
    }
    assert!(words <= 24_000, "{words} words");
    let is_hash = |word: &&str| {
        (7..=40).contains(&word.len())
            && word.chars().all(|c| c.is_ascii_digit() || ('a'..='f').contains(&c))
            && word.contains(|c: char| c.is_ascii_digit())
            && word.contains(|c: char| c.is_ascii_lowercase())
    };
    for file in files("docs", &[".md"]) {
        let page = text(&file);
        let mut all = page.split(|c: char| !c.is_alphanumeric() && !"+-.".contains(c));
        assert_eq!(all.find(is_hash), None, "{}: a commit?", named(&file));
    }
}

/// Commands of a page with the lines that follow them.
fn commands(page: &str) -> Vec<(String, Vec<String>)> {
    let mut found: Vec<(String, Vec<String>)> = vec![];
    for block in page.split("```console\n").skip(1) {
        for line in block.split("```").next().unwrap().lines() {
            match (line.strip_prefix("$ "), found.last_mut()) {
                (Some(command), _) => found.push((command.into(), vec![])),
                // A command may go on after a backslash.
                (None, Some((command, _))) if command.ends_with('\\') => {
                    command.pop();
                    command.push_str(line.trim_start());
                }
                (None, Some((_, shown))) => shown.push(line.into()),
                (None, None) => panic!("{line:?} is the output of nothing"),
            }
        }
    }
    found
}

/// Numbers apart from what stands between them.
fn parts(line: &str) -> (Vec<f64>, String) {
    let is_number = |c: char| c.is_ascii_digit() || ".-+e".contains(c);
    let (mut numbers, mut rest) = (vec![], String::new());
    for token in line.split_inclusive(|c: char| !is_number(c)) {
        let text = token.trim_end_matches(|c: char| !is_number(c));
        match text.parse::<f64>() {
            Ok(number) => {
                numbers.push(number);
                rest.push_str(&token[text.len()..]);
            }
            Err(_) => rest.push_str(token),
        }
    }
    (numbers, rest)
}

/// Whether a line is like the one shown, in which "…" after digits stands for more digits, elsewhere for any text.
fn is_like(printed: &str, shown: &str) -> bool {
    if let Some((first, rest)) = shown.split_once('…') {
        let Some(left) = printed.strip_prefix(first) else { return false };
        let any = |c: char| {
            !first.ends_with(|c: char| c.is_ascii_digit()) || c.is_ascii_digit() || "e-".contains(c)
        };
        let ends = left.char_indices().map(|(i, c)| (i, any(c))).chain([(left.len(), false)]);
        return ends
            .scan(true, |goes_on, (i, more)| {
                let here = goes_on.then_some(i);
                *goes_on = more;
                here
            })
            .any(|i| is_like(&left[i..], rest));
    }
    let ((found, found_rest), (numbers, rest)) =
        (parts(without_time(printed)), parts(without_time(shown)));
    let close = |(a, b): (&f64, &f64)| (a - b).abs() <= 1e-9 * b.abs();
    found_rest == rest && found.len() == numbers.len() && found.iter().zip(&numbers).all(close)
}

/// A line without ", 2.1 ms" at its end.
fn without_time(line: &str) -> &str {
    match line.rsplit_once(", ") {
        Some((before, time)) if time.ends_with(" ms") || time.ends_with(" s") => before,
        _ => line,
    }
}

/// Whether a text consists of the lines shown, where "…" stands for any number of lines.
fn consists_of(printed: &[&str], shown: &[String]) -> bool {
    match shown.split_first() {
        None => printed.is_empty(),
        Some((first, rest)) if first.trim() == "…" => {
            (0..=printed.len()).any(|n| consists_of(&printed[n..], rest))
        }
        Some((first, rest)) => printed
            .split_first()
            .is_some_and(|(line, left)| is_like(line, first) && consists_of(left, rest)),
    }
}

/// A command as it acts on a terminal, where it answers in words unless something else is requested.
fn on_a_terminal(command: &str) -> String {
    const ANSWER: [&str; 9] = [
        "run",
        "stability",
        "boundary",
        "response",
        "compare",
        "cycle",
        "continue",
        "raster",
        "units",
    ];
    let mut words = command.split_whitespace();
    let is_ours = words.next() == Some("stickslip")
        && words.next().is_some_and(|name| ANSWER.contains(&name));
    let elsewhere = ["-o ", "--print ", "--format ", "|", ">", "--help", "--resume "];
    let plain = is_ours && !elsewhere.iter().any(|one| command.contains(one));
    format!("{{ {command}{}\n}} 2>&1", if plain { " --format text" } else { "" })
}

/// Runs the commands of the pages below a folder, those of one page in one folder.
fn run(pages: &[PathBuf]) -> usize {
    let bin = cargo_bin!("stickslip").parent().unwrap().to_path_buf();
    let path = format!("{}:{}", bin.display(), std::env::var("PATH").unwrap());
    let mut count = 0;
    for page in pages {
        let name = named(page);
        let folder = Folder::new(&format!("book_{}", name.replace(['/', '.'], "_")));
        symlink(Path::new(ROOT).join("examples"), folder.path("examples")).unwrap();
        for (command, shown) in commands(&text(page)) {
            let mut shell = Command::new("sh");
            shell.args(["-c", &on_a_terminal(&command)]).current_dir(folder.path(""));
            let output = shell.env("PATH", &path).output().unwrap();
            let printed = String::from_utf8_lossy(&output.stdout).into_owned();
            assert!(output.status.success(), "{name}: {command}\n{printed}");
            let lines: Vec<&str> = printed.lines().collect();
            assert!(
                consists_of(&lines, &shown),
                "{name}: {command}\nprints\n{printed}\nnot\n{}",
                shown.join("\n")
            );
            count += 1;
        }
    }
    count
}

#[test]
fn commands_of_the_readme() {
    assert!(run(&[Path::new(ROOT).join("README.md")]) >= 3);
}

#[test]
fn commands_of_the_tutorials() {
    assert!(run(&files("docs/tutorials", &[".md"])) >= 20);
}

#[test]
fn commands_of_the_how_to_pages() {
    assert!(run(&files("docs/how-to", &[".md"])) >= 20);
}

#[test]
fn commands_of_all_other_pages() {
    let mut pages = files("docs/explanation", &[".md"]);
    pages.extend(files("docs/reference", &[".md"]));
    pages.extend(files("docs/findings", &[".md"]));
    assert!(run(&pages) >= 5);
}

/// All that a reader is to type is run, but for what installs the program and what starts a cluster.
#[test]
fn no_command_is_left_out() {
    let pages = files("docs", &[".md"]).into_iter().chain([Path::new(ROOT).join("README.md")]);
    let makefile = text(&Path::new(ROOT).join("Makefile"));
    for file in pages {
        let page = text(&file);
        for block in page.split("```sh\n").skip(1) {
            for line in block.split("```").next().unwrap().lines() {
                assert!(
                    !line.contains("stickslip "),
                    "{}: {line} belongs into a console block",
                    named(&file)
                );
                if let Some(verb) = line.strip_prefix("make ") {
                    let verb = verb.split_whitespace().next().unwrap();
                    assert!(makefile.contains(&format!("\n{verb}:")), "{}: {line}", named(&file));
                }
            }
        }
    }
}

/// The judge itself.
#[test]
fn a_wrong_page_is_found() {
    let shown = |lines: &[&str]| lines.iter().map(|line| (*line).to_owned()).collect::<Vec<_>>();
    assert!(consists_of(&["a 1.0, 2 ms", "b", "c 3"], &shown(&["a 1.0, 3.1 ms", "…", "c 3"])));
    assert!(!consists_of(&["a 1.0"], &shown(&["a 1.1"])));
    assert!(
        consists_of(&["a 1.25,b"], &shown(&["a 1.2…,b"]))
            && !consists_of(&["a 1.25,b"], &shown(&["a 1.3…,b"]))
    );
    assert!(consists_of(&["into /a/b.jsonl"], &shown(&["into …/b.jsonl"])));
    assert!(!consists_of(&["a 1.2 and 7,b"], &shown(&["a 1.2…,b"])));
    assert!(!consists_of(&["a", "b"], &shown(&["a"])));
    assert_eq!(anchor("## 3. Friction, α"), "3-friction-α");
    assert_eq!(
        options("`run --alpha 1 --depth-limit`").collect::<Vec<_>>(),
        ["alpha", "depth-limit"]
    );
    let page = "```console\n$ a \\\n  b\nc\n```\n";
    assert_eq!(commands(page), [("a b".to_owned(), shown(&["c"]))]);
}
