//! Tip, r and α: the options of every command that needs a model, or only a tip.

use super::named::named;
use clap::Args;
use std::path::PathBuf;
use stickslip::TipName;

#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Model")]
pub(crate) struct TipArguments {
    /// Footprint f(x) of the tip [default: triple-gaussian].
    #[arg(long, value_parser = named::<TipName>(), value_name = "NAME")]
    pub(crate) tip: Option<TipName>,

    /// Side-lobe weight β of the triple Gaussian: ∫f is proportional to 1 - β [default: 1].
    #[arg(long, value_name = "B", allow_hyphen_values = true)]
    pub(crate) beta: Option<f64>,

    /// Width of either Gaussian: f(x/W) [default: 1].
    #[arg(long, value_name = "W", allow_hyphen_values = true)]
    pub(crate) width: Option<f64>,

    /// Footprint from a file: JSON {"gaussians":[{"amplitude":1,"center":0,"width":1},…]} or CSV `x,f` sampled on x ≥
    /// 0. In three dimensions each Gaussian also has a "width_y", and a "center_y" if that is not 0, or the CSV is
    /// `x,y,f` on a grid of x ≥ 0 and y ≥ 0: the motion follows f(x,0), and `surface --y-range` shows f(x,y).
    #[arg(long, value_name = "FILE")]
    pub(crate) tip_file: Option<PathBuf>,
}

impl TipArguments {
    /// Whether any of these options was given.
    pub(crate) fn is_given(&self) -> bool {
        let Self { tip, beta, width, tip_file } = self;
        tip.is_some() || beta.is_some() || width.is_some() || tip_file.is_some()
    }
}

/// Commands that require r add `mut_arg("r", |r| r.required(true))`.
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

    #[command(flatten)]
    pub(crate) wider: WiderArguments,
}

/// Options of the extended model.
#[derive(Debug, Clone, Default, Args)]
#[command(next_help_heading = "Extended model")]
pub(crate) struct WiderArguments {
    /// Depth limit b of (61), in kσ²/a; above 0: the tip indents at the rate α exp(-|u|/b) [default: none].
    #[arg(long, value_name = "B", allow_hyphen_values = true)]
    pub(crate) depth_limit: Option<f64>,

    /// Healing time T: the surface relaxes as exp(-t/T); in Γ/k, above 0 [default: never].
    #[arg(long, value_name = "T", allow_hyphen_values = true)]
    pub(crate) healing_time: Option<f64>,

    /// Inertia of the tip, in Γ²/k; above 0 [default: none].
    #[arg(long, value_name = "M", allow_hyphen_values = true)]
    pub(crate) inertia: Option<f64>,

    /// No spring and no support: a particle driven by its own groove. There is no --r then, --alpha may be below 0,
    /// and the initial surface is flat.
    #[arg(long)]
    pub(crate) no_spring: bool,
}
