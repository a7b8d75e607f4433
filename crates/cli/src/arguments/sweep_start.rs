//! Sweeps whose points are runs: the initial condition, each option a range.

use super::named::named;
use super::range::Range;
use clap::Args;
use stickslip::StartName;

#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Runs")]
pub(crate) struct SweepRunArguments {
    /// Make each point a run to this time, in Γ/k, as of `stickslip run`, instead of the motion that the tip settles
    /// into.
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub(crate) until: Option<f64>,

    /// Initial condition [default: steady].
    #[arg(long, value_parser = named::<StartName>(), value_name = "START", requires = "until")]
    pub(crate) start: Option<StartName>,

    /// Initial position X of the tip, in σ [default: 14].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, requires = "until")]
    pub(crate) start_position: Option<Range>,

    /// Displacement D: the tip starts at X - D [default: 0].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, requires = "until")]
    pub(crate) kick: Option<Range>,

    /// Initial velocity of a tip with inertia, in kσ/Γ [default: r with --start steady, else 0].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, requires = "until")]
    pub(crate) start_velocity: Option<Range>,

    /// Noise on the initial surface: heights uniform in [-A, A] on a grid, interpolated by a cubic spline [default:
    /// none; 1e-4 with --start paper].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, requires = "until")]
    pub(crate) noise: Option<Range>,

    /// Spacing of the noise grid, in σ [default: 0.1].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, requires = "noise")]
    pub(crate) noise_spacing: Option<Range>,

    /// Seeds of the noise, whole numbers: 1:100:100 makes an ensemble of a hundred [default: 1].
    #[arg(long, value_name = "RANGE", allow_hyphen_values = true, requires = "noise")]
    pub(crate) seed: Option<Range>,
}
