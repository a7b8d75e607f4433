//! Adaptive collocation of the closed equation, with the displacement of the tip within the step as the only unknown.
//!
//! Radau IIA is applied to (10) and (11) together. The stage values of u never appear. Within a step the groove is the
//! sum of the groove of the past, from the memory, and the contribution of the step: the Butcher matrix applied to
//! `f'(x_i - x_j)`. So one scalar unknown remains for each stage.

pub(crate) mod ahead;
pub(crate) mod control;
pub(crate) mod corner;
mod error;
pub(crate) mod landing;
pub(crate) mod newton;
mod saved;
mod stage_equations;
pub(crate) mod taylor;

use crate::collocation::{RADAU, Stages};
use crate::elementary::exp;
use crate::history::{Heights, Step};
use crate::initial_surface::Stretch;
use crate::memory::{Policy, longest_look};
use crate::step;
use crate::tip_function::Apex;
use crate::{Force, InitialSurface, Model, Scenario, Support};
use control::Control;
use corner::Corner;
pub use error::IntegrationError;
use landing::landing;
use stage_equations::{Begin, Solution, StageEquations};
use std::cell::OnceCell;
use taylor::Taylor;
pub(crate) use taylor::{BeginBeside, SideBySide};

/// Numbers of steps, iterations and series, which do not depend on the machine.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "RasterWork"))]
#[cfg_attr(
    feature = "schema",
    schemars(description = "Counts over all lines, which depend on the input alone.")
)]
pub struct Work {
    /// Number of accepted steps.
    pub steps: u64,
    /// Number of steps repeated with a smaller length.
    pub rejected: u64,
    /// Number of Newton iterations in all steps.
    pub newton_iterations: u64,
    /// Number of Taylor expansions; each makes one or several steps without iteration.
    #[cfg_attr(feature = "serde", serde(default))]
    pub series: u64,
    /// Number of changes from Taylor steps to collocation.
    #[cfg_attr(feature = "serde", serde(default))]
    pub switches: u64,
}

/// The state of a tip in motion, and all forces on it.
pub struct Integrator<'a> {
    model: &'a Model,
    /// Expansion of f about its apex, computed when collocation first needs it.
    apex: OnceCell<Apex>,
    surface: &'a InitialSurface,
    force: &'a Force,
    support: Support,
    memory: Policy,
    control: Control,
    t: f64,
    /// Start and end time of the run.
    start: f64,
    until: f64,
    /// End of the initial rest by symmetry: until then no force acts on the tip, and the groove is even about it.
    rest_until: f64,
    /// R - x0
    extension: f64,
    velocity: f64,
    /// u_xx at the tip: minus the stiffness that the groove adds.
    curvature: f64,
    /// u0' and Fext as contained in `velocity`, their limits from before; where they jump, the next step begins with
    /// other values.
    limits_from_before: (f64, f64),
    /// The stretch of u0 on which the present step began.
    stretch: Stretch,
    /// The kink of |h|, with a depth limit.
    corner: Option<Corner>,
    taylor: Taylor,
    last: Option<Step>,
    work: Work,
}

/// Accuracy of the iterations, and of the expansion of the contribution of the step, as a fraction of the error
/// allowed in a step.
pub(crate) const ENOUGH: f64 = 0.01;

/// Error of the velocity, relative to the error of a step divided by its length. With inertia M an error of the
/// velocity displaces the tip by M times as much.
pub(crate) const COASTING: f64 = 10.0;

impl<'a> Integrator<'a> {
    /// The tip of a scenario at its start, over this surface, with no past except that of `memory`.
    pub fn new(scenario: &'a Scenario, surface: &'a InitialSurface, memory: Policy) -> Self {
        let Scenario { model, force, until, tolerance, .. } = scenario;
        let (t, wider) = (scenario.start_time(), model.wider());
        let (extension, support) = (scenario.start_extension() + scenario.kick, scenario.support());
        let x = support.position(t) - extension;
        let (slope, curvature) = surface.slope_and_curvature(x);
        let pull = if wider.spring { extension } else { 0.0 };
        let force_now = force.value(t);
        let drift = -slope + pull + force_now;
        let velocity = if wider.inertia.is_some() { scenario.velocity_at_start() } else { drift };
        let coasts = wider.inertia.is_some() && velocity.abs() > 0.0;
        let rests = support == Support::None && surface.is_flat() && !coasts;
        let control = Control::new(*tolerance);
        let mut integrator = Self {
            model,
            apex: OnceCell::new(),
            corner: None,
            taylor: Taylor::new(model, *tolerance),
            surface,
            force,
            support,
            memory,
            control,
            t,
            start: t,
            until: *until,
            rest_until: if rests { force.begins() } else { f64::NEG_INFINITY },
            extension,
            velocity,
            curvature,
            limits_from_before: (slope, force_now),
            stretch: Stretch::default(),
            last: None,
            work: Work::default(),
        };
        if integrator.rests() {
            integrator.velocity = 0.0;
        }
        if wider.depth_limit.is_some() {
            integrator.corner = Corner::of(model, surface.height(x), integrator.control.target());
        }
        integrator
    }

