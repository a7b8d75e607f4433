//! `stickslip units`.

use super::{Options, OutletArguments, Questions};
use clap::Args;
use stickslip::parameter::{Parameter, parameters};
use stickslip::{Units, UnitsDocument};

/// Convert measured quantities to the numbers of the model, and back.
///
/// Give all six quantities to obtain α and r. Or leave one out and give --r or --alpha, or leave two out and give
/// both: they are solved for, from r = Γ v0/(kσ) (12) and α = Γ N a/(σ² k²) (13). Quantities are numbers with a unit
/// and any SI prefixes, such as 50nm, 0.5N/m or 1um/s; a number without a unit is rejected.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = EXAMPLES, next_help_heading = "Quantities")]
pub(crate) struct UnitsArguments {
    /// Friction Γ of the tip (kg/s or Ns/m), (1).
    #[arg(long, value_name = "Γ", visible_alias = "gamma", allow_hyphen_values = true)]
    pub(crate) damping: Option<String>,

    /// Spring constant k (N/m), (3).
    #[arg(long, value_name = "k", visible_alias = "k", allow_hyphen_values = true)]
    pub(crate) stiffness: Option<String>,

    /// Width σ of the tip (m), (7); by default that of a --tip-file written by `stickslip tip`.
    #[arg(long, value_name = "σ", visible_alias = "sigma", allow_hyphen_values = true)]
    pub(crate) tip_width: Option<String>,

    /// Indentation rate N (m/s), (7).
    #[arg(long, value_name = "N", visible_alias = "N", allow_hyphen_values = true)]
    pub(crate) indentation_rate: Option<String>,

    /// Force a per slope of the surface (N), (4).
    #[arg(long, value_name = "a", visible_alias = "a", allow_hyphen_values = true)]
    pub(crate) slope_force: Option<String>,

    /// Velocity v0 of the support (m/s), (3).
    #[arg(long, value_name = "v0", visible_alias = "v0", allow_hyphen_values = true)]
    pub(crate) velocity: Option<String>,

    #[command(flatten)]
    pub(crate) options: Options<Given>,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,
}

/// The dimensionless numbers of the question.
#[derive(Debug)]
pub(crate) struct Given;

impl Questions for Given {
    fn parameters() -> Vec<&'static Parameter> {
        parameters::<Units>().iter().collect()
    }

    fn formats() -> Vec<&'static str> {
        vec![UnitsDocument::FORMAT]
    }
}

const USAGE: &str =
    "stickslip units --damping <Γ> --stiffness <k> --tip-width <σ> --indentation-rate <N>
           --slope-force <a> --velocity <v0> [OPTIONS]
       one of these may be replaced by --r or --alpha, two by both";

const EXAMPLES: &str = "Examples:
  α, r, the lag, and the distance from the onset of stick-slip:
    stickslip units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm \\
        --slope-force 5nN --indentation-rate 200nm/s --velocity 1um/s
  The velocity and indentation rate that give α = 1.2 and r = 1:
    stickslip units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm \\
        --slope-force 5nN --alpha 1.2 --r 1
  The indentation rate from an α fitted to a measured profile:
    stickslip units --damping 1mNs/m --stiffness 0.05N/m --tip-width 20nm \\
        --slope-force 5nN --velocity 1um/s --alpha 1.2";
