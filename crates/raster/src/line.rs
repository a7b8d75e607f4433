//! A finished scan line.

use crate::path::Track;
use stickslip_tip::{Model, Step, Support, Trajectory, Work};

/// The motion of the tip along one line. Time counts from the start of the line.
#[derive(Debug, Clone)]
pub struct Line {
    track: Track,
    /// Motion in the frame of the line: the support starts at 0 and moves to larger x.
    trajectory: Trajectory,
    work: Work,
}

impl Line {
    /// A line from its steps, in the frame of the line, with the law of a model.
    ///
    /// # Panics
    /// There is no step.
    #[must_use]
    pub fn new(track: Track, model: &Model, steps: Vec<Step>, work: Work) -> Self {
        let trajectory = Trajectory::under(*model.wider(), Support::Moving(model.r()), steps);
        Self { track, trajectory, work }
    }

    /// The path of the support.
    #[must_use]
    pub fn track(&self) -> Track {
        self.track
    }

    /// The motion in the frame of the line, in which the support starts at 0 and moves to larger x.
    #[must_use]
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// Counts of the integrator.
    #[must_use]
    pub fn work(&self) -> Work {
        self.work
    }

    /// x0 on the surface.
    #[must_use]
    pub fn x0(&self, t: f64) -> f64 {
        self.track.x(self.trajectory.x0(t))
    }

    /// R - x0 on the surface: the lateral force. Negative on a line towards smaller x, where the tip lags behind.
    #[must_use]
    pub fn lag(&self, t: f64) -> f64 {
        self.track.sign() * (self.trajectory.l(t) + self.trajectory.r())
    }

    /// x0' on the surface.
    #[must_use]
    pub fn velocity(&self, t: f64) -> f64 {
        self.track.sign() * self.trajectory.velocity(t)
    }

    /// x0 on the surface at the end.
    pub(crate) fn x0_at_end(&self) -> f64 {
        let (r, steps) = (self.trajectory.r(), self.trajectory.steps());
        let last = steps[steps.len() - 1];
        self.track.x(r * last.end() - last.extension_at_end(r))
    }

    /// The height of the surface under the tip, in kσ²/a, if there is a depth limit.
    #[must_use]
    pub fn height(&self, t: f64) -> Option<f64> {
        self.trajectory.height(t)
    }

    /// x0' on the surface at the end.
    pub(crate) fn velocity_at_end(&self) -> f64 {
        self.velocity(self.trajectory.end())
    }

    /// The residence of the tip on the surface: positions and weights such that ∫ w(t) e^{-(X/r-t)/T} g(x0(t))dt = Σ
    /// `w_j` g(`x_j`) at the end of the line, with w and T of the extended model.
    #[must_use]
    pub fn residence(&self) -> (Vec<f64>, Vec<f64>) {
        let (mut positions, weights) = self.trajectory.residence(self.trajectory.end());
        positions.iter_mut().for_each(|x| *x = self.track.x(*x));
        (positions, weights)
    }
}
