//! The reference for a tip that is free to move across the lines: the equations as they stand, summed over every position of
//! every line at every stage of a fixed step.
//!
//! ```text
//!     M x'' + x' = α ∫ w f_x(x - x', y - y') e^{-(t-t')/T} dt' + R(t) - x + F_x(t)
//!             y' = α ∫ w f_y(x - x', y - y') e^{-(t-t')/T} dt' + κ_y (y_n - y) + F_y(t)          w = e^{-|u(x,y)|/b}
//! ```
//!
//! The integrals go over all lines so far, in the frame of the surface. Gauss collocation of four stages, of order 8 at the
//! ends of steps, its equations solved by plain iteration. Nothing here is shared with the library: no layers, no rows, no
//! exponentials, no Fourier transforms, no forgetting.

use crate::gauss::{Method, STAGES, lagrange};
use std::array::from_fn;

const MOST_ITERATIONS: usize = 200;
/// Corrections below this end an iteration.
const ENOUGH: f64 = 1e-12;

/// f(x,y) = Σ a exp(-(x-c)²/2w²) exp(-(y-d)²/2v²): a, c, w, d, v of each term.
pub(crate) type Terms = Vec<[f64; 5]>;

/// The law, and the force on the first line.
#[derive(Clone)]
pub(crate) struct Law {
    pub(crate) terms: Terms,
    pub(crate) alpha: f64,
    pub(crate) r: f64,
    /// κ_y
    pub(crate) stiffness: f64,
    /// M, T and b.
    pub(crate) inertia: Option<f64>,
    pub(crate) healing: Option<f64>,
    pub(crate) depth: Option<f64>,
    /// Amplitude, time and width of a pulse along, and of one across.
    pub(crate) pulses: [Option<[f64; 3]>; 2],
}

/// A line: y, start and end of the support, and the displacement of the tip from the support at its start, or none if
/// the tip goes on from where it is.
pub(crate) struct Way {
    pub(crate) y: f64,
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) put_down: Option<[f64; 2]>,
}

struct Visit {
    t: f64,
    at: [f64; 2],
    weight: f64,
}

/// All lines so far.
pub(crate) struct Reference {
    law: Law,
    /// Time since the start of the first line.
    t: f64,
    lines: usize,
    visits: Vec<Visit>,
    at: [f64; 2],
    /// x' of a tip with inertia.
    velocity: f64,
}

impl Law {
    /// f, `f_x` and `f_y`.
    fn footprint(&self, [x, y]: [f64; 2]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        for [a, c, w, d, v] in &self.terms {
            let (z, s) = ((x - c) / w, (y - d) / v);
            let value = a * (-0.5 * (z * z + s * s)).exp();
            sum[0] += value;
            sum[1] -= z / w * value;
            sum[2] -= s / v * value;
        }
        sum
    }
}

impl Reference {
    pub(crate) fn new(law: Law) -> Self {
        Self { law, t: 0.0, lines: 0, visits: vec![], at: [0.0; 2], velocity: 0.0 }
    }

    /// Scans a line in so many steps, and returns the times since its start at their ends, with the positions there.
    pub(crate) fn line(&mut self, way: &Way, steps: usize) -> Vec<(f64, [f64; 2])> {
        let sign = (way.to - way.from).signum();
        if let Some(off) = way.put_down {
            self.at = [way.from + off[0], way.y + off[1]];
            self.velocity = 0.0;
        }
        let (method, begun) = (Method::new(), self.t);
        let h = (way.to - way.from).abs() / self.law.r / steps as f64;
        let mut motion = vec![(0.0, self.at)];
        let mut rates = [[0.0; 2]; STAGES];
        for n in 1..=steps {
            let since = self.t - begun;
            let support = |t: f64| way.from + sign * self.law.r * (since + t);
            let stages = self.stages(&method, h, (&support, way.y, since), &rates);
            rates = stages.rates;
            for (k, rate) in rates.iter().enumerate() {
                let spent = h * method.b[k];
                self.visits.push(Visit {
                    t: self.t + h * method.c[k],
                    at: stages.at[k],
                    weight: spent * stages.weights[k],
                });
                (0..2).for_each(|j| self.at[j] += spent * rate[j]);
                let lost = stages.forces[k][0] - rate[0];
                self.velocity += self.law.inertia.map_or(0.0, |mass| spent * lost / mass);
            }
            self.t = begun + h * n as f64;
            motion.push((self.t - begun, self.at));
        }
        self.lines += 1;
        motion
    }

