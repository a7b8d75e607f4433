//! The footprint: options of every command that needs one.

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
