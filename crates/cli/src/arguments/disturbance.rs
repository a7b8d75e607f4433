//! Disturbances of a run: the options of every command that integrates the motion.

use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Clone, Args)]
pub(crate) struct DisturbanceArguments {
    /// Noise on the initial surface: heights uniform in [-A, A] on a grid, interpolated by a cubic spline; A is 0 or
    /// above [default: none; 1e-4 with --start paper].
    #[arg(long, value_name = "A", allow_hyphen_values = true, help_heading = "Start")]
    pub(crate) noise: Option<f64>,

    /// Spacing of the noise grid, in σ [default: 0.1]. It is part of the initial condition: white noise has no limit
    /// as the spacing goes to 0.
    #[arg(long, value_name = "S", allow_hyphen_values = true, help_heading = "Start")]
    pub(crate) noise_spacing: Option<f64>,

    /// Seed of the noise [default: 1].
    #[arg(long, value_name = "N", allow_hyphen_values = true, help_heading = "Start")]
    pub(crate) seed: Option<u64>,

    /// Profile added to the initial surface: CSV `x,u`, interpolated by a cubic spline with level ends, 0 outside;
    /// or, with --start flat, one surface `t,x,u` as written by `surface -o FILE.csv`, which contains the groove
    /// already. Columns with a unit in their heading, x_nm,u_nm, are converted by --units or --sigma.
    #[arg(long, value_name = "FILE", help_heading = "Start")]
    pub(crate) initial_surface: Option<PathBuf>,

    /// External force A exp(-(t-T)²/(2 W²)) on the tip, in kσ; repeatable. A pulse that begins before the start,
    /// or comes after the end, causes a warning.
    #[arg(long, value_name = "A,T,W", allow_hyphen_values = true, help_heading = "Force")]
    pub(crate) pulse: Vec<String>,

    /// External force from a file: CSV `t,force`, interpolated by a cubic spline, 0 outside; or with units,
    /// t_s,force_nN.
    #[arg(long, value_name = "FILE", help_heading = "Force")]
    pub(crate) force_file: Option<PathBuf>,
}

impl DisturbanceArguments {
    /// An option that describes a noise, if one is given.
    pub(crate) fn of_noise(&self) -> Option<&'static str> {
        let spacing = self.noise_spacing.map(|_| "--noise-spacing");
        spacing.or(self.seed.map(|_| "--seed"))
    }
}
