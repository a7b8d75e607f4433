//! `stickslip figures`.

use clap::{Args, ValueEnum};
use std::path::PathBuf;

/// Figures and tables that can be made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum FigureName {
    /// Surfaces below and above onset, and the velocity of the tip.
    Fig1,
    /// Squared amplitudes against α - αc.
    Fig2,
    /// Wavelength against α - αc.
    Fig3,
    /// Surface and initial surface of the Gaussian tip.
    Fig4,
    /// Squared amplitudes against r - rc.
    Fig5,
    /// The stability boundary.
    Fig6,
    /// The surface in three dimensions.
    Fig7,
    /// The extremes of l against α, with the period doublings.
    Bifurcation,
    /// Criticality along the boundary.
    Criticality,
    /// u over position and time.
    Kymograph,
    /// Time against error, from saved measurements.
    WorkPrecision,
    /// The paper's numbers compared with ours.
    Reproduction,
}

impl FigureName {
    /// Name of the figure in the library; `None` for the table of numbers.
    pub(crate) fn figure(self) -> Option<String> {
        let name = self.to_possible_value().filter(|_| self != Self::Reproduction);
        name.map(|name| name.get_name().to_owned())
    }
}

/// Redraw the paper's figures, and compare its numbers with ours.
///
/// Each figure is written as JSON and drawn from it as SVG and PNG; reproduction.md and .json contain the printed
/// numbers, ours, and the explanation of each difference. The figures for β = 0 use exp(-x²), the tip of the printed
/// numbers.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct FiguresArguments {
    /// Output folder; it is created if necessary, and files of the same names are replaced.
    #[arg(long, value_name = "DIR")]
    pub(crate) out_dir: PathBuf,

    /// Make only these figures, and the table of numbers only if `reproduction` is among them.
    #[arg(long, value_enum, value_name = "NAME1,NAME2,…", value_delimiter = ',')]
    pub(crate) only: Option<Vec<FigureName>>,
}

const EXAMPLES: &str = "Examples:
  stickslip figures --out-dir figures
  stickslip figures --out-dir figures --only fig6,reproduction";
