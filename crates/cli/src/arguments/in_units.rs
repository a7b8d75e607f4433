//! Scales of an experiment, for results in physical units.

use clap::Args;
use std::path::PathBuf;

/// Options of every command with results in nm, s and nN.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Physical units")]
pub(crate) struct InUnitsArguments {
    /// Also report the result in nm, s and nN, with the scales in a document of `stickslip units`, `tip` or `fit`, or
    /// in any document with physical units; its α and r do not matter. Options then take quantities, such as --until 2s; a
    /// number without a unit is one of the model, with or without scales.
    ///
    /// Tables and pictures are in these units, and their columns and axes are named accordingly (x0_nm); in a JSON
    /// document `physical` contains them in addition to the dimensionless numbers.
    #[arg(
        long,
        value_name = "UNITS.json",
        conflicts_with_all = ["sigma", "stiffness", "damping", "velocity", "slope_force"]
    )]
    pub(crate) units: Option<PathBuf>,

    /// Width σ of the tip, such as 30nm: lengths are reported in nm. Default: that of a --tip-file written by
    /// `stickslip tip`.
    #[arg(long, value_name = "σ", visible_alias = "tip-width", allow_hyphen_values = true)]
    pub(crate) sigma: Option<String>,

    /// Spring constant k, such as 0.2N/m: with σ forces are reported in nN.
    #[arg(long, value_name = "k", allow_hyphen_values = true)]
    pub(crate) stiffness: Option<String>,

    /// Friction Γ of the tip, such as 3mNs/m: with k times are reported in s.
    #[arg(long, value_name = "Γ", allow_hyphen_values = true)]
    pub(crate) damping: Option<String>,

    /// Velocity v0 of the support, such as 1um/s: with σ and r times are reported in s, instead of Γ.
    #[arg(long, value_name = "v0", allow_hyphen_values = true)]
    pub(crate) velocity: Option<String>,

    /// Force a per slope of the surface, such as 5nN: with k and σ heights are reported in nm.
    #[arg(long, value_name = "a", allow_hyphen_values = true)]
    pub(crate) slope_force: Option<String>,
}
