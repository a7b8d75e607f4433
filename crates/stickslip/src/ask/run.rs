//! The question `run`: the motion of the tip from an initial condition, and its regime.

use super::lines::footprint;
use super::moving;
use super::run_found::RunFound;
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, Context, Document, FARTHEST, Failure, History, Indentation, Law, ModelParameters,
    Question, Refused, RunEnd, Samples, Sampling, SteadyState, Tip, Typed, Unusable,
};
use serde::{Deserialize, Serialize};
use stickslip_outcome::{Watched, WatchedAcross};
use stickslip_tip::planar::{HeightTable, PlanarError, PlanarScenario, TextureError};
use stickslip_tip::{
    Force, ForceError, MemoryChoice, Model, Noise, Pulse, RunError, Scenario, Start, Support,
    SupportPath, TipFunction, Trajectory, planar,
};

/// Everything that defines a run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Run {
    /// Footprint f(x) of the tip.
    #[schemars(extend("x-option" = option("NAME", "Model", 1)))]
    #[serde(default)]
    pub tip: Tip,
    /// α, or αc(r) + D.
    #[serde(flatten)]
    pub indentation: Indentation,
    /// Dimensionless support velocity r = Γ v0/(k σ), (12); above 0, and 0 without a spring.
    #[schemars(extend("x-option" = option("R", "Model", 2)))]
    #[serde(default)]
    pub r: Option<f64>,
    /// Terms added to the basic model.
    #[serde(flatten)]
    pub law: Law,
    /// Initial condition; by default the steady state, or a flat surface without a spring.
    #[schemars(extend("x-option" = option("START", "Start", 21)))]
    #[serde(default)]
    pub start: Option<StartName>,
    /// X: position of the tip at the start, in σ.
    #[schemars(extend("x-option" = option("X", "Start", 22)))]
    #[serde(default = "default_start_position")]
    pub start_position: f64,
    /// D: the tip starts at X - D, in σ, which increases l by D.
    #[schemars(extend("x-option" = option("D", "Start", 23)))]
    #[serde(default)]
    pub kick: f64,
    /// Path of the support: R minus its initial value, linear between the knots.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support_path: Option<SupportPathParameters>,
    /// T,H in Γ/k, to slide, hold and slide: the run starts at t = 0, and the support stops at t = T for a time H. Then
    /// it moves on with the velocity r. Documents contain the path of the support instead.
    #[schemars(extend("x-option" = option("T,H", "Start", 25)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub hold: Option<Vec<f64>>,
    /// Initial velocity of a tip with inertia, in kσ/Γ; by default r with a steady start, else 0.
    #[schemars(extend("x-option" = option("V", "Start", 24)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_velocity: Option<f64>,
    /// Noise added to the initial surface.
    #[serde(default)]
    pub noise: Option<Noise>,
    /// Profile added to the initial surface.
    #[serde(default)]
    pub initial_surface: Option<Profile>,
    /// Gaussian pulses of external force.
    #[serde(default)]
    pub pulses: Vec<Pulse>,
    /// Tabulated external force.
    #[serde(default)]
    pub force: Option<ForceTable>,
    /// Time at which the run ends, in Γ/k. A run starts when the support has pulled the tip to its start position:
    /// about t = 16 by default.
    #[schemars(extend("x-option" = option("T", "Model", 5)))]
    pub until: f64,
    /// Target for the error of l(t) and x0(t), in σ; from 1e-13 to 1e-2.
    #[schemars(extend("x-option" = option("E", "Accuracy", 51)))]
    #[serde(default = "default_tolerance")]
    pub tolerance: f64,
    /// Memory: the algorithm for the history integral. All memories give the same motion within the tolerance.
    #[schemars(extend("x-option" = option("MEMORY", "Accuracy", 50)))]
    #[serde(default)]
    pub memory: MemoryChoice,
    /// κ_y, the spring constant across the scan over that along it; above 0. Without it the tip cannot leave its
    /// line.
    #[schemars(extend("x-option" = option("K", "Across the scan", 30)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stiffness_across: Option<f64>,
    /// Initial distance of the tip from its line, in σ, if it is free to move across the scan; 0 by default.
    #[schemars(extend("x-option" = option("D", "Across the scan", 31)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub kick_across: Option<f64>,
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ, for a tip that is free to move across the scan and has no f(x,y) of
    /// its own; by default the width of the tip's Gaussians.
    #[schemars(extend("x-option" = option("V", "Across the scan", 32)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub width_y: Option<f64>,
    /// Correlation length of the noise across the scan, in σ, for a tip that is free to move there: rows of noise at
    /// this distance are independent. By default noise does not depend on y.
    #[schemars(extend("x-option" = option("C", "Across the scan", 33)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub noise_spacing_across: Option<f64>,
    /// Table u0(x,y) added to the initial surface, if the tip is free to move across the scan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub initial_surface_across: Option<SurfaceTable>,
    /// Times of the samples.
    #[serde(flatten)]
    pub sampling: Sampling,
}

