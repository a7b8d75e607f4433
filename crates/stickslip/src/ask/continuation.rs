//! The question `continue`: a branch of cycles, and the branches of doubled period.

use crate::documents::table::{Array, Column, Named, Tabular, as_arrays};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, Context, Cycle, CycleDocument, Document, Failure, Indentation, Law, ModelParameters,
    Question, Refused, Tip, Unusable, digits,
};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use stickslip_cycles::{
    self as cycles, Branch, Continuation, CycleError, End, Parameter, Point, Special, SpecialKind,
};
use stickslip_stability::trapping_alpha;
use stickslip_tip::Trajectory;

/// Largest number of branches of doubled period: a cascade has infinitely many.
const MOST_BRANCHES: usize = 12;
/// Period doublings within this relative distance of each other count as one.
const SAME: f64 = 1e-6;
/// A height under the tip that is this fraction of the range of heights reaches 0.
const TOUCH: f64 = 0.01;

/// Branches of periodic motions. Lengths in σ, times in Γ/k, heights in kσ²/a; amplitudes are half
/// peak-to-peak.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ContinueFound {
    /// The first branch and, with --switch, those of twice its period, of four times, ….
    pub branches: Vec<CycleBranch>,
    /// Special points of the branches, in order of the branches.
    pub special: Vec<SpecialDocument>,
    /// The value of the continuation parameter at which trapping becomes possible; null if there is none.
    pub trapping: Option<f64>,
    /// Whether a signal stopped the computation.
    pub interrupted: bool,
}

/// A branch of cycles in α or r, stable or not, with its special points. It begins at the cycle of the given α and r;
/// if the continuation parameter is not given, at the onset of oscillation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Continue {
    /// Footprint f(x) of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// α, or αc(r) + D.
    #[serde(flatten)]
    pub indentation: Indentation,
    /// Dimensionless support velocity r = Γ v0/(k σ), (12); above 0.
    #[schemars(extend("x-option" = option("R", "Model", 2)))]
    #[serde(default)]
    pub r: Option<f64>,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
    /// The continuation parameter.
    #[schemars(extend("x-option" = option("NAME", "Branch", 20)))]
    pub over: Parameter,
    /// Last value of the continuation parameter; by default the branch ends by another criterion.
    #[schemars(extend("x-option" = option("V", "Branch", 21)))]
    #[serde(default)]
    pub to: Option<f64>,
    /// Follow the branches of twice the period too, from each period doubling, up to the longest period: each may take minutes.
    #[schemars(extend("x-option" = option("", "Branch", 22)))]
    #[serde(default)]
    pub switch: bool,
    /// Largest period, in Γ/k; the branch ends where it is exceeded.
    #[schemars(extend("x-option" = option("T", "Branch", 23)))]
    #[serde(default = "default_longest_period")]
    pub longest_period: f64,
    /// Longest step from one cycle to the next, in relative changes of parameter, period and l.
    #[schemars(extend("x-option" = option("S", "Branch", 24)))]
    #[serde(default = "default_longest_step")]
    pub longest_step: f64,
    /// Largest number of cycles of a branch.
    #[schemars(extend("x-option" = option("N", "Branch", 25)))]
    #[serde(default = "default_most_points")]
    pub most_points: usize,
    /// Largest residual that the equation of motion (18) may have at any time, in kσ/Γ; from 1e-11 to 1e-4.
    #[schemars(extend("x-option" = option("E", "Accuracy", 30)))]
    #[serde(default = "super::cycle::default_tolerance")]
    pub tolerance: f64,
    /// One period of a motion near the first cycle, from which Newton's method starts.
    #[serde(skip)]
    pub start: Option<Trajectory>,
}

fn default_longest_period() -> f64 {
    300.0
}

fn default_longest_step() -> f64 {
    0.05
}

fn default_most_points() -> usize {
    2000
}

/// Branches of cycles and the question that they answer.
pub type ContinueDocument = Document<Continue>;

impl Question for Continue {
    const FORMAT: &'static str = "stickslip/continue";
    type Answer = ContinueFound;
}

/// A branch, and the special point (branch, index in its list) at which it begins.
struct Found {
    branch: Branch,
    from: Option<(usize, usize)>,
}

impl Continue {
    /// Footprint, law, α and r in the form of documents.
    pub fn model_parameters(&self) -> ModelParameters {
        let r = self.r.unwrap_or(f64::NAN);
        ModelParameters::of_question(&self.tip, self.indentation, r, self.law)
    }

