//! `stickslip raster`.

use super::brief::Brief;
use super::{FieldArguments, Format, InUnitsArguments, Options};
use clap::Args;
use std::path::PathBuf;
use stickslip::Raster;

/// The lines of an area from a file: an option of every command that scans an area.
#[derive(Debug, Args)]
pub(crate) struct AreaArguments {
    /// Area of any shape, scanned line by line: CSV `y,start,length`, a row for each line in the order of the scan,
    /// in σ; replaces --pitch, --lines and --length.
    #[arg(long, value_name = "FILE", help_heading = "Scan")]
    pub(crate) area: Option<PathBuf>,
}

/// Scan an area line by line, and report the pattern of the lines.
///
/// Wavelength and crest angle are those of the strongest wave on the last half of the lines, with 95 % errors; a
/// number that these lines do not determine is null, with a warning.
///
/// Each line is a run over the surface that the earlier lines have made. Finished lines are saved immediately beside
/// the output (FILE.partial): after an interrupt the same command resumes from there, and writes the same bytes.
#[derive(Debug, Args)]
#[command(
    override_usage = USAGE,
    after_help = EXAMPLES,
    mut_arg("area", |area| area.conflicts_with_all(["pitch", "lines", "length"])),
    brief()
)]
pub(crate) struct RasterArguments {
    #[command(flatten)]
    pub(crate) options: Options<Raster>,

    #[command(flatten)]
    pub(crate) area: AreaArguments,

    /// External force A exp(-(t-T)²/(2 W²)) on the tip, in kσ, on the first line, T after its start; it disturbs all
    /// later lines; repeatable.
    #[arg(long, value_name = "A,T,W", allow_hyphen_values = true, help_heading = "Force")]
    pub(crate) pulse: Vec<String>,

    /// Number of threads; the result does not depend on it. Lines are scanned in parallel, each a few widths behind the one
    /// before; lines of a zigzag are scanned one after another [default: the number of cores].
    #[arg(long, value_name = "N", help_heading = "Work")]
    pub(crate) threads: Option<usize>,

    /// File to write: .json for the document, .csv for the samples, .npz for samples, heights and history as NumPy
    /// arrays, .gsf for the height map in Gwyddion; `-` is standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-", help_heading = "Output")]
    pub(crate) output: PathBuf,

    /// Output format, independent of the file name [default: by its extension; on standard output text for a
    /// terminal, else json].
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = "Output")]
    pub(crate) format: Option<Format>,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) fields: FieldArguments,

    /// Draw the heights with the crests marked, and the lags, to this .svg, .png or .pdf.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const USAGE: &str = "stickslip raster (--alpha <A> | --alpha-above <D>) --r <R>
           --pitch <D> --lines <N> --length <X> [OPTIONS]
       stickslip raster (--alpha <A> | --alpha-above <D>) --r <R> --area <FILE> [OPTIONS]
       stickslip raster (--alpha <A> | --alpha-above <D>) --r <R>
           --path repeat --lines <N> --length <X> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  Ripples far below the threshold of a single line (`stability --pitch 0.5` computes where they begin):
    stickslip raster --tip gaussian --alpha 0.45 --r 1 --pitch 0.5 \\
        --lines 256 --length 60 -o raster.json --plot raster.png
  Back and forth, as a height map for Gwyddion:
    stickslip raster --tip gaussian --alpha 0.5 --r 1 --pitch 0.5 \\
        --path zigzag --lines 256 --length 60 -o raster.gsf
  A disc, whose lines examples/areas/circle.csv lists:
    stickslip raster --tip gaussian --alpha 0.48 --r 1 \\
        --area examples/areas/circle.csv --tolerance 1e-6 -o disc.json \\
        --plot disc.png
  The same line ten times:
    stickslip raster --alpha 0.4 --r 1 --path repeat --lines 10 --length 40 \\
        -o repeated.csv
  Profiles and images of it afterwards:
    stickslip surface raster.json --range 0:60 --y-range 0:128 \\
        --spacing 0.25 -o heights.npz";
