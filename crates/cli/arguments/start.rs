//! How a run begins: the options of every command that makes one.

use clap::{Args, ValueEnum};

/// What the tip finds at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum StartChoice {
    /// The steady state, as after an infinite past.
    Steady,
    /// A flat surface, the spring relaxed, the support above the tip.
    Flat,
    /// As the paper's simulations start: noise of 1e-4 on a grid of 0.05 unless told otherwise, the spring stretched
    /// by r + alpha/r; the surface flat for a tip whose f has no volume (beta = 1), else that of steady motion.
    Paper,
}

#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Start")]
pub(crate) struct StartArguments {
    /// What the tip finds at the start.
    #[arg(long, value_enum, value_name = "START", default_value = "steady")]
    pub(crate) start: StartChoice,

    /// Position of the tip at the start, in σ.
    #[arg(long, value_name = "X", default_value_t = 14.0, allow_hyphen_values = true)]
    pub(crate) start_position: f64,

    /// The tip starts at X - D, so that l is D above its start value.
    #[arg(long, value_name = "D", default_value_t = 0.0, allow_hyphen_values = true)]
    pub(crate) kick: f64,
}
