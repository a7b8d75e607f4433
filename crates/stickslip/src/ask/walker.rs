//! The question `walker`: a particle in the plane that is driven by the field of J0 that it leaves.

use super::run::default_tolerance;
use super::walker_motion::{CircleDocument, WalkerRegime, motion};
use crate::documents::table::{Named, Tabular};
use crate::parameter::option;
use crate::schema::JsonSchema;
use crate::{
    Ask, ComplexDocument, Context, Document, Failure, Question, Refused, SampleLine, Samples,
    Sampling, StartName,
};
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;
use stickslip_stability::{self as theory};
use stickslip_tip::walker::{
    WalkerError, WalkerPast, WalkerScenario, WalkerTrajectory, run_observed,
};
use stickslip_tip::{Force, Pulse};

/// A particle in the plane, driven by the field Q of J0 that it leaves: M x'' + x' = α ∇Q - Ω ẑ × x' - K x + F. Here Q
/// = ∫ J0(|x - x(t')|) exp(-(t-t')/T) dt'. The particle starts at t = 0.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct Walker {
    /// Compute a walker: a particle in the plane without a spring, driven by its own field, with the footprint J0(|x|).
    /// It is free, in a rotating frame, or in a trap.
    #[schemars(extend("x-option" = option("", "Walker", 70)))]
    #[serde(default = "yes")]
    pub walker: bool,
    /// α, below 0 for a particle that its field drives.
    #[schemars(extend("x-option" = option("A", "Model", 3)))]
    pub alpha: f64,
    /// T, the time in which the field decays by a factor e, in Γ/k; above 0.
    #[schemars(extend("x-option" = option("T", "Extended model", 11)))]
    #[serde(default = "one")]
    pub healing_time: f64,
    /// Inertia M of the particle, in Γ²/k; above 0.
    #[schemars(extend("x-option" = option("M", "Extended model", 12)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia: Option<f64>,
    /// Ω of a walker in a rotating frame: the Coriolis force -Ω ẑ × x' acts on it. In units of Γ.
    #[schemars(extend("x-option" = option("OMEGA", "Walker", 71)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rotation: Option<f64>,
    /// K of a walker in a harmonic trap about the origin, in units of k; 0 or above.
    #[schemars(extend("x-option" = option("K", "Walker", 72)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trap: Option<f64>,
    /// Initial condition. Steady, the default: as after an infinitely long straight walk along x, or on a circular
    /// orbit with --rotation or --trap. Flat: no field, so that a pulse must set the particle in motion.
    #[schemars(extend("x-option" = option("START", "Start", 21)))]
    #[serde(default)]
    pub start: Option<StartName>,
    /// X, in σ: the particle starts at (X, 0), or on the circular orbit whose radius is nearest to |X|. By default X is
    /// 0, and the orbit is the smallest one that is stable.
    #[schemars(extend("x-option" = option("X", "Start", 22)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_position: Option<f64>,
    /// D: the particle, but not its field, is displaced by -D along x, in σ.
    #[schemars(extend("x-option" = option("D", "Start", 23)))]
    #[serde(default)]
    pub kick: f64,
    /// Displacement of the particle, but not of its field, along y, in σ.
    #[schemars(extend("x-option" = option("D", "Across the scan", 31)))]
    #[serde(default)]
    pub kick_across: f64,
    /// Initial velocity along x of a particle with inertia on a flat field, in kσ/Γ; 0 by default.
    #[schemars(extend("x-option" = option("V", "Start", 24)))]
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_velocity: Option<f64>,
    /// Gaussian pulses of external force along x.
    #[serde(default)]
    pub pulses: Vec<Pulse>,
    /// Time at which the run ends, in Γ/k; it starts at 0.
    #[schemars(extend("x-option" = option("T", "Model", 5)))]
    pub until: f64,
    /// Target for the error of the position per unit of time, in σ; from 1e-13 to 1e-2.
    #[schemars(extend("x-option" = option("E", "Accuracy", 51)))]
    #[serde(default = "default_tolerance")]
    pub tolerance: f64,
    /// Largest radius of the circular orbits that are listed, in σ; above 0 and at most 200.
    #[schemars(extend("x-option" = option("RADIUS", "Walker", 73)))]
    #[serde(default = "default_largest_radius")]
    pub largest_radius: f64,
    /// Times of the samples.
    #[serde(flatten)]
    pub sampling: Sampling,
}

fn yes() -> bool {
    true
}

fn one() -> f64 {
    1.0
}

fn default_largest_radius() -> f64 {
    30.0
}

/// Largest value of `largest_radius`, in σ.
const MOST_RADIUS: f64 = 200.0;

/// The motion of a walker. Lengths in σ, the inverse wave number of J0; times in Γ/k.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WalkerFound {
    /// Speed of a free walker in steady motion, in kσ/Γ; 0 if it does not walk.
    pub free_speed: f64,
    /// All circular orbits about the origin up to the largest radius, by rising radius; null without a rotation or a trap.
    pub orbits: Option<Vec<OrbitDocument>>,
    /// Motion at the end of the run, in its last quarter.
    pub regime: WalkerRegime,
    /// Mean speed in the last quarter of the run, in kσ/Γ.
    pub speed: f64,
    /// The circle, if the particle moves on one.
    pub circle: Option<CircleDocument>,
    /// Positions and velocities at the sample times.
    pub samples: Samples,
    /// Whether a signal stopped the run before `until`.
    pub interrupted: bool,
    /// Cost of the run.
    pub work: WalkerWork,
}

