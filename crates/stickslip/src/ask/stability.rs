//! The question `stability`: the point at which steady motion loses its stability, and the growth of small
//! deviations.

use super::exponents::{failed, judge_count, leftmost, remarks};
use super::lines::footprint;
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, ComplexDocument, Context, CriticalDocument, Document, Failure, Indentation, Law,
    LimitsDocument, ModelParameters, OnsetDocument, Question, Refused, SolveFor, StabilityFound,
    Tip, TrappingDocument,
};
use serde::{Deserialize, Serialize};
use stickslip_stability as theory;
use stickslip_stability::{Creep, Critical, Onset, OnsetKind, Snaking, Spectrum, StabilityError};
use stickslip_tip::{Model, Wider};

/// Warning for steady motion at the kink of the extended model, u = 0.
const CORNER: &str = "critical: the height under the tip is 0 in steady motion, where |h| of the depth \
     limit has a corner: small deviations obey no linear law and have no exponents; at alpha of critical a small \
     oscillation keeps its amplitude, and at finite amplitude onset moves";

/// The critical point at one r (or one α), and the growth exponents at α and r.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Stability {
    /// Footprint f(x) of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// α, or αc(r) + D. Without either, α is the critical one.
    #[serde(flatten)]
    pub indentation: Indentation,
    /// Dimensionless support velocity r = Γ v0/(k σ), (12); above 0. Optional with `solve_for` "r": r is then the
    /// critical one.
    #[schemars(extend("x-option" = option("R", "Model", 2)))]
    pub r: Option<f64>,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
    /// Parameter for which the critical point is solved, α or r, at the given value of the other.
    #[schemars(extend("x-option" = option("NAME", "Critical point", 20)))]
    #[serde(default)]
    pub solve_for: SolveFor,
    /// Whether α and r are those of the critical point, because one of them was not given.
    #[serde(default)]
    pub at_critical_point: bool,
    /// κ_y, the spring constant across the scan over that along it, above 0, for a tip that is free to move across:
    /// compute the onset of snaking of a line, and of bunching of many. Without it the tip cannot leave its line.
    #[schemars(extend("x-option" = option("K", "Across the scan", 25)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_across: Option<f64>,
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip without its own f(x,y); by default the width of the tip's
    /// Gaussians.
    #[schemars(extend("x-option" = option("V", "Across the scan", 26)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_y: Option<f64>,
    /// Least number of growth exponents in the list; 10 if no bound is given. The list has all exponents to the right
    /// of a vertical line in the complex plane.
    #[schemars(extend("x-option" = option("N", "Growth exponents", 40)))]
    #[serde(default)]
    pub roots: Option<usize>,
    /// Lower bound on real parts, in k/Γ: list all growth exponents at or above it, instead of a number of them.
    #[schemars(extend("x-option" = option("BOUND", "Growth exponents", 41)))]
    #[serde(default)]
    pub re_above: Option<f64>,
}

/// Stability and the question that it answers.
pub type StabilityDocument = Document<Stability>;

impl Question for Stability {
    const FORMAT: &'static str = "stickslip/stability";
    type Answer = StabilityFound;
}

impl Stability {
    /// Default number of growth exponents.
    pub const DEFAULT_ROOTS: usize = 10;

    /// The question about the critical point of a footprint at one r, for the basic model.
    pub fn new(tip: Tip, r: f64) -> Self {
        Self {
            tip,
            indentation: Indentation::default(),
            r: Some(r),
            law: Law::default(),
            solve_for: SolveFor::default(),
            at_critical_point: false,
            stiffness_across: None,
            width_y: None,
            roots: None,
            re_above: None,
        }
    }

    /// Footprint, law, α and r of a resolved question, as a model.
    ///
    /// # Errors
    /// A number is out of its range.
    pub fn model(&self) -> Result<Model, Refused> {
        let law = self.law.dragged(&self.tip.0)?;
        self.indentation.model(&self.tip.0, law, self.velocity()?)
    }

    /// Footprint, law, α and r in the form of documents.
    pub fn model_parameters(&self) -> ModelParameters {
        let r = self.r.unwrap_or(f64::NAN);
        ModelParameters::of_question(&self.tip, self.indentation, r, self.law)
    }

    fn velocity(&self) -> Result<f64, Refused> {
        let why = "αc is a function of r: give {r}, or {alpha} with {solve_for} r for rc(α)";
        self.r.ok_or_else(|| Refused::whole("r", why))
    }

