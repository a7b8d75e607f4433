//! Are the generated pages of docs/reference up to date?
//!
//! Judge: the program, by `--help` of each command and `schema` of each document. Where they differ, `make reference` writes
//! the pages anew.

use crate::folder::Folder;
use serde_json::Value;
use std::fmt::Write;
use std::path::PathBuf;
use std::{env, fs};

/// Set by `make reference`.
const WRITES: &str = "STICKSLIP_WRITE_REFERENCE";

const MADE: &str = "<!-- Made by `make reference`: do not edit. -->\n";

/// Compares a page with what it should contain, or writes it.
#[track_caller]
fn is_up_to_date(name: &str, page: &str) {
    let path = format!("{}/../../docs/reference/{name}", env!("CARGO_MANIFEST_DIR"));
    if env::var_os(WRITES).is_some() {
        fs::write(path, page).unwrap();
        return;
    }
    let written = fs::read_to_string(path).unwrap_or_default();
    let differs = written.lines().zip(page.lines()).find(|(old, new)| old != new);
    assert!(written == page, "docs/reference/{name} is stale: make reference\n{differs:?}");
}

/// The schemas and the tables of parameters in files are those of the types.
#[test]
fn schemas_are_those_of_the_types() {
    let folder = format!("{}/../stickslip/schemas", env!("CARGO_MANIFEST_DIR"));
    let mut known = vec![];
    for (name, text) in stickslip::derived() {
        let path = PathBuf::from(format!("{folder}/{name}"));
        if env::var_os(WRITES).is_some() {
            fs::write(&path, text).unwrap();
        } else {
            let written = fs::read_to_string(&path).unwrap_or_default();
            assert!(written == text, "crates/stickslip/schemas/{name} is stale: make reference");
        }
        known.push(path);
    }
    for part in ["documents", "parameters"] {
        for file in fs::read_dir(format!("{folder}/{part}")).unwrap() {
            let path = file.unwrap().path();
            assert!(known.contains(&path), "{} is of no type", path.display());
        }
    }
}

/// What `stickslip WORDS --help` prints.
fn help(folder: &Folder, words: &str) -> String {
    let mut command = folder.command(&format!("{words} --help"));
    let output = command.env("COLUMNS", "100").output().unwrap();
    assert!(output.status.success(), "{words}");
    String::from_utf8(output.stdout).unwrap()
}

/// Names below `Commands:` of a help page.
fn commands(help: &str) -> Vec<&str> {
    let below = help.lines().skip_while(|line| *line != "Commands:").skip(1);
    let lines = below.take_while(|line| line.starts_with("  "));
    let names = lines
        .filter(|line| !line.starts_with("   "))
        .filter_map(|line| line.split_whitespace().next());
    names.filter(|name| *name != "help").collect()
}

#[test]
fn the_page_of_commands() {
    let folder = Folder::new("reference_commands");
    let all = help(&folder, "");
    let mut page = format!(
        "# Commands\n\n{MADE}\nWhat `stickslip COMMAND --help` prints; `-h` prints a summary. What each parameter is \
         called in documents and in Python: [parameters](parameters.md).\n"
    );
    for name in commands(&all) {
        let described =
            |line: &str| line.split_whitespace().next() == Some(name) && line.trim() != name;
        assert!(all.lines().any(described), "{name} has no description in the list of commands");
        let text = help(&folder, name);
        write!(page, "\n## {name}\n\n```text\n{}\n```\n", text.trim_end()).unwrap();
        for below in commands(&text) {
            let text = help(&folder, &format!("{name} {below}"));
            write!(page, "\n### {name} {below}\n\n```text\n{}\n```\n", text.trim_end()).unwrap();
        }
    }
    is_up_to_date("commands.md", &page);
}

/// The short help fits on two screens, and names the long one, which has all options.
#[test]
fn short_help_is_short() {
    let folder = Folder::new("short_help");
    for name in commands(&help(&folder, "")) {
        let mut command = folder.command(&format!("{name} -h"));
        let output = command.env("COLUMNS", "100").output().unwrap();
        let short = String::from_utf8(output.stdout).unwrap();
        let long = help(&folder, name);
        let options = |text: &str| {
            let own = |line: &&str| {
                line.trim_start().starts_with('-')
                    && line.starts_with("  ")
                    && !line.starts_with("       ")
            };
            let name = |line: &str| {
                Some(line.split_whitespace().find(|word| word.starts_with("--"))?.to_owned())
            };
            text.lines().filter(own).filter_map(name).collect::<Vec<String>>()
        };
        let (few, all) = (options(&short), options(&long));
        assert!(few.iter().all(|option| all.contains(option)), "{name}: {few:?}");
        assert_eq!(few.len() < all.len(), short.contains("more option"), "{name}");
        let lines = short.lines().count();
        println!("{name}: {lines} lines, {} of {} options", few.len(), all.len());
        assert!(lines <= 95, "{name}: {lines} lines");
    }
}

