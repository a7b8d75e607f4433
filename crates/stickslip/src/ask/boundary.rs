//! The question `boundary`, and its answer.

use crate::documents::table::{Named, Tabular, columns};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, Context, Document, Failure, Indentation, Law, ModelParameters, Question, Refused, Tip,
    Typed,
};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;
use std::fmt::Display;
use stickslip_stability::{
    self as stability, BoundaryBranch, Critical, Criticality, OnsetKind, StabilityError,
    memory_length, onset_at,
};
use stickslip_tip::{TipFunction, Wider};

/// The critical α over a range of r, and the oscillation that bifurcates there.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Boundary {
    /// Footprint f(x) of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// First and last r, above 0, and the number of values, both ends included.
    #[schemars(extend("x-option" = option("LO:HI:N", "Boundary", 20)))]
    pub r_range: [f64; 2],
    /// Number of values, if the range does not contain it; from 2 to 100,000.
    #[schemars(extend("x-option" = option("N", "Boundary", 21)))]
    #[serde(default = "default_points")]
    pub points: usize,
    /// Spacing of the values of the range.
    #[schemars(extend("x-option" = option("NAME", "Boundary", 22)))]
    #[serde(default)]
    pub spacing: SpacingName,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
}

pub(super) fn default_points() -> usize {
    Boundary::DEFAULT_POINTS
}

/// A boundary and the question that it answers.
pub type BoundaryDocument = Document<Boundary>;

/// The stability boundary. `Omega`, `r`, `alpha` and the columns of `onset` have equal lengths.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BoundaryFound {
    /// Ω = ω/r of the oscillation at onset, in 1/σ.
    #[serde(rename = "Omega")]
    pub wave_number: Vec<f64>,
    /// r, ascending, without the values for which there is no critical α.
    pub r: Vec<f64>,
    /// αc(r), the first crossing: steady motion is stable below.
    pub alpha: Vec<f64>,
    /// The oscillation at onset.
    pub onset: OnsetColumns,
    /// The whole curve (42), (43) within the range of r, in stretches with contiguous Ω. If there are several, or if
    /// one turns back in r, the parts above αc(r) are crossings of further pairs of roots. Empty for the extended
    /// model.
    pub branches: Vec<BoundaryBranch>,
    /// Extended model only: the kind of onset at each r.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub kind: Vec<OnsetKind>,
    /// Extended model only: conditions under which steady motion is stable at every α.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limits: Option<LimitColumns>,
}

impl Boundary {
    /// Number of values of r, by default.
    pub const DEFAULT_POINTS: usize = 200;
    /// Largest number of points: more would take hours.
    pub const MOST_POINTS: usize = 100_000;

    /// The boundary over a range of r, in 200 points, for the basic model.
    pub fn new(tip: Tip, r_range: [f64; 2]) -> Self {
        let (points, spacing) = (default_points(), SpacingName::default());
        Self { tip, r_range, points, spacing, law: Law::default() }
    }

    /// The model at a point of the boundary.
    pub fn at(&self, r: f64, alpha: f64) -> ModelParameters {
        ModelParameters::of_question(&self.tip, Indentation::given(alpha), r, self.law)
    }

    /// Rejects an invalid range, or too few or too many points.
    fn judged(&self) -> Result<(), Refused> {
        let [low, high] = self.r_range;
        let refused = |why: &str| Err(self.refused(why));
        if !(low.is_finite() && high.is_finite() && low < high) {
            return refused("must be two finite numbers, the first below the second");
        }
        if low <= 0.0 {
            return refused("needs numbers above 0, such as 0.05 and 3");
        }
        judge_points(self.points)
    }

    fn refused(&self, why: impl Display) -> Refused {
        refused_range("r_range", self.r_range, self.points, why)
    }