pub(super) fn default_start_position() -> f64 {
    14.0
}

pub(super) fn default_tolerance() -> f64 {
    1e-9
}

impl Document<Run> {
    /// The motion, reconstructed from its dense history.
    ///
    /// # Errors
    /// The history is missing or invalid.
    pub fn trajectory(&self) -> Result<Trajectory, Unusable> {
        if self.parameters.stiffness_across.is_some() {
            let why = "the tip moves in two coordinates: results of motion along a line are not available";
            return Err(Unusable::new(why));
        }
        let (history, parameters) = (self.kept_history()?, &self.parameters);
        if let (None, false, Some(r)) =
            (&parameters.support_path, parameters.law.no_spring, parameters.r)
        {
            return history.under(parameters.law.into(), Support::Moving(r));
        }
        let scenario = parameters.scenario()?;
        history.under(*scenario.model.wider(), scenario.support())
    }

    /// The scenario and the motion of a tip that is free to move across the scan.
    ///
    /// # Errors
    /// The tip is held on its line, the parameters define no run, or the history is missing or invalid.
    pub fn trajectory_across(&self) -> Result<(PlanarScenario, planar::Trajectory), Unusable> {
        let RunScenario::Across(scenario) = self.parameters.prepared()? else {
            return Err(Unusable::new("the tip is held on its line"));
        };
        let history = self.kept_history()?;
        let along = &scenario.along;
        let trajectory = history.across(*along.model.wider(), along.support())?;
        Ok((scenario, trajectory))
    }

    fn kept_history(&self) -> Result<&History, Unusable> {
        let missing = || Unusable::new("history: it was left out; run it again with --history all");
        self.history.as_ref().ok_or_else(missing)
    }
}

/// The scenario of a run.
#[derive(Debug, Clone)]
#[expect(clippy::large_enum_variant, reason = "a run has one")]
pub enum RunScenario {
    /// A tip that is held on its line.
    Along(Scenario),
    /// A tip that is free to move across the scan; its model has f(x,y).
    Across(PlanarScenario),
}

impl RunScenario {
    /// The motion along the scan.
    pub fn along(&self) -> &Scenario {
        match self {
            Self::Along(scenario) => scenario,
            Self::Across(scenario) => &scenario.along,
        }
    }

    /// Start and end of the run, in Γ/k.
    pub fn span(&self) -> (f64, f64) {
        (self.along().start_time(), self.along().until)
    }
}

/// The noise of the paper's simulations, but on a grid that resolves its slope.
const PAPERS_NOISE: Noise = Noise { amplitude: 1e-4, spacing: 0.05, seed: 1 };

/// Knots of the piecewise linear path of the support.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SupportPathParameters {
    /// Times from the start of the run, ascending, in Γ/k.
    pub t: Vec<f64>,
    /// Displacements of the support from its initial position, in σ.
    #[serde(rename = "R")]
    pub displacement: Vec<f64>,
}

/// A height profile.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Positions, ascending, in σ.
    pub x: Vec<f64>,
    /// Heights at the positions `x`, in kσ²/a.
    pub u: Vec<f64>,
}

/// Heights u at the points (x, y) of a grid, interpolated by a bicubic spline. Before the first x and after the last, u
/// is 0; beyond the first and last y, u is that of the nearest row.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SurfaceTable {
    /// Positions along the scan, ascending, in σ.
    pub x: Vec<f64>,
    /// Positions across the scan, ascending, in σ.
    pub y: Vec<f64>,
    /// Heights in kσ²/a, one row for each y.
    pub u: Vec<Vec<f64>>,
}

/// External force as a function of time.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceTable {
    /// Times, ascending, in Γ/k.
    pub t: Vec<f64>,
    /// Forces at the times `t`, in kσ.
    pub force: Vec<f64>,
}

