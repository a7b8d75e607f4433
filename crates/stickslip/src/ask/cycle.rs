//! The question `cycle`, and its answer.

use crate::documents::table::{Named, Tabular, columns};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, ComplexDocument, Context, Document, Failure, History, Indentation, Law, ModelParameters,
    Question, Refused, Tip, Unusable,
};
use serde::{Deserialize, Serialize};
use stickslip_cycles as cycles;
use stickslip_cycles::CycleError;
use stickslip_tip::{Model, Step, Support, TipFunction, Trajectory};

/// Smallest number of profile intervals per mesh step: the error of the largest velocity is then 0.3 %, and 1.4 %
/// with one interval (α from 1.2 to 2, the loosest tolerance).
const FEWEST_PARTS: usize = 2;
/// Largest number of points of a profile.
const MOST_POINTS: usize = 1_000_000;

/// The periodic motion at given α and r, and its stability.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Cycle {
    /// Footprint f(x) of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// α, or αc(r) + D.
    #[serde(flatten)]
    pub indentation: Indentation,
    /// Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.
    #[schemars(extend("x-option" = option("R", "Model", 2)))]
    pub r: f64,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
    /// Largest residual that the equation of motion (18) may have at any time, in kσ/Γ; from 1e-11 to 1e-4.
    #[schemars(extend("x-option" = option("E", "Accuracy", 20)))]
    #[serde(default = "default_tolerance")]
    pub tolerance: f64,
    /// Least number of intervals of the profile, up to 1,000,000; they are uneven in time. Each step of the cycle's
    /// mesh, short where the motion is fast, is divided evenly, into at least two.
    #[schemars(extend("x-option" = option("N", "Output", 30)))]
    #[serde(default = "default_points")]
    pub points: usize,
    /// One period of a similar motion, from which Newton's method starts; by default the small oscillation at αc or a
    /// short run.
    #[serde(skip)]
    pub start: Option<Trajectory>,
}

pub(super) fn default_tolerance() -> f64 {
    cycles::DEFAULT_TOLERANCE
}

fn default_points() -> usize {
    400
}

/// A cycle and the question that it answers.
pub type CycleDocument = Document<Cycle>;

impl Cycle {
    /// The cycle of a footprint at an indentation rate and a support velocity, for the basic model.
    pub fn new(tip: Tip, indentation: Indentation, r: f64) -> Self {
        Self {
            tip,
            indentation,
            r,
            law: Law::default(),
            tolerance: default_tolerance(),
            points: default_points(),
            start: None,
        }
    }

    /// The question of a document, with its answer as the initial approximation. It is resolved: its α is a number.
    ///
    /// # Errors
    /// The history of the document is damaged, or is not that of a cycle.
    pub fn again(document: &CycleDocument) -> Result<Self, Unusable> {
        let question = document.parameters.clone();
        let support = Support::Moving(question.r);
        let start = document.history.under(question.law.into(), support)?;
        if start.start().abs() > 0.0 {
            return Err(Unusable::new("history: a cycle starts at t = 0"));
        }
        Ok(Self { start: Some(start), ..question })
    }

    /// Footprint, law, α and r of a resolved question, as a model.
    ///
    /// # Errors
    /// A number is out of its range.
    pub fn model(&self) -> Result<Model, Refused> {
        let law = self.law.dragged(&self.tip.0)?;
        self.indentation.model(&self.tip.0, law, self.r)
    }

    /// Footprint, law, α and r in the form of documents.
    pub fn model_parameters(&self) -> ModelParameters {
        ModelParameters::of_question(&self.tip, self.indentation, self.r, self.law)
    }

    /// The cycle of a resolved question.
    ///
    /// # Errors
    /// A number is out of its range; no cycle was found.
    pub fn solve(&self) -> Result<cycles::Cycle, Failure> {
        let model = self.model()?;
        let found = match &self.start {
            Some(start) => cycles::cycle_near(&model, start, self.tolerance),
            None => cycles::cycle(&model, self.tolerance),
        };
        Ok(found?)
    }

    /// Rejects a tolerance that cannot be reached, or that is too large for a cycle.
    pub(super) fn judge_tolerance(tolerance: f64) -> Result<(), Refused> {
        let (least, most) = cycles::TOLERANCES;
        if (least..=most).contains(&tolerance) {
            return Ok(());
        }
        Err(Refused::number("tolerance", tolerance, CycleError::Tolerance(tolerance)))
    }

    /// Rejects parameters for which no cycle can be computed, and an invalid number of points.
    fn judged(&self) -> Result<(), Refused> {
        Self::judge_tolerance(self.tolerance)?;
        if matches!(self.tip.0, TipFunction::Bessel) {
            return Err(Refused::word("tip", "bessel", CycleError::NeverFades));
        }
        if !(1..=MOST_POINTS).contains(&self.points) {
            let why = format!("must be from 1 to {MOST_POINTS}");
            return Err(Refused::number("points", self.points as f64, why));
        }
        Ok(())
    }
}

impl Question for Cycle {
    const FORMAT: &'static str = "stickslip/cycle";
    type Answer = CycleFound;
}

impl Ask for Cycle {
    fn support_velocity(&self) -> Option<f64> {
        Some(self.r)
    }

    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        self.judged()?;
        let law = self.law.dragged(&self.tip.0)?;
        let indentation = self.indentation.resolved(&self.tip.0, law, self.r)?;
        let question = Self { indentation, ..self };
        question.model()?;
        Ok(question)
    }

    fn answer(&self, context: &Context) -> Result<(CycleFound, Vec<String>), Failure> {
        let started = context.seconds();
        let cycle = self.solve()?;
        Ok((CycleFound::of(&cycle, self.points, context.seconds() - started), vec![]))
    }
}