    /// Whether the tip is at rest by symmetry. No algorithm for the history integral is exactly even, and if rest is
    /// unstable the remaining slope would grow.
    fn rests(&self) -> bool {
        self.t < self.rest_until
    }

    /// The integrator with a fixed step, without error control: for observing the order of convergence.
    #[must_use]
    pub fn with_fixed_step(mut self, h: f64) -> Self {
        self.control.fix(h);
        self
    }

    /// Time reached.
    pub fn t(&self) -> f64 {
        self.t
    }

    /// End of the steps that have been made, also of those that have not been returned.
    pub(crate) fn made_until(&self) -> f64 {
        self.taylor.left().last().map_or(self.t, Step::end)
    }

    /// Numbers of steps, iterations and series so far.
    pub fn work(&self) -> Work {
        self.work
    }

    /// The memory in use.
    pub fn memory(&self) -> &Policy {
        &self.memory
    }

    /// The memory in use, to be replaced by a memory of another past.
    pub fn memory_mut(&mut self) -> &mut Policy {
        &mut self.memory
    }

    /// Makes one step. It ends at the end of the scenario at the latest, except for one rounding of t.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    #[inline]
    pub fn step(&mut self) -> Result<(), IntegrationError> {
        if self.step_by_series() { Ok(()) } else { self.step_by_collocation() }
    }

    /// The last step.
    #[inline]
    pub fn last(&self) -> Option<&Step> {
        self.taylor.taken().or(self.last.as_ref())
    }

    #[inline(never)]
    fn step_by_collocation(&mut self) -> Result<(), IntegrationError> {
        self.enter_stretch();
        let (limit, end) = (self.length_limit(), self.next_end());
        let mut h = self.control.proposal(limit, end - self.t);
        loop {
            h = landing(self.t, h, end).ok_or(self.too_small(h))?;
            match self.attempt(h) {
                Ok(()) => return Ok(()),
                Err(retry) => {
                    h = retry.length((self.t, h), self.corner.as_mut(), &mut self.work);
                }
            }
        }
    }

    fn too_small(&self, h: f64) -> IntegrationError {
        IntegrationError::StepTooSmall { t: self.t, h, tolerance: self.control.tolerance() }
    }

    /// Sets the stretch of u0 ahead, and the velocity with which the tip enters it.
    fn enter_stretch(&mut self) {
        let (x, accuracy) = (self.position(), self.control.target());
        self.surface.enter(&mut self.stretch, x, self.velocity >= 0.0, accuracy);
        if self.model.wider().inertia.is_some() || self.rests() {
            return;
        }
        let slope = self.relief_slope();
        let force = self.force.value(self.t.next_up());
        self.velocity += (force - self.limits_from_before.1) - (slope - self.limits_from_before.0);
    }

    /// Makes a step of length h; on failure, returns the shorter length to try instead.
    fn attempt(&mut self, h: f64) -> Result<(), Retry> {
        let longest = step::longest_displacement(self.model.tip().band());
        let guess = self.predict(h, longest);
        let enough = ENOUGH * self.control.target();
        let (surface, force) = ((self.surface, &self.stretch), self.force);
        let accuracy = enough.max(f64::EPSILON);
        let apex = self.apex.get_or_init(|| Apex::new(self.model.tip(), accuracy));
        let model = (self.model, apex);
        let mass = self.model.wider().inertia;
        let inertia = mass.map(|mass| step::Inertia::new(mass, h, self.velocity));
        let begin = self.begin(h);
        let equations = StageEquations::new(model, surface, force, begin, inertia.as_ref());
        let look = longest_look(self.model.tip());
        let count = &mut self.work.newton_iterations;
        let solution = equations.solve(&mut self.memory, guess, (enough, look), count);
        let solution = solution.ok_or(Retry::Shorter(0.3 * h))?;
        let displacement = solution.displacement;
        let moved = displacement.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        let most = control::OVERSHOOT * longest;
        if moved > most && !self.control.is_fixed() {
            return Err(Retry::Shorter(h * (0.8 * most / moved).max(0.1)));
        }
        let at = |tau: f64| RADAU.value(&displacement, tau);
        if let Some(tau) = self.leaves(&RADAU.c, &displacement, at) {
            return Err(Retry::ToKnot(tau * h));
        }
        let (mut heights, mut error_of_heights) = (None, 0.0);
        if let Some((corner, nodes)) = self.corner.as_ref().zip(solution.height) {
            let heights = heights.insert(corner.heights(nodes));
            corner.passed(heights, (self.t, h))?;
            error_of_heights = corner.error(heights, self.last.as_ref(), h);
        }
        let stiffness = (1.0 + self.curvature).max(0.0);
        let signs = self.signs_of_error(&displacement, h);
        self.control.judge(signs, h, stiffness, error_of_heights).map_err(Retry::Shorter)?;
        self.accept(h, &solution, heights);
        Ok(())
    }