/// The initial condition.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StartName {
    /// The steady state, as after infinitely long motion.
    Steady,
    /// A flat surface, the spring relaxed, the support above the tip.
    Flat,
    /// The initial condition of the paper's simulations: noise of 1e-4 on a grid of 0.05 if no other is given, and
    /// the spring stretched by r + alpha/r; the surface is flat for a tip whose f has no volume (beta = 1), else that
    /// of steady motion.
    Paper,
}

impl Run {
    /// A run from steady motion to a given time, for the basic model.
    pub fn new(tip: Tip, indentation: Indentation, r: f64, until: f64) -> Self {
        Self {
            tip,
            indentation,
            r: Some(r),
            law: Law::default(),
            start: None,
            start_position: default_start_position(),
            kick: 0.0,
            support_path: None,
            hold: None,
            start_velocity: None,
            noise: None,
            initial_surface: None,
            pulses: vec![],
            force: None,
            until,
            tolerance: default_tolerance(),
            memory: MemoryChoice::Auto,
            stiffness_across: None,
            kick_across: None,
            width_y: None,
            noise_spacing_across: None,
            initial_surface_across: None,
            sampling: Sampling::default(),
        }
    }

    /// Footprint, law, α and r in the form of other documents.
    pub fn model_parameters(&self) -> ModelParameters {
        ModelParameters::of_question(
            &self.tip,
            self.indentation,
            self.r.unwrap_or(f64::NAN),
            self.law,
        )
    }

    /// The velocity of the support; 0 without a spring.
    fn velocity(&self) -> Result<f64, Refused> {
        if self.law.no_spring {
            return match self.r.filter(|r| r.abs() > 0.0) {
                None => Ok(0.0),
                Some(r) => {
                    let why = "without a spring there is no support that could move: leave it out";
                    Err(Refused::number("r", r, why))
                }
            };
        }
        self.r.ok_or_else(|| Refused::whole("r", "is needed: the support velocity r, (12)"))
    }

    /// The question with the α of αc(r) + D computed.
    fn indented(self) -> Result<Self, Refused> {
        let r = self.velocity()?;
        if let Some(above) = self.indentation.alpha_above.filter(|_| self.law.no_spring) {
            let why = "without a spring there is no onset: give {alpha}";
            return Err(Refused::number("alpha_above", above, why));
        }
        let indentation = self.indentation.resolved(&self.tip.0, self.law.into(), r)?;
        Ok(Self { indentation, r: Some(r), ..self })
    }

    /// The model of a question whose α is known.
    ///
    /// # Errors
    /// A number is out of its range.
    pub fn model(&self) -> Result<Model, Refused> {
        self.indentation.model(&self.tip.0, self.law.into(), self.velocity()?)
    }

    /// The question with the paper's initial condition expressed by the other parameters. The paper sets the tip down
    /// at X with the spring stretched by r + α/r on the steady surface. It takes this surface as flat if f has no
    /// volume (docs/findings/corrections.md, 13).
    fn started(self, model: &Model) -> Self {
        let usual = if model.wider().spring { StartName::Steady } else { StartName::Flat };
        let start = self.start.unwrap_or(usual);
        if start != StartName::Paper {
            return Self { start: Some(start), ..self };
        }
        let noise = self.noise.or(Some(PAPERS_NOISE));
        // Round-off of a sum of Gaussians that cancel.
        if model.steady_surface_behind().abs() > 1e-9 * model.alpha() {
            return Self { start: Some(StartName::Steady), noise, ..self };
        }
        let stretched = model.r() + model.alpha() / model.r();
        let (start_position, kick) = (self.start_position + stretched, self.kick + stretched);
        Self { start: Some(StartName::Flat), noise, start_position, kick, ..self }
    }

