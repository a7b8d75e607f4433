//! `stickslip sweep`.

use super::brief::Brief;
use super::named::named;
use super::range::Range;
use super::raster_sweep::RasterSweepArguments;
use super::{AnswerArguments, Options, Questions, WorkArguments};
use clap::{Args, Subcommand};
use std::path::PathBuf;
use stickslip::parameter::{Parameter, parameters};
use stickslip::{Sweep, TipName};

/// Find the motion that the tip settles into, over a grid of α, r and any other parameter of the model or of the
/// initial condition.
///
/// Each point is computed independently of the others: below αc the steady motion, above it the stable cycle, and if
/// none is found the result of a run. With --until each point is a run from the given initial condition; if seeds
/// vary, the document contains the statistics of each ensemble. Finished points are saved immediately beside the
/// output (FILE.partial): after an interrupt the same command resumes from there.
#[derive(Debug, Args)]
#[command(
    override_usage = USAGE, after_help = EXAMPLES,
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true,
    mut_arg("plot", |plot| plot.help(PLOT)),
    brief()
)]
pub(crate) struct SweepArguments {
    #[command(subcommand)]
    pub(crate) then: Option<SweepThen>,

    /// Footprint f(x) of the tip [default: triple-gaussian].
    #[arg(long, value_parser = named::<TipName>(), value_name = "NAME", help_heading = "Model")]
    pub(crate) tip: Option<TipName>,

    /// Side-lobe weight β of the triple Gaussian: a RANGE is V, LO:HI:N or V1,V2,… [default: 1].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) beta: Option<Range>,

    /// Width of either Gaussian: f(x/W) [default: 1].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) width: Option<Range>,

    /// Footprint from a file, as for `stickslip run`.
    #[arg(long, value_name = "FILE", help_heading = "Model")]
    pub(crate) tip_file: Option<PathBuf>,

    /// Take f(-x) of the tip file, as for `stickslip run`.
    #[arg(long, requires = "tip_file", help_heading = "Model")]
    pub(crate) retrace: bool,

    #[command(flatten)]
    pub(crate) options: Options<Swept>,

    #[command(flatten)]
    pub(crate) work: WorkArguments,

    #[command(flatten)]
    pub(crate) answer: AnswerArguments,
}

const PLOT: &str = "Draw the phase diagram or, if a single parameter varies, amplitude and period over it, to this .svg, \
                    .png or .pdf. Points without these, such as steady and trapped ones, are marked at the foot";

/// The parameters of a sweep, which are those of no document: documents of sweeps list all values of each parameter.
#[derive(Debug)]
pub(crate) struct Swept;

impl Questions for Swept {
    fn parameters() -> Vec<&'static Parameter> {
        parameters::<Sweep>().iter().collect()
    }

    fn formats() -> Vec<&'static str> {
        vec![]
    }
}

/// Each with its line in the list of commands, as in [`Command`](super::Command).
#[derive(Debug, Subcommand)]
#[command(defer = true)]
pub(crate) enum SweepThen {
    /// Combine the parts of a sweep: the result is byte for byte that of one sweep over all points.
    Merge(Box<MergeArguments>),
    /// Compute the pattern of a raster over a grid of pitch and α.
    Raster(Box<RasterSweepArguments>),
}

/// Combine the parts of a sweep: the result is byte for byte that of one sweep over all points.
#[derive(Debug, Args)]
#[command(
    after_help = "Example:\n  stickslip sweep merge part-*.json -o map.json --plot map.svg",
    mut_arg("plot", |plot| plot.help("Draw the result, as for `sweep`"))
)]
pub(crate) struct MergeArguments {
    /// Documents of `stickslip sweep --shard`, or of `stickslip sweep raster --shard`, in any order.
    #[arg(value_name = "PART.json", required = true)]
    pub(crate) parts: Vec<PathBuf>,

    #[command(flatten)]
    pub(crate) answer: AnswerArguments,
}

const USAGE: &str =
    "stickslip sweep --r <RANGE> (--alpha <RANGE> | --alpha-above <RANGE>) [OPTIONS]
       stickslip sweep merge <PART.json>... [OPTIONS]
       stickslip sweep raster --r <R> --pitch <RANGE> --alpha <RANGE>
           --lines <N> --length <X> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  The amplitude of stick-slip over α:
    stickslip sweep --r 1 --alpha 1.07:2:100 -o amplitude.json \\
        --plot amplitude.svg
  A phase diagram, and where steady motion ends in it:
    stickslip sweep --r 0.1:2:100 --alpha 0.05:4:100 -o map.json \\
        --plot map.png
  With a depth limit no tip is trapped:
    stickslip sweep --beta 0 --r 1 --alpha 2:12:51 --depth-limit 5 \\
        -o limited.json --plot limited.svg
  A hundred runs, each from its own noise, and their statistics:
    stickslip sweep --alpha 1.2 --r 1 --noise 1e-3 --seed 1:100:100 \\
        --until 200 -o ensemble.json
  A phase diagram on four machines:
    stickslip sweep --r 0.1:2:100 --alpha 0.05:4:100 --shard 1/4 \\
        -o part-1.json
    stickslip sweep merge part-1.json part-2.json part-3.json part-4.json \\
        -o map.json";
