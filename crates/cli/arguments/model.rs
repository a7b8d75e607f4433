//! Tip, r and α: the options of every command that needs a model, or only a tip.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum TipName {
    /// (48): a Gaussian with side lobes of weight -beta/2 at ±2 widths.
    TripleGaussian,
    /// exp(-x²/(2 W²)).
    Gaussian,
    /// The Bessel function J0(x).
    Bessel,
}

#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Model")]
pub(crate) struct TipArguments {
    /// Footprint f(x) of the tip [default: triple-gaussian].
    #[arg(long, value_enum, value_name = "NAME")]
    pub(crate) tip: Option<TipName>,

    /// Side lobes of the triple Gaussian; 1 keeps the volume [default: 1].
    #[arg(long, value_name = "B", allow_hyphen_values = true)]
    pub(crate) beta: Option<f64>,

    /// Width of either Gaussian: f(x/W) [default: 1].
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    pub(crate) width: Option<f64>,

    /// Footprint from a file: JSON {"gaussians":[{"amplitude":1,"center":0,"width":1},…]} or CSV `x,f`
    /// sampled on x ≥ 0. In three dimensions each Gaussian has a "width_y" too, and a "center_y" if that
    /// is not 0, or the CSV is `x,y,f` on a grid of x ≥ 0 and y ≥ 0: the motion follows f(x,0), and
    /// `surface --y-range` shows the rest.
    #[arg(long, value_name = "FILE")]
    pub(crate) tip_file: Option<PathBuf>,
}

/// Commands that cannot do without r add `mut_arg("r", |r| r.required(true))`.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Model")]
pub(crate) struct ModelArguments {
    #[command(flatten)]
    pub(crate) tip: TipArguments,

    /// Dimensionless support velocity Γ v0/(k σ), (12); above 0.
    #[arg(long, value_name = "R", allow_hyphen_values = true)]
    pub(crate) r: Option<f64>,

    /// Dimensionless indentation rate Γ N a/(σ² k²), (13); 0 or above.
    #[arg(long, value_name = "A", allow_hyphen_values = true)]
    pub(crate) alpha: Option<f64>,

    /// Indentation rate given as αc(r) + D, D above the critical one (below, if negative).
    #[arg(long, value_name = "D", allow_hyphen_values = true)]
    pub(crate) alpha_above: Option<f64>,
}
