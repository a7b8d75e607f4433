//! The motion of a walker: its steps, each with its Taylor polynomials.

use crate::integrator::taylor::pieces::value;

/// One step of the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkerStep {
    /// Start of the step.
    pub t: f64,
    /// Duration.
    pub h: f64,
    /// Coefficients of x and of y in powers of the time since the start of the step.
    pub position: [Vec<f64>; 2],
}

impl WalkerStep {
    /// Time at the end of the step.
    pub fn end(&self) -> f64 {
        self.t + self.h
    }
}

/// The dense output of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct WalkerTrajectory {
    steps: Vec<WalkerStep>,
}

impl WalkerTrajectory {
    /// A trajectory of consecutive steps, the first at t = 0.
    ///
    /// # Panics
    /// If there are no steps.
    pub fn new(steps: Vec<WalkerStep>) -> Self {
        assert!(!steps.is_empty(), "a trajectory has at least one step");
        Self { steps }
    }

    /// The steps, in order.
    pub fn steps(&self) -> &[WalkerStep] {
        &self.steps
    }

    /// End time.
    pub fn end(&self) -> f64 {
        self.steps[self.steps.len() - 1].end()
    }

    /// (x0, y0) at t. Outside of the run, the first or last step is extrapolated.
    pub fn position(&self, t: f64) -> [f64; 2] {
        let step = self.step_at(t);
        [0, 1].map(|axis| value(&step.position[axis], t - step.t))
    }

    /// (x0', y0') at t.
    pub fn velocity(&self, t: f64) -> [f64; 2] {
        let step = self.step_at(t);
        [0, 1].map(|axis| {
            let terms = step.position[axis].iter().enumerate().rev();
            let slope = |sum: f64, (k, c): (usize, &f64)| {
                if k == 0 { sum } else { sum * (t - step.t) + k as f64 * c }
            };
            terms.fold(0.0, slope)
        })
    }

    fn step_at(&self, t: f64) -> &WalkerStep {
        let after = self.steps.partition_point(|step| step.t <= t);
        &self.steps[after.max(1) - 1]
    }
}
