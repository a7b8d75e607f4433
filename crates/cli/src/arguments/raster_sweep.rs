//! `stickslip sweep raster`.

use super::brief::Brief;
use super::{AnswerArguments, Options, WorkArguments};
use clap::Args;
use stickslip::RasterSweep;

/// Compute the pattern of a raster over a grid of pitch and α.
///
/// Each point is a raster. Finished points are saved immediately beside the output (FILE.partial): after an interrupt
/// the same command resumes from there.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES, mut_arg("plot", |plot| plot.help(PLOT)), brief())]
pub(crate) struct RasterSweepArguments {
    #[command(flatten)]
    pub(crate) options: Options<RasterSweep>,

    #[command(flatten)]
    pub(crate) work: WorkArguments,

    #[command(flatten)]
    pub(crate) answer: AnswerArguments,
}

const PLOT: &str = "Draw the regimes over pitch and α, or wavelength, crest angle and coherence over the one that \
                    varies, to this .svg, .png or .pdf";

const EXAMPLES: &str = "Examples:
  From no ripples to ripples, pits and lines that stay at the edge:
    stickslip sweep raster --tip gaussian --r 1 --pitch 0.25:2:8 \\
        --alpha 0.2:2:10 --lines 128 --length 80 -o map.json --plot map.svg
  With the depth limit of the literature:
    stickslip sweep raster --r 1 --pitch 0.25:2:8 --alpha 0.5:3:6 \\
        --depth-limit 3 --lines 128 --length 80 -o map.json --plot map.svg";
