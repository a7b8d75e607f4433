//! A finished scan line.

use crate::path::Track;
use stickslip_tip::planar::{self, Visit};
use stickslip_tip::{Model, STAGES, Stages, Step, Support, Trajectory, Work};

/// The motion of the tip along one line. Time counts from the start of the line.
#[derive(Debug, Clone)]
pub struct Line {
    track: Track,
    /// Motion in the frame of the line: the support starts at 0 and moves to larger x.
    trajectory: Trajectory,
    /// For each step the distance of the tip from the line at the start of the step, and its changes at the nodes. Empty
    /// if the tip is held on the line.
    across: Vec<(f64, Stages)>,
    work: Work,
}

impl Line {
    /// A line from its steps, in the frame of the line, with the law of a model.
    ///
    /// # Panics
    /// There is no step.
    pub fn new(track: Track, model: &Model, steps: Vec<Step>, work: Work) -> Self {
        let trajectory = Trajectory::under(*model.wider(), Support::Moving(model.r()), steps);
        Self { track, trajectory, across: vec![], work }
    }

    /// A line of a tip that is free to move across it, from its steps in the frame of the line, whose y is 0.
    ///
    /// # Panics
    /// There is no step.
    pub fn free(track: Track, model: &Model, steps: &[planar::Step], work: Work) -> Self {
        let along = steps.iter().map(|step| step.along).collect();
        let across = steps.iter().map(|step| (step.y, step.across)).collect();
        Self { across, ..Self::new(track, model, along, work) }
    }

    /// Steps in both coordinates, in the frame of the line; none if the tip is held on the line.
    pub fn planar_steps(&self) -> impl Iterator<Item = planar::Step> {
        let steps = self.trajectory.steps().iter().zip(&self.across);
        steps.map(|(along, (y, across))| planar::Step { along: *along, y: *y, across: *across })
    }

    /// The step that contains t, in both coordinates; `None` if the tip is held on the line.
    fn planar_step(&self, t: f64) -> Option<planar::Step> {
        let steps = self.trajectory.steps();
        let n = steps.partition_point(|step| step.t <= t).max(1) - 1;
        let (y, across) = *self.across.get(n)?;
        Some(planar::Step { along: steps[n], y, across })
    }

    /// Whether the tip is free to move across the line.
    pub fn is_free(&self) -> bool {
        !self.across.is_empty()
    }

    /// y0 on the surface: y of the line if the tip is held on it.
    pub fn y0(&self, t: f64) -> f64 {
        self.track.y + self.planar_step(t).map_or(0.0, |step| step.y0(t))
    }

    /// y0' on the surface: 0 if the tip is held on the line.
    pub fn velocity_y(&self, t: f64) -> f64 {
        self.planar_step(t).map_or(0.0, |step| step.velocity(t)[1])
    }

    /// y0 on the surface at the end.
    pub(crate) fn y0_at_end(&self) -> f64 {
        let off = self.across.last().map_or(0.0, |(y, across)| y + across[STAGES - 1]);
        self.track.y + off
    }

    /// The path of the support.
    pub fn track(&self) -> Track {
        self.track
    }

    /// The motion in the frame of the line, in which the support starts at 0 and moves to larger x.
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// Numbers of steps and iterations of the integrator.
    pub fn work(&self) -> Work {
        self.work
    }

    /// x0 on the surface.
    pub fn x0(&self, t: f64) -> f64 {
        self.at(t)[0]
    }

    /// R - x0 on the surface: the lateral force. Negative on a line towards smaller x, where the tip lags behind.
    pub fn lag(&self, t: f64) -> f64 {
        self.at(t)[1]
    }

    /// x0' on the surface.
    pub fn velocity(&self, t: f64) -> f64 {
        self.at(t)[2]
    }

    /// x0 on the surface at the end.
    pub(crate) fn x0_at_end(&self) -> f64 {
        let (r, steps) = (self.trajectory.r(), self.trajectory.steps());
        let last = steps[steps.len() - 1];
        self.track.x(r * last.end() - last.extension_at_end(r))
    }

    /// x0, the lag and x0' on the surface at t, as [`x0`](Self::x0), [`lag`](Self::lag) and [`velocity`](Self::velocity).
    pub fn at(&self, t: f64) -> [f64; 3] {
        let (step, r, sign) = (self.trajectory.step_at(t), self.trajectory.r(), self.track.sign());
        let l = step.l(r, t);
        [self.track.x(r * t - r - l), sign * (l + r), sign * step.velocity(t)]
    }

    /// The height of the surface under the tip, in kσ²/a, if there is a depth limit.
    pub fn height(&self, t: f64) -> Option<f64> {
        self.trajectory.height(t)
    }

    /// x0' on the surface at the end.
    pub(crate) fn velocity_at_end(&self) -> f64 {
        self.velocity(self.trajectory.end())
    }

    /// The residence of the tip on the surface at the end of the line, of length X: positions `x_j` and weights `w_j`
    /// such that ∫ w(t) e^{-(X/r-t)/T} g(x0(t))dt = Σ `w_j` g(`x_j`), with w and T of the extended model.
    pub fn residence(&self) -> (Vec<f64>, Vec<f64>) {
        let (mut positions, weights) = self.trajectory.residence(self.trajectory.end());
        positions.iter_mut().for_each(|x| *x = self.track.x(*x));
        (positions, weights)
    }

    /// The residence in both coordinates at the end of the line.
    pub fn visits(&self) -> Vec<Visit> {
        self.visits_until(self.trajectory.end())
    }

    /// The residence in both coordinates at t.
    pub fn visits_until(&self, t: f64) -> Vec<Visit> {
        let wider = self.trajectory.wider();
        let mut visits = vec![];
        let steps = self.trajectory.steps().iter().take_while(|step| step.t < t);
        for (n, step) in steps.enumerate() {
            let origin = self.trajectory.support().position(step.t) - step.extension;
            let across = self.across.get(n);
            step.each_moment(wider, t, |moment| {
                visits.push(Visit {
                    x: self.track.x(origin + moment.value(&step.displacement)),
                    y: self.track.y + across.map_or(0.0, |(y, across)| y + moment.value(across)),
                    weight: moment.weight,
                });
            });
        }
        visits
    }
}
