//! Commands and options of the program.

use pyo3::prelude::*;
use stickslip_cli::hosted;

/// An option: name, whether it is positional, placeholder of its value (None for a switch), delimiter, whether it may be
/// repeated, and help.
type Described = (String, bool, Option<String>, Option<char>, bool, String);

/// The options of a command or subcommand; None if there is no command of that name.
#[pyfunction]
pub(crate) fn options(path: Vec<String>) -> Option<Vec<Described>> {
    let path: Vec<&str> = path.iter().map(String::as_str).collect();
    let found = hosted::options(&path)?.into_iter();
    let found = found
        .map(|o| (o.name, o.is_positional, o.value, o.delimiter, o.is_repeatable, o.help))
        .collect();
    Some(found)
}

/// The commands, each with a description.
#[pyfunction]
pub(crate) fn commands() -> Vec<(String, String)> {
    hosted::commands()
}
