//! `stickslip compare`.

use super::brief::Brief;
use super::named::named;
use super::{AnswerArguments, AreaArguments, DisturbanceArguments, Either, Options};
use clap::Args;
use std::path::PathBuf;
use stickslip::{GridName, Raster, Run};

/// Compare the closed equation with the full PDE on a grid: largest difference and speed.
///
/// Compares a run up to --until or, with --lines or --area, a raster. --tolerance is that of the closed equation.
#[derive(Debug, Args)]
#[command(
    override_usage = USAGE,
    after_help = EXAMPLES,
    mut_arg("lines", |lines| lines.conflicts_with_all(OF_A_RUN)),
    mut_arg("area", |area| {
        area.conflicts_with_all(OF_A_RUN).conflicts_with_all(["pitch", "lines", "length"])
    }),
    brief()
)]
pub(crate) struct CompareArguments {
    #[command(flatten)]
    pub(crate) options: Options<Either<Run, Raster>>,

    #[command(flatten)]
    pub(crate) area: AreaArguments,

    #[command(flatten)]
    pub(crate) disturbance: DisturbanceArguments,

    /// Motion of the support from the start of the run, which then is at t = 0: CSV `t,R`, as for `stickslip run`.
    #[arg(long, value_name = "FILE", help_heading = "Start")]
    pub(crate) support_path: Option<PathBuf>,

    /// Discretisation of the full equations (10), (11). Rasters have sinc (also by the name spectral) and windowed;
    /// uniform is not available with --stiffness-across.
    #[arg(
        long,
        value_parser = named::<GridName>(),
        value_name = "GRID",
        default_value = "spectral",
        help_heading = "Grid"
    )]
    pub(crate) grid: GridName,

    /// Grid spacing Δx, in σ [default: the widest that is exact to round-off for spectral and sinc, 0.01 tip widths for
    /// uniform and windowed, 0.05 with --stiffness-across; the paper has 0.001].
    #[arg(long, value_name = "DX", allow_hyphen_values = true, help_heading = "Grid")]
    pub(crate) spacing: Option<f64>,

    /// Adaptive steps with local error E in every unknown [default: as --tolerance].
    #[arg(
        long,
        value_name = "E",
        conflicts_with = "step",
        allow_hyphen_values = true,
        help_heading = "Grid"
    )]
    pub(crate) grid_tolerance: Option<f64>,

    /// Constant steps of this length, in Γ/k, in place of adaptive ones; at most the length of the run. The paper has about
    /// 0.04.
    #[arg(long, value_name = "DT", allow_hyphen_values = true, help_heading = "Grid")]
    pub(crate) step: Option<f64>,

    /// End time of the grid, if earlier than --until; the speedup is then that over this shorter time.
    #[arg(long, value_name = "T", allow_hyphen_values = true, help_heading = "Grid")]
    pub(crate) grid_until: Option<f64>,

    /// Time limit of closed equation and grid, each, in seconds: stop once it is predicted to be exceeded.
    #[arg(
        long,
        value_name = "S",
        default_value_t = 600.0,
        allow_hyphen_values = true,
        help_heading = "Output"
    )]
    pub(crate) time_limit: f64,

    #[command(flatten)]
    pub(crate) answer: AnswerArguments,
}

const USAGE: &str =
    "stickslip compare (--alpha <A> | --alpha-above <D>) --r <R> --until <T> [OPTIONS]
       stickslip compare (--alpha <A> | --alpha-above <D>) --r <R>
           --pitch <D> --lines <N> --length <X> [OPTIONS]
       stickslip compare (--alpha <A> | --alpha-above <D>) --r <R> --area <FILE> [OPTIONS]";

/// Options of runs that do not apply to rasters, whose lines start on a flat surface and have fixed ends.
const OF_A_RUN: [&str; 6] =
    ["support_path", "noise", "seed", "initial_surface", "force_file", "grid_until"];

const EXAMPLES: &str = "Examples:
  Against the strongest grid, exact to round-off in space:
    stickslip compare --alpha 1.2 --r 1 --kick 0.05 --until 76 \\
        -o compare.json --plot compare.svg
  From the paper's own start, noise on a flat surface:
    stickslip compare --alpha-above 0.01 --r 1 --start paper --until 76
  Against the paper's scheme at its Δx and Δt, within a window of the tip:
    stickslip compare --alpha-above 0.01 --r 1 --kick 0.01 --until 457 \\
        --grid windowed --spacing 0.001 --step 0.04 --grid-until 76
  A raster against rows of cells:
    stickslip compare --tip gaussian --alpha 0.5 --r 1 --pitch 0.5 \\
        --lines 24 --length 40 -o rasters.json --plot rasters.png
  Against the paper's own grid, for a time unit of it:
    stickslip compare --alpha-above 0.01 --r 1 --kick 0.01 --until 457 \\
        --grid uniform --spacing 0.001 --step 0.04 --grid-until 17";