    /// The boundary of the basic model, with criticality and all stretches of the curve.
    fn basic(&self, context: &Context) -> Result<(BoundaryFound, Vec<String>), Failure> {
        let tip = &self.tip.0;
        let boundary = stability::Boundary::new(&Wider::default(), tip);
        let steps = 2 * self.points;
        let (mut along, mut left_out) = (vec![], vec![]);
        for (n, r) in self.spacing.values(self.r_range, self.points).into_iter().enumerate() {
            match boundary.at(r) {
                Ok(found) => along.push(found),
                Err(error) => left_out.push(error),
            }
            context.counted(n + 1, steps, "steps")?;
        }
        if let (true, Some(error)) = (along.is_empty(), left_out.first()) {
            return Err(self.refused(error).into());
        }
        let [low, high] = self.r_range;
        let branches = boundary.branches(low, high, self.points);
        let branches = branches.map_err(|error| self.refused(error))?;
        let mut onset = OnsetColumns::default();
        for (n, at) in along.iter().enumerate() {
            onset.push(tip, at);
            context.counted(self.points + n + 1, steps, "steps")?;
        }
        let found = BoundaryFound { branches, ..BoundaryFound::through(along.iter(), onset) };
        Ok((found, left_out_remark(&left_out).into_iter().collect()))
    }

    /// The boundary of an extended model. A model without any instability is an answer too.
    fn extended(
        &self,
        law: &Wider,
        context: &Context,
    ) -> Result<(BoundaryFound, Vec<String>), Failure> {
        let tip = &self.tip.0;
        let boundary = stability::Boundary::new(law, tip);
        let values = self.spacing.values(self.r_range, self.points);
        let (mut along, mut left_out, mut least) = (vec![], vec![], vec![]);
        for (n, r) in values.iter().enumerate() {
            match boundary.at(*r) {
                Ok(found) => along.push(found),
                Err(
                    error @ (StabilityError::NoCrossing { .. } | StabilityError::Unsettled { .. }),
                ) => {
                    left_out.push(error);
                }
                Err(StabilityError::Wider(error)) => return Err(Refused::from(error).into()),
                Err(error) => return Err(self.refused(error).into()),
            }
            least.push(boundary.least_depth_limit(*r).ok());
            context.counted(n + 1, self.points, "steps")?;
        }
        let found = BoundaryFound {
            kind: along.iter().map(|at| at.kind).collect(),
            limits: Some(LimitColumns {
                r: values,
                least_depth_limit: least,
                memory_length: memory_length(tip).ok(),
            }),
            ..BoundaryFound::through(along.iter(), OnsetColumns::unknown(along.len()))
        };
        Ok((found, remarks(&along, &left_out)))
    }
}

/// Rejects too few or too many values of a range.
fn judge_points(points: usize) -> Result<(), Refused> {
    if (2..=Boundary::MOST_POINTS).contains(&points) {
        return Ok(());
    }
    let why = format!("must be from 2 to {}", Boundary::MOST_POINTS);
    Err(Refused::number("points", points as f64, why))
}

/// Rejects a range unless its ends are finite, above 0 and ascending, and its number of values is allowed.
pub(crate) fn judge_range(
    name: &'static str,
    [low, high]: [f64; 2],
    points: usize,
) -> Result<(), Refused> {
    if !(high.is_finite() && 0.0 < low && low < high) {
        let why = "must be two finite numbers above 0, the first below the second";
        return Err(refused_range(name, [low, high], points, why));
    }
    judge_points(points)
}

/// A rejection of a range, with its value as typed.
pub(crate) fn refused_range(
    name: &'static str,
    ends: [f64; 2],
    points: usize,
    why: impl Display,
) -> Refused {
    let [low, high] = ends.map(Typed);
    Refused::word(name, format!("{low}:{high}:{points}"), why)
}

impl Question for Boundary {
    const FORMAT: &'static str = "stickslip/boundary";
    type Answer = BoundaryFound;
}

impl Ask for Boundary {
    fn answer(&self, context: &Context) -> Result<(BoundaryFound, Vec<String>), Failure> {
        self.judged()?;
        let law = self.law.dragged(&self.tip.0)?;
        if law.is_basic() && self.tip.0 != TipFunction::Cosine {
            self.basic(context)
        } else {
            self.extended(&law, context)
        }
    }
}

fn left_out_remark(left_out: &[StabilityError]) -> Option<String> {
    let first = left_out.first()?;
    Some(format!("{} values of r are left out: {first}", left_out.len()))
}

