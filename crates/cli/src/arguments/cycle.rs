//! `stickslip cycle`.

use super::brief::Brief;
use super::{AnswerArguments, Options};
use clap::Args;
use std::path::PathBuf;
use stickslip::Cycle;

/// Compute the periodic motion at given α and r, and its stability, without simulating the transient.
///
/// Solves for the motion and its period simultaneously, for unstable cycles too. A Floquet multiplier is the factor
/// by which a small deviation changes in a period.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = EXAMPLES, brief())]
pub(crate) struct CycleArguments {
    #[command(flatten)]
    pub(crate) options: Options<Cycle>,

    /// Start from the cycle in a document of `stickslip cycle`, with its tip, r and α unless they are given; by
    /// default from the oscillation that bifurcates at αc or from a short run.
    #[arg(long, value_name = "CYCLE.json", help_heading = "Start", conflicts_with = "parameters")]
    pub(crate) from: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) answer: AnswerArguments,
}

const USAGE: &str = "stickslip cycle (--alpha <A> | --alpha-above <D>) --r <R> [OPTIONS]
       stickslip cycle --from <CYCLE.json> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  Just above onset, where a run would need thousands of time units to settle:
    stickslip cycle --alpha-above 1e-4 --r 1
  Stick-slip with slips at 37 r, drawn:
    stickslip cycle --tip gaussian --alpha 2.6 --r 1 -o cycle.json \\
        --plot cycle.svg
  The same a little further on:
    stickslip cycle --from cycle.json --alpha 2.61 -o next.json
  The wavelength in nm of an experiment, at any α:
    stickslip cycle --alpha 1.3 --r 1 --sigma 30nm \\
        --print physical.wavelength_nm";
