//! Where a result goes, and how: the options of every command that has one.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// What is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// A few aligned lines for a person, what there is by default on a terminal.
    Text,
    /// The whole document.
    Json,
    /// Its columns.
    Csv,
    /// Its arrays, for NumPy.
    Npz,
}

#[derive(Debug, Clone, Args)]
pub(crate) struct OutletArguments {
    /// File to write, as its extension says: .json for all, .csv or .npz for the columns; `-` is standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-", help_heading = "Output")]
    pub(crate) output: PathBuf,

    /// What is written, whatever the name of the file [default: by its extension; on standard output text for a
    /// terminal, else json].
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = "Output")]
    pub(crate) format: Option<Format>,

    #[command(flatten)]
    pub(crate) fields: FieldArguments,
}

#[derive(Debug, Clone, Default, Args)]
pub(crate) struct FieldArguments {
    /// Print this field of the document, such as parameters.alpha, or period where one field alone ends so: a line each,
    /// in place of the document on standard output; repeatable.
    #[arg(long, value_name = "FIELD", help_heading = "Output")]
    pub(crate) print: Vec<String>,
}