    /// The cycle at which the first branch begins; `None` if it begins at onset.
    fn first(&self) -> Result<Option<Cycle>, Failure> {
        let alpha = self.indentation != Indentation::default();
        let is_there = match self.over {
            Parameter::Alpha => alpha,
            Parameter::R => self.r.is_some(),
        };
        let Some(r) = self.r.filter(|_| is_there) else {
            return match is_there {
                true => Err(Refused::whole("r", "missing: give {r}, at which α varies").into()),
                false => Ok(None),
            };
        };
        let cycle = Cycle::new(self.tip.clone(), self.indentation, r);
        let (law, tolerance, start) = (self.law, self.tolerance, self.start.clone());
        Ok(Some(Cycle { law, tolerance, start, ..cycle }))
    }

    /// The value of the fixed parameter, for a branch that begins at onset.
    fn other(&self) -> Result<f64, Refused> {
        let (name, value) = match self.over {
            Parameter::Alpha => ("r", self.r),
            Parameter::R => ("alpha", self.indentation.alpha),
        };
        let varies = if name == "r" { "α" } else { "r" };
        let why = || format!("missing: give {{{name}}}, at which {varies} varies");
        value.ok_or_else(|| Refused::whole(name, why()))
    }

    fn settings(&self) -> Result<Continuation, Refused> {
        let positive = Refused::positive;
        let nowhere = match self.over {
            Parameter::Alpha => f64::INFINITY,
            Parameter::R => 0.0,
        };
        if self.most_points == 0 {
            return Err(Refused::number("most_points", 0.0, "must be 1 or more"));
        }
        Ok(Continuation {
            over: self.over,
            to: self.to.map_or(Ok(nowhere), |to| positive("to", to))?,
            tolerance: self.tolerance,
            longest_period: positive("longest_period", self.longest_period)?,
            longest_step: positive("longest_step", self.longest_step)?,
            most_points: self.most_points,
        })
    }

    fn branches(&self, context: &Context) -> Result<(Vec<Found>, Vec<String>), Failure> {
        let settings = self.settings()?;
        let (mut remarks, mut count) = (vec![], 0);
        let name = if self.over == Parameter::Alpha { "α" } else { "r" };
        let mut observe = |cycle: &cycles::Cycle| {
            let model = cycle.model();
            let at = if self.over == Parameter::Alpha { model.alpha() } else { model.r() };
            count += 1;
            // The length of a branch, and whether it turns back, is unknown in advance.
            match context.reached(None, &format!("{count} cycles, {name} = {}", digits(at, 6))) {
                Ok(()) => ControlFlow::Continue(()),
                Err(_) => ControlFlow::Break(()),
            }
        };
        let first = match self.first()? {
            Some(cycle) => settings.from_cycle(&cycle.solve()?, &mut observe),
            None => {
                let law = self.law.dragged(&self.tip.0)?;
                settings.from_onset_under((&law, &self.tip.0), self.other()?, &mut observe)
            }
        };
        let first = first.map_err(|error| self.explained(&error))?;
        let mut found = vec![Found { branch: first, from: None }];
        let mut next = 0;
        while self.switch && next < found.len() && !context.is_cancelled() {
            for i in 0..found[next].branch.special.len() {
                let special = &found[next].branch.special[i];
                let is_known =
                    special.kind != SpecialKind::PeriodDoubling || is_end_of(special, &found);
                if is_known || found.len() >= MOST_BRANCHES {
                    continue;
                }
                match settings.switched(special, &mut observe) {
                    Ok(branch) => found.push(Found { branch, from: Some((next, i)) }),
                    Err(error) => remarks.push(format!("a branch of twice the period: {error}")),
                }
            }
            next += 1;
        }
        remarks.extend(found.iter().filter_map(|found| remark_on_lost_branch(&found.branch)));
        Ok((found, remarks))
    }

    fn explained(&self, error: &CycleError) -> Failure {
        match (error, self.over) {
            (CycleError::Stability(error), Parameter::Alpha) => {
                Refused::number("r", self.r.unwrap_or_default(), error).into()
            }
            (CycleError::Stability(error), Parameter::R) => {
                Refused::number("alpha", self.indentation.alpha.unwrap_or_default(), error).into()
            }
            // There is no nearer one that it could start from.
            (CycleError::NotConverged { alpha, r }, over) if self.start.is_none() => {
                let further = match over {
                    Parameter::Alpha => format!("{{alpha}} {}", digits(1.05 * alpha, 4)),
                    Parameter::R => format!("{{r}} {}", digits(0.95 * r, 4)),
                };
                Failure::Failed(format!(
                    "no cycle was reached where the branch begins, at alpha = {alpha:?}, r = {r:?}: begin further \
                     away with {further}, or with {{from}} and a document of `stickslip cycle`"
                ))
            }
            _ => error.clone().into(),
        }
    }

