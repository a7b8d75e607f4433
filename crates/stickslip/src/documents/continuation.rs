//! `stickslip/continue`.

use crate::documents::table::{Array, Column, Named, Tabular};
use crate::{Document, ModelParameters, Question};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_cycles::{Branch, End, Parameter, Point, Special, SpecialKind};

/// Branches of periodic motions. Lengths in σ, times in Γ/k, heights in kσ²/a; amplitudes are half
/// peak-to-peak.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContinueFound {
    /// The first, and with --switch those of twice its period, of four times, ….
    pub branches: Vec<CycleBranch>,
    /// Where something happens to the cycles of a branch, in order of the branches.
    pub special: Vec<SpecialDocument>,
    /// The value of what varies at which the tip can be trapped for ever; null if there is none.
    pub trapping: Option<f64>,
    /// Whether a signal stopped it.
    pub interrupted: bool,
}

/// The document of that.
pub type ContinueDocument = Document<ContinueParameters>;

impl Question for ContinueParameters {
    const FORMAT: &'static str = "stickslip/continue";
    type Answer = ContinueFound;
}

/// What was asked for.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct ContinueParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// What varies.
    pub over: OverName,
    /// Its last value, if any.
    pub to: Option<f64>,
    /// Whether the branches of twice the period were followed.
    pub switch: bool,
    /// The period, in Γ/k, beyond which a branch is not followed.
    pub longest_period: f64,
    /// Longest step from one cycle to the next, in relative changes of parameter, period and l.
    pub longest_step: f64,
    /// Number of cycles with which a branch ends at the latest.
    pub most_points: usize,
    /// Largest residual of (18), in kσ/Γ.
    pub tolerance: f64,
}

/// What varies along a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum OverName {
    /// α at fixed r.
    Alpha,
    /// r at fixed α.
    R,
}

/// Cycles in the order in which they were found; columns of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CycleBranch {
    /// Index in `special` of the period doubling that it began at; null for the first branch.
    pub from: Option<usize>,
    /// α of each cycle, dimensionless (13).
    pub alpha: Vec<f64>,
    /// r of each cycle, dimensionless (12).
    pub r: Vec<f64>,
    /// T of each cycle, in Γ/k.
    pub period: Vec<f64>,
    /// Half peak-to-peak of l, that is of x0 less its steady advance, in σ.
    pub amplitude_x0: Vec<f64>,
    /// Half peak-to-peak of the surface far behind the tip, (35), in kσ²/a. Where the surface heals, u at the distance D
    /// behind the support is U(x) e^{-D/(rT)} with a periodic U(x), and this is half peak-to-peak of U.
    pub amplitude_u: Vec<f64>,
    /// Whether every small deviation from the cycle but a shift in time dies out.
    pub stable: Vec<bool>,
    /// Real part of the largest Floquet multiplier but that of a shift in time, dimensionless; 0 where all are
    /// below 1e-6.
    pub multiplier_re: Vec<f64>,
    /// Its imaginary part.
    pub multiplier_im: Vec<f64>,
    /// Why it ends where it does.
    pub end: EndName,
}

/// Why a branch ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum EndName {
    /// What varies has its last value.
    Reached,
    /// The period exceeds the longest one.
    LongPeriod,
    /// The cycle has shrunk to steady motion.
    Steady,
    /// It joins the branch of half the period.
    Halved,
    /// Enough cycles.
    ManyPoints,
    /// No cycle was found a shortest step further on.
    Lost,
    /// A signal.
    Interrupted,
}

/// A point where something happens to the cycles of a branch.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpecialDocument {
    /// What.
    pub kind: SpecialName,
    /// Index in `branches`.
    pub branch: usize,
    /// α there, dimensionless (13).
    pub alpha: f64,
    /// r there, dimensionless (12).
    pub r: f64,
    /// T of the cycle there, in Γ/k; at a Hopf point that of the oscillation that is born.
    pub period: f64,
    /// Half peak-to-peak of l of the cycle there, in σ; 0 at a Hopf point.
    pub amplitude_x0: f64,
}