    /// Positions, velocities and forces at the stages of a step, by iteration from the velocities of the step before, continued.
    fn stages(
        &self,
        method: &Method,
        h: f64,
        (support, y, since): (&dyn Fn(f64) -> f64, f64, f64),
        before: &[[f64; 2]; STAGES],
    ) -> Stages {
        let carried = |values: &[[f64; 2]; STAGES], i: usize, j: usize| -> f64 {
            h * (0..STAGES).map(|k| method.a[i][k] * values[k][j]).sum::<f64>()
        };
        let continued = |i: usize, j: usize| -> f64 {
            (0..STAGES).map(|k| lagrange(&method.c, k, 1.0 + method.c[i]) * before[k][j]).sum()
        };
        let rates = from_fn(|i| from_fn(|j| continued(i, j)));
        let mut stages =
            Stages { at: [self.at; STAGES], rates, forces: rates, weights: [1.0; STAGES] };
        for n in 0..MOST_ITERATIONS {
            let new: [[f64; 2]; STAGES] =
                from_fn(|i| from_fn(|j| self.at[j] + carried(&stages.rates, i, j)));
            let pairs = stages.at.iter().flatten().zip(new.iter().flatten());
            let moved = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            stages.at = new;
            let mut weights = [1.0; STAGES];
            for i in 0..STAGES {
                let now = self.t + h * method.c[i];
                let mut sum = self.past(now, new[i]);
                for k in 0..STAGES {
                    let visit = Visit {
                        t: self.t + h * method.c[k],
                        at: new[k],
                        weight: h * method.a[i][k] * stages.weights[k],
                    };
                    self.add(now, new[i], &visit, &mut sum);
                }
                let force = self.force(since + h * method.c[i]);
                stages.forces[i] = [
                    sum[1] + support(h * method.c[i]) - new[i][0] + force[0],
                    sum[2] + self.law.stiffness * (y - new[i][1]) + force[1],
                ];
                weights[i] = self.law.depth.map_or(1.0, |b| (-sum[0].abs() / b).exp());
            }
            let pairs = stages.weights.iter().zip(&weights);
            let changed = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            stages.weights = weights;
            if moved.max(changed) < ENOUGH * self.at[0].abs().max(1.0) && n > 0 {
                return stages;
            }
            let mut rates = stages.forces;
            if let Some(mass) = self.law.inertia {
                let gain = |i: usize| [(stages.forces[i][0] - stages.rates[i][0]) / mass, 0.0];
                let gains = from_fn(gain);
                (0..STAGES).for_each(|i| rates[i][0] = self.velocity + carried(&gains, i, 0));
            }
            stages.rates = rates;
        }
        panic!("the iteration of the reference does not converge: take shorter steps");
    }

    /// The pulses, on the first line.
    fn force(&self, since: f64) -> [f64; 2] {
        self.law.pulses.map(|pulse| match pulse {
            Some([amplitude, time, width]) if self.lines == 0 => {
                amplitude * (-0.5 * ((since - time) / width).powi(2)).exp()
            }
            _ => 0.0,
        })
    }

    /// -u and the force of the groove at a position, from all positions so far.
    fn past(&self, now: f64, at: [f64; 2]) -> [f64; 3] {
        let mut sum = [0.0; 3];
        self.visits.iter().for_each(|visit| self.add(now, at, visit, &mut sum));
        sum
    }

    fn add(&self, now: f64, at: [f64; 2], visit: &Visit, sum: &mut [f64; 3]) {
        let left = self.law.healing.map_or(1.0, |time| (-(now - visit.t) / time).exp());
        let of = self.law.footprint([at[0] - visit.at[0], at[1] - visit.at[1]]);
        (0..3).for_each(|j| sum[j] += self.law.alpha * left * visit.weight * of[j]);
    }

    /// The surface at a position, after the last line.
    pub(crate) fn height(&self, at: [f64; 2]) -> f64 {
        -self.past(self.t, at)[0]
    }
}

/// Results of an iteration, at the stages: position, x' and y', forces, and w.
struct Stages {
    at: [[f64; 2]; STAGES],
    rates: [[f64; 2]; STAGES],
    forces: [[f64; 2]; STAGES],
    weights: [f64; STAGES],
}