/// A circular orbit about the origin.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OrbitDocument {
    /// Radius, in σ.
    pub radius: f64,
    /// Angular frequency, in k/Γ; above 0 if counterclockwise.
    pub omega: f64,
    /// Speed, in kσ/Γ.
    pub speed: f64,
    /// Whether small deviations decay, except shifts of the orbit; null if the memory is too long to compute this.
    pub stable: Option<bool>,
    /// The growth exponents with the largest real parts, at most six, in k/Γ, with those of shifts; null if `stable` is.
    pub roots: Option<Vec<ComplexDocument>>,
}

/// Number of exponents in a document.
const EXPONENTS: usize = 6;

/// Cost of a run of a walker.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WalkerWork {
    /// Number of steps.
    pub steps: u64,
    /// Number of plane waves that represent the field.
    pub directions: u64,
    /// Computing time, in s.
    pub seconds: f64,
}

/// A walker and the question that it answers.
pub type WalkerDocument = Document<Walker>;

impl Question for Walker {
    const FORMAT: &'static str = "stickslip/walker";
    type Answer = WalkerFound;
}

impl Walker {
    /// Whether circular orbits exist.
    fn has_orbits(&self) -> bool {
        self.rotation.is_some_and(|rotation| rotation.abs() > 0.0)
            || self.trap.is_some_and(|trap| trap > 0.0)
    }

    fn on_flat_field(&self) -> Result<WalkerScenario, Refused> {
        let force = Force::new(self.pulses.clone(), None)
            .map_err(|error| Refused::whole("pulses", error))?;
        let scenario = WalkerScenario {
            inertia: self.inertia,
            rotation: self.rotation.unwrap_or_default(),
            trap: self.trap.unwrap_or_default(),
            force: [force, Force::default()],
            position: [self.start_position.unwrap_or_default(), 0.0],
            kick: [-self.kick, self.kick_across],
            velocity: [self.start_velocity.unwrap_or_default(), 0.0],
            tolerance: self.tolerance,
            ..WalkerScenario::new(self.alpha, self.healing_time, self.until)
        };
        scenario.validate().map_err(|error| self.refused(&error))?;
        Ok(scenario)
    }

    fn scenario(&self) -> Result<(WalkerScenario, Option<Vec<theory::Orbit>>), Failure> {
        let scenario = self.on_flat_field()?;
        let orbits = self.has_orbits().then(|| theory::orbits(&scenario, self.largest_radius));
        if self.start == Some(StartName::Flat) {
            return Ok((scenario, orbits));
        }
        let started = match &orbits {
            Some(orbits) if scenario.free_speed() > 0.0 => self.on_orbit(scenario, orbits)?,
            _ => {
                let velocity = [scenario.free_speed(), 0.0];
                WalkerScenario { past: WalkerPast::Straight(velocity), velocity, ..scenario }
            }
        };
        Ok((started, orbits))
    }

    /// The scenario that starts on one of these orbits.
    fn on_orbit(
        &self,
        scenario: WalkerScenario,
        orbits: &[theory::Orbit],
    ) -> Result<WalkerScenario, Refused> {
        let stable = |orbit: &&theory::Orbit| orbit.unstable_count(&scenario) == Some(0);
        let chosen = match self.start_position {
            Some(x) => orbits
                .iter()
                .min_by(|a, b| (a.radius - x.abs()).abs().total_cmp(&(b.radius - x.abs()).abs())),
            None => orbits.iter().find(stable).or(orbits.first()),
        };
        let Some(orbit) = chosen else {
            let why =
                "has no circular orbit up to there to start on: give a larger one, or {start} flat";
            return Err(Refused::number("largest_radius", self.largest_radius, why));
        };
        Ok(WalkerScenario {
            past: WalkerPast::Circle(orbit.frequency),
            position: [orbit.radius, 0.0],
            velocity: [0.0, orbit.radius * orbit.frequency],
            ..scenario
        })
    }

    /// The rejection of the parameter that caused an error.
    fn refused(&self, error: &WalkerError) -> Refused {
        let number = |name: &'static str, value: f64| Refused::number(name, value, error);
        match *error {
            WalkerError::Alpha(value) => number("alpha", value),
            WalkerError::HealingTime(value) => number("healing_time", value),
            WalkerError::Inertia(value) => number("inertia", value),
            WalkerError::Rotation(value) => number("rotation", value),
            WalkerError::Trap(value) => number("trap", value),
            WalkerError::Until(value) => number("until", value),
            WalkerError::Tolerance(value) => number("tolerance", value),
            WalkerError::Start(_) => {
                let given = [
                    ("start_position", self.start_position.unwrap_or_default()),
                    ("kick", self.kick),
                    ("kick_across", self.kick_across),
                    ("start_velocity", self.start_velocity.unwrap_or_default()),
                ];
                let bad = given.into_iter().find(|(_, value)| !value.is_finite());
                bad.map_or(Refused::whole("start", error), |(name, value)| number(name, value))
            }
            _ => Refused::whole("walker", error),
        }
    }