    /// The critical point at the given α or r, solved for the other.
    fn critical(&self, law: &Wider) -> Result<Result<Critical, StabilityError>, Refused> {
        let tip = &self.tip.0;
        match self.solve_for {
            SolveFor::Alpha => {
                let r = self.velocity()?;
                match theory::critical(law, tip, r) {
                    Err(error @ StabilityError::R(_)) => Err(Refused::number("r", r, error)),
                    Err(StabilityError::Wider(error)) => Err(error.into()),
                    found => Ok(found),
                }
            }
            SolveFor::R => {
                let why = "rc is a function of α: give {alpha}";
                let alpha = self.indentation.alpha.ok_or_else(|| Refused::whole("alpha", why))?;
                match theory::critical_r(law, tip, alpha) {
                    Err(error @ StabilityError::Alpha(_)) => {
                        Err(Refused::number("alpha", alpha, error))
                    }
                    found => Ok(found),
                }
            }
        }
    }

    /// Rejects questions about a critical r that cannot be computed.
    fn judge_solved_for(&self, law: &Wider) -> Result<(), Refused> {
        if self.solve_for == SolveFor::Alpha {
            return Ok(());
        }
        if !law.is_basic() {
            let why = "rc(α) is available for the basic model only: give {r}, for αc(r)";
            return Err(Refused::word("solve_for", "r", why));
        }
        match self.indentation.alpha_above {
            Some(above) => {
                let why = "αc is a function of the unknown r: give {alpha}";
                Err(Refused::number("alpha_above", above, why))
            }
            None => Ok(()),
        }
    }

    /// The question with α and r computed.
    fn placed(self, law: Wider) -> Result<Self, Refused> {
        self.judge_solved_for(&law)?;
        let (has_alpha, has_r) = (self.indentation != Indentation::default(), self.r.is_some());
        if has_alpha && has_r {
            let indentation = self.indentation.resolved(&self.tip.0, law, self.velocity()?)?;
            return Ok(Self { indentation, ..self });
        }
        let (given, value, other) = match self.solve_for {
            SolveFor::Alpha => ("r", self.r, "alpha"),
            SolveFor::R => ("alpha", self.indentation.alpha, "r"),
        };
        let at = self.critical(&law)?.map_err(|error| {
            let snakes = self.snaking().ok().flatten().and_then(|line| line.critical().ok()?);
            let across = snakes.map_or(String::new(), |at| {
                format!("; across the scan the line snakes above alpha = {:.9}", at.alpha)
            });
            let why = format!("{error}{across}; give {{{other}}} for the growth exponents there");
            Refused::number(given, value.unwrap_or(f64::NAN), why)
        })?;
        let indentation = Indentation::given(at.alpha);
        Ok(Self { indentation, r: Some(at.r), at_critical_point: true, ..self })
    }

    /// Rejects too many exponents, and too low a bound on their real parts.
    fn judge_extent(&self, model: &Model) -> Result<(), Refused> {
        let Some(bound) = self.re_above else {
            return judge_count("roots", self.roots.unwrap_or(Self::DEFAULT_ROOTS));
        };
        if self.roots.is_some() {
            return Err(Refused::whole("roots and re_above", "give one of them, not both"));
        }
        let least = leftmost(model);
        if bound.is_finite() && bound >= least {
            return Ok(());
        }
        let why = format!("must be a finite number, {least:.3} or above here");
        Err(Refused::number("re_above", bound, why))
    }

    fn spectrum(&self, model: &Model) -> Result<Spectrum, Failure> {
        let Some(bound) = self.re_above else {
            let count = self.roots.unwrap_or(Self::DEFAULT_ROOTS);
            let found = theory::leading_roots(model, count);
            return found.map_err(|error| failed(&error, "ask for another number with {roots}"));
        };
        theory::roots(model, bound).map_err(|error| match error {
            StabilityError::TooFarApart { .. } => failed(&error, "move {re_above} a little"),
            StabilityError::Stopped => Failure::Cancelled,
            error => Refused::number("re_above", bound, error).into(),
        })
    }

    /// The scan line with its spring across the scan; `None` if the tip cannot leave it.
    fn snaking(&self) -> Result<Option<Snaking>, Refused> {
        let Some(stiffness) = self.stiffness_across else { return Ok(None) };
        let law = self.law.dragged(&self.tip.0)?;
        let (footprint, _) = footprint(self.width_y, &self.tip.0)?;
        let line = Snaking::new(&footprint, law, (self.velocity()?, stiffness));
        line.map(Some).map_err(|error| Refused::number("stiffness_across", stiffness, error))
    }

    /// The width across the scan, if the tip is free to move there.
    fn width_across(&self) -> Result<Option<f64>, Refused> {
        match (self.stiffness_across, self.width_y) {
            (Some(_), width) => Ok(footprint(width, &self.tip.0)?.1),
            (None, None) => Ok(None),
            (None, Some(width)) => {
                let why = "applies to a tip that moves across the scan, or to a raster: give {stiffness_across} or \
                {pitch} too, or leave it out";
                Err(Refused::number("width_y", width, why))
            }
        }
    }

