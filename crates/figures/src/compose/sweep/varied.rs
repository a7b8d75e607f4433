//! What a sweep varies, and what its points come to.

use crate::compose::labels::{ALPHA, R};
use stickslip_documents::{ColourName, RegimeName, SweepParameters, SweepPoint};

/// A parameter that varies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Varied<'a> {
    pub(super) values: &'a [f64],
    pub(super) label: &'static str,
    /// Index of a point in the grid to its place along this axis.
    pub(super) stride: usize,
}

impl Varied<'_> {
    pub(super) fn place(&self, point: &SweepPoint) -> usize {
        point.index / self.stride % self.values.len()
    }
}

/// Those that vary, the slowest first.
pub(super) fn varied(parameters: &SweepParameters) -> Vec<Varied<'_>> {
    let SweepParameters { beta, r, alpha, alpha_above, .. } = parameters;
    let above = alpha_above.as_deref().map(|values| (values, "α − α_c"));
    let (alphas, label) =
        alpha.as_deref().map(|values| (values, ALPHA)).or(above).unwrap_or((&[], ALPHA));
    let stride = alphas.len().max(1);
    let all = [
        Varied {
            values: beta.as_deref().unwrap_or(&[]),
            label: "β",
            stride: stride * r.len().max(1),
        },
        Varied { values: r, label: R, stride },
        Varied { values: alphas, label, stride: 1 },
    ];
    all.into_iter().filter(|axis| axis.values.len() > 1).collect()
}

/// Kinds of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Phase {
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
            (RegimeName::Transient | RegimeName::Drifting, _) => Self::Unsettled,
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

    pub(super) fn colour(self) -> ColourName {
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
