//! When a motion is sampled: the options of every command that gives one.

use clap::Args;
use stickslip::Sampling;

#[derive(Debug, Args)]
pub(crate) struct SamplingArguments {
    /// Sample every DT [default: 2,000 intervals].
    #[arg(
        long,
        value_name = "DT",
        conflicts_with = "sample_at",
        allow_hyphen_values = true,
        help_heading = "Output"
    )]
    pub(crate) sample_every: Option<f64>,

    /// Sample at these times.
    #[arg(
        long,
        value_name = "T1,T2,…",
        value_delimiter = ',',
        allow_hyphen_values = true,
        help_heading = "Output"
    )]
    pub(crate) sample_at: Option<Vec<f64>>,
}

impl SamplingArguments {
    pub(crate) fn sampling(&self) -> Sampling {
        Sampling { sample_every: self.sample_every, sample_at: self.sample_at.clone() }
    }
}
