//! Output options of every command that answers a question.

use super::{InUnitsArguments, OutletArguments};
use clap::Args;
use std::path::PathBuf;

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
