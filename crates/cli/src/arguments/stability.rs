//! `stickslip stability`.

use super::examples::examples;
use super::named::named;
use super::{InUnitsArguments, ModelArguments, OutletArguments};
use clap::Args;
use std::path::PathBuf;
use stickslip::{PathName, SolveFor};

/// Where steady motion loses its stability, and all growth exponents.
///
/// Without --alpha (with --solve-for r: without --r) the growth exponents are those of the critical
/// point. With --no-spring: the speeds of steady walks, and their growth exponents.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = examples(EXAMPLES))]
pub(crate) struct StabilityArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// Which of the two is varied to find the critical point.
    #[arg(long, value_parser = named::<SolveFor>(), default_value = "alpha", value_name = "NAME")]
    pub(crate) solve_for: SolveFor,

    /// Distance of scan lines that lie beside each other, in σ: where ripples begin to grow from line to line, and at
    /// what angle their crests stand, in place of a single line.
    #[arg(
        long,
        value_name = "D",
        allow_hyphen_values = true,
        conflicts_with_all = ["solve_for", "roots", "re_above"],
        help_heading = "Raster"
    )]
    pub(crate) pitch: Option<f64>,

    /// How the support goes from one line to the next [default: one-way].
    #[arg(
        long,
        value_parser = named::<PathName>(),
        value_name = "PATH",
        conflicts_with_all = ["solve_for", "roots", "re_above"],
        help_heading = "Raster"
    )]
    pub(crate) path: Option<PathName>,

    /// V in f(x,y) = f(x) exp(-y²/(2 V²)), for a tip that has no f(x,y) of its own [default: the width of the tip's
    /// Gaussians].
    #[arg(long, value_name = "V", allow_hyphen_values = true, help_heading = "Raster")]
    pub(crate) width_y: Option<f64>,

    /// How far the support goes along each line, in σ, for a surface that heals meanwhile.
    #[arg(
        long,
        value_name = "X",
        allow_hyphen_values = true,
        requires = "pitch",
        help_heading = "Raster"
    )]
    pub(crate) length: Option<f64>,

    /// At least N growth exponents: all those right of a line chosen so [default: 10].
    #[arg(long, value_name = "N", conflicts_with = "re_above")]
    pub(crate) roots: Option<usize>,

    /// All growth exponents λ with Re λ of at least this, in k/Γ.
    #[arg(long, value_name = "BOUND", allow_hyphen_values = true)]
    pub(crate) re_above: Option<f64>,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw the growth exponents in the complex plane, or of a raster the growth from line to line, to this .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const USAGE: &str = "stickslip stability --r <R> [OPTIONS]
       stickslip stability --alpha <A> --solve-for r [OPTIONS]
       stickslip stability --r <R> --pitch <D> [OPTIONS]
       stickslip stability --alpha <A> --no-spring [OPTIONS]";

const EXAMPLES: &str = "Examples:
  The critical α at r = 1, with the oscillation that is born there:
    stickslip stability --r 1
  The critical r at α = 1:
    stickslip stability --alpha 1 --solve-for r
  Is a motion stable? All that grows, or decays slower than e^(-3t):
    stickslip stability --alpha 1.2 --r 1 --re-above=-3 --plot roots.svg
  Thirty exponents of a Gaussian tip, as CSV:
    stickslip stability --tip gaussian --width 0.7 --alpha-above=-0.1 --r 2 --roots 30 -o roots.csv
  Lines half a width apart: where ripples set in, and how they grow above that:
    stickslip stability --tip gaussian --r 1 --pitch 0.5
    stickslip stability --tip gaussian --r 1 --pitch 0.5 --alpha 0.45 -o growth.csv --plot growth.svg
  The same where the tip has inertia and grooves are limited in depth:
    stickslip stability --tip gaussian --r 1 --pitch 0.5 --depth-limit 8 --inertia 0.3
  Another pass over the same line:
    stickslip stability --tip gaussian --r 1 --path repeat --alpha 0.3 -o growth.csv
  A tip that walks by itself, over waves of its own that fade: its speed, and whether it keeps it:
    stickslip stability --no-spring --tip bessel --alpha=-3 --healing-time 1";
