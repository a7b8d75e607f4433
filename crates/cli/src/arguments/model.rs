//! The footprint: options of every command that needs one.

use super::named::named;
use clap::Args;
use std::path::PathBuf;
use std::str::FromStr;
use stickslip::TipName;
use stickslip_units::Unit;

/// A length as typed: a number, or one with a unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Length {
    /// In the unit of its context.
    Bare(f64),
    /// In m.
    Metres(f64),
}

impl FromStr for Length {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let metres = || Unit::Length.parse(text).ok().map(Self::Metres);
        let bare = text.trim().parse().ok().map(Self::Bare);
        bare.or_else(metres).ok_or("needs a number, or for measured data a length such as 30nm")
    }
}

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
    pub(crate) width: Option<Length>,

    /// Footprint from a file: JSON {"gaussians":[{"amplitude":1,"center":0,"width":1},…]} or CSV `x,f` sampled on x ≥
    /// 0. In three dimensions each Gaussian also has a "width_y", and a "center_y" if that is not 0, or the CSV is
    /// `x,y,f` on a grid of x ≥ 0 and y ≥ 0: the motion follows f(x,0), and `surface --y-range` shows f(x,y). If the sides
    /// differ, as those of `tip --both-sides`, f'(0) must be 0; x > 0 is ahead of a tip that moves to larger x.
    #[arg(long, value_name = "FILE")]
    pub(crate) tip_file: Option<PathBuf>,

    /// Take f(-x) of the tip file, as for a tip that moves to smaller x; x then counts along its motion.
    #[arg(long, requires = "tip_file")]
    pub(crate) retrace: bool,
}

impl TipArguments {
    /// Whether any of these options was given.
    pub(crate) fn is_given(&self) -> bool {
        let Self { tip, beta, width, tip_file, retrace: _ } = self;
        tip.is_some() || beta.is_some() || width.is_some() || tip_file.is_some()
    }
}
