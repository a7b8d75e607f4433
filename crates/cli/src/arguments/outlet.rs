//! Output options: file and format of a result.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Output formats.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Format {
    /// A few aligned lines; the default on a terminal.
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
    /// File to write, with the format given by its extension: .json for the document, .csv or .npz for the columns;
    /// `-` is standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-", help_heading = "Output")]
    pub(crate) output: PathBuf,

    /// Output format, independent of the file name [default: by its extension; on standard output text for a
    /// terminal, else json].
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = "Output")]
    pub(crate) format: Option<Format>,

    #[command(flatten)]
    pub(crate) fields: FieldArguments,
}

#[derive(Debug, Clone, Default, Args)]
pub(crate) struct FieldArguments {
    /// Print this field of the document, such as parameters.alpha, or period if only one field ends so: one line
    /// each, instead of the document on standard output; repeatable.
    #[arg(long, value_name = "FIELD", help_heading = "Output")]
    pub(crate) print: Vec<String>,
}
