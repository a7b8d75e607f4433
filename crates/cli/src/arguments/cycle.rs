//! `stickslip cycle`.

use super::examples::examples;
use super::{InUnitsArguments, ModelArguments, OutletArguments};
use clap::Args;
use std::path::PathBuf;

/// How a cycle is asked for, of the commands that need one to begin with.
#[derive(Debug, Clone, Args)]
pub(crate) struct CycleStart {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Start from the cycle in a document of `stickslip cycle` or from its tip, r and α where they are not
    /// given; without it, from the oscillation born at αc or from a short run.
    #[arg(long, value_name = "CYCLE.json", help_heading = "Start")]
    pub(crate) from: Option<PathBuf>,

    /// Largest residual that the equation of motion (18) may have at any time, in units of kσ/Γ; from
    /// 1e-11 to 1e-4.
    #[arg(
        long,
        value_name = "E",
        default_value = "1e-9",
        allow_hyphen_values = true,
        help_heading = "Accuracy"
    )]
    pub(crate) tolerance: f64,
}

/// The periodic motion at given α and r, and its stability, without waiting for it.
///
/// Solves for the motion and its period at once; unstable cycles are as good as stable ones. A Floquet
/// multiplier says by how much a small deviation grows in a period.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = examples(EXAMPLES))]
pub(crate) struct CycleArguments {
    #[command(flatten)]
    pub(crate) start: CycleStart,

    /// Intervals of the profile, about, and not fewer. They are uneven in time: each step of the cycle's mesh, short
    /// where the motion is fast, is divided evenly, in two at least.
    #[arg(long, value_name = "N", default_value_t = 400, help_heading = "Output")]
    pub(crate) points: usize,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw l(t), the tip's velocity and the ripple left behind to this .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const USAGE: &str = "stickslip cycle (--alpha <A> | --alpha-above <D>) --r <R> [OPTIONS]
       stickslip cycle --from <CYCLE.json> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  Just above onset, where a run would need thousands of time units to settle:
    stickslip cycle --alpha-above 1e-4 --r 1
  Stick-slip with slips at 37 r, drawn:
    stickslip cycle --tip gaussian --alpha 2.6 --r 1 -o cycle.json --plot cycle.svg
  The same a little further on:
    stickslip cycle --from cycle.json --alpha 2.61 -o next.json
  The wavelength in nm of an experiment, at any α:
    stickslip cycle --alpha 1.3 --r 1 --sigma 30nm --print physical.wavelength_nm";
