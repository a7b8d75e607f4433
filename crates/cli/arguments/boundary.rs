//! `stickslip boundary`.

use super::TipArguments;
use clap::Args;
use std::path::PathBuf;

/// The critical α against r, and what is born along it.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct BoundaryArguments {
    #[command(flatten)]
    pub(crate) tip: TipArguments,

    /// First and last r.
    #[arg(
        long,
        value_name = "LO,HI",
        value_delimiter = ',',
        allow_hyphen_values = true,
        required = true
    )]
    pub(crate) r_range: Vec<f64>,

    /// Number of r, both ends included.
    #[arg(long, value_name = "N", default_value_t = 200)]
    pub(crate) points: usize,

    /// Equal ratios of r from one to the next, in place of equal differences.
    #[arg(long)]
    pub(crate) logarithmic: bool,

    /// File to write: .json for all, .csv or .npz for the boundary; `-` is JSON on standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-", help_heading = "Output")]
    pub(crate) output: PathBuf,

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
    stickslip boundary --r-range 0.05,3 --points 300 -o boundary.json --plot boundary.svg
  For a tip of your own, over four decades, as CSV:
    stickslip boundary --tip-file tip.csv --r-range 0.01,100 --points 401 --logarithmic -o boundary.csv
  Criticality along it:
    stickslip boundary --r-range 0.01,100 --logarithmic --plot-onset criticality.svg";