/// A periodic motion, l(t + T) = l(t). Lengths in σ, times in Γ/k, heights in kσ²/a; amplitudes are half
/// peak-to-peak.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CycleFound {
    /// Period T, in Γ/k.
    pub period: f64,
    /// Error of `period`, in Γ/k.
    #[serde(default)]
    pub period_error: Option<f64>,
    /// rT, the wavelength of the surface far behind the tip, in σ.
    pub wavelength: f64,
    /// Error of `wavelength`, in σ.
    #[serde(default)]
    pub wavelength_error: Option<f64>,
    /// Half peak-to-peak of l (the oscillation of x0 about its steady advance), in σ.
    pub amplitude_x0: f64,
    /// Error of `amplitude_x0`, in σ.
    #[serde(default)]
    pub amplitude_x0_error: Option<f64>,
    /// Half peak-to-peak of the surface far behind the tip, (35), in kσ²/a; on a healing surface, of U(x) in u = U
    /// e^{-D/(r T_h)}, with the healing time T_h and the distance D behind the support.
    pub amplitude_u: f64,
    /// Error of `amplitude_u`, in kσ²/a.
    #[serde(default)]
    pub amplitude_u_error: Option<f64>,
    /// Number of maxima of l in one period.
    pub slips: usize,
    /// One period, beginning at the maximum of l, at uneven times: densely sampled where the motion is fast.
    pub profile: CycleProfile,
    /// Floquet multipliers, the factors of small deviations per period, by falling modulus. The list ends at 1e-6 (0.01
    /// for footprints with much detail). Of a complex pair, the one above the real axis comes first. One is 1, that of
    /// a shift in time. The error is at most 5e-8 for moduli above 0.01 and at most 1e-6 below.
    pub floquet: Vec<ComplexDocument>,
    /// Error |μ - 1| of the multiplier μ of a shift in time.
    pub floquet_error: f64,
    /// Whether every small deviation except a shift in time decays.
    pub stable: bool,
    /// Estimate of the largest residual of (18) at any time, in kσ/Γ.
    pub residual: f64,
    /// The dense solution over one period.
    pub history: History,
    /// Cost of the computation.
    pub work: CycleWork,
}

impl CycleFound {
    /// The document of a cycle with at least `points` intervals of its profile and its cost.
    fn of(cycle: &cycles::Cycle, points: usize, seconds: f64) -> Self {
        let multipliers = cycle.multipliers();
        let distances = multipliers.iter().map(|m| (m - 1.0).norm());
        Self {
            period: cycle.period(),
            period_error: Some(cycle.error()),
            wavelength: cycle.wavelength(),
            wavelength_error: Some(cycle.model().r() * cycle.error()),
            amplitude_x0: cycle.amplitude_x0(),
            amplitude_x0_error: Some(cycle.error()),
            amplitude_u: cycle.amplitude_u(),
            amplitude_u_error: Some(cycle.amplitude_u_error()),
            slips: cycle.slips(),
            profile: CycleProfile::of(cycle, points),
            floquet: multipliers.iter().map(|m| ComplexDocument { re: m.re, im: m.im }).collect(),
            floquet_error: distances.fold(1.0, f64::min),
            stable: cycle.is_stable(),
            residual: cycle.residual(),
            history: cycle.motion().into(),
            work: CycleWork {
                steps: cycle.steps(),
                newton_iterations: cycle.iterations(),
                seconds,
            },
        }
    }
}

/// Columns of equal length, at uneven times: each step of the cycle's mesh, short where the motion is fast, is divided
/// evenly. The largest velocity is about 0.3 % too small at most.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CycleProfile {
    /// Times from 0, where l is largest, to T, in Γ/k; ascending, unevenly spaced.
    pub t: Vec<f64>,
    /// l = rt - r - x0, in σ.
    pub l: Vec<f64>,
    /// x0', in kσ/Γ.
    pub velocity: Vec<f64>,
    /// The height of the surface under the tip, in kσ²/a, if there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<Vec<f64>>,
}

impl CycleProfile {
    /// A profile of at least `points` intervals. The steps are short where the motion is fast: even times would miss
    /// the slips.
    fn of(cycle: &cycles::Cycle, points: usize) -> Self {
        let motion = cycle.motion();
        let steps = motion.steps();
        let parts = points.div_ceil(steps.len()).max(FEWEST_PARTS);
        let within = |step: &Step| {
            let (t, part) = (step.t, step.h / parts as f64);
            (0..parts).map(move |i| t + part * i as f64)
        };
        let t: Vec<f64> = steps.iter().flat_map(within).chain([cycle.period()]).collect();
        Self {
            l: t.iter().map(|t| motion.l(*t)).collect(),
            velocity: t.iter().map(|t| motion.velocity(*t)).collect(),
            height: t.iter().map(|t| motion.height(*t)).collect(),
            t,
        }
    }
}

/// Counts that depend on the input alone, and the time of the computation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CycleWork {
    /// Number of steps of the mesh over one period.
    pub steps: usize,
    /// Number of Newton iterations, on all meshes.
    pub newton_iterations: usize,
    /// Time of the computation, in seconds: the only field that differs between identical runs.
    pub seconds: f64,
}

impl Tabular for CycleFound {
    /// The profile as a table.
    fn columns(&self) -> Vec<Named<'_>> {
        let CycleProfile { t, l, velocity, height } = &self.profile;
        let mut columns = columns!(t, l, velocity);
        columns.extend(height.iter().map(|height| ("height", height.into())));
        columns
    }
}