    fn judge(&self) -> Result<(), Refused> {
        if !self.walker {
            return Err(Refused::whole("walker", "must be true, or left out"));
        }
        if self.start == Some(StartName::Paper) {
            return Err(Refused::whole("start", "a walker starts steady or flat"));
        }
        if !(self.largest_radius > 0.0 && self.largest_radius <= MOST_RADIUS) {
            let why = format!("must be above 0 and at most {MOST_RADIUS}");
            return Err(Refused::number("largest_radius", self.largest_radius, why));
        }
        let velocity = self.start_velocity;
        if let Some(velocity) =
            velocity.filter(|_| self.inertia.is_none() || self.start != Some(StartName::Flat))
        {
            let why = "is that of a particle with {inertia} on a flat field: give {start} flat too";
            return Err(Refused::number("start_velocity", velocity, why));
        }
        Ok(())
    }
}

impl Ask for Walker {
    fn resolved(self, _: &Context) -> Result<Self, Failure> {
        self.judge()?;
        self.on_flat_field()?;
        self.sampling.times((0.0, self.until), "the run", true)?;
        let start = Some(self.start.unwrap_or(StartName::Steady));
        Ok(Self { start, ..self })
    }

    fn answer(&self, context: &Context) -> Result<(WalkerFound, Vec<String>), Failure> {
        let (scenario, orbits) = self.scenario()?;
        let times = self.sampling.times((0.0, self.until), "the run", true)?;
        let began = context.seconds();
        let run = run_observed(&scenario, |step, steps| {
            context.stepped((0.0, self.until), step.end(), steps);
            ControlFlow::Continue(())
        });
        let run = run.map_err(|error| match error {
            WalkerError::Range { .. } | WalkerError::Step { .. } | WalkerError::TooLong { .. } => {
                Failure::Failed(error.to_string())
            }
            error => self.refused(&error).into(),
        })?;
        let trajectory = &run.trajectory;
        let sampled = times.all().into_iter().filter(|t| *t <= trajectory.end());
        let (regime, speed, circle) = motion(trajectory);
        let found = WalkerFound {
            free_speed: scenario.free_speed(),
            orbits: orbits.map(|orbits| {
                orbits.iter().map(|orbit| OrbitDocument::of(orbit, &scenario)).collect()
            }),
            regime,
            speed,
            circle,
            samples: sampled.map(|t| sample(trajectory, t)).collect(),
            interrupted: trajectory.end() < self.until,
            work: WalkerWork {
                steps: trajectory.steps().len() as u64,
                directions: run.directions as u64,
                seconds: context.seconds() - began,
            },
        };
        Ok((found, remarks(self, &scenario)))
    }

    /// A cancelled run ends at the time that it has reached.
    fn answered(self, context: &Context) -> Result<WalkerDocument, Failure> {
        let (answer, remarks) = context.keeping(|| self.answer(context))?;
        Ok(Document::new(self, answer, remarks))
    }
}

fn remarks(question: &Walker, scenario: &WalkerScenario) -> Vec<String> {
    let is_flat = question.start == Some(StartName::Flat);
    let is_idle = question.pulses.is_empty() && scenario.velocity[0].abs() <= 0.0;
    let at_rest = is_flat && is_idle && question.trap.unwrap_or_default() <= 0.0;
    let rests =
        "the particle starts at rest on a flat field, and nothing sets it going: add a pulse";
    let slow = "a free particle walks above -αT² = 2 only";
    let said = [(at_rest, rests), (scenario.free_speed() <= 0.0, slow)];
    said.into_iter().filter(|(is_so, _)| *is_so).map(|(_, why)| why.to_owned()).collect()
}

fn sample(trajectory: &WalkerTrajectory, t: f64) -> SampleLine {
    let ([x, y], [u, v]) = (trajectory.position(t), trajectory.velocity(t));
    let (y0, velocity_y) = (Some(y), Some(v));
    SampleLine { t, x0: x, velocity: u, y0, velocity_y, ..SampleLine::default() }
}

impl OrbitDocument {
    fn of(orbit: &theory::Orbit, scenario: &WalkerScenario) -> Self {
        let leading = orbit.exponents.as_ref().map(|exponents| {
            let first = exponents.iter().take(EXPONENTS);
            first.map(|z| ComplexDocument { re: z.re, im: z.im }).collect()
        });
        Self {
            radius: orbit.radius,
            omega: orbit.frequency,
            speed: orbit.speed(),
            stable: orbit.unstable_count(scenario).map(|count| count == 0),
            roots: leading,
        }
    }
}

impl Tabular for WalkerFound {
    /// The samples, as a table.
    fn columns(&self) -> Vec<Named<'_>> {
        self.samples.columns()
    }
}
