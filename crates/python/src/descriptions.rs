//! What the program tells of itself: its commands and their options; and numbers as it reads them.

use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use std::fmt::Write;
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

/// Columns as the text of a table: shortest digits, which are read back to the last bit, and NaN for what is missing.
/// Every number has a point or an exponent, so that a semicolon is all that separates two.
#[pyfunction]
pub(crate) fn csv(py: Python<'_>, columns: Vec<PyReadonlyArray1<'_, f64>>) -> String {
    let columns: Vec<Vec<f64>> = columns.iter().map(|c| c.as_array().to_vec()).collect();
    py.detach(|| {
        let rows = columns.iter().map(Vec::len).min().unwrap_or(0);
        let mut text = String::with_capacity(20 * rows * columns.len());
        for row in 0..rows {
            for (i, column) in columns.iter().enumerate() {
                let separator = if i > 0 { ";" } else { "" };
                // A String takes all that is written to it.
                write!(text, "{separator}{:?}", column[row]).ok();
            }
            text.push('\n');
        }
        text
    })
}
