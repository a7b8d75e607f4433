//! `stickslip boundary`.

use super::examples::examples;
use super::{Interval, OutletArguments, TipArguments};
use clap::Args;
use std::path::PathBuf;

/// The critical α against r, and what is born along it.
#[derive(Debug, Args)]
#[command(after_help = examples(EXAMPLES))]
pub(crate) struct BoundaryArguments {
    #[command(flatten)]
    pub(crate) tip: TipArguments,

    /// First and last r, and how many there are, both included.
    #[arg(long, value_name = "LO:HI:N", allow_hyphen_values = true, required = true)]
    pub(crate) r_range: Interval,

    /// Number of r, where the range does not say it [default: 200].
    #[arg(long, value_name = "N")]
    pub(crate) points: Option<usize>,

    /// Equal ratios of r from one to the next, in place of equal differences.
    #[arg(long)]
    pub(crate) logarithmic: bool,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw the boundary, the unstable region shaded, to this .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,

    /// Draw how the square of the amplitude grows along the boundary, subcritical where it is below
    /// 0, to this .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot_onset: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  The paper's Fig. 6:
    stickslip boundary --r-range 0.05:3:300 -o boundary.json --plot boundary.svg
  For a tip of your own, over four decades, as CSV:
    stickslip boundary --tip-file tip.csv --r-range 0.01:100:401 --logarithmic -o boundary.csv
  Criticality along it:
    stickslip boundary --r-range 0.01:100 --logarithmic --plot-onset criticality.svg";
