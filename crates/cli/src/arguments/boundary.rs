//! `stickslip boundary`.

use super::brief::Brief;
use super::{AnswerArguments, Either, Options};
use clap::Args;
use std::path::PathBuf;
use stickslip::{Boundary, LoadMap, RasterBoundary, SnakingBoundary};

/// The questions beside the boundary of a single line.
type Others = Either<RasterBoundary, Either<SnakingBoundary, LoadMap>>;

/// Stability boundary: the critical α against r, with the oscillation at onset; of scan lines, against their pitch; or of
/// snaking, against the stiffness across the scan. With loads: where there are ripples, over load and velocity.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = EXAMPLES, brief())]
pub(crate) struct BoundaryArguments {
    #[command(flatten)]
    pub(crate) options: Options<Either<Boundary, Others>>,

    /// Width of the contact at several loads, in place of --width-exponent: CSV `load_nN,width_nm`, with other units or none.
    /// Only the ratio of a width to that at --load matters; between neighbouring rows the width is a power of the load.
    #[arg(long, value_name = "FILE", help_heading = "Load")]
    pub(crate) load_widths: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) answer: AnswerArguments,

    /// Draw the criticality of the onset along the boundary, d ln α/d(amplitude²), subcritical where it is below 0, to this
    /// .svg, .png or .pdf.
    #[arg(long, value_name = "FILE", help_heading = "Output", conflicts_with = "pitch_range")]
    pub(crate) plot_onset: Option<PathBuf>,
}

const USAGE: &str = "stickslip boundary --r-range <LO:HI:N> [OPTIONS]
       stickslip boundary --pitch-range <LO:HI:N> --r <R> [OPTIONS]
       stickslip boundary --stiffness-range <LO:HI:N> --r <R> [OPTIONS]
       stickslip boundary --r-range <LO:HI:N> --stiffness-across <K> [OPTIONS]
       stickslip boundary --load-range <LO:HI> --r-range <LO:HI:N> --load <F> --alpha <A> --r <R> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  The paper's Fig. 6:
    stickslip boundary --r-range 0.05:3:300 -o boundary.json \\
        --plot boundary.svg
  For a tip of your own, over four decades, as CSV:
    stickslip boundary --tip-file tip.csv --r-range 0.01:100:401 \\
        --logarithmic -o boundary.csv
  Criticality along the boundary:
    stickslip boundary --r-range 0.01:100 --logarithmic \\
        --plot-onset criticality.svg
  With a depth limit, and at each r the depth limit below which steady motion is always stable:
    stickslip boundary --beta 0 --depth-limit 5 --r-range 0.2:3:100 \\
        -o limited.json --plot limited.svg
  Where lines begin to ripple together, and at what angle:
    stickslip boundary --tip gaussian --pitch-range 0.05:3:60 --r 1 \\
        -o pitch.csv --plot pitch.svg
  The same for a tip on a spring across the scan, where lines also bunch:
    stickslip boundary --tip gaussian --pitch-range 0.5:3:11 --r 1 \\
        --stiffness-across 2.5 -o across.csv --plot across.svg
  Where a single line snakes, and from which stiffness on it sticks and slips first:
    stickslip boundary --stiffness-range 0.05:2:40 --r 1 -o snaking.json \\
        --plot snaking.svg
    stickslip boundary --r-range 0.1:3:30 --stiffness-across 0.5 \\
        -o velocity.csv
  At which load and velocity there are ripples, and how far apart, from a lever with α = 1.3 and r = 0.8 at 10 nN and 1 µm/s:
    stickslip boundary --alpha 1.3 --r 0.8 --load 10nN \\
        --load-range 2nN:20nN --r-range 0.2um/s:2um/s --sigma 20nm \\
        --stiffness 0.2N/m --damping 3.2mNs/m -o loads.csv --plot loads.svg
  The same for a contact whose width was measured at several loads, each a row of the table:
    stickslip boundary --alpha 1.3 --r 0.8 --load 10nN \\
        --load-range 2nN:20nN --load-widths widths.csv --r-range 0.4:1.6 \\
        -o loads.json";