    /// The answer for these branches.
    fn found(&self, found: &[Found], interrupted: bool) -> ContinueFound {
        let first = &found[0].branch.points[0];
        // Where the special points of each branch begin in the list of all.
        let counts = found.iter().map(|f| f.branch.special.len());
        let offsets: Vec<usize> = counts
            .scan(0, |sum, count| {
                *sum += count;
                Some(*sum - count)
            })
            .collect();
        let special = found.iter().enumerate().flat_map(|(i, f)| {
            f.branch.special.iter().map(move |special| SpecialDocument::of(i, special))
        });
        let from = |f: &Found| f.from.map(|(branch, place)| offsets[branch] + place);
        // Steady creep depends on α/r; with a depth limit or healing no tip stays trapped.
        let law: stickslip_tip::Wider = self.law.into();
        let ratio = trapping_alpha(&self.tip.0, 1.0).ok().filter(|_| law.traps());
        let trapping = ratio.map(|ratio| match self.over {
            Parameter::Alpha => ratio * first.r,
            Parameter::R => first.alpha / ratio,
        });
        let branches = found.iter().map(|f| CycleBranch::of(&f.branch, from(f))).collect();
        ContinueFound { branches, special: special.collect(), trapping, interrupted }
    }

    /// The question for a branch that begins at the cycle of a document.
    ///
    /// # Errors
    /// The history of the document is damaged.
    pub fn beginning_with(self, document: &CycleDocument) -> Result<Self, Unusable> {
        Ok(Self { start: Cycle::again(document)?.start, ..self })
    }
}

impl Ask for Continue {
    fn resolved(self, context: &Context) -> Result<Self, Failure> {
        self.settings()?;
        let indentation = match self.first()? {
            Some(cycle) => cycle.resolved(context)?.indentation,
            None => {
                Cycle::judge_tolerance(self.tolerance)?;
                self.other()?;
                let law = self.law.dragged(&self.tip.0)?;
                law.validate().map_err(Refused::from)?;
                self.indentation
            }
        };
        Ok(Self { indentation, ..self })
    }

    fn answer(&self, context: &Context) -> Result<(ContinueFound, Vec<String>), Failure> {
        let (found, remarks) = self.branches(context)?;
        Ok((self.found(&found, context.is_cancelled()), remarks))
    }

    /// The α and r of the document are those of the first cycle. Branches found before a cancellation are kept.
    fn answered(self, context: &Context) -> Result<ContinueDocument, Failure> {
        let (answer, remarks) = context.keeping(|| self.answer(context))?;
        let first = &answer.branches[0];
        let alpha_above = self.indentation.alpha_above;
        let indentation = Indentation { alpha: Some(first.alpha[0]), alpha_above };
        let question = Self { indentation, r: Some(first.r[0]), ..self };
        Ok(Document::new(question, answer, remarks))
    }

    fn support_velocity(&self) -> Option<f64> {
        self.r.filter(|_| self.over == Parameter::Alpha)
    }
}

/// A remark on a branch that is lost, if the reason is known: the tip swings back too far for cycles to be computed, or
/// the branch ends at the corner of exp(-|h|/b).
fn remark_on_lost_branch(branch: &Branch) -> Option<String> {
    if branch.end != End::Lost {
        return None;
    }
    let model = branch.last.model();
    let place = format!("at alpha = {}, r = {}", digits(model.alpha(), 6), digits(model.r(), 6));
    if let Some(retreat) = branch.last.farthest_retreat() {
        return Some(format!(
            "the branch that is lost {place} goes on: from there the tip swings back by more than {}, farther than \
             cycles can",
            digits(retreat, 4),
        ));
    }
    touches_the_corner(&branch.last).then(|| {
        format!(
            "the branch that is lost {place} ends where the height under the tip reaches 0, the corner of exp(-|h|/b): \
             cycles on both sides of 0 form another branch, which --from follows from one of them"
        )
    })
}

/// Whether the height under the tip reaches 0 without passing through it.
fn touches_the_corner(cycle: &stickslip_cycles::Cycle) -> bool {
    let motion = cycle.motion();
    let heights = motion.steps().iter().filter_map(|step| motion.height(step.t));
    let (low, high) =
        heights.fold((f64::MAX, f64::MIN), |(low, high), h| (h.min(low), h.max(high)));
    low.abs().min(high.abs()) < TOUCH * (high - low)
}

