//! `stickslip boundary`.

use super::examples::examples;
use super::{InUnitsArguments, Interval, OutletArguments, TipArguments, WiderArguments};
use clap::Args;
use std::path::PathBuf;

/// The critical α against r, and what is born along it; or that of scan lines against their pitch.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = examples(EXAMPLES))]
pub(crate) struct BoundaryArguments {
    #[command(flatten)]
    pub(crate) tip: TipArguments,

    #[command(flatten)]
    pub(crate) wider: WiderArguments,

    /// First and last r, and how many there are, both included.
    #[arg(
        long,
        value_name = "LO:HI:N",
        allow_hyphen_values = true,
        required_unless_present = "pitch_range",
        help_heading = "Boundary"
    )]
    pub(crate) r_range: Option<Interval>,

    /// First and last distance of scan lines beside each other, in σ, and how many there are: where ripples begin to
    /// grow from line to line, and the angle of their crests, at the r of --r.
    #[arg(
        long,
        value_name = "LO:HI:N",
        allow_hyphen_values = true,
        conflicts_with_all = ["r_range", "plot_onset"],
        requires = "r",
        help_heading = "Raster"
    )]
    pub(crate) pitch_range: Option<Interval>,

    /// Dimensionless support velocity of the lines; above 0.
    #[arg(
        long,
        value_name = "R",
        allow_hyphen_values = true,
        requires = "pitch_range",
        help_heading = "Raster"
    )]
    pub(crate) r: Option<f64>,

    /// V in f(x,y) = f(x) exp(-y²/(2 V²)), for a tip that has no f(x,y) of its own [default: the width of the tip's
    /// Gaussians].
    #[arg(
        long,
        value_name = "V",
        allow_hyphen_values = true,
        requires = "pitch_range",
        help_heading = "Raster"
    )]
    pub(crate) width_y: Option<f64>,

    /// How far the support goes along each line, in σ, for a surface that heals meanwhile.
    #[arg(
        long,
        value_name = "X",
        allow_hyphen_values = true,
        requires = "pitch_range",
        help_heading = "Raster"
    )]
    pub(crate) length: Option<f64>,

    /// Number of values, where the range does not say it [default: 200].
    #[arg(long, value_name = "N")]
    pub(crate) points: Option<usize>,

    /// Equal ratios from one to the next, in place of equal differences.
    #[arg(long)]
    pub(crate) logarithmic: bool,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

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

const USAGE: &str = "stickslip boundary --r-range <LO:HI:N> [OPTIONS]
       stickslip boundary --pitch-range <LO:HI:N> --r <R> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  The paper's Fig. 6:
    stickslip boundary --r-range 0.05:3:300 -o boundary.json --plot boundary.svg
  For a tip of your own, over four decades, as CSV:
    stickslip boundary --tip-file tip.csv --r-range 0.01:100:401 --logarithmic -o boundary.csv
  Criticality along it:
    stickslip boundary --r-range 0.01:100 --logarithmic --plot-onset criticality.svg
  With a depth limit, with the one below which nothing is unstable at each r:
    stickslip boundary --beta 0 --depth-limit 5 --r-range 0.2:3:100 -o limited.json --plot limited.svg
  Where lines begin to ripple together, and at what angle:
    stickslip boundary --tip gaussian --pitch-range 0.05:3:60 --r 1 -o pitch.csv --plot pitch.svg";
