//! `stickslip response`.

use super::brief::Brief;
use super::{AnswerArguments, Options};
use clap::Args;
use stickslip::Response;

/// Compute the linear response of steady motion to weak pulses, as a sum of modes (A.9).
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = EXAMPLES, brief())]
pub(crate) struct ResponseArguments {
    #[command(flatten)]
    pub(crate) options: Options<Response>,

    /// External force A exp(-(t-T)²/(2 W²)) on the tip, in kσ; repeatable.
    #[arg(long, value_name = "A,T,W", allow_hyphen_values = true, help_heading = "Force")]
    pub(crate) pulse: Vec<String>,

    #[command(flatten)]
    pub(crate) answer: AnswerArguments,
}

const USAGE: &str = "stickslip response (--alpha <A> | --alpha-above <D>) --r <R>
           --pulse <A,T,W> --until <T> [OPTIONS]";

const EXAMPLES: &str = "Examples:
  One pulse, below the critical point:
    stickslip response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60 \\
        --plot response.svg
  For comparison with a run, sample by sample:
    stickslip response --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60 \\
        --sample-every 0.1 -o response.csv
    stickslip run --alpha 0.9 --r 1 --pulse 1e-4,30,0.5 --until 60 \\
        --sample-every 0.1 --tolerance 1e-12 -o run.csv";
