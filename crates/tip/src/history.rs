//! The history of the tip: its accepted steps, each a polynomial.

use crate::collocation::{RADAU, STAGES, Stages};
use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// One accepted step: the stage polynomial of the tip's displacement.
///
/// Positions are kept as the spring's extension and as displacements, not as x0: a tip that has
/// travelled 1e6 widths keeps its last digits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Time at its start.
    pub t: f64,
    /// Its duration.
    pub h: f64,
    /// rt - x0 at its start, the extension of the spring; l = rt - r - x0.
    pub extension: f64,
    /// x0 less its value at the start, at the collocation nodes; the last is the end of the step.
    pub displacement: Stages,
}

/// How many numbers make a step.
pub const STEP_NUMBERS: usize = 3 + STAGES;

impl Step {
    /// Time at its end.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.t + self.h
    }

    /// rt - x0 at its end, for support velocity r.
    #[must_use]
    pub fn extension_at_end(&self, r: f64) -> f64 {
        self.extension + (r * self.h - self.displacement[STAGES - 1])
    }

    /// l(t) = rt - r - x0(t) on its polynomial, for support velocity r.
    #[must_use]
    pub fn l(&self, r: f64, t: f64) -> f64 {
        let moved = RADAU.value(&self.displacement, self.part(t));
        self.extension - r + (r * (t - self.t) - moved)
    }

    /// x0(t) on its polynomial.
    #[must_use]
    pub fn x0(&self, r: f64, t: f64) -> f64 {
        r * t - r - self.l(r, t)
    }

    /// x0'(t) on its polynomial: one order less accurate than x0.
    #[must_use]
    pub fn velocity(&self, t: f64) -> f64 {
        RADAU.slope(&self.displacement, self.part(t)) / self.h
    }

    /// The fraction of it that has passed at t.
    fn part(&self, t: f64) -> f64 {
        (t - self.t) / self.h
    }

    /// t, h, extension and displacements: all that it is.
    #[must_use]
    pub fn numbers(&self) -> [f64; STEP_NUMBERS] {
        let mut numbers = [0.0; STEP_NUMBERS];
        numbers[..3].copy_from_slice(&[self.t, self.h, self.extension]);
        numbers[3..].copy_from_slice(&self.displacement);
        numbers
    }

    /// From its [`numbers`](Self::numbers).
    #[must_use]
    pub fn from_numbers([t, h, extension, displacement @ ..]: [f64; STEP_NUMBERS]) -> Self {
        Self { t, h, extension, displacement }
    }
}

/// The dense history of a run: x0(t) at every t of it. What `surface` needs, and no more.
#[derive(Debug, Clone, PartialEq)]
pub struct Trajectory {
    r: f64,
    steps: Vec<Step>,
}

/// Points of the Gauss rule on the part of a step up to a given time. It integrates
/// f(x - polynomial) far beyond the accuracy of the polynomial itself.
const POINTS_ON_A_PART: usize = 16;

static GAUSS: LazyLock<GaussLegendre> =
    LazyLock::new(|| GaussLegendre::new(const { NonZeroUsize::new(POINTS_ON_A_PART).unwrap() }));

impl Trajectory {
    /// From steps that follow each other without a gap, under support velocity r.
    ///
    /// # Panics
    /// Without any step.
    #[must_use]
    pub fn new(r: f64, steps: Vec<Step>) -> Self {
        assert!(!steps.is_empty(), "a trajectory has at least one step");
        Self { r, steps }
    }

    /// Support velocity.
    #[must_use]
    pub fn r(&self) -> f64 {
        self.r
    }

    /// The steps, in order.
    #[must_use]
    pub fn steps(&self) -> &[Step] {
        &self.steps
    }

    /// Time at which it starts.
    #[must_use]
    pub fn start(&self) -> f64 {
        self.steps[0].t
    }

    /// Time at which it ends.
    #[must_use]
    pub fn end(&self) -> f64 {
        self.steps[self.steps.len() - 1].end()
    }

    /// l(t) = rt - r - x0(t). Outside of the run, the polynomials of its first and last step.
    #[must_use]
    pub fn l(&self, t: f64) -> f64 {
        self.step_at(t).l(self.r, t)
    }

    /// x0(t).
    #[must_use]
    pub fn x0(&self, t: f64) -> f64 {
        self.step_at(t).x0(self.r, t)
    }

    /// x0'(t), the derivative of the stage polynomial: one order less accurate than x0.
    #[must_use]
    pub fn velocity(&self, t: f64) -> f64 {
        self.step_at(t).velocity(t)
    }

    /// Where the tip was until time t, and for how long: positions and weights such that
    /// ∫_{start}^t g(x0(t'))dt' = Σ `w_j` g(`x_j`).
    #[must_use]
    pub fn residence(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let (mut positions, mut weights) = (vec![], vec![]);
        for step in self.steps.iter().take_while(|step| step.t < t) {
            let origin = self.r * step.t - step.extension;
            if step.end() <= t {
                positions.extend(step.displacement.map(|d| origin + d));
                weights.extend(RADAU.b().map(|b| b * step.h));
                continue;
            }
            let part = (t - step.t) / step.h;
            for (node, weight) in GAUSS.as_node_weight_pairs() {
                let tau = 0.5 * part * (1.0 + node);
                positions.push(origin + RADAU.value(&step.displacement, tau));
                weights.push(0.5 * part * step.h * weight);
            }
        }
        (positions, weights)
    }

    /// The step that holds t.
    fn step_at(&self, t: f64) -> &Step {
        let after = self.steps.partition_point(|step| step.t <= t);
        &self.steps[after.max(1) - 1]
    }
}
