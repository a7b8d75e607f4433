//! The history of a tip in two coordinates: its accepted steps, each a polynomial along and one across.

use crate::collocation::{RADAU, STAGES, Stages, apply};
use crate::{Support, Wider};

/// One accepted step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Duration of the step, and the motion along the scan.
    pub along: crate::Step,
    /// y0 at the start of the step.
    pub y: f64,
    /// y0 minus its value at the start, at the collocation nodes; the last node is the end of the step.
    pub across: Stages,
}

impl Step {
    /// Time at the end of the step.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.along.end()
    }

    /// y0 at the end of the step.
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

    /// y0' on its polynomial as a function of t, for many t.
    pub fn velocity_across(&self) -> impl Fn(f64) -> f64 + use<'_> {
        self.rate(&self.across)
    }

    /// x0' on its polynomial as a function of t, for many t.
    pub fn velocity_along(&self) -> impl Fn(f64) -> f64 + use<'_> {
        self.rate(&self.along.displacement)
    }

    /// The derivative of the polynomial through these displacements.
    fn rate(&self, displacement: &Stages) -> impl Fn(f64) -> f64 + use<'_> {
        let rates = apply(&RADAU.derivative, displacement);
        move |t| RADAU.between(&rates, self.part(t)) / self.along.h
    }

    fn part(&self, t: f64) -> f64 {
        (t - self.along.t) / self.along.h
    }
}

/// The dense output of a run: x0(t) and y0(t) at every t of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    support: Support,
    wider: Wider,
    steps: Vec<Step>,
}

/// A node of the history: a position with its weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Visit {
    /// x0
    pub x: f64,
    /// y0
    pub y: f64,
    /// Time spent there, multiplied by its undecayed part, and by w with a depth limit.
    pub weight: f64,
}

impl Trajectory {
    /// A trajectory of consecutive steps without gaps.
    ///
    /// # Panics
    /// If there are no steps.
    #[must_use]
    pub fn new(wider: Wider, support: Support, steps: Vec<Step>) -> Self {
        assert!(!steps.is_empty(), "a trajectory has at least one step");
        Self { support, wider, steps }
    }

    /// Positions of the tip until t with their weights: `∫_{start}^t w e^{-(t-t')/T} q(x0(t'), y0(t')) dt'` = Σ weight
    /// q(x, y). The surface is its initial state minus α times the sum for q = f(x - x0, y - y0).
    #[must_use]
    pub fn residence(&self, t: f64) -> Vec<Visit> {
        let mut visits = vec![];
        for step in self.steps.iter().take_while(|step| step.along.t < t) {
            let origin = self.support.position(step.along.t) - step.along.extension;
            step.along.each_moment(&self.wider, t, |moment| {
                visits.push(Visit {
                    x: origin + moment.value(&step.along.displacement),
                    y: step.y + moment.value(&step.across),
                    weight: moment.weight,
                });
            });
        }
        visits
    }

    /// The steps, in order.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Start time.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.steps[0].along.t
    }

    /// End time.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.steps[self.steps.len() - 1].end()
    }

    /// x0(t). Outside of the run, the polynomial of the first or last step.
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

    /// The height of the surface under the tip, with a depth limit.
    #[must_use]
    pub fn height(&self, t: f64) -> Option<f64> {
        self.step_at(t).along.height(t)
    }

    /// The motion of the support.
    #[must_use]
    pub fn support(&self) -> &Support {
        &self.support
    }

    /// The step that contains t.
    #[must_use]
    pub fn step_at(&self, t: f64) -> &Step {
        let after = self.steps.partition_point(|step| step.along.t <= t);
        &self.steps[after.max(1) - 1]
    }
}