/// Whether a branch that was already followed ends at this period doubling.
fn is_end_of(doubling: &Special, found: &[Found]) -> bool {
    let special = found.iter().flat_map(|f| &f.branch.special);
    special.filter(|s| s.kind == SpecialKind::PeriodHalving).any(|s| {
        let near = |a: f64, b: f64| (a - b).abs() <= SAME * b;
        near(s.alpha, doubling.alpha) && near(s.r, doubling.r) && near(s.period, doubling.period)
    })
}

/// Cycles in the order in which they were found; columns of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CycleBranch {
    /// Index in `special` of the period doubling at which the branch begins; null for the first branch.
    pub from: Option<usize>,
    /// α of each cycle, dimensionless (13).
    pub alpha: Vec<f64>,
    /// r of each cycle, dimensionless (12).
    pub r: Vec<f64>,
    /// Period T of each cycle, in Γ/k.
    pub period: Vec<f64>,
    /// Half peak-to-peak of l (the oscillation of x0 about its steady advance), in σ.
    pub amplitude_x0: Vec<f64>,
    /// Half peak-to-peak of the surface far behind the tip, (35), in kσ²/a; on a healing surface, of U(x) in u = U
    /// e^{-D/(r T_h)}, with the healing time T_h and the distance D behind the support.
    pub amplitude_u: Vec<f64>,
    /// Whether every small deviation from the cycle, except a shift in time, decays.
    pub stable: Vec<bool>,
    /// Real part of the largest Floquet multiplier except that of a shift in time, dimensionless; 0 if all are below
    /// 1e-6.
    pub multiplier_re: Vec<f64>,
    /// Imaginary part of the multiplier with the real part `multiplier_re`.
    pub multiplier_im: Vec<f64>,
    /// The reason why the branch ends.
    pub end: End,
}

/// A special point of a branch, such as a fold or a period doubling.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpecialDocument {
    /// The kind of special point.
    pub kind: SpecialKind,
    /// Index of the branch in `branches`.
    pub branch: usize,
    /// α at the point, dimensionless (13).
    pub alpha: f64,
    /// r at the point, dimensionless (12).
    pub r: f64,
    /// Period of the cycle at the point, in Γ/k; at a Hopf point that of the oscillation at onset.
    pub period: f64,
    /// Half peak-to-peak of l of the cycle at the point, in σ; 0 at a Hopf point.
    pub amplitude_x0: f64,
}

impl CycleBranch {
    /// A branch, with the index in `special` of the period doubling at which it begins.
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
            end: branch.end,
        }
    }
}

impl SpecialDocument {
    /// A special point of the branch with this index.
    pub fn of(branch: usize, special: &Special) -> Self {
        Self {
            kind: special.kind,
            branch,
            alpha: special.alpha,
            r: special.r,
            period: special.period,
            amplitude_x0: special.cycle.as_ref().map_or(0.0, |cycle| cycle.amplitude_x0()),
        }
    }
}

impl Tabular for ContinueFound {
    /// The cycles of all branches, in one table.
    fn columns(&self) -> Vec<Named<'_>> {
        let joined = |of: fn(&CycleBranch) -> &Vec<f64>| -> Column {
            self.branches.iter().map(of).collect()
        };
        let numbers = self.branches.iter().enumerate();
        let numbers = numbers.flat_map(|(i, b)| vec![i as f64; b.alpha.len()]);
        let stable = self.branches.iter().flat_map(|b| &b.stable);
        let stable = stable.map(|stable| f64::from(u8::from(*stable)));
        vec![
            ("branch", numbers.collect()),
            ("alpha", joined(|b| &b.alpha)),
            ("r", joined(|b| &b.r)),
            ("period", joined(|b| &b.period)),
            ("amplitude_x0", joined(|b| &b.amplitude_x0)),
            ("amplitude_u", joined(|b| &b.amplitude_u)),
            ("stable", stable.collect()),
            ("multiplier_re", joined(|b| &b.multiplier_re)),
            ("multiplier_im", joined(|b| &b.multiplier_im)),
        ]
    }

    fn note(&self) -> Option<String> {
        self.interrupted.then(|| "interrupted: the branches are incomplete".into())
    }

    /// Arrays of the branches, and an array `interrupted` if a signal stopped the computation.
    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let mark = self.interrupted.then(|| ("interrupted", Array::vector(vec![1.0])));
        as_arrays(self.columns()).chain(mark).collect()
    }
}
