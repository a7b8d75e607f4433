//! What the program tells of itself: its commands and their options.

use pyo3::prelude::*;
use stickslip_cli::hosted;

/// Name, whether it stands without one, what stands for its value (None: a switch), delimiter, whether it may be
/// repeated, and its help.
type Described = (String, bool, Option<String>, Option<char>, bool, String);

/// The options of a command, or of one below it; None where there is none of that name.
#[pyfunction]
pub(crate) fn options(path: Vec<String>) -> Option<Vec<Described>> {
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    let found = hosted::options(&path)?.into_iter();
    let found = found
        .map(|o| (o.name, o.is_positional, o.value, o.delimiter, o.is_repeatable, o.help))
        .collect();
    Some(found)
}

/// The commands, and what each does.
#[pyfunction]
pub(crate) fn commands() -> Vec<(String, String)> {
    hosted::commands()
}
