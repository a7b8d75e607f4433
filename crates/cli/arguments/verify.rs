//! `stickslip verify`.

use clap::Args;
use std::path::PathBuf;

/// Repeat a saved run with another memory and a tighter tolerance: does it keep its promise?
///
/// Exit status 1 if l or the surface differ by more than the run's tolerance allows.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct VerifyArguments {
    /// Document that `stickslip run` wrote; `-` is standard input.
    #[arg(value_name = "RUN.json")]
    pub(crate) run: PathBuf,

    /// File to write, as JSON; `-` is standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-")]
    pub(crate) output: PathBuf,
}

const EXAMPLES: &str = "Example:
  stickslip run --alpha 1.2 --r 1 --kick 0.05 --until 200 -o run.json
  stickslip verify run.json";