    /// The question with slide, hold, slide expressed by the path of the support: it moves with the velocity r until T,
    /// stands still for H, and moves on.
    fn held(self) -> Result<Self, Refused> {
        let Some(hold) = &self.hold else { return Ok(self) };
        let refused = |why: String| {
            let value: Vec<String> = hold.iter().map(|time| Typed(*time).to_string()).collect();
            Refused::word("hold", value.join(","), why)
        };
        let [slide, held] = match **hold {
            [slide, held] if [slide, held].iter().all(|t| t.is_finite() && *t > 0.0) => {
                [slide, held]
            }
            _ => {
                let why = "must be two times above 0, T,H in Γ/k: at T the support stops for H";
                return Err(refused(why.into()));
            }
        };
        if self.support_path.is_some() {
            let why = "is a path of the support, as {support_path} is: leave one of them out";
            return Err(refused(why.into()));
        }
        if self.law.no_spring {
            let why = "without a spring there is no support that could stop: leave it out";
            return Err(refused(why.into()));
        }
        let end = slide + held;
        if self.until <= end {
            let why = format!("the hold ends at t = {}: give a later {{until}}", Typed(end));
            return Err(refused(why));
        }
        let r = self.velocity()?;
        let way = r * slide;
        let path = SupportPathParameters {
            t: vec![0.0, slide, end, self.until],
            displacement: vec![0.0, way, way, way + r * (self.until - end)],
        };
        Ok(Self { hold: None, support_path: Some(path), ..self })
    }

    /// The start time of a run with a steady start.
    pub(crate) fn started_at(&self) -> Result<f64, Failure> {
        Ok(Self { start: Some(StartName::Steady), ..self.clone() }.scenario()?.start_time())
    }

    /// The scenario along the scan of a resolved question.
    ///
    /// # Errors
    /// A parameter is out of its range, or contradicts another.
    pub fn scenario(&self) -> Result<Scenario, Failure> {
        let scenario = self.assembled()?;
        scenario.validate().map_err(|error| self.refused(&error))?;
        Ok(scenario)
    }

    /// The scenario, without a check that it can be run.
    fn assembled(&self) -> Result<Scenario, Refused> {
        let table = self.force.clone().map(|table| (table.t, table.force));
        let force = Force::new(self.pulses.clone(), table).map_err(|error| match error {
            ForceError::Table(error) => Refused::whole("force", error),
            error => Refused::whole("pulses", error),
        })?;
        let path = self.support_path.as_ref().map(SupportPathParameters::path).transpose();
        Ok(Scenario {
            start: self.start.unwrap_or(StartName::Steady).into(),
            start_position: self.start_position,
            kick: self.kick,
            path: path.map_err(|error| Refused::whole("support_path", error))?,
            start_velocity: self.start_velocity,
            noise: self.noise,
            profile: self.initial_surface.clone().map(|profile| (profile.x, profile.u)),
            force,
            tolerance: self.tolerance,
            memory: self.memory,
            ..Scenario::new(self.model()?, self.until)
        })
    }

    /// The scenario of a resolved question.
    ///
    /// # Errors
    /// A parameter is out of its range, contradicts another, or is not available in two coordinates.
    pub fn prepared(&self) -> Result<RunScenario, Failure> {
        let along = self.scenario()?;
        if let Some(stiffness) = self.stiffness_across {
            return Ok(RunScenario::Across(self.across(along, stiffness)?));
        }
        let given = [
            ("kick_across", self.kick_across),
            ("width_y", self.width_y),
            ("noise_spacing_across", self.noise_spacing_across),
        ];
        let why = "applies to a tip that moves across the scan: give {stiffness_across} too";
        let stray = given.into_iter().find_map(|(name, value)| Some((name, value?)));
        if let Some((name, value)) = stray {
            return Err(Refused::number(name, value, why).into());
        }
        match self.initial_surface_across {
            None => Ok(RunScenario::Along(along)),
            Some(_) => Err(Refused::whole("initial_surface_across", why).into()),
        }
    }

    /// The scenario of a tip that is free to move across the scan, from the scenario along it.
    fn across(&self, along: Scenario, stiffness: f64) -> Result<PlanarScenario, Failure> {
        let (footprint, _) = footprint(self.width_y, &self.tip.0)?;
        let (alpha, r) = (self.indentation.alpha.unwrap_or(f64::NAN), self.velocity()?);
        let tip = TipFunction::of_footprint(footprint);
        let model = Model::under(self.law.into(), tip, alpha, r).map_err(Refused::from)?;
        let along = Scenario { model, ..along };
        if let Some(spacing) = self.noise_spacing_across.filter(|_| along.noise.is_none()) {
            let why = "is of noise: give {noise} too";
            return Err(Refused::number("noise_spacing_across", spacing, why).into());
        }
        let table = self.initial_surface_across.as_ref().map(SurfaceTable::heights).transpose();
        let scenario = PlanarScenario {
            kick_across: self.kick_across.unwrap_or_default(),
            noise_spacing_across: self.noise_spacing_across,
            profile_across: table
                .map_err(|error| Refused::whole("initial_surface_across", error))?,
            ..PlanarScenario::new(along, stiffness)
        };
        scenario.validate().map_err(|error| self.refused_across(error))?;
        Ok(scenario)
    }

