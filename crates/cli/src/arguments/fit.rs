//! `stickslip fit`.

use super::brief::Brief;
use super::{Either, Length, Options, OutletArguments};
use clap::Args;
use std::path::PathBuf;
use stickslip::{Fit, FitImage};

/// Estimate α, r and σ from ripples, lateral forces, onsets and wavelengths, with 95 % intervals.
///
/// Compares the settled motion, the limit cycle at α and r, with measured ripples and forces. Offsets, slopes, phases
/// and unknown gains are fitted simultaneously; both scan directions are tried; starting values are estimated from
/// the data. Ripples may repeat after one slip or, beyond a period doubling, after two. Several data sets of one motion
/// may be combined. Intervals follow from the profile likelihood, widened for noise that is correlated from row to row
/// and for the error of a measured footprint. The noise is estimated from the scatter between wavelengths: data without
/// a significant ripple are rejected, and a model that does not explain the data gets no intervals.
///
/// With --image, α and r follow from the wave vector and the shape of the ripples of an area. Offset and tilt of each
/// line are removed. All lines must be scanned in one direction. The tip is held on its lines, unless --stiffness-across is
/// given or free.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = EXAMPLES)]
#[command(mut_arg("width", |width| width.help(WIDTH).visible_alias("sigma")), brief())]
pub(crate) struct FitArguments {
    /// Heights of ripples far behind the tip, along its path, by a heading such as `x_nm,z_nm`; or t,x,u, as `surface`
    /// writes it.
    #[arg(long, value_name = "FILE", help_heading = "Data")]
    pub(crate) ripple: Vec<PathBuf>,

    /// Lateral force against the position of the support, two columns; three are a loop: trace, then retrace, over
    /// the same positions.
    #[arg(long, value_name = "FILE", help_heading = "Data")]
    pub(crate) friction: Vec<PathBuf>,

    /// Heights of an area of settled ripples, .gsf (Gwyddion), with rows along the lines that made them, all scanned in
    /// one direction.
    #[arg(long, value_name = "FILE", help_heading = "Data", conflicts_with_all = OF_LINES)]
    pub(crate) image: Option<PathBuf>,

    /// Heights of the same area on the retrace, .gsf, at the positions of --image, fitted together with those of --image.
    #[arg(long, value_name = "FILE", help_heading = "Data", requires = "image")]
    pub(crate) retrace_image: Option<PathBuf>,

    /// Lateral forces on the lines that made the ripples of --image, .gsf, against the position of the support, at the same
    /// positions; positive where the lever is bent back from larger x. Deflections in a unit of length, or forces with
    /// --force-gain, narrow the intervals; forces alone give k.
    #[arg(long, value_name = "FILE", help_heading = "Data", requires = "image")]
    pub(crate) lateral_image: Option<PathBuf>,

    /// Distance of the lines that made the ripples of an image, such as 15nm; a bare number is in the unit of the image
    /// [default: the distance of its rows].
    #[arg(
        long,
        value_name = "D",
        help_heading = "Known",
        allow_hyphen_values = true,
        requires = "image"
    )]
    pub(crate) pitch: Option<Length>,

    /// Velocities, and the loads at the onset of stick-slip, two columns.
    #[arg(long, value_name = "FILE", help_heading = "Data")]
    pub(crate) onsets: Option<PathBuf>,

    /// Velocities, loads, and wavelengths of ripples, three columns.
    #[arg(long, value_name = "FILE", help_heading = "Data")]
    pub(crate) wavelengths: Option<PathBuf>,

    /// k/a, if known: heights in the units of the data are k/a times σ² times those of the model.
    #[arg(long, value_name = "G", allow_hyphen_values = true, help_heading = "Data")]
    pub(crate) height_gain: Option<f64>,

    /// k, if known: forces in the units of the data are k times σ times those of the model.
    #[arg(long, value_name = "K", allow_hyphen_values = true, help_heading = "Data")]
    pub(crate) force_gain: Option<f64>,

    #[command(flatten)]
    pub(crate) options: Options<Either<Fit, FitImage>>,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw data, model, residuals and the profiles of the likelihood to this .svg, .png or .pdf.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const WIDTH: &str = "σ, such as 30nm, if known; a bare number is in the unit of the data. An image needs it, unless a \
                     --tip-file written by `stickslip tip` contains it";

/// Data that cannot be combined with an image.
const OF_LINES: [&str; 5] = ["ripple", "friction", "onsets", "wavelengths", "height_gain"];

const USAGE: &str = "stickslip fit --ripple <FILE> [--friction <FILE>] [OPTIONS]
       stickslip fit --onsets <FILE> [--wavelengths <FILE>] [OPTIONS]
       stickslip fit --image <FILE> --width <W> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  α, r and σ from ripples in nm, for a tip that was measured before, with a picture:
    stickslip fit --ripple ripples.csv --tip-file tip.json -o fit.json \\
        --plot fit.svg
  The same with σ known, and with the lateral force of the same scan:
    stickslip fit --ripple ripples.csv --friction trace.csv \\
        --tip-file tip.json --width 30nm
  A depth limit too, from rows some of which are dust:
    stickslip fit --ripple ripples.csv --free depth-limit --robust
  α and r from an image of ripples whose lines were 15 nm apart:
    stickslip fit --image scan.gsf --width 30nm --pitch 15nm --tip gaussian \\
        -o fit.json --plot fit.png
  The same with a lever that is three times as stiff across the lines as along them, and the lateral force of its scan:
    stickslip fit --image scan.gsf --width 30nm --pitch 15nm --tip gaussian \\
        --stiffness-across 3 --lateral-image force.gsf
  α per load and r per velocity from onsets:
    stickslip fit --onsets onsets.csv --tip-file tip.json";
