//! `stickslip continue`.

use super::brief::Brief;
use super::{AnswerArguments, Options};
use clap::Args;
use std::path::PathBuf;
use stickslip::Continue;

/// Follow a branch of cycles in α or r, stable or not, and find its special points.
///
/// The branch begins at the cycle of the given α and r, or of --from; if the continuation parameter is not given, at
/// the onset of oscillation. It continues through folds, and ends at --to, in steady motion, at a branch of half the
/// period, or where the period exceeds --longest-period: towards trapping the period has no bound.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = EXAMPLES, brief())]
pub(crate) struct ContinueArguments {
    #[command(flatten)]
    pub(crate) options: Options<Continue>,

    /// Begin with the cycle in a document of `stickslip cycle`, with its tip, r and α unless they are given.
    #[arg(long, value_name = "CYCLE.json", help_heading = "Start", conflicts_with = "parameters")]
    pub(crate) from: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) answer: AnswerArguments,
}

const USAGE: &str = "stickslip continue --over alpha --r <R> [OPTIONS]
       stickslip continue --over r --alpha <A> [OPTIONS]
       stickslip continue --over <NAME> --from <CYCLE.json> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  From onset through the period doubling and back, drawn:
    stickslip continue --r 1 --over alpha --to 1.88 --switch \\
        -o branches.json --plot branches.svg
  As far as there are cycles, towards trapping:
    stickslip continue --r 1 --over alpha -o branch.csv
  In r, from a cycle that is known:
    stickslip cycle --alpha 1.3 --r 1 -o cycle.json
    stickslip continue --from cycle.json --over r --to 0.9 -o branch.json";