/// Kinds of special points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SpecialName {
    /// The cycle vanishes into steady motion.
    Hopf,
    /// The branch turns back.
    Fold,
    /// A multiplier passes -1: a branch of twice the period begins.
    PeriodDoubling,
    /// The branch joins one of half the period, where that doubles it; period and amplitude are that one's.
    PeriodHalving,
    /// A second multiplier passes 1, and the branch does not turn: another branch crosses.
    BranchPoint,
    /// A complex pair crosses the unit circle: a torus is born.
    Torus,
}

impl CycleBranch {
    /// A branch, and the index in `special` of the period doubling that it began at.
    pub fn of(branch: &Branch, from: Option<usize>) -> Self {
        let points = &branch.points;
        let column = |of: fn(&Point) -> f64| points.iter().map(of).collect();
        Self {
            from,
            alpha: column(|p| p.alpha),
            r: column(|p| p.r),
            period: column(|p| p.period),
            amplitude_x0: column(|p| p.amplitude_x0),
            amplitude_u: column(|p| p.amplitude_u),
            stable: points.iter().map(|p| p.stable).collect(),
            multiplier_re: column(|p| p.leading.re),
            multiplier_im: column(|p| p.leading.im),
            end: branch.end.into(),
        }
    }
}

impl SpecialDocument {
    /// A point of the branch with this index.
    pub fn of(branch: usize, special: &Special) -> Self {
        Self {
            kind: special.kind.into(),
            branch,
            alpha: special.alpha,
            r: special.r,
            period: special.period,
            amplitude_x0: special.cycle.as_ref().map_or(0.0, |cycle| cycle.amplitude_x0()),
        }
    }
}

impl From<OverName> for Parameter {
    fn from(name: OverName) -> Self {
        match name {
            OverName::Alpha => Self::Alpha,
            OverName::R => Self::R,
        }
    }
}

impl From<End> for EndName {
    fn from(end: End) -> Self {
        match end {
            End::Reached => Self::Reached,
            End::LongPeriod => Self::LongPeriod,
            End::Steady => Self::Steady,
            End::Halved => Self::Halved,
            End::ManyPoints => Self::ManyPoints,
            End::Lost => Self::Lost,
            End::Interrupted => Self::Interrupted,
        }
    }
}

impl From<SpecialKind> for SpecialName {
    fn from(kind: SpecialKind) -> Self {
        match kind {
            SpecialKind::Hopf => Self::Hopf,
            SpecialKind::Fold => Self::Fold,
            SpecialKind::PeriodDoubling => Self::PeriodDoubling,
            SpecialKind::PeriodHalving => Self::PeriodHalving,
            SpecialKind::BranchPoint => Self::BranchPoint,
            SpecialKind::Torus => Self::Torus,
        }
    }
}

impl Tabular for ContinueFound {
    /// The cycles of all branches, one after the other.
    fn columns(&self) -> Vec<Named<'_>> {
        let joined = |of: fn(&CycleBranch) -> &Vec<f64>| -> Column {
            self.branches.iter().flat_map(of).copied().collect::<Vec<_>>().into()
        };
        let numbers = self.branches.iter().enumerate();
        let numbers: Vec<f64> = numbers.flat_map(|(i, b)| vec![i as f64; b.alpha.len()]).collect();
        let stable = self.branches.iter().flat_map(|b| &b.stable);
        let stable: Vec<f64> = stable.map(|stable| f64::from(u8::from(*stable))).collect();
        vec![
            ("branch", numbers.into()),
            ("alpha", joined(|b| &b.alpha)),
            ("r", joined(|b| &b.r)),
            ("period", joined(|b| &b.period)),
            ("amplitude_x0", joined(|b| &b.amplitude_x0)),
            ("amplitude_u", joined(|b| &b.amplitude_u)),
            ("stable", stable.into()),
            ("multiplier_re", joined(|b| &b.multiplier_re)),
            ("multiplier_im", joined(|b| &b.multiplier_im)),
        ]
    }

    fn note(&self) -> Option<String> {
        self.interrupted.then(|| "interrupted: more of the branches was asked for".into())
    }

    /// A branch cut short says so.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let columns = self.columns().into_iter();
        let columns = columns.filter_map(|(name, column)| Some((name, column.array()?)));
        let mark = self.interrupted.then(|| ("interrupted", Array::vector(vec![1.0])));
        columns.chain(mark).collect()
    }
}
