//! `stickslip tip`.

use super::brief::Brief;
use super::model::Length;
use super::{Options, OutletArguments};
use clap::Args;
use std::path::PathBuf;
use stickslip::MeasuredTip;

/// Fit a footprint to a measured profile, which may be noisy, tilted, off centre, and in nanometres.
///
/// Fits a sum of Gaussians on a sloping or curved background; the data determine their number. Reports the width of the
/// tip, the α at the onset of stick-slip, and their uncertainty. The output is a tip file, which every command reads by
/// --tip-file: f(0) is 1, and lengths are in σ. By default σ is the width of the Gaussian with the same full width at half
/// maximum.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, brief())]
pub(crate) struct MeasuredTipArguments {
    /// Positions and heights, in two columns with any separator and decimal mark, with a heading such as `x_nm,z_nm`
    /// or a row of units below it; rows may be in any order and at any distance, and rows without a value are
    /// omitted. Heights of a pit are below its surroundings. `-` is standard input. An image, .gsf (Gwyddion), gives
    /// f(x,y): the profile along x through its middle, and the width of each Gaussian across.
    #[arg(value_name = "MEASURED.csv")]
    pub(crate) measured: PathBuf,

    #[command(flatten)]
    pub(crate) options: Options<MeasuredTip>,

    /// The profile has both halves.
    #[arg(long, conflicts_with = "half", help_heading = "Data")]
    pub(crate) both: bool,

    /// Centre of symmetry, such as 12nm; a bare number is in the unit of the positions [default: fitted].
    #[arg(long, value_name = "X", allow_hyphen_values = true, help_heading = "Data")]
    pub(crate) centre: Option<Length>,

    /// σ, with a unit, such as 30nm; 1σ if the positions are in σ [default: fitted].
    #[arg(long, value_name = "S", allow_hyphen_values = true, help_heading = "Data")]
    pub(crate) sigma: Option<String>,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw data, fit and residuals to this .svg, .png or .pdf.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const EXAMPLES: &str = "Examples:
  A profile with a heading x_nm,z_nm, fitted, drawn, and used:
    stickslip tip pit.csv -o tip.json --plot tip.svg
    stickslip stability --tip-file tip.json --r 0.8
  A profile without a heading, in micrometres, by two Gaussians, with σ = 30 nm:
    stickslip tip pit.txt --unit um --terms 2 --sigma 30nm -o tip.json
  An image, for f(x,y) of a raster:
    stickslip tip pit.gsf -o tip.json
    stickslip raster --tip-file tip.json --alpha 0.3 --r 1 --pitch 0.5 \\
        --lines 64 --length 60 -o raster.json
  A pit whose sides differ; αc of trace and retrace, and a zigzag, in which each direction has its side:
    stickslip tip pit.csv --both-sides -o sides.json
    stickslip stability --tip-file sides.json --r 1
    stickslip stability --tip-file sides.json --r 1 --retrace
    stickslip raster --tip-file sides.json --width-y 1 --alpha 0.6 --r 1 \\
        --pitch 0.5 --lines 4 --length 20 --path zigzag -o raster.json
  The interval of αc at r = 0.5, for a script:
    stickslip tip pit.csv --r 0.5 --print critical_alpha.low \\
        --print critical_alpha.high";
