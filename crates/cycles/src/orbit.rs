//! One period of the tip's motion on a mesh.

use super::carved::{Carved, Heights};
use super::change::Change;
use stickslip_tip::collocation::{RADAU, STAGES, Stages};
use stickslip_tip::step::velocity_at_end;
use stickslip_tip::{Step, Trajectory, Wider};

/// A closed, or nearly closed, orbit: the unknowns of the collocation equations.
#[derive(Debug, Clone)]
pub(super) struct Orbit {
    pub(super) period: f64,
    /// Ends of the steps as fractions of the period, from 0 to 1.
    pub(super) mesh: Vec<f64>,
    /// Extension rt - x0 of the spring at t = 0, where it is largest.
    pub(super) extension: f64,
    /// Displacement of x0 in each step, at its nodes.
    pub(super) stages: Vec<Stages>,
    /// Heights under the tip in each step, under a depth limit.
    pub(super) heights: Vec<Heights>,
}

/// A motion as a function of time, from 0 to its period: l, and the height under the tip if it is known.
pub(super) struct Profile<L, H> {
    pub(super) l: L,
    pub(super) height: H,
}

impl Orbit {
    /// The orbit of the motion l(t) = rt - r - x0, t from 0 to the period.
    pub(super) fn of_profile<L: Fn(f64) -> f64, H: Fn(f64) -> Option<f64>>(
        r: f64,
        period: f64,
        mesh: Vec<f64>,
        Profile { l, height }: Profile<L, H>,
    ) -> Self {
        let stages = mesh.windows(2).map(|ends| {
            let (t, h) = (period * ends[0], period * (ends[1] - ends[0]));
            let before = l(t);
            RADAU.c.map(|c| r * h * c - (l(t + h * c) - before))
        });
        let heights = mesh.windows(2).map_while(|ends| {
            let (t, h) = (period * ends[0], period * (ends[1] - ends[0]));
            height(t)?;
            Some(Heights::new(RADAU.c.map(|c| height(t + h * c).unwrap_or_default())))
        });
        let heights = heights.collect();
        Self { period, stages: stages.collect(), mesh, extension: l(0.0) + r, heights }
    }

    /// Durations of the steps.
    pub(super) fn lengths(&self) -> impl Iterator<Item = f64> + '_ {
        self.mesh.windows(2).map(|ends| self.period * (ends[1] - ends[0]))
    }

    /// x0' at the end of the period, which is also its start.
    pub(super) fn velocity(&self) -> f64 {
        let last = self.stages.last().zip(self.lengths().last());
        last.map_or(0.0, |(d, h)| velocity_at_end(d, h))
    }

    /// Weights and decay of each step.
    pub(super) fn carved(&self, wider: &Wider) -> Vec<Carved> {
        let steps = self.lengths().enumerate();
        steps.map(|(n, h)| Carved::new(wider, h, self.heights.get(n))).collect()
    }

    /// One period of the motion from t = 0.
    pub(super) fn trajectory(&self, r: f64) -> Trajectory {
        Trajectory::new(r, self.steps(r))
    }

    pub(super) fn steps(&self, r: f64) -> Vec<Step> {
        let mut extension = self.extension;
        let mut before = self.heights.last().map(|last| last.nodes[STAGES - 1]);
        let steps = self.mesh.iter().zip(self.lengths()).zip(&self.stages).enumerate();
        let step = steps.map(|(n, ((start, h), displacement))| {
            let t = self.period * start;
            let height = self.heights.get(n).zip(before);
            let height = height.map(|(h, start)| stickslip_tip::Heights { start, nodes: h.nodes });
            before = height.map(|height| height.nodes[STAGES - 1]);
            let step = Step { t, h, extension, displacement: *displacement, height };
            extension = step.extension_at_end(r);
            step
        });
        step.collect()
    }

    /// The same motion on another mesh, to the accuracy of its polynomials.
    pub(super) fn on_mesh(&self, r: f64, mesh: Vec<f64>) -> Self {
        let motion = self.trajectory(r);
        let profile = Profile { l: |t| motion.l(t), height: |t| motion.height(t) };
        Self::of_profile(r, self.period, mesh, profile)
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
            heights: [self.heights.as_slice(), &self.heights].concat(),
        }
    }

    /// One period of half the length: the mean of the two halves.
    pub(super) fn halved(&self, r: f64) -> Self {
        let (motion, period) = (self.trajectory(r), 0.5 * self.period);
        let inner = self.mesh[1..].iter().map(|end| 2.0 * end);
        let inner = inner.filter(|end| *end < 1.0 - LEAST_SHARE);
        let mesh = [0.0].into_iter().chain(inner).chain([1.0]).collect();
        let profile = Profile {
            l: |t| 0.5 * (motion.l(t) + motion.l(period + t)),
            height: |t| Some(0.5 * (motion.height(t)? + motion.height(period + t)?)),
        };
        Self::of_profile(r, period, mesh, profile)
    }

    /// The largest difference between l and l half a period later.
    pub(super) fn difference_of_halves(&self, r: f64) -> f64 {
        let (motion, half) = (self.trajectory(r), 0.5 * self.period);
        let times = self.mesh.iter().filter(|at| **at < 0.5).map(|at| at * self.period);
        times.map(|t| (motion.l(t) - motion.l(t + half)).abs()).fold(0.0, f64::max)
    }

    /// The largest backward motion of the tip.
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
        let add = |(to, by): (&mut Stages, &Stages)| {
            to.iter_mut().zip(by).for_each(|(d, by)| *d += factor * by);
        };
        self.stages.iter_mut().zip(&change.stages).for_each(add);
        self.heights.iter_mut().map(|h| &mut h.nodes).zip(&change.heights).for_each(add);
    }
}

/// A last step below this fraction of the period is joined to the one before it.
const LEAST_SHARE: f64 = 1e-3;

/// The ends of this number of equal steps.
pub(super) fn even_mesh(steps: usize) -> Vec<f64> {
    (0..=steps).map(|i| i as f64 / steps as f64).collect()
}
