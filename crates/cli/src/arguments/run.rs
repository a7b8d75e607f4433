//! `stickslip run`.

use super::brief::Brief;
use super::named::named;
use super::{DisturbanceArguments, Either, FieldArguments, InUnitsArguments, Options};
use clap::{Arg, Args, ValueEnum};
use std::path::{Path, PathBuf};
use stickslip::{Run, RunFormat, Walker};

/// The part of the dense history in a document.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum HistoryName {
    /// All of it.
    All,
    /// No history: the memory use of a run does not grow with its length.
    None,
}

/// Integrate the motion of the tip and classify the result.
///
/// With --walker, the motion is that of a particle in the plane, driven by the field of J0 waves that it leaves: free, in a
/// rotating frame or in a trap.
#[derive(Debug, Args)]
#[command(
    override_usage = USAGE,
    after_help = EXAMPLES,
    mut_args(not_on_resume),
    brief()
)]
pub(crate) struct RunArguments {
    #[command(flatten)]
    pub(crate) options: Options<Either<Run, Walker>>,

    #[command(flatten)]
    pub(crate) disturbance: DisturbanceArguments,

    /// Motion of the support from the start of the run, which then is at t = 0: CSV `t,R` of times and displacements,
    /// beginning with 0,0, linear between the rows (steps, holds, trace and retrace); --r is the velocity before the start.
    #[arg(long, value_name = "FILE", help_heading = "Start")]
    pub(crate) support_path: Option<PathBuf>,

    /// Table u0(x,y) added to the initial surface of a tip that is free to move across the scan: CSV `x,y,u` with a row for
    /// each point of a grid, interpolated by a bicubic spline.
    #[arg(long, value_name = "FILE", help_heading = "Across the scan")]
    pub(crate) initial_surface_across: Option<PathBuf>,

    /// File to write: .json for the document, .csv for the samples, .npz for samples and history as NumPy arrays,
    /// .jsonl for samples written during the run, in constant memory; `-` is standard output [default: -].
    #[arg(short, long, value_name = "FILE", help_heading = "Output")]
    pub(crate) output: Option<PathBuf>,

    /// Output format, independent of the file name [default: by its extension; on standard output text for a
    /// terminal, else json].
    #[arg(long, value_parser = named::<RunFormat>(), value_name = "FORMAT", help_heading = "Output")]
    pub(crate) format: Option<RunFormat>,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) fields: FieldArguments,

    /// Part of the dense history in a .json or .npz; `surface` needs all of it.
    #[arg(long, value_enum, value_name = "PART", default_value = "all", help_heading = "Output")]
    pub(crate) history: HistoryName,

    /// Draw l(t), the tip's velocity and the final surface to this .svg, .png or .pdf.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,

    /// Repeat the run with another memory and a tighter tolerance, and report the difference in the document; exit
    /// status 1 if it exceeds the tolerance allowed. Takes many times as long as the run.
    #[arg(long, help_heading = "Accuracy")]
    pub(crate) verify: bool,

    /// Save the state of the run to FILE at intervals, so that `--resume FILE` can continue it.
    #[arg(long, value_name = "FILE", help_heading = "Long runs")]
    pub(crate) checkpoint: Option<PathBuf>,

    /// Time between two checkpoints, in Γ/k [default: a hundredth of the run].
    #[arg(
        long,
        value_name = "T",
        requires = "checkpoint",
        allow_hyphen_values = true,
        help_heading = "Long runs"
    )]
    pub(crate) checkpoint_every: Option<f64>,

    /// Resume the run from the checkpoint FILE, with the same output as an uninterrupted run. The output goes to the files
    /// that the checkpoint names if they are in its folder, or else to -o and --plot; all other options come from FILE.
    #[arg(long, value_name = "FILE", help_heading = "Long runs")]
    pub(crate) resume: Option<PathBuf>,
}

const USAGE: &str = "stickslip run (--alpha <A> | --alpha-above <D>) --r <R> --until <T> [OPTIONS]
       stickslip run --walker --alpha <A> --until <T> [OPTIONS]
       stickslip run --resume <FILE> [-o <FILE>]";

impl RunArguments {
    /// The output of the run.
    pub(crate) fn output(&self) -> &Path {
        self.output.as_deref().unwrap_or(Path::new("-"))
    }
}

/// Excludes an option together with --resume: a checkpoint contains all options, and only the outputs may be changed.
fn not_on_resume(argument: Arg) -> Arg {
    match argument.get_id().as_str() {
        "resume" | "output" | "plot" | "print" | "quiet" => argument,
        _ => argument.conflicts_with("resume"),
    }
}

const EXAMPLES: &str = "Examples:
  The paper's Fig. 1, just above onset:
    stickslip run --alpha-above 0.01 --r 1 --kick 0.01 --until 457 \\
        -o run.json --plot run.svg
  With the paper's own start, noise on a flat surface:
    stickslip run --alpha-above 0.01 --r 1 --start paper --until 457 \\
        -o run.json
  A tip of your own, two pulses, samples as CSV:
    stickslip run --tip-file tip.csv --alpha 0.5 --r 0.8 --pulse 2,30,0.5 \\
        --pulse=-2,40,0.5 --until 80 -o run.csv
  A trapped tip:
    stickslip run --alpha 4 --r 1 --until 1000 -o trapped.json
  Under the depth limit (61), on a surface that heals, and a friction loop of trace and retrace:
    stickslip run --alpha 2.6 --beta 0 --r 1 --depth-limit 20 --kick 0.05 \\
        --until 200 -o limited.json
    stickslip run --alpha 1.5 --r 1 --healing-time 10 --kick 0.05 \\
        --until 200 -o healing.json
    printf 't,R\\n0,0\\n20,20\\n40,0\\n' > path.csv
    stickslip run --alpha 0.8 --r 1 --support-path path.csv --until 40 \\
        -o loop.json --plot loop.svg
  The peak of the lateral force after a hold of 100:
    stickslip run --alpha 0.8 --r 1 --hold 20,100 --until 160 -o held.json \\
        --plot held.svg
  A particle driven by its own past, the Lorenz system:
    stickslip run --tip cosine --no-spring --alpha -28 --inertia 0.1 \\
        --healing-time 1 --start-velocity 1 --until 40 -o lorenz.json
  A walker in a rotating frame, on a circular orbit, and all orbits that exist there:
    stickslip run --walker --alpha=-3 --rotation 0.3 --until 100 \\
        -o orbit.json --plot orbit.svg
  A long run that writes its samples as it goes, and survives a loss of power (errors of the period
  add up: `verify`, in twenty times the time, reports until when l is right to ten tolerances):
    stickslip run --alpha 1.2 --r 1 --until 1e6 --tolerance 1e-6 \\
        --sample-every 10 -o long.jsonl --checkpoint long.checkpoint
    stickslip run --resume long.checkpoint";
