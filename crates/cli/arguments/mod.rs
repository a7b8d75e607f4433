//! What can be typed. Parsing only: values are judged where they are used.

mod model;
mod run;
mod surface;

pub(crate) use model::{ModelArguments, TipName};
pub(crate) use run::{MemoryName, RunArguments, StartName};
pub(crate) use surface::SurfaceArguments;

use crate::documents::SchemaName;
use clap::{Args, Parser, Subcommand};

/// Stick-slip of an AFM tip on a soft surface, from one closed delay equation.
///
/// A tip dragged over a soft surface carves it, and the groove pulls back on the tip: above a critical
/// indentation rate it sticks, slips and writes ripples. All quantities are dimensionless: lengths in
/// tip widths σ, times in Γ/k, forces in kσ, heights in kσ²/a.
#[derive(Debug, Parser)]
#[command(name = "stickslip", version, after_help = EXAMPLES)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXAMPLES: &str = "Examples:
  stickslip run --alpha-above 0.01 --r 1 --kick 0.01 --until 457 -o run.json --plot run.svg
  stickslip surface run.json --at 457 --range -5,460 --spacing 0.02 -o surface.csv
  stickslip schema run

`stickslip COMMAND --help` explains each command and gives examples.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Run(RunArguments),
    Surface(SurfaceArguments),
    Schema(SchemaArguments),
}

/// Print the JSON Schema of a document.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  stickslip schema run > run.schema.json")]
pub(crate) struct SchemaArguments {
    /// Kind of document.
    #[arg(value_enum)]
    pub(crate) name: SchemaName,
}