fn remarks(along: &[Critical], left_out: &[StabilityError]) -> Vec<String> {
    let mut remarks: Vec<String> = left_out_remark(left_out).into_iter().collect();
    if along.iter().any(|at| at.kind == OnsetKind::NonSmooth) {
        let message = "kind non-smooth: the height under the tip is 0 in steady motion, where |h| of the depth limit \
                       has a corner: alpha is where a small oscillation keeps its amplitude, and at finite amplitude \
                       onset moves";
        remarks.push(message.into());
    }
    if !along.is_empty() {
        let message =
            "onset: the leading order of small cycles is available for the basic law only";
        remarks.push(message.into());
    }
    remarks
}

impl BoundaryFound {
    /// The curve through these critical points.
    fn through<'a>(along: impl Iterator<Item = &'a Critical> + Clone, onset: OnsetColumns) -> Self {
        Self {
            wave_number: along.clone().map(|at| TAU / at.wavelength).collect(),
            r: along.clone().map(|at| at.r).collect(),
            alpha: along.map(|at| at.alpha).collect(),
            onset,
            branches: vec![],
            kind: vec![],
            limits: None,
        }
    }
}

/// The spacing of values in a range.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SpacingName {
    /// Equal differences.
    #[default]
    Linear,
    /// Equal ratios.
    Logarithmic,
}

impl SpacingName {
    /// The given number of values from low to high, both ends exact.
    pub fn values(self, [low, high]: [f64; 2], points: usize) -> Vec<f64> {
        let last = points.max(2) - 1;
        let between = |i: usize| {
            let part = i as f64 / last as f64;
            match self {
                Self::Linear => low + part * (high - low),
                Self::Logarithmic => low * (high / low).powf(part),
            }
        };
        (0..points).map(|i| if i == last { high } else { between(i) }).collect()
    }
}

/// Depth limits and memory lengths below which no α makes steady motion unstable.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitColumns {
    /// All values of r requested, including those without a critical α.
    pub r: Vec<f64>,
    /// Depth limit b_c at each r, in kσ²/a. With a depth limit below b_c, and the healing and inertia of `parameters`,
    /// steady motion is stable at every α. Null if steady motion is stable at every b, or unstable at some α for every
    /// b. Also null if the height under the steady tip is 0, the kink of |u|.
    pub least_depth_limit: Vec<Option<f64>>,
    /// The product of r and healing time, in σ, below which steady motion is stable at every α without a depth limit.
    /// Null if there is none.
    pub memory_length: Option<f64>,
}

/// The small oscillation along the boundary, to leading order in α - αc. Null where the leading order is not
/// available.
#[derive(Debug, Clone, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OnsetColumns {
    /// Whether the oscillation starts with amplitude 0 beyond αc (supercritical) or exists already below it
    /// (subcritical).
    pub criticality: Vec<Option<Criticality>>,
    /// d(a²)/dα, with a = half the peak-to-peak of l, in σ².
    pub amplitude_squared_slope: Vec<Option<f64>>,
    /// dT/dα of the period T along the branch of cycles, in Γ/k.
    pub period_slope: Vec<Option<f64>>,
    /// First Lyapunov coefficient, in k/(Γσ²).
    pub lyapunov: Vec<Option<f64>>,
}

impl OnsetColumns {
    /// Columns of null for the given number of points.
    pub fn unknown(points: usize) -> Self {
        Self {
            criticality: vec![None; points],
            amplitude_squared_slope: vec![None; points],
            period_slope: vec![None; points],
            lyapunov: vec![None; points],
        }
    }

    /// Appends the small oscillation at a point of the boundary.
    pub fn push(&mut self, tip: &TipFunction, at: &Critical) {
        let onset = onset_at(tip, *at).ok();
        self.criticality.push(onset.map(|o| o.criticality));
        self.amplitude_squared_slope.push(onset.map(|o| o.amplitude_squared_slope));
        self.period_slope.push(onset.map(|o| o.period_slope));
        self.lyapunov.push(onset.map(|o| o.lyapunov));
    }
}

impl Tabular for BoundaryFound {
    /// The boundary as a table, with a row for each r.
    fn columns(&self) -> Vec<Named<'_>> {
        let Self { wave_number, r, alpha, .. } = self;
        let OnsetColumns { amplitude_squared_slope, period_slope, lyapunov, .. } = &self.onset;
        let mut columns = vec![("Omega", wave_number.into())];
        columns.extend(columns!(r, alpha, amplitude_squared_slope, period_slope, lyapunov));
        columns
    }
}