/// Names of all schemas, as `schema --help` lists them.
fn schemas(folder: &Folder) -> Vec<(String, Value)> {
    let text = help(folder, "schema");
    let names = text.split_once("[possible values: ").unwrap().1.split_once(']').unwrap().0;
    let names = names.split(',').map(|name| name.split_whitespace().collect::<String>());
    names.map(|name| (name.clone(), folder.prints_json(&format!("schema {name}")))).collect()
}

/// A description in one cell of a table.
fn cell(text: &Value) -> String {
    let text = text.as_str().unwrap_or_default();
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

/// A property's own schema, what it refers to, and whether it may be null.
struct Found<'a> {
    schema: &'a Value,
    is_list: bool,
    nullable: bool,
}

/// Follows `$ref`, `anyOf` with null, and lists.
fn followed<'a>(property: &'a Value, whole: &'a Value) -> Found<'a> {
    let mut found = Found { schema: property, is_list: false, nullable: false };
    loop {
        let here = found.schema;
        if let Some(name) = here["$ref"].as_str() {
            found.schema = &whole["$defs"][name.rsplit('/').next().unwrap()];
        } else if let Some(several) = here["anyOf"].as_array()
            && let [one, null] = &several[..]
            && null["type"] == "null"
        {
            found.schema = one;
            found.nullable = true;
        } else if is(here, "array") && !found.is_list && here["items"].is_object() {
            found.nullable |= is(here, "null");
            found.is_list = true;
            found.schema = &here["items"];
        } else {
            found.nullable |= is(here, "null");
            return found;
        }
    }
}

fn is(schema: &Value, kind: &str) -> bool {
    match &schema["type"] {
        Value::String(one) => one == kind,
        Value::Array(several) => several.iter().any(|one| one == kind),
        _ => false,
    }
}

/// The kind of a value in words, such as "list of numbers or null".
fn kind(found: &Found) -> String {
    let names = ["number", "integer", "boolean", "string", "object", "array"];
    let name = match found.schema {
        schema if names_of(schema).is_some() => "name",
        schema => match names.into_iter().find(|name| is(schema, name)) {
            Some("boolean") => "true or false",
            Some("string") => "text",
            Some("array") => "list",
            Some(name) => name,
            None => "one of several",
        },
    };
    let list = if found.is_list { format!("list: {name}") } else { name.to_owned() };
    if found.nullable { format!("{list}, or null") } else { list }
}

/// The names that a value may have, with their meanings.
fn names_of(schema: &Value) -> Option<String> {
    if let Some(names) = schema["enum"].as_array() {
        let names = names.iter().filter_map(Value::as_str).map(|name| format!("`{name}`"));
        return Some(names.collect::<Vec<_>>().join(", "));
    }
    let several = schema["oneOf"].as_array()?;
    let names = several.iter().map(|one| {
        let name = one["const"].as_str()?;
        Some(format!("`{name}`: {}", cell(&one["description"]).trim_end_matches('.')))
    });
    Some(names.collect::<Option<Vec<_>>>()?.join("; "))
}

/// Rows for the fields of an object, and of the objects in it.
fn rows(
    page: &mut String,
    prefix: &str,
    schema: &Value,
    whole: &Value,
    skipped: &[&str],
    above: &[&Value],
) {
    for (name, property) in schema["properties"].as_object().into_iter().flatten() {
        if skipped.contains(&name.as_str()) {
            continue;
        }
        let found = followed(property, whole);
        let own = &property["description"];
        let mut text = cell(if own.is_null() { &found.schema["description"] } else { own });
        if let Some(names) = names_of(found.schema) {
            write!(text, " {names}").unwrap();
        }
        let list = if found.is_list { "[]" } else { "" };
        writeln!(page, "| `{prefix}{name}` | {} | {} |", kind(&found), text.trim()).unwrap();
        // Trees end where a type contains itself.
        if !above.contains(&found.schema) {
            let above = [above, &[found.schema]].concat();
            rows(page, &format!("{prefix}{name}{list}."), found.schema, whole, &[], &above);
        }
    }
}

