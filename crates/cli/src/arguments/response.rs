//! `stickslip response`.

use super::examples::examples;
use super::{InUnitsArguments, ModelArguments, OutletArguments, SamplingArguments};
use clap::Args;
use std::path::PathBuf;

/// The linear response of steady motion to weak pulses, as a sum of modes (A.9).
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = examples(EXAMPLES), mut_arg("r", |r| r.required(true)))]
pub(crate) struct ResponseArguments {
    #[command(flatten)]
    pub(crate) model: ModelArguments,

    /// External force A exp(-(t-T)²/(2 W²)) on the tip, in kσ; repeatable.
    #[arg(
        long,
        value_name = "A,T,W",
        allow_hyphen_values = true,
        required = true,
        help_heading = "Force"
    )]
    pub(crate) pulse: Vec<String>,

    /// At least N modes: all those right of a line chosen so.
    #[arg(long, value_name = "N", default_value_t = 10, help_heading = "Accuracy")]
    pub(crate) modes: usize,

    /// Time of the last sample, in Γ/k.
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub(crate) until: f64,

    /// The samples begin where `stickslip run` with this start position and --start steady begins, so
    /// that the two can be compared one by one.
    #[arg(
        long,
        value_name = "X",
        default_value_t = 14.0,
        allow_hyphen_values = true,
        help_heading = "Output"
    )]
    pub(crate) start_position: f64,

    #[command(flatten)]
    pub(crate) sampling: SamplingArguments,

    #[command(flatten)]
    pub(crate) in_units: InUnitsArguments,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw l - l0 against t to this .svg or .png.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const USAGE: &str = "stickslip response (--alpha <A> | --alpha-above <D>) --r <R>
           --pulse <A,T,W> --until <T> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  One pulse, below the critical point:
    stickslip response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60 --plot response.svg
  Beside a run, sample by sample:
    stickslip response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60 --sample-every 0.1 -o response.csv
    stickslip run --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60 --sample-every 0.1 --tolerance 1e-12 -o run.csv";
