//! `stickslip stability`.

use super::brief::Brief;
use super::{AnswerArguments, Either, Options};
use clap::Args;
use stickslip::{RasterStability, Stability, Walking};

/// Compute the critical point of steady motion, and all growth exponents.
///
/// Without --alpha (with --solve-for r: without --r) the growth exponents are those of the critical point. With
/// --pitch: the threshold for ripples that grow from scan line to scan line. With --no-spring: the speeds of steady
/// walks, and their growth exponents.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = EXAMPLES, brief())]
pub(crate) struct StabilityArguments {
    #[command(flatten)]
    pub(crate) options: Options<Either<Stability, Either<RasterStability, Walking>>>,

    #[command(flatten)]
    pub(crate) answer: AnswerArguments,
}

const USAGE: &str = "stickslip stability --r <R> [OPTIONS]
       stickslip stability --alpha <A> --solve-for r [OPTIONS]
       stickslip stability --r <R> --pitch <D> [OPTIONS]
       stickslip stability --alpha <A> --no-spring [OPTIONS]";

const EXAMPLES: &str = "Examples:
  The critical α at r = 1, with the oscillation that begins there:
    stickslip stability --r 1
  The critical r at α = 1:
    stickslip stability --alpha 1 --solve-for r
  Is a motion stable? All exponents of deviations that grow, or decay slower than e^(-3t):
    stickslip stability --alpha 1.2 --r 1 --re-above=-3 --plot roots.svg
  Thirty exponents of a Gaussian tip, as CSV:
    stickslip stability --tip gaussian --width 0.7 --alpha-above=-0.1 --r 2 \\
        --roots 30 -o roots.csv
  Lines half a width apart: where ripples set in, and how they grow above that:
    stickslip stability --tip gaussian --r 1 --pitch 0.5
    stickslip stability --tip gaussian --r 1 --pitch 0.5 --alpha 0.45 \\
        -o growth.csv --plot growth.svg
  The same for a tip with inertia and a depth limit:
    stickslip stability --tip gaussian --r 1 --pitch 0.5 --depth-limit 8 \\
        --inertia 0.3
  On a spring across the scan, softer than that along it: where a line snakes, and where lines bunch or ripple:
    stickslip stability --r 1 --stiffness-across 0.5
    stickslip stability --tip gaussian --r 1 --pitch 0.5 \\
        --stiffness-across 0.5
  Another pass over the same line:
    stickslip stability --tip gaussian --r 1 --path repeat --alpha 0.3 \\
        -o growth.csv
  A tip that walks without a spring, over a healing surface: its speed, and whether it is stable:
    stickslip stability --no-spring --tip bessel --alpha=-3 --healing-time 1";
