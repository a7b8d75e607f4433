//! `stickslip fit`.

use super::examples::examples;
use super::{OutletArguments, TipArguments};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Estimate α, r and σ from ripples, lateral forces, onsets and wavelengths, with 95 % intervals.
///
/// Compares the settled motion, the limit cycle at α and r, with measured ripples and forces. Offsets, slopes, phases
/// and unknown gains are fitted simultaneously; both scan directions are tried; starting values are estimated from
/// the data. Several data sets of one motion may be combined. Intervals follow from the profile likelihood, widened
/// for noise that is correlated from row to row and for the error of a measured footprint. The noise is estimated
/// from the scatter between wavelengths: data without a significant ripple are rejected, and a model that does not
/// explain the data gets no intervals.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = examples(EXAMPLES))]
pub(crate) struct FitArguments {
    /// Heights of ripples far behind the tip, along its path, by a heading such as `x_nm,z_nm`; or t,x,u, as `surface`
    /// writes it.
    #[arg(long, value_name = "FILE", help_heading = "Data")]
    pub(crate) ripple: Vec<PathBuf>,

    /// Lateral force against the position of the support, two columns; three are a loop: trace, then retrace, over
    /// the same positions.
    #[arg(long, value_name = "FILE", help_heading = "Data")]
    pub(crate) friction: Vec<PathBuf>,

    /// Velocities, and the loads at the onset of stick-slip, two columns.
    #[arg(long, value_name = "FILE", help_heading = "Data")]
    pub(crate) onsets: Option<PathBuf>,

    /// Velocities, loads, and wavelengths of ripples, three columns.
    #[arg(long, value_name = "FILE", help_heading = "Data")]
    pub(crate) wavelengths: Option<PathBuf>,

    /// k/a, if known: heights in the units of the data are k/a times σ² times those of the model.
    #[arg(long, value_name = "G", allow_hyphen_values = true, help_heading = "Data")]
    pub(crate) height_gain: Option<f64>,

    /// k, if known: forces in the units of the data are k times σ times those of the model.
    #[arg(long, value_name = "K", allow_hyphen_values = true, help_heading = "Data")]
    pub(crate) force_gain: Option<f64>,

    /// Unit of lengths, for files without one and for the result [default: that of the first file].
    #[arg(long, value_name = "UNIT", help_heading = "Data")]
    pub(crate) unit: Option<String>,

    /// Reduce the weight of outliers, by Huber's weights.
    #[arg(long, help_heading = "Data")]
    pub(crate) robust: bool,

    /// Direction in which the tip moved along the positions of ripples and traces [default: both are tried].
    #[arg(long, value_name = "DIRECTION", help_heading = "Data")]
    pub(crate) scan: Option<ScanName>,

    /// --width is σ in the unit of the data, if known.
    #[command(flatten)]
    pub(crate) tip: TipArguments,

    /// r, if known.
    #[arg(long, value_name = "R", allow_hyphen_values = true, help_heading = "Known")]
    pub(crate) r: Option<f64>,

    /// α, if known.
    #[arg(long, value_name = "A", allow_hyphen_values = true, help_heading = "Known")]
    pub(crate) alpha: Option<f64>,

    /// Depth limit b of (61), in kσ²/a, if known.
    #[arg(long, value_name = "B", allow_hyphen_values = true, help_heading = "Known")]
    pub(crate) depth_limit: Option<f64>,

    /// Healing time T of the surface, in Γ/k, if known.
    #[arg(long, value_name = "T", allow_hyphen_values = true, help_heading = "Known")]
    pub(crate) healing_time: Option<f64>,

    /// Inertia of the tip, in Γ²/k, if known.
    #[arg(long, value_name = "M", allow_hyphen_values = true, help_heading = "Known")]
    pub(crate) inertia: Option<f64>,

    /// Further parameters to fit: beta, depth-limit, healing-time, inertia.
    #[arg(long, value_name = "NAME,…", value_delimiter = ',', help_heading = "Fitted")]
    pub(crate) free: Vec<String>,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw data, model, residuals and the profiles of the likelihood to this .svg, .png or .pdf.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

/// A direction along the positions.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum ScanName {
    /// Towards larger positions
    Right,
    /// Towards smaller positions
    Left,
}

const USAGE: &str = "stickslip fit --ripple <FILE> [--friction <FILE>] [OPTIONS]
       stickslip fit --onsets <FILE> [--wavelengths <FILE>] [OPTIONS]";

const EXAMPLES: &str = "Examples:
  α, r and σ from ripples in nm, by the tip measured before, drawn:
    stickslip fit --ripple ripples.csv --tip-file tip.json -o fit.json --plot fit.svg
  The same with σ known, and with the lateral force of the same scan:
    stickslip fit --ripple ripples.csv --friction trace.csv --tip-file tip.json --width 30
  A depth limit too, of rows some of which are dust:
    stickslip fit --ripple ripples.csv --free depth-limit --robust
  α per load and r per velocity from onsets:
    stickslip fit --onsets onsets.csv --tip-file tip.json";
