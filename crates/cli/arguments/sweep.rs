//! `stickslip sweep`.

use super::examples::examples;
use super::range::Range;
use super::raster_sweep::RasterSweepArguments;
use super::{OutletArguments, TipName, WiderArguments};
use clap::{Args, Subcommand};
use std::path::PathBuf;
use std::str::FromStr;

/// Part I of N of the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shard {
    /// From 1 to `of`.
    pub(crate) index: usize,
    pub(crate) of: usize,
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('/').and_then(|(i, n)| i.parse().ok().zip(n.parse().ok()));
        parts
            .filter(|(index, of)| (1..=*of).contains(index))
            .map(|(index, of)| Self { index, of })
            .ok_or_else(|| "I/N with I from 1 to N, such as 2/8".into())
    }
}

/// What the tip settles into, over a grid of α, r and β.
///
/// Each point is found by itself, whatever the others are: below αc the steady motion, above it the stable
/// cycle, and where none is found what a run comes to. Finished points are kept beside the output at once
/// (FILE.partial): after an interrupt the same command goes on from there.
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
    #[arg(long, value_enum, value_name = "NAME", help_heading = "Model")]
    pub(crate) tip: Option<TipName>,

    /// Side lobes of the triple Gaussian, V or LO:HI:N [default: 1].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) beta: Option<Range>,

    /// Width of either Gaussian: f(x/W) [default: 1].
    #[arg(long, value_name = "W", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) width: Option<f64>,

    /// Footprint from a file, as for `stickslip run`.
    #[arg(long, value_name = "FILE", help_heading = "Model")]
    pub(crate) tip_file: Option<PathBuf>,

    /// Support velocities, V or LO:HI:N.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) r: Option<Range>,

    /// Indentation rates, V or LO:HI:N.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) alpha: Option<Range>,

    /// Indentation rates as αc(r) + D, D as V or LO:HI:N.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) alpha_above: Option<Range>,

    #[command(flatten)]
    pub(crate) wider: WiderArguments,

    /// Largest residual that the equation of motion (18) may have on a cycle, in units of kσ/Γ; from
    /// 1e-11 to 1e-4.
    #[arg(
        long,
        value_name = "E",
        default_value = "1e-9",
        allow_hyphen_values = true,
        help_heading = "Accuracy"
    )]
    pub(crate) tolerance: f64,

    /// Points computed side by side [default: the number of cores].
    #[arg(long, value_name = "N", help_heading = "Work")]
    pub(crate) threads: Option<usize>,

    /// Compute part I of N of the points only; `stickslip sweep merge` puts the parts together.
    #[arg(long, value_name = "I/N", help_heading = "Work")]
    pub(crate) shard: Option<Shard>,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw the phase diagram, or with a single parameter varied the amplitude and period over it, to this
    /// .svg or .png. What has neither, such as steady and trapped tips, is marked at the foot.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum SweepThen {
    Merge(MergeArguments),
    Raster(Box<RasterSweepArguments>),
}

/// Put the parts of a sweep together: byte for byte what one sweep over all points would have written.
#[derive(Debug, Args)]
#[command(after_help = "Example:\n  stickslip sweep merge part-*.json -o map.json --plot map.svg")]
pub(crate) struct MergeArguments {
    /// Documents of `stickslip sweep --shard`, in any order.
    #[arg(value_name = "PART.json", required = true)]
    pub(crate) parts: Vec<PathBuf>,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw it, as for `sweep`.
    #[arg(long, value_name = "FILE")]
    pub(crate) plot: Option<PathBuf>,
}

const USAGE: &str =
    "stickslip sweep --r <RANGE> (--alpha <RANGE> | --alpha-above <RANGE>) [OPTIONS]
       stickslip sweep merge <PART.json>... [OPTIONS]
       stickslip sweep raster --r <R> --pitch <RANGE> --alpha <RANGE> --lines <N> --length <X> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  The amplitude of stick-slip over α:
    stickslip sweep --r 1 --alpha 1.07:2:100 -o amplitude.json --plot amplitude.svg
  A phase diagram, and where steady motion ends in it:
    stickslip sweep --r 0.1:2:100 --alpha 0.05:4:100 -o map.json --plot map.png
  With a depth limit no tip is held for ever:
    stickslip sweep --beta 0 --r 1 --alpha 2:12:51 --depth-limit 5 -o limited.json --plot limited.svg
  A phase diagram on four machines:
    stickslip sweep --r 0.1:2:100 --alpha 0.05:4:100 --shard 1/4 -o part-1.json
    stickslip sweep merge part-1.json part-2.json part-3.json part-4.json -o map.json";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_count_from_one() {
        assert_eq!("2/8".parse(), Ok(Shard { index: 2, of: 8 }));
        for bad in ["0/8", "9/8", "1", "1/0", "-1/2", "1/2/3"] {
            assert!(bad.parse::<Shard>().is_err(), "{bad}");
        }
    }
}