    /// The rejection of the parameter that caused an error of a run in two coordinates; or the failure.
    pub fn refused_across(&self, error: PlanarError) -> Failure {
        let stiffness = self.stiffness_across.unwrap_or_default();
        let number = |name: &'static str, value: f64| Refused::number(name, value, &error).into();
        match error {
            PlanarError::Along(error) => self.refused(&error),
            PlanarError::Stiffness(_) | PlanarError::Unavailable(_) => {
                number("stiffness_across", stiffness)
            }
            PlanarError::Kick(kick) => number("kick_across", kick),
            PlanarError::NoiseSpacing(spacing) => number("noise_spacing_across", spacing),
            PlanarError::InitialSurface(TextureError::Points { .. }) => {
                Refused::whole("noise_spacing_across", error).into()
            }
            PlanarError::InitialSurface(_) => Refused::whole("initial_surface", error).into(),
            PlanarError::NoFootprint => Refused::whole("width_y", error).into(),
            PlanarError::TwoSides => Refused::whole("tip", error).into(),
            PlanarError::Products(_) | PlanarError::NeverFades => {
                Refused::whole("tip", error).into()
            }
            PlanarError::Fit(_) => Refused::word("memory", "modes", error).into(),
            error => Failure::Failed(error.to_string()),
        }
    }

    /// Rejects runs whose positions need more digits than a number has.
    fn judge_distances(&self, scenario: &Scenario) -> Result<(), Refused> {
        let model = &scenario.model;
        // Without a spring there is none.
        let lag = if model.wider().spring { model.steady_lag() } else { 0.0 };
        let (name, value) = self.behind_the_lag(model);
        let distances = [
            ("start_position", self.start_position, "the tip would start at", self.start_position),
            ("kick", self.kick, "the tip would be displaced by", self.kick),
            ("until", self.until, "the support would go to r until =", model.r() * self.until),
            (name, value, "in steady motion the tip would lag behind by r + alpha f(0)/r =", lag),
        ];
        // Numbers that are not finite are left to the validation of the scenario.
        let far = |distance: f64| distance.abs() > FARTHEST;
        match distances.into_iter().find(|(.., distance)| far(*distance)) {
            None => Ok(()),
            Some((name, value, what, distance)) => {
                let why = format!(
                    "{what} {}; must be at most {FARTHEST:e}, where positions are resolved to a thousandth",
                    Typed(distance)
                );
                Err(if name == "tip" {
                    Refused::whole(name, why)
                } else {
                    Refused::number(name, value, why)
                })
            }
        }
    }

    /// The parameter that determines the size of r + α f(0)/r: the one farthest from 1.
    fn behind_the_lag(&self, model: &Model) -> (&'static str, f64) {
        let (alpha, r, height) = (model.alpha(), model.r(), model.tip().value(0.0).abs());
        match self.indentation.alpha_above {
            _ if height > alpha.max(r).max(1.0 / r) => ("tip", height),
            _ if r.max(1.0 / r) > alpha => ("r", r),
            Some(above) => ("alpha_above", above),
            None => ("alpha", alpha),
        }
    }

    /// The rejection of the parameter that caused this error; or the failure.
    pub fn refused(&self, error: &RunError) -> Failure {
        let number = |name: &'static str, value: f64| Refused::number(name, value, error);
        let named = |name: &'static str, value: &str| Refused::word(name, value, error);
        let refused = match error {
            RunError::TooFar { .. } if self.start_position.abs() > 1e3 => {
                number("start_position", self.start_position)
            }
            RunError::StartPosition(x) => number("start_position", *x),
            RunError::Kick(kick) => number("kick", *kick),
            RunError::Until { until, .. } => number("until", *until),
            RunError::Tolerance(tolerance) | RunError::TooFar { tolerance, .. } => {
                number("tolerance", *tolerance)
            }
            RunError::Noise { noise, .. } => {
                let value = format!("{} and {}", Typed(noise.amplitude), Typed(noise.spacing));
                named("noise and noise_spacing", &value)
            }
            RunError::Modes(_) => named("memory", "modes"),
            RunError::Profile(_) => Refused::whole("initial_surface", error),
            RunError::StartVelocity(v) => number("start_velocity", *v),
            RunError::Path(_) | RunError::PathWithoutSpring | RunError::PathEnds { .. } => {
                Refused::whole("support_path", error)
            }
            RunError::NoSteadyStart(_) => named("start", "steady"),
            RunError::Integration(_) | RunError::HistoryTooLong { .. } | RunError::State(_) => {
                return Failure::Failed(error.to_string());
            }
        };
        refused.into()
    }

