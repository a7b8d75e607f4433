//! How a run begins: the options of every command that makes one.

use super::named::named;
use clap::Args;
use stickslip_documents::StartName;

#[derive(Debug, Clone, Copy, Args)]
#[command(next_help_heading = "Start")]
pub(crate) struct StartArguments {
    /// What the tip finds at the start.
    #[arg(long, value_parser = named::<StartName>(), value_name = "START", default_value = "steady")]
    pub(crate) start: StartName,

    /// Position of the tip at the start, in σ.
    #[arg(long, value_name = "X", default_value_t = 14.0, allow_hyphen_values = true)]
    pub(crate) start_position: f64,

    /// The tip starts at X - D, so that l is D above its start value.
    #[arg(long, value_name = "D", default_value_t = 0.0, allow_hyphen_values = true)]
    pub(crate) kick: f64,
}
