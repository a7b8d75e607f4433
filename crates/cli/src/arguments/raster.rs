//! `stickslip raster`.

use super::examples::examples;
use super::named::named;
use super::{
    FieldArguments, Format, InUnitsArguments, ModelArguments, SamplingArguments, ScanArguments,
};
use clap::Args;
use std::path::PathBuf;
use stickslip::MemoryName;

/// Scan an area line by line, and report the pattern that the lines have written.
///
/// Wavelength and crest angle are those of the strongest wave on the last half of the lines, with 95 % errors; what these
/// lines do not determine is null, and a remark says why.
///
/// Each line is a run over what the lines before it have left. Finished lines are kept beside the output at once
/// (FILE.partial): after an interrupt the same command goes on from there, and writes the same bytes.
#[derive(Debug, Args)]
#[command(
    override_usage = USAGE,
    after_help = examples(EXAMPLES),
    mut_arg("r", |r| r.required(true)),
    mut_arg("pitch", |pitch| pitch.required_unless_present_any(["path", "area"])),
    mut_arg("lines", |lines| lines.required_unless_present("area")),
    mut_arg("length", |length| length.required_unless_present("area"))
)]
pub(crate) struct RasterArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    #[command(flatten)]
    pub(crate) scan: ScanArguments,

    /// External force A exp(-(t-T)²/(2 W²)) on the tip, in kσ, on the first line, T since its start: what disturbs all
    /// that follow; repeatable.
    #[arg(long, value_name = "A,T,W", allow_hyphen_values = true, help_heading = "Force")]
    pub(crate) pulse: Vec<String>,

    /// How the past of a line is remembered. All memories give the same motion to the tolerance.
    #[arg(
        long,
        value_parser = named::<MemoryName>(),
        value_name = "MEMORY",
        default_value = "auto",
        help_heading = "Accuracy"
    )]
    pub(crate) memory: MemoryName,

    /// Error of x0 on each line asked for, in σ; from 1e-13 to 1e-2.
    #[arg(
        long,
        value_name = "E",
        default_value = "1e-9",
        allow_hyphen_values = true,
        help_heading = "Accuracy"
    )]
    pub(crate) tolerance: f64,

    #[command(flatten)]
    pub(crate) sampling: SamplingArguments,

    /// File to write: .json for all, .csv for the samples, .npz for samples, heights and history as NumPy arrays, .gsf
    /// for the height map in Gwyddion; `-` is standard output.
    #[arg(short, long, value_name = "FILE", default_value = "-", help_heading = "Output")]
    pub(crate) output: PathBuf,

    /// What is written, whatever the name of the file [default: by its extension; on standard output text for a
    /// terminal, else json].
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = "Output")]
    pub(crate) format: Option<Format>,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) fields: FieldArguments,

    /// Draw the heights with the crests marked, and the lags beside them, to this .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const USAGE: &str = "stickslip raster (--alpha <A> | --alpha-above <D>) --r <R>
           --pitch <D> --lines <N> --length <X> [OPTIONS]
       stickslip raster (--alpha <A> | --alpha-above <D>) --r <R> --area <FILE> [OPTIONS]
       stickslip raster (--alpha <A> | --alpha-above <D>) --r <R>
           --path repeat --lines <N> --length <X> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  Ripples far below the threshold of a single line (`stability --pitch 0.5` says where they begin):
    stickslip raster --tip gaussian --alpha 0.45 --r 1 --pitch 0.5 --lines 256 --length 60 -o raster.json --plot raster.png
  Forth and back, as a height map for Gwyddion:
    stickslip raster --tip gaussian --alpha 0.5 --r 1 --pitch 0.5 --path zigzag --lines 256 --length 60 -o raster.gsf
  A disc, whose lines examples/areas/circle.csv lists:
    stickslip raster --tip gaussian --alpha 0.48 --r 1 --area examples/areas/circle.csv --tolerance 1e-6 -o disc.json --plot disc.png
  The same line ten times:
    stickslip raster --alpha 0.4 --r 1 --path repeat --lines 10 --length 40 -o repeated.csv
  Profiles and images of it afterwards:
    stickslip surface raster.json --range 0:60 --y-range 0:128 --spacing 0.25 -o heights.npz";
