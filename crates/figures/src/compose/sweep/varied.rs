//! Parameters that a sweep varies, and regimes of its points.

use crate::compose::axes::{ALPHA, R};
use stickslip::{AxisName, ColourName, RegimeName, SweepParameters, SweepPoint};

/// A parameter that varies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Varied<'a> {
    pub(super) values: &'a [f64],
    pub(super) label: &'static str,
    /// Number of consecutive points with the same value of this parameter.
    pub(super) stride: usize,
}

impl Varied<'_> {
    pub(super) fn place(&self, point: &SweepPoint) -> usize {
        point.index / self.stride % self.values.len()
    }
}

/// The parameters that vary, the slowest first. Seeds are included only if nothing else varies, because their points
/// coincide.
pub(super) fn varied(parameters: &SweepParameters) -> Vec<Varied<'_>> {
    let mut all = all(parameters);
    all.retain(|axis| axis.values.len() > 1);
    if all.len() > 1 {
        all.retain(|axis| axis.label != AxisName::Seed.label());
    }
    all
}

fn all(parameters: &SweepParameters) -> Vec<Varied<'_>> {
    let SweepParameters { width, beta, r, alpha, alpha_above, axes, .. } = parameters;
    let above = alpha_above.as_deref().map(|values| (values, "α − α_c"));
    let (alphas, label) =
        alpha.as_deref().map(|values| (values, ALPHA)).or(above).unwrap_or((&[], ALPHA));
    let further = axes.iter().map(|axis| (axis.values.as_slice(), axis.name.label()));
    let of_tip = [(width, "width (σ)"), (beta, "β")];
    let of_tip = of_tip.map(|(values, label)| (values.as_deref().unwrap_or(&[]), label));
    let named = of_tip.into_iter().chain([(r.as_slice(), R), (alphas, label)]).chain(further);
    // From the last, which varies fastest.
    let mut stride = 1;
    let mut all: Vec<Varied> = vec![];
    for (values, label) in named.collect::<Vec<_>>().into_iter().rev() {
        all.push(Varied { values, label, stride });
        stride *= values.len().max(1);
    }
    all.reverse();
    all
}

/// Regimes of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::compose) enum Phase {
    Steady,
    OneSlip,
    TwoSlips,
    MoreSlips,
    Trapped,
    Unsettled,
}

impl Phase {
    pub(super) const ALL: [Self; 6] = [
        Self::Steady,
        Self::OneSlip,
        Self::TwoSlips,
        Self::MoreSlips,
        Self::Trapped,
        Self::Unsettled,
    ];

    pub(super) fn of(point: &SweepPoint) -> Option<Self> {
        Some(match (point.regime?, point.slips) {
            (RegimeName::Steady, _) => Self::Steady,
            (RegimeName::StickSlip, Some(1)) => Self::OneSlip,
            (RegimeName::StickSlip, Some(2)) => Self::TwoSlips,
            (RegimeName::StickSlip, _) => Self::MoreSlips,
            (RegimeName::Trapped, _) => Self::Trapped,
            (RegimeName::Transient | RegimeName::Drifting | RegimeName::Snaking, _) => {
                Self::Unsettled
            }
        })
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Steady => "steady",
            Self::OneSlip => "one slip a period",
            Self::TwoSlips => "two slips",
            Self::MoreSlips => "three or more",
            Self::Trapped => "trapped",
            Self::Unsettled => "not settled",
        }
    }

    pub(in crate::compose) const fn colour(self) -> ColourName {
        match self {
            Self::Steady => ColourName::Silver,
            Self::OneSlip => ColourName::Blue,
            Self::TwoSlips => ColourName::Vermillion,
            Self::MoreSlips => ColourName::Orange,
            Self::Trapped => ColourName::Black,
            Self::Unsettled => ColourName::Purple,
        }
    }
}
