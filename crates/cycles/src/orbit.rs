//! One period of the tip's motion on a mesh.

use super::change::Change;
use stickslip_tip::collocation::{RADAU, STAGES, Stages};
use stickslip_tip::{Step, Trajectory};

/// A closed, or nearly closed, orbit: the unknowns of the collocation equations.
#[derive(Debug, Clone)]
pub(super) struct Orbit {
    pub(super) period: f64,
    /// Ends of the steps as fractions of the period, from 0 to 1.
    pub(super) mesh: Vec<f64>,
    /// rt - x0 at t = 0, where it is largest.
    pub(super) extension: f64,
    /// Displacement of x0 in each step, at its nodes.
    pub(super) stages: Vec<Stages>,
}

impl Orbit {
    /// Of the motion l(t) = rt - r - x0, t from 0 to the period.
    pub(super) fn of_profile(r: f64, period: f64, mesh: Vec<f64>, l: impl Fn(f64) -> f64) -> Self {
        let stages = mesh.windows(2).map(|ends| {
            let (t, h) = (period * ends[0], period * (ends[1] - ends[0]));
            let before = l(t);
            RADAU.c.map(|c| r * h * c - (l(t + h * c) - before))
        });
        Self { period, stages: stages.collect(), mesh, extension: l(0.0) + r }
    }

    /// Durations of the steps.
    pub(super) fn lengths(&self) -> impl Iterator<Item = f64> + '_ {
        self.mesh.windows(2).map(|ends| self.period * (ends[1] - ends[0]))
    }

    /// One period of the motion from t = 0.
    pub(super) fn trajectory(&self, r: f64) -> Trajectory {
        let mut extension = self.extension;
        let steps = self.mesh.iter().zip(self.lengths()).zip(&self.stages);
        let step = steps.map(|((start, h), displacement)| {
            let t = self.period * start;
            let step = Step { t, h, extension, displacement: *displacement, height: None };
            extension = step.extension_at_end(r);
            step
        });
        Trajectory::new(r, step.collect())
    }

    /// The same motion, to the accuracy of its polynomials, on another mesh.
    pub(super) fn on_mesh(&self, r: f64, mesh: Vec<f64>) -> Self {
        let motion = self.trajectory(r);
        Self::of_profile(r, self.period, mesh, |t| motion.l(t))
    }

    /// Two periods as one.
    pub(super) fn doubled(&self) -> Self {
        let halves = self.mesh.iter().map(|end| 0.5 * end);
        let second = self.mesh[1..].iter().map(|end| 0.5 + 0.5 * end);
        Self {
            period: 2.0 * self.period,
            mesh: halves.chain(second).collect(),
            extension: self.extension,
            stages: [self.stages.as_slice(), &self.stages].concat(),
        }
    }

    /// One period of half the length: the mean of the two halves.
    pub(super) fn halved(&self, r: f64) -> Self {
        let (motion, period) = (self.trajectory(r), 0.5 * self.period);
        let inner = self.mesh[1..].iter().map(|end| 2.0 * end);
        let inner = inner.filter(|end| *end < 1.0 - LEAST_SHARE);
        let mesh = [0.0].into_iter().chain(inner).chain([1.0]).collect();
        Self::of_profile(r, period, mesh, |t| 0.5 * (motion.l(t) + motion.l(period + t)))
    }

    /// The largest difference between l and l half a period later.
    pub(super) fn difference_of_halves(&self, r: f64) -> f64 {
        let (motion, half) = (self.trajectory(r), 0.5 * self.period);
        let times = self.mesh.iter().filter(|at| **at < 0.5).map(|at| at * self.period);
        times.map(|t| (motion.l(t) - motion.l(t + half)).abs()).fold(0.0, f64::max)
    }

    /// The farthest that the tip steps back from where it has been.
    pub(super) fn retreat(&self) -> f64 {
        let (mut at, mut farthest, mut most) = (0.0_f64, 0.0_f64, 0.0_f64);
        for stages in self.stages.iter().chain(&self.stages) {
            for d in stages {
                farthest = farthest.max(at + d);
                most = most.max(farthest - (at + d));
            }
            at += stages[STAGES - 1];
        }
        most
    }

    /// Adds a multiple of a change.
    pub(super) fn move_by(&mut self, change: &Change, factor: f64) {
        self.extension += factor * change.state[0];
        self.period += factor * change.period;
        for (stages, by) in self.stages.iter_mut().zip(&change.stages) {
            stages.iter_mut().zip(by).for_each(|(d, by)| *d += factor * by);
        }
    }
}

/// A last step that is a smaller part of the period is joined to the one before it.
const LEAST_SHARE: f64 = 1e-3;

/// So many steps of equal length.
pub(super) fn even_mesh(steps: usize) -> Vec<f64> {
    (0..=steps).map(|i| i as f64 / steps as f64).collect()
}
