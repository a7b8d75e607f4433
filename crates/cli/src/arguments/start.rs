//! How a run begins: the options of every command that makes one.

use super::named::named;
use clap::Args;
use std::path::PathBuf;
use stickslip::StartName;

#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Start")]
pub(crate) struct StartArguments {
    /// What the tip finds at the start [default: steady; flat with --no-spring].
    #[arg(long, value_parser = named::<StartName>(), value_name = "START")]
    pub(crate) start: Option<StartName>,

    /// Position of the tip at the start, in σ.
    #[arg(long, value_name = "X", default_value_t = 14.0, allow_hyphen_values = true)]
    pub(crate) start_position: f64,

    /// The tip starts at X - D, so that l is D above its start value.
    #[arg(long, value_name = "D", default_value_t = 0.0, allow_hyphen_values = true)]
    pub(crate) kick: f64,

    /// Velocity of a tip with inertia at the start, in kσ/Γ [default: r with --start steady, else 0].
    #[arg(long, value_name = "V", allow_hyphen_values = true)]
    pub(crate) start_velocity: Option<f64>,

    /// Motion of the support from the start of the run, which then is at t = 0: CSV `t,R` of times and
    /// displacements, from 0,0 on, straight between the rows (steps, holds, trace and retrace); --r is the
    /// velocity before.
    #[arg(long, value_name = "FILE")]
    pub(crate) support_path: Option<PathBuf>,
}
