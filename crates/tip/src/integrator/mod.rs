//! Adaptive collocation of the closed equation: one unknown, the tip's displacement within the step.
//!
//! Radau IIA applied to (10) and (11) together. The stage values of u never appear: within a step the
//! groove is what the memory knows of the past plus the step's own indentation, the Butcher matrix
//! applied to `f'(x_i - x_j)`, so that s scalar unknowns remain.

mod control;
mod stage_equations;

use crate::collocation::{RADAU, STAGES, Stages, apply};
use crate::history::Step;
use crate::memory::{Memory, longest_look};
use crate::{Force, InitialSurface, Model};
use control::Control;
use stage_equations::StageEquations;
use thiserror::Error;

/// What the integrator did, in counts that do not depend on the machine.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Work {
    /// Accepted steps.
    pub steps: u64,
    /// Steps repeated with a smaller length.
    pub rejected: u64,
    /// Newton iterations, each of them one look at the groove in all stages.
    pub newton_iterations: u64,
}

/// Why a run could not go on.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum IntegrationError {
    /// The step length fell to the round-off of t.
    #[error(
        "at t = {t}: the tolerance {tolerance:e} cannot be met, the step length fell to {h:e}; ask for a larger tolerance, or for smoother forces and surfaces"
    )]
    StepTooSmall {
        /// Time reached.
        t: f64,
        /// Last step length tried.
        h: f64,
        /// Tolerance asked for.
        tolerance: f64,
    },
}

/// The state of a tip under way, and all that acts on it.
pub struct Integrator<'a> {
    model: &'a Model,
    surface: &'a InitialSurface,
    force: &'a Force,
    memory: Box<dyn Memory + 'a>,
    control: Control,
    t: f64,
    /// rt - x0
    extension: f64,
    velocity: f64,
    /// u_xx at the tip: minus the stiffness that the groove adds.
    curvature: f64,
    last: Option<Step>,
    work: Work,
}

impl<'a> Integrator<'a> {
    /// A tip that starts at time t with its spring extended by `extension` = rt - x0, and nothing
    /// remembered but what `memory` brings along.
    pub fn new(
        model: &'a Model,
        surface: &'a InitialSurface,
        force: &'a Force,
        memory: Box<dyn Memory + 'a>,
        start: (f64, f64),
        tolerance: f64,
    ) -> Self {
        let (t, extension) = start;
        let (slope, curvature) = surface.slope_and_curvature(model.r() * t - extension);
        Self {
            model,
            surface,
            force,
            memory,
            control: Control::new(tolerance),
            t,
            extension,
            velocity: -slope + extension + force.value(t),
            curvature,
            last: None,
            work: Work::default(),
        }
    }

    /// Steps of this length only, without error control: for observing the order of convergence.
    #[must_use]
    pub fn with_fixed_step(mut self, h: f64) -> Self {
        self.control.fix(h);
        self
    }

    /// Time reached.
    #[must_use]
    pub fn t(&self) -> f64 {
        self.t
    }

    /// l = rt - r - x0 now.
    #[must_use]
    pub fn l(&self) -> f64 {
        self.extension - self.model.r()
    }

    /// Counts so far.
    #[must_use]
    pub fn work(&self) -> Work {
        self.work
    }

    /// The memory in use.
    #[must_use]
    pub fn memory(&self) -> &dyn Memory {
        self.memory.as_ref()
    }

    /// Makes one step, which ends at `until` at the latest.
    ///
    /// # Errors
    /// The tolerance cannot be met.
    pub fn step(&mut self, until: f64) -> Result<Step, IntegrationError> {
        let mut h = self.control.proposal(self.length_limit(), self.distance_to_break(until));
        loop {
            // The difference of two representable times: t loses nothing as it grows.
            h = (self.t + h) - self.t;
            if h <= 4.0 * f64::EPSILON * self.t.abs().max(1e-3) {
                let tolerance = self.control.tolerance();
                return Err(IntegrationError::StepTooSmall { t: self.t, h, tolerance });
            }
            match self.attempt(h) {
                Ok(step) => return Ok(step),
                Err(shorter) => {
                    self.work.rejected += 1;
                    h = shorter;
                }
            }
        }
    }

    /// A step of length h, accepted, or the shorter length to try instead.
    fn attempt(&mut self, h: f64) -> Result<Step, f64> {
        let longest = self.longest_displacement();
        let guess = self.predict(h, longest);
        let target = self.control.target();
        let (model, surface, force) = (self.model, self.surface, self.force);
        let equations = StageEquations::new(model, surface, force, (self.t, h, self.extension));
        let most = control::OVERSHOOT * longest;
        let look = longest_look(self.model.tip());
        let solved = equations.solve(self.memory.as_mut(), guess, 0.01 * target, look);
        self.work.newton_iterations += solved.iterations;
        let Some(solution) = solved.solution else { return Err(0.3 * h) };
        let displacement = solution.displacement;
        let moved = displacement.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        if moved > most && !self.control.is_fixed() {
            return Err(h * (0.8 * most / moved).max(0.1));
        }
        let stiffness = (1.0 + self.curvature).max(0.0);
        self.control.judge(self.defect(&displacement, h), h, stiffness)?;
        Ok(self.accept(h, displacement, solution.curvature_at_end))
    }

    /// Defect of the stage polynomial at the start of the step, where the true velocity is known from
    /// the step before.
    fn defect(&self, displacement: &Stages, h: f64) -> f64 {
        let slope: f64 =
            RADAU.derivative_at_start.iter().zip(displacement).map(|(w, d)| w * d).sum();
        slope / h - self.velocity
    }

    fn accept(&mut self, h: f64, displacement: Stages, curvature: f64) -> Step {
        let step = Step { t: self.t, h, extension: self.extension, displacement };
        self.memory.remember(&displacement, &RADAU.b().map(|b| b * h));
        self.t = step.end();
        self.extension = step.extension_at_end(self.model.r());
        self.velocity = apply(&RADAU.derivative, &displacement)[STAGES - 1] / h;
        self.curvature = curvature;
        self.last = Some(step);
        self.work.steps += 1;
        step
    }

    /// The last stage polynomial continued, where it can be trusted to; else a straight line.
    fn predict(&self, h: f64, longest: f64) -> Stages {
        if let Some(last) = self.last.filter(|last| h <= 1.5 * last.h) {
            let end = last.displacement[STAGES - 1];
            let at = |c: f64| RADAU.value(&last.displacement, 1.0 + c * h / last.h) - end;
            let guess = RADAU.c.map(at);
            if guess.iter().all(|d| d.abs() < longest) {
                return guess;
            }
        }
        RADAU.c.map(|c| (c * h * self.velocity).clamp(-longest, longest))
    }

    /// The longest displacement that a step may make: the step's own indentation must remain a smooth
    /// function of its stages, and no feature of u0 may be jumped over.
    fn longest_displacement(&self) -> f64 {
        let x0 = self.model.r() * self.t - self.extension;
        let own = control::BANDS_PER_STEP / self.model.tip().band();
        own.min(control::LONGEST_DISPLACEMENT).min(self.surface.longest_displacement(x0))
    }

    fn length_limit(&self) -> f64 {
        let speed = self.velocity.abs().max(1e-300);
        self.force.longest_step(self.t).min(self.longest_displacement() / speed)
    }

    fn distance_to_break(&self, until: f64) -> f64 {
        self.force.next_break(self.t).min(until) - self.t
    }
}
