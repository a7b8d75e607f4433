//! `stickslip friction`.

use super::brief::Brief;
use super::{Options, OutletArguments};
use clap::Args;
use std::path::PathBuf;
use stickslip::Friction;

/// Compute friction forces and work from a measured loop of lateral force, with 95 % intervals.
///
/// Trace and retrace of one line give the kinetic friction force, the static peak after each reversal, the hysteresis and the
/// work of a loop, in nN and fJ if the units are known. A run is evaluated from its samples. The zero of the instrument is
/// removed. Errors of means account for the correlation of stick-slip; the error of the peak follows from the noise of the rows
/// near it.
#[derive(Debug, Args)]
#[command(override_usage = USAGE, after_help = EXAMPLES, brief())]
pub(crate) struct FrictionArguments {
    /// Positions of the support and lateral forces of the trace, by a heading such as `x_nm,force_nN`; with a third column,
    /// the retrace over the same positions. Or a document of `run`: the last closed loop of its --support-path.
    #[arg(value_name = "TRACE.csv")]
    pub(crate) trace: PathBuf,

    /// Positions and lateral forces of the retrace, converted to the units of the trace; or the run of the retrace.
    #[arg(value_name = "RETRACE.csv")]
    pub(crate) retrace: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) options: Options<Friction>,

    /// Lateral spring constant, such as 0.2N/m, for data that are deflections, in a unit of length.
    #[arg(long, value_name = "k", help_heading = "Physical units", allow_hyphen_values = true)]
    pub(crate) stiffness: Option<String>,

    /// Force of one unit of the data, such as 25nN/V or 25pN/mV, for data that are neither forces nor deflections.
    #[arg(
        long,
        value_name = "F/UNIT",
        help_heading = "Physical units",
        allow_hyphen_values = true,
        conflicts_with = "stiffness"
    )]
    pub(crate) sensitivity: Option<String>,

    #[command(flatten)]
    pub(crate) outlet: OutletArguments,

    /// Draw the loop to this .svg, .png or .pdf.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) plot: Option<PathBuf>,
}

const USAGE: &str = "stickslip friction [OPTIONS] <TRACE.csv> <RETRACE.csv>
       stickslip friction [OPTIONS] <LOOP.csv|RUN.json>";

const EXAMPLES: &str = "Examples:
  Two tables with headings x_nm,force_nN:
    stickslip friction trace.csv retrace.csv -o friction.json \\
        --plot friction.svg
  One table of three columns, position, trace and retrace, of deflections in nm:
    stickslip friction loop.csv --stiffness 0.2N/m
  A run whose support returns, such as that of `stickslip run --support-path path.csv --sample-every 0.1 -o loop.json`:
    stickslip friction loop.json
  Voltages of a photodiode, calibrated to 25 nN per volt:
    stickslip friction trace.csv retrace.csv --sensitivity 25nN/V \\
        --print work.value";
