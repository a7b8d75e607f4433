//! Output options: file and format of a result, physical units, and a picture.

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
    /// Print this field, such as parameters.alpha, or only its end, such as period, if no other field ends so; repeatable.
    /// Each field is a line, in place of the document on standard output.
    #[arg(long, value_name = "FIELD", help_heading = "Output")]
    pub(crate) print: Vec<String>,
}

#[derive(Debug, Clone, Args)]
pub(crate) struct AnswerArguments {
    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw the answer to this .svg, .png or .pdf, as `stickslip plot` does.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

/// Options of every command with results in nm, s and nN.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Physical units")]
pub(crate) struct InUnitsArguments {
    /// Also report the result in nm, s and nN, with the scales in a document of `stickslip units`, `tip` or `fit`, or
    /// in any document with physical units; its α and r do not matter. Options then take quantities, such as --until 2s; a
    /// number without a unit is one of the model, with or without scales.
    ///
    /// Tables and pictures are in these units, and their columns and axes are named accordingly (x0_nm); in a JSON
    /// document `physical` contains them in addition to the dimensionless numbers.
    #[arg(
        long,
        value_name = "UNITS.json",
        conflicts_with_all = ["sigma", "stiffness", "damping", "velocity", "slope_force"]
    )]
    pub(crate) units: Option<PathBuf>,

    /// Width σ of the tip, such as 30nm: lengths are reported in nm. Default: that of a --tip-file written by
    /// `stickslip tip`.
    #[arg(long, value_name = "σ", visible_alias = "tip-width", allow_hyphen_values = true)]
    pub(crate) sigma: Option<String>,

    /// Spring constant k, such as 0.2N/m: with σ forces are reported in nN.
    #[arg(long, value_name = "k", allow_hyphen_values = true)]
    pub(crate) stiffness: Option<String>,

    /// Friction Γ of the tip, such as 3mNs/m: with k times are reported in s.
    #[arg(long, value_name = "Γ", allow_hyphen_values = true)]
    pub(crate) damping: Option<String>,

    /// Velocity v0 of the support, such as 1um/s: with σ and r times are reported in s, instead of Γ.
    #[arg(long, value_name = "v0", allow_hyphen_values = true)]
    pub(crate) velocity: Option<String>,

    /// Force a per slope of the surface, such as 5nN: with k and σ heights are reported in nm.
    #[arg(long, value_name = "a", allow_hyphen_values = true)]
    pub(crate) slope_force: Option<String>,
}
