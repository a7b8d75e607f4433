//! `stickslip continue`.

use super::examples::examples;
use super::named::named;
use super::{CycleStart, InUnitsArguments, OutletArguments};
use clap::Args;
use std::path::PathBuf;
use stickslip::OverName;

/// A branch of cycles in α or r, stable or not, with the points where something happens to it.
///
/// Begins at the cycle of the α and r given, or of --from; where the one that varies is not given, at the
/// onset of oscillation. Goes through folds, and ends at --to, in steady motion, where it joins a branch of half
/// the period, or where the period exceeds --longest-period: towards trapping it has no bound.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = examples(EXAMPLES))]
pub(crate) struct ContinueArguments {
    #[command(flatten)]
    pub(crate) start: CycleStart,

    /// What varies.
    #[arg(long, value_parser = named::<OverName>(), value_name = "NAME", help_heading = "Branch")]
    pub(crate) over: OverName,

    /// Its last value [default: none, the branch ends otherwise].
    #[arg(long, value_name = "V", allow_hyphen_values = true, help_heading = "Branch")]
    pub(crate) to: Option<f64>,

    /// Follow the branches of twice the period too, from each period doubling.
    #[arg(long, help_heading = "Branch")]
    pub(crate) switch: bool,

    /// The branch ends where the period is longer than this, in Γ/k.
    #[arg(
        long,
        value_name = "T",
        default_value_t = 300.0,
        allow_hyphen_values = true,
        help_heading = "Branch"
    )]
    pub(crate) longest_period: f64,

    /// Longest step from one cycle to the next, in relative changes of parameter, period and l.
    #[arg(
        long,
        value_name = "S",
        default_value_t = 0.05,
        allow_hyphen_values = true,
        help_heading = "Branch"
    )]
    pub(crate) longest_step: f64,

    /// Each branch ends with this many cycles.
    #[arg(long, value_name = "N", default_value_t = 2000, help_heading = "Branch")]
    pub(crate) most_points: usize,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw amplitude and period over what varies, stable cycles solid and unstable ones dashed, to this .svg
    /// or .png; by their logarithm where they become large.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const USAGE: &str = "stickslip continue --over alpha --r <R> [OPTIONS]
       stickslip continue --over r --alpha <A> [OPTIONS]
       stickslip continue --over <NAME> --from <CYCLE.json> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  From onset through the period doubling and back, drawn:
    stickslip continue --r 1 --over alpha --to 1.88 --switch -o branches.json --plot branches.svg
  As far as there are cycles, towards trapping:
    stickslip continue --r 1 --over alpha -o branch.csv
  In r, from a cycle that is known:
    stickslip cycle --alpha 1.3 --r 1 -o cycle.json
    stickslip continue --from cycle.json --over r --to 0.9 -o branch.json";
