//! `stickslip sweep raster`.

use super::examples::examples;
use super::named::named;
use super::range::Range;
use super::shard::Shard;
use super::{InUnitsArguments, OutletArguments, TipArguments, WiderArguments};
use clap::Args;
use std::path::PathBuf;
use stickslip::PathName;

/// Compute the pattern of a raster over a grid of pitch and α.
///
/// Each point is a raster. Finished points are saved immediately beside the output (FILE.partial): after an interrupt
/// the same command resumes from there.
#[derive(Debug, Args)]
#[command(after_help = examples(EXAMPLES))]
pub(crate) struct RasterSweepArguments {
    #[command(flatten)]
    pub(crate) tip: TipArguments,

    /// Dimensionless support velocity Γ v0/(k σ), (12); above 0.
    #[arg(long, value_name = "R", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) r: f64,

    /// Indentation rates, V or LO:HI:N.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) alpha: Range,

    #[command(flatten)]
    pub(crate) wider: WiderArguments,

    /// V in f(x,y) = f(x) exp(-y²/(2 V²)), for a tip without its own f(x,y) [default: the width of the tip's
    /// Gaussians].
    #[arg(long, value_name = "V", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) width_y: Option<f64>,

    /// Distances of the lines, in σ, V or LO:HI:N.
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, help_heading = "Scan")]
    pub(crate) pitch: Range,

    /// Number of lines.
    #[arg(long, value_name = "N", help_heading = "Scan")]
    pub(crate) lines: usize,

    /// Distance that the support moves along each line, in σ.
    #[arg(long, value_name = "X", allow_hyphen_values = true, help_heading = "Scan")]
    pub(crate) length: f64,

    /// Path of the support from one line to the next.
    #[arg(
        long,
        value_parser = named::<PathName>(),
        value_name = "PATH",
        default_value = "one-way",
        help_heading = "Scan"
    )]
    pub(crate) path: PathName,

    /// κ_y, the spring constant across the lines over that along them; above 0. Without it the tip cannot leave its
    /// line.
    #[arg(long, value_name = "K", allow_hyphen_values = true, help_heading = "Across the scan")]
    pub(crate) stiffness_across: Option<f64>,

    /// Target for the error of x0 on each line, in σ; from 1e-13 to 1e-2.
    #[arg(
        long,
        value_name = "E",
        default_value = "1e-6",
        allow_hyphen_values = true,
        help_heading = "Accuracy"
    )]
    pub(crate) tolerance: f64,

    /// Number of points computed in parallel [default: the number of cores].
    #[arg(long, value_name = "N", help_heading = "Work")]
    pub(crate) threads: Option<usize>,

    /// Compute only part I of N of the points; `stickslip sweep merge` combines the parts. `slurm`, or slurm/N: the
    /// part of this task of an array job, as for `stickslip sweep`.
    #[arg(long, value_name = "I/N", help_heading = "Work")]
    pub(crate) shard: Option<Shard>,

    /// Do nothing if --output is already this sweep, complete and of this version; replace it if it is another.
    #[arg(long, conflicts_with = "plot", help_heading = "Work")]
    pub(crate) if_needed: bool,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw the regimes over pitch and α, or wavelength, crest angle and coherence over the one that varies, to this
    /// .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  From no ripples to ripples, pits and lines that stay at the edge:
    stickslip sweep raster --tip gaussian --r 1 --pitch 0.25:2:8 --alpha 0.2:2:10 --lines 128 --length 80 -o map.json --plot map.svg
  The literature's depth limit:
    stickslip sweep raster --r 1 --pitch 0.25:2:8 --alpha 0.5:3:6 --depth-limit 3 --lines 128 --length 80 -o map.json --plot map.svg";