    /// Whether steady motion is stable. At the kink u = 0 small oscillations grow above αc, however small they are.
    fn is_stable(&self, model: &Model, critical: Option<&Critical>) -> Result<bool, Failure> {
        if self.at_critical_point {
            return Ok(false);
        }
        if has_corner(critical) {
            return Ok(critical.is_some_and(|critical| model.alpha() < critical.alpha));
        }
        let count = theory::unstable_count(model);
        Ok(count.map_err(|error| failed(&error, "move {alpha} or {r} a little"))? == 0)
    }
}

fn has_corner(critical: Option<&Critical>) -> bool {
    critical.is_some_and(|critical| critical.kind == OnsetKind::NonSmooth)
}

impl Ask for Stability {
    fn support_velocity(&self) -> Option<f64> {
        self.r
    }

    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        let law = self.law.dragged(&self.tip.0)?;
        let question = self.placed(law)?;
        question.judge_extent(&question.model()?)?;
        let width_y = question.width_across()?;
        let question = Self { width_y, ..question };
        question.snaking()?;
        let default = question.re_above.is_none().then_some(Self::DEFAULT_ROOTS);
        Ok(Self { roots: question.roots.or(default), ..question })
    }

    fn answer(&self, _: &Context) -> Result<(StabilityFound, Vec<String>), Failure> {
        let model = self.model()?;
        let law = *model.wider();
        let critical = self.critical(&law)?;
        let at = critical.as_ref().ok();
        let spectrum = if has_corner(at) { Spectrum::none() } else { self.spectrum(&model)? };
        let onset = critical.and_then(|critical| onset(&model, critical));
        let (trapping, creep) = trapping(&model);
        let (trapped, complex_pair) = TrappingDocument::of(trapping.ok(), creep.as_ref().ok());
        let mut said: Vec<String> = why("critical", critical.err())
            .into_iter()
            .chain(why("onset", onset.err().filter(|_| critical.is_ok())))
            .chain(why("trapping", trapping.err()))
            .chain(why("trapping", creep.err()))
            .collect();
        said.dedup();
        said.extend(complex_pair);
        if has_corner(at) {
            said.push(CORNER.into());
        } else {
            said.extend(remarks(&spectrum, self.roots, "roots"));
        }
        let line = self.snaking()?;
        let snaking = line.as_ref().map(Snaking::critical).transpose().map_err(uncertain)?;
        let snakes = match line.as_ref().zip(snaking.flatten()) {
            Some((line, _)) => line.unstable_count(model.alpha()).map_err(uncertain)? > 0,
            None => false,
        };
        let kind = |at: &Critical| (!law.is_basic()).then_some(at.kind);
        let found = StabilityFound {
            critical: at.map(|at| CriticalDocument::of(at, kind(at))),
            stable: !snakes && self.is_stable(&model, at)?,
            trapping: trapped,
            roots: spectrum.roots.iter().map(|z| ComplexDocument::new(z.re, z.im)).collect(),
            certificate: (&spectrum.certificate).into(),
            onset: onset.as_ref().ok().map(OnsetDocument::from),
            limits: limits(&model),
            snaking: snaking.map(|snaking| snaking.map(Into::into)),
        };
        Ok((found, said))
    }
}

/// The failure if stability across the scan cannot be computed.
fn uncertain(error: StabilityError) -> Failure {
    match error {
        StabilityError::AcrossGaussiansOnly => Refused::whole("tip", error).into(),
        error => failed(&error, "move {stiffness_across} or {r} a little"),
    }
}

/// A warning with the reason why a field is null.
fn why(name: &str, error: Option<StabilityError>) -> Option<String> {
    error.map(|error| format!("{name}: {error}"))
}

/// The trapping threshold and the rates of creep, which inertia does not change. With a depth limit or healing no tip
/// stays trapped permanently.
fn trapping(model: &Model) -> (Result<f64, StabilityError>, Result<Creep, StabilityError>) {
    let basic = Model::new(model.tip().clone(), model.alpha(), model.r());
    match basic.ok().filter(|_| model.wider().traps()) {
        Some(basic) => (theory::trapping_alpha(model.tip(), model.r()), theory::creep(&basic)),
        None => {
            let error = StabilityError::PapersLawOnly("trapping");
            (Err(error), Err(error))
        }
    }
}

/// Conditions under which steady motion is stable at every α; `None` for the basic model.
fn limits(model: &Model) -> Option<LimitsDocument> {
    let (law, tip) = (model.wider(), model.tip());
    (!law.is_basic()).then(|| LimitsDocument {
        least_depth_limit: theory::least_depth_limit(law, tip, model.r()).ok(),
        memory_length: theory::memory_length(tip).ok(),
    })
}

/// The small oscillation at the critical point, to leading order.
fn onset(model: &Model, critical: Critical) -> Result<Onset, StabilityError> {
    if !model.wider().is_basic() {
        return Err(StabilityError::PapersLawOnly("the leading order of small cycles"));
    }
    theory::onset_at(model.tip(), critical)
}