const TABLE: &str = "\n| field | value | contents |\n|---|---|---|\n";

#[test]
fn the_page_of_documents() {
    let folder = Folder::new("reference_documents");
    let envelope = ["format", "format_version", "software", "parameters", "remarks", "physical"];
    let mut page = format!(
        "# Documents\n\n{MADE}\nThe fields of every document, from the schemas that `stickslip schema NAME` prints. \
         `roots[].re` is the field `re` of each entry of the list `roots`.\n\nEvery document contains `format` (its name), \
         `format_version`, `software` (program and version), `parameters` (the question, which `--parameters` reads: see \
         [parameters](parameters.md)), and, unless its table says otherwise, `remarks` (warnings) and `physical` (the numbers of \
         the answer in nm, s and nN, if scales were given).\n"
    );
    for (name, schema) in schemas(&folder) {
        writeln!(page, "\n## {name}").unwrap();
        for one in schema["anyOf"].as_array().into_iter().flatten() {
            let found = followed(one, &schema);
            write!(page, "\n{}\n{TABLE}", cell(&found.schema["description"])).unwrap();
            rows(&mut page, "", found.schema, &schema, &envelope, &[]);
        }
        if schema["properties"].is_object() {
            page.push_str(TABLE);
            rows(&mut page, "", &schema, &schema, &envelope, &[]);
        }
    }
    is_up_to_date("documents.md", &page);
}

/// One parameter as some of the questions declare it.
struct Row {
    group: String,
    name: String,
    symbol: String,
    text: String,
    questions: Vec<String>,
}

#[test]
fn the_page_of_parameters() {
    let folder = Folder::new("reference_parameters");
    let mut all: Vec<Row> = vec![];
    for (question, schema) in schemas(&folder) {
        // These contain the question of a run or a raster.
        if ["verify", "compare", "raster-compare", "raster-surface"].contains(&question.as_str()) {
            continue;
        }
        let declared = followed(&schema["properties"]["parameters"], &schema).schema;
        let mut properties: Vec<_> =
            declared["properties"].as_object().into_iter().flatten().collect();
        properties.sort_by_key(|(_, property)| property["x-option"]["place"].as_u64());
        for (name, property) in properties {
            let Some(option) = property["x-option"].as_object() else { continue };
            let mut text = cell(&property["description"]);
            if let Some(default) =
                property.get("default").filter(|value| value.is_number() || value.is_string())
            {
                write!(text, " Default: {}.", default.to_string().trim_matches('"')).unwrap();
            }
            let group = option["group"].as_str().unwrap_or_default().to_owned();
            match all
                .iter_mut()
                .find(|row| row.name == *name && row.text == text && row.group == group)
            {
                Some(row) => row.questions.push(question.clone()),
                None => {
                    let row = Row {
                        group,
                        name: name.clone(),
                        symbol: option["symbol"].as_str().unwrap_or_default().to_owned(),
                        text,
                        questions: vec![question.clone()],
                    };
                    // Rows of one name are neighbours.
                    let alike = |other: &Row| other.name == row.name && other.group == row.group;
                    let place = all.iter().rposition(alike).map_or(all.len(), |last| last + 1);
                    all.insert(place, row);
                }
            }
        }
    }
    let mut groups: Vec<&str> = vec![];
    all.iter().for_each(|row| {
        if !groups.contains(&row.group.as_str()) {
            groups.push(&row.group)
        }
    });
    let mut page = format!(
        "# Parameters\n\n{MADE}\nEach parameter has one name: the option `--depth-limit` is the keyword `depth_limit` in Python \
         and the field `depth_limit` in `parameters` of a document. The last column names the documents whose questions have it. \
         Parameters of sweeps, fits, tips, units and figures: [commands](commands.md).\n"
    );
    for group in groups {
        let group_name = if group.is_empty() { "Other" } else { group };
        write!(page, "\n## {group_name}\n\n| option | value | meaning | in |\n|---|---|---|---|\n")
            .unwrap();
        for row in all.iter().filter(|row| row.group == group) {
            let option = row.name.replace('_', "-");
            let symbol =
                if row.symbol.is_empty() { String::new() } else { format!("`{}`", row.symbol) };
            writeln!(
                page,
                "| `--{option}` | {symbol} | {} | {} |",
                row.text,
                row.questions.join(", ")
            )
            .unwrap();
        }
    }
    is_up_to_date("parameters.md", &page);
}
