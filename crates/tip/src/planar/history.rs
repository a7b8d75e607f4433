//! The history of a tip in two coordinates: its accepted steps, each a polynomial along and one across.

use crate::Support;
use crate::collocation::{RADAU, STAGES, Stages};

/// One accepted step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Its duration, and the motion along the scan.
    pub along: crate::Step,
    /// y0 at its start.
    pub y: f64,
    /// y0 less its value at the start, at the collocation nodes; the last is the end of the step.
    pub across: Stages,
}

impl Step {
    /// Time at its end.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.along.end()
    }

    /// y0 at its end.
    #[must_use]
    pub fn y_at_end(&self) -> f64 {
        self.y + self.across[STAGES - 1]
    }

    /// y0(t) on its polynomial.
    #[must_use]
    pub fn y0(&self, t: f64) -> f64 {
        self.y + RADAU.value(&self.across, self.part(t))
    }

    /// x0'(t) and y0'(t) on its polynomials: one order less accurate than positions.
    #[must_use]
    pub fn velocity(&self, t: f64) -> [f64; 2] {
        let across = RADAU.slope(&self.across, self.part(t)) / self.along.h;
        [self.along.velocity(t), across]
    }

    fn part(&self, t: f64) -> f64 {
        (t - self.along.t) / self.along.h
    }
}

/// The dense history of a run: x0(t) and y0(t) at every t of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    support: Support,
    steps: Vec<Step>,
}

impl Trajectory {
    /// From steps that follow each other without a gap.
    ///
    /// # Panics
    /// Without any step.
    #[must_use]
    pub fn new(support: Support, steps: Vec<Step>) -> Self {
        assert!(!steps.is_empty(), "a trajectory has at least one step");
        Self { support, steps }
    }

    /// The steps, in order.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Time at which it starts.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.steps[0].along.t
    }

    /// Time at which it ends.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.steps[self.steps.len() - 1].end()
    }

    /// x0(t). Outside of the run, the polynomials of its first and last step.
    #[must_use]
    pub fn x0(&self, t: f64) -> f64 {
        self.step_at(t).along.position(&self.support, t)
    }

    /// y0(t).
    #[must_use]
    pub fn y0(&self, t: f64) -> f64 {
        self.step_at(t).y0(t)
    }

    /// R(t) - x0(t).
    #[must_use]
    pub fn lag(&self, t: f64) -> f64 {
        self.step_at(t).along.lag(&self.support, t)
    }

    /// x0'(t) and y0'(t), one order less accurate than positions.
    #[must_use]
    pub fn velocity(&self, t: f64) -> [f64; 2] {
        self.step_at(t).velocity(t)
    }

    /// The step that holds t.
    fn step_at(&self, t: f64) -> &Step {
        let after = self.steps.partition_point(|step| step.along.t <= t);
        &self.steps[after.max(1) - 1]
    }
}