    /// The document of a run with the result `end`.
    pub fn document(self, samples: Samples, history: Option<History>, end: RunEnd) -> RunDocument {
        let steady_state = self.model().ok().and_then(|model| SteadyState::of(&model));
        let remarks = end.remarks.clone();
        Document::new(self, RunFound::new(steady_state, samples, history, end), remarks)
    }
}

/// A run and the question that it answers. `remarks` are warnings: the result depends on round-off, on the initial
/// condition, on the tolerance or on a disturbance.
pub type RunDocument = Document<Run>;

impl From<&RunDocument> for RunEnd {
    /// The result of the run in a document.
    fn from(document: &RunDocument) -> Self {
        let found = &document.answer;
        let reached = found.history.as_ref().and_then(|history| history.t.last().copied());
        Self {
            end: reached.unwrap_or(document.parameters.until),
            regime: found.regime,
            oscillation: found.oscillation.clone(),
            snaking: found.snaking.clone(),
            creep: found.creep,
            drifting: found.drifting,
            transient: found.transient.clone(),
            remarks: document.remarks.clone(),
            interrupted: found.interrupted,
            work: found.work.clone(),
        }
    }
}

impl Question for Run {
    const FORMAT: &'static str = "stickslip/run";
    type Answer = RunFound;

    fn history(answer: &mut RunFound) -> Option<&mut Option<History>> {
        Some(&mut answer.history)
    }
}

impl Ask for Run {
    fn support_velocity(&self) -> Option<f64> {
        self.r
    }

    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        let question = self.indented()?;
        let model = question.model()?;
        let question = question.started(&model).held()?;
        question.judge_distances(&question.assembled()?)?;
        question.prepared()?;
        Ok(question)
    }

    /// The answer, with the dense history.
    fn answer(&self, context: &Context) -> Result<(RunFound, Vec<String>), Failure> {
        let scenario = self.prepared()?;
        let times = self.sampling.times(scenario.span(), "the run", true)?;
        match &scenario {
            RunScenario::Along(scenario) => {
                let refused = |error: RunError| self.refused(&error);
                let initial = scenario.initial_surface().map_err(refused)?;
                let running = Watched::new(scenario, &initial).map_err(refused)?;
                moving::answered(scenario, running, &times, context, refused)
            }
            RunScenario::Across(scenario) => {
                let refused = |error: PlanarError| self.refused_across(error);
                let running = WatchedAcross::new(scenario).map_err(refused)?;
                moving::answered(&scenario.along, running, &times, context, refused)
            }
        }
    }

    /// The document of a run; a cancelled run ends at the time that it has reached.
    fn answered(self, context: &Context) -> Result<RunDocument, Failure> {
        let (answer, remarks) = context.keeping(|| self.answer(context))?;
        Ok(Document::new(self, answer, remarks))
    }
}

impl SupportPathParameters {
    pub(crate) fn path(&self) -> Result<SupportPath, RunError> {
        SupportPath::new(self.t.clone(), self.displacement.clone()).map_err(RunError::from)
    }
}

impl SurfaceTable {
    fn heights(&self) -> Result<HeightTable, String> {
        let uneven = self.u.iter().position(|row| row.len() != self.x.len());
        if let Some(row) = uneven {
            return Err(format!("row {} of u does not have one height for each x", row + 1));
        }
        let heights = HeightTable::new(self.x.clone(), self.y.clone(), self.u.concat());
        heights.map_err(|error| error.to_string())
    }
}

impl From<StartName> for Start {
    fn from(name: StartName) -> Self {
        match name {
            StartName::Steady => Self::Steady,
            // The surface of the paper's start, until the question is resolved.
            StartName::Flat | StartName::Paper => Self::Flat,
        }
    }
}
