//! `stickslip sweep`.

use super::examples::examples;
use super::named::named;
use super::range::Range;
use super::raster_sweep::RasterSweepArguments;
use super::shard::Shard;
use super::sweep_start::SweepRunArguments;
use super::{InUnitsArguments, OutletArguments};
use clap::{Args, Subcommand};
use std::path::PathBuf;
use stickslip::TipName;

/// Find the motion that the tip settles into, over a grid of α, r and any other parameter of the model or of the
/// initial condition.
///
/// Each point is computed independently of the others: below αc the steady motion, above it the stable cycle, and if
/// none is found the result of a run. With --until each point is a run from the given initial condition; if seeds
/// vary, the document contains the statistics of each ensemble. Finished points are saved immediately beside the
/// output (FILE.partial): after an interrupt the same command resumes from there.
#[derive(Debug, Args)]
#[command(
    override_usage = USAGE, after_help = examples(EXAMPLES),
    args_conflicts_with_subcommands = true,
    subcommand_negates_reqs = true
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

    /// Support velocities.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) r: Option<Range>,

    /// Indentation rates.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) alpha: Option<Range>,

    /// Indentation rates as αc(r) + D.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) alpha_above: Option<Range>,

    #[command(flatten)]
    pub(crate) wider: WiderRanges,

    #[command(flatten)]
    pub(crate) run: SweepRunArguments,

    /// Largest residual of the equation of motion (18) on a cycle, in units of kσ/Γ; or error of a run, in σ; from
    /// 1e-11 to 1e-4.
    #[arg(
        long,
        value_name = "E",
        default_value = "1e-9",
        allow_hyphen_values = true,
        help_heading = "Accuracy"
    )]
    pub(crate) tolerance: f64,

    /// Number of points computed in parallel [default: the number of cores].
    #[arg(long, value_name = "N", help_heading = "Work")]
    pub(crate) threads: Option<usize>,

    /// Compute only part I of N of the points; `stickslip sweep merge` combines the parts. `slurm`: the part of this
    /// task of an array job whose numbers begin at 1, by SLURM_ARRAY_TASK_ID and SLURM_ARRAY_TASK_COUNT; slurm/N if
    /// the array contains only some of N parts.
    #[arg(long, value_name = "I/N", help_heading = "Work")]
    pub(crate) shard: Option<Shard>,

    /// Do nothing if --output is already this sweep, complete and of this version; replace it if it is another.
    #[arg(long, conflicts_with = "plot", help_heading = "Work")]
    pub(crate) if_needed: bool,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw the phase diagram, or with a single parameter varied the amplitude and period over it, to this .svg or
    /// .png. Points with neither, such as steady and trapped ones, are marked at the foot.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

/// Options of the extended model, each a range.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Extended model")]
pub(crate) struct WiderRanges {
    /// Depth limit b of (61), in kσ²/a; above 0 [default: none].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(crate) depth_limit: Option<Range>,

    /// Healing time of the surface, in Γ/k; above 0 [default: never].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(crate) healing_time: Option<Range>,

    /// Inertia of the tip, in Γ²/k; above 0 [default: none].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true)]
    pub(crate) inertia: Option<Range>,

    /// Not available in `sweep`.
    #[arg(long)]
    pub(crate) no_spring: bool,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SweepThen {
    Merge(Box<MergeArguments>),
    Raster(Box<RasterSweepArguments>),
}

/// Combine the parts of a sweep: the result is byte for byte that of one sweep over all points.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  stickslip sweep merge part-*.json -o map.json --plot map.svg")]
pub(crate) struct MergeArguments {
    /// Documents of `stickslip sweep --shard`, or of `stickslip sweep raster --shard`, in any order.
    #[arg(value_name = "PART.json", required = true)]
    pub(crate) parts: Vec<PathBuf>,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw the result, as for `sweep`.
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
}

const USAGE: &str =
    "stickslip sweep --r <RANGE> (--alpha <RANGE> | --alpha-above <RANGE>) [OPTIONS]
       stickslip sweep merge <PART.json>... [OPTIONS]
       stickslip sweep raster --r <R> --pitch <RANGE> --alpha <RANGE>
           --lines <N> --length <X> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  The amplitude of stick-slip over α:
    stickslip sweep --r 1 --alpha 1.07:2:100 -o amplitude.json --plot amplitude.svg
  A phase diagram, and where steady motion ends in it:
    stickslip sweep --r 0.1:2:100 --alpha 0.05:4:100 -o map.json --plot map.png
  With a depth limit no tip is held for ever:
    stickslip sweep --beta 0 --r 1 --alpha 2:12:51 --depth-limit 5 -o limited.json --plot limited.svg
  A hundred runs from noise of their own, and what they have in common:
    stickslip sweep --alpha 1.2 --r 1 --noise 1e-3 --seed 1:100:100 --until 200 -o ensemble.json
  A phase diagram on four machines:
    stickslip sweep --r 0.1:2:100 --alpha 0.05:4:100 --shard 1/4 -o part-1.json
    stickslip sweep merge part-1.json part-2.json part-3.json part-4.json -o map.json";