    /// The data at the start of a step of length h.
    fn begin(&self, h: f64) -> Begin {
        Begin {
            t: self.t,
            h,
            x: self.position(),
            extension: self.extension,
            velocity: self.support.velocity(self.t),
            depth: self.corner.map(|corner| corner.depth()),
            age: self.t - self.start,
            rests: self.rests(),
        }
    }

    /// Defect of the step, and its error as an interpolant from a comparison with the last step.
    fn signs_of_error(&self, displacement: &Stages, h: f64) -> (f64, f64) {
        let before =
            |last: Step| step::interpolation_error(displacement, h, (&last.displacement, last.h));
        let coasting = self.model.wider().inertia.map_or(1.0, |mass| 1.0 + COASTING * mass / h);
        let defect = step::defect(displacement, h, self.velocity);
        (coasting * defect, coasting * self.last.map_or(0.0, before))
    }

    fn accept(&mut self, h: f64, solution: &Solution, height: Option<Heights>) {
        let (displacement, rested) = (solution.displacement, self.rests());
        let step = Step { t: self.t, h, extension: self.extension, displacement, height };
        if let Some(time) = self.model.wider().healing_time {
            self.memory.fade(exp(-h / time));
        }
        self.memory.remember(&displacement, &solution.spent);
        self.extension = step.extension_at_end(self.support.velocity(self.t));
        if let Some(corner) = &mut self.corner {
            corner.arrive(&step);
        }
        self.t = step.end();
        self.velocity = step::velocity_at_end(&displacement, h);
        self.curvature = solution.curvature_at_end;
        self.limits_from_before = if rested {
            (0.0, 0.0)
        } else {
            (self.relief_slope(), self.force.value(self.t.next_down()))
        };
        self.last = Some(step);
        self.work.steps += 1;
        self.taylor.made(h * step::fastest(1.0 + self.curvature, self.model.wider().inertia));
    }

    /// The present x0.
    fn position(&self) -> f64 {
        self.support.position(self.t) - self.extension
    }

    /// The undecayed part of u0' at the tip.
    fn relief_slope(&self) -> f64 {
        let slope = self.surface.slope_and_curvature_on(&self.stretch, self.position()).0;
        match self.model.wider().healing_time {
            None => slope,
            Some(_) => slope * self.model.wider().left_after(self.t - self.start),
        }
    }
}

/// Reasons for repeating an attempt with another step.
pub(crate) enum Retry {
    /// The error was too large: use this shorter length.
    Shorter(f64),
    /// The step passed a knot of u0, or the kink of |h|, where it must end: use this length.
    ToKnot(f64),
    /// The step began at the kink of |h|, and moved to the other side.
    OtherSide,
}

impl Retry {
    /// The length of the next attempt, after one of length h from t.
    pub(crate) fn length(
        self,
        (t, h): (f64, f64),
        corner: Option<&mut Corner>,
        work: &mut Work,
    ) -> f64 {
        match self {
            Self::Shorter(shorter) => {
                work.rejected += 1;
                shorter
            }
            // Once: where both sides end at once, the step was too long to tell.
            Self::OtherSide if corner.is_some_and(Corner::turn) => h,
            Self::OtherSide => 0.3 * h,
            // A step that round-off keeps from becoming shorter would be tried indefinitely.
            Self::ToKnot(shorter) if t + shorter < t + h => shorter,
            Self::ToKnot(_) => 0.0,
        }
    }
}
