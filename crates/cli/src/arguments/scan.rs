//! What is scanned: the options of every command that scans an area.

use super::named::named;
use clap::Args;
use std::path::PathBuf;
use stickslip::PathName;

#[derive(Debug, Args)]
pub(crate) struct ScanArguments {
    /// V in f(x,y) = f(x) exp(-y²/(2 V²)), for a tip that has no f(x,y) of its own [default: the width of the tip's
    /// Gaussians].
    #[arg(long, value_name = "V", allow_hyphen_values = true, help_heading = "Model")]
    pub(crate) width_y: Option<f64>,

    /// Distance of the lines, in σ.
    #[arg(long, value_name = "D", allow_hyphen_values = true, help_heading = "Scan")]
    pub(crate) pitch: Option<f64>,

    /// How many lines.
    #[arg(long, value_name = "N", help_heading = "Scan")]
    pub(crate) lines: Option<usize>,

    /// How far the support goes along each line, in σ; a line lasts X/r.
    #[arg(long, value_name = "X", allow_hyphen_values = true, help_heading = "Scan")]
    pub(crate) length: Option<f64>,

    /// Any shape, scanned line by line: CSV `y,start,length`, a row for each line in the order of the scan, in σ. It
    /// takes the place of --pitch, --lines and --length.
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["pitch", "lines", "length"],
        help_heading = "Scan"
    )]
    pub(crate) area: Option<PathBuf>,

    /// How the support goes from one line to the next.
    #[arg(
        long,
        value_parser = named::<PathName>(),
        value_name = "PATH",
        default_value = "one-way",
        help_heading = "Scan"
    )]
    pub(crate) path: PathName,
}
