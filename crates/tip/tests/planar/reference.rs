//! The reference: the equations as they stand, summed over every visit of the history at every stage of a fixed step.
//!
//! ```text
//!     M x'' + x' = α ∫ w f_x(x - x', y - y') e^{-(t-t')/T} dt' + R(t) - x + F_x(t)
//!             y' = α ∫ w f_y(x - x', y - y') e^{-(t-t')/T} dt' - κ_y y + F_y(t)
//! ```
//!
//! Gauss collocation of four stages, of order 8 at the ends of steps, its equations solved by plain iteration. The integral
//! over earlier steps is the method's own quadrature, and so is that over the step under way. A steady past is a list of
//! visits like any other. Nothing here is shared with the library: no layers, no exponentials, no forgetting.

use gauss_quad::legendre::GaussLegendre;
use std::num::NonZeroUsize;

const STAGES: usize = 4;
/// Corrections below so many roundings of a position end an iteration.
const ROUNDINGS: f64 = 4.0;
const MOST_ITERATIONS: usize = 200;
/// What lies farther behind than so many widths is below round-off of f, and left out of the steady past.
const FAR_BEHIND: f64 = 15.0;

/// f(x,y) = `Σ_k a_k` exp(-(x-`c_k`)²/2) exp(-y²/2v²)
pub(crate) struct Footprint {
    /// `a_k`, `c_k`
    pub(crate) terms: Vec<(f64, f64)>,
    /// v
    pub(crate) width: f64,
}

/// A motion to be computed. The line is y = 0; the support is at R(t).
pub(crate) struct Problem {
    pub(crate) footprint: Footprint,
    pub(crate) alpha: f64,
    pub(crate) r: f64,
    /// κ_y
    pub(crate) stiffness: f64,
    /// M
    pub(crate) inertia: Option<f64>,
    /// T
    pub(crate) healing: Option<f64>,
    pub(crate) support: fn(&Problem, f64) -> f64,
    /// `F_x` and `F_y`.
    pub(crate) force: fn(f64) -> [f64; 2],
    /// Time of the start.
    pub(crate) start: f64,
    /// Where the tip starts, and the velocity along the scan that it has there, if it has inertia.
    pub(crate) position: [f64; 2],
    pub(crate) velocity: f64,
    /// A steady past on the line ends here.
    pub(crate) steady_past: Option<f64>,
}

/// Where the tip was, when, and for how long.
struct Visit {
    t: f64,
    at: [f64; 2],
    spent: f64,
}

/// Positions at the ends of steps, and velocities there.
pub(crate) struct Motion {
    pub(crate) t: Vec<f64>,
    pub(crate) position: Vec<[f64; 2]>,
    pub(crate) velocity: Vec<[f64; 2]>,
}

impl Footprint {
    /// (48) times a Gaussian of the width v across.
    pub(crate) fn triple(beta: f64, width: f64) -> Self {
        Self { terms: vec![(1.0, 0.0), (-beta / 2.0, -2.0), (-beta / 2.0, 2.0)], width }
    }

    /// `f_x` and `f_y`.
    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let v = self.width;
        let across = (-0.5 * y * y / (v * v)).exp();
        let (mut value, mut slope) = (0.0, 0.0);
        for (a, c) in &self.terms {
            let term = a * (-0.5 * (x - c) * (x - c)).exp();
            value += term;
            slope -= (x - c) * term;
        }
        [slope * across, -y / (v * v) * value * across]
    }
}

/// Gauss's rule on the unit interval.
pub(crate) fn gauss(n: usize) -> Vec<(f64, f64)> {
    let rule = GaussLegendre::new(NonZeroUsize::new(n).unwrap());
    let pair = |(x, w): &(f64, f64)| (0.5 * (1.0 + x), 0.5 * w);
    let mut rule: Vec<_> = rule.as_node_weight_pairs().iter().map(pair).collect();
    rule.sort_by(|a, b| a.0.total_cmp(&b.0));
    rule
}

/// Nodes c, weights b, matrix a = `∫_0^{c_i} ℓ_k`.
struct Method {
    c: [f64; STAGES],
    b: [f64; STAGES],
    a: [[f64; STAGES]; STAGES],
}

impl Method {
    fn new() -> Self {
        let rule = gauss(STAGES);
        let c: [f64; STAGES] = std::array::from_fn(|i| rule[i].0);
        let lagrange = |k: usize, x: f64| -> f64 {
            (0..STAGES).filter(|&j| j != k).map(|j| (x - c[j]) / (c[k] - c[j])).product()
        };
        let integral = |k: usize, end: f64| -> f64 {
            rule.iter().map(|(x, w)| w * end * lagrange(k, x * end)).sum()
        };
        Self {
            b: std::array::from_fn(|k| rule[k].1),
            a: std::array::from_fn(|i| std::array::from_fn(|k| integral(k, c[i]))),
            c,
        }
    }
}

/// What an iteration finds: positions at the stages of a step, x' and y' there, and forces.
struct Stages {
    at: [[f64; 2]; STAGES],
    rates: [[f64; 2]; STAGES],
    forces: [[f64; 2]; STAGES],
}

impl Problem {
    /// The motion in so many equal steps.
    pub(crate) fn motion(&self, until: f64, steps: usize) -> Motion {
        let (method, h) = (Method::new(), (until - self.start) / steps as f64);
        let mut visits = self.steady_visits();
        let (mut at, mut v) = (self.position, self.velocity);
        let mut rates = [[0.0; 2]; STAGES];
        let mut motion = Motion { t: vec![], position: vec![], velocity: vec![] };
        for n in 0..=steps {
            let t = self.start + h * n as f64;
            let force = self.force_at(t, at, &visits);
            motion.t.push(t);
            motion.position.push(at);
            motion.velocity.push(if self.inertia.is_some() { [v, force[1]] } else { force });
            let stages = self.stages((&method, t, h), (at, v), &visits, &rates);
            for k in 0..STAGES {
                let spent = h * method.b[k];
                visits.push(Visit { t: t + h * method.c[k], at: stages.at[k], spent });
                (0..2).for_each(|j| at[j] += spent * stages.rates[k][j]);
                let lost = stages.forces[k][0] - stages.rates[k][0];
                v += self.inertia.map_or(0.0, |mass| spent * lost / mass);
            }
            rates = stages.rates;
        }
        motion
    }

    /// Visits of a tip that moved along the line with the velocity r for ever.
    fn steady_visits(&self) -> Vec<Visit> {
        let Some(end) = self.steady_past else { return vec![] };
        let (panels, rule) = (60, gauss(8));
        let length = FAR_BEHIND / f64::from(panels);
        let panel = |i: u32| {
            rule.iter().map(move |(x, w)| (length * (f64::from(i) + x), w * length / self.r))
        };
        let visit = |(behind, spent): (f64, f64)| Visit {
            t: self.start - behind / self.r,
            at: [end - behind, 0.0],
            spent,
        };
        (0..panels).flat_map(panel).map(visit).collect()
    }

    /// The stages of a step, from x' and y' in the step before.
    fn stages(
        &self,
        step: (&Method, f64, f64),
        (at, v): ([f64; 2], f64),
        visits: &[Visit],
        before: &[[f64; 2]; STAGES],
    ) -> Stages {
        let (method, _, h) = step;
        let carried = |values: &[[f64; 2]; STAGES], i: usize, j: usize| -> f64 {
            h * (0..STAGES).map(|k| method.a[i][k] * values[k][j]).sum::<f64>()
        };
        let enough = ROUNDINGS * f64::EPSILON * at[0].abs().max(1.0);
        let mut stages = Stages { at: [at; STAGES], rates: *before, forces: *before };
        for n in 0..MOST_ITERATIONS {
            let rates = &stages.rates;
            let new = std::array::from_fn(|i| [0, 1].map(|j| at[j] + carried(rates, i, j)));
            let old = std::mem::replace(&mut stages.at, new);
            let pairs = old.iter().flatten().zip(new.iter().flatten());
            if pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < enough && n > 0 {
                return stages;
            }
            stages.forces = std::array::from_fn(|i| self.force_on_stage(step, &new, i, visits));
            let mut rates = stages.forces;
            if let Some(mass) = self.inertia {
                let gains: [_; STAGES] = std::array::from_fn(|i| {
                    [(stages.forces[i][0] - stages.rates[i][0]) / mass, 0.0]
                });
                (0..STAGES).for_each(|i| rates[i][0] = v + carried(&gains, i, 0));
            }
            stages.rates = rates;
        }
        panic!("the iteration of the reference does not converge: take shorter steps");
    }

    /// All that acts at a stage: earlier visits, and the step under way.
    fn force_on_stage(
        &self,
        (method, t, h): (&Method, f64, f64),
        stages: &[[f64; 2]; STAGES],
        i: usize,
        visits: &[Visit],
    ) -> [f64; 2] {
        let now = t + h * method.c[i];
        let mut force = self.force_at(now, stages[i], visits);
        for k in 0..STAGES {
            let spent = h * method.a[i][k];
            let visit = Visit { t: t + h * method.c[k], at: stages[k], spent };
            self.add(now, stages[i], &visit, &mut force);
        }
        force
    }

    /// All that acts at a place: the sum over these visits, springs, and external forces.
    fn force_at(&self, t: f64, at: [f64; 2], visits: &[Visit]) -> [f64; 2] {
        let mut force = (self.force)(t);
        force[0] += (self.support)(self, t) - at[0];
        force[1] -= self.stiffness * at[1];
        for visit in visits {
            self.add(t, at, visit, &mut force);
        }
        force
    }

    fn add(&self, t: f64, at: [f64; 2], visit: &Visit, force: &mut [f64; 2]) {
        let left = self.healing.map_or(1.0, |time| (-(t - visit.t) / time).exp());
        let gradient = self.footprint.gradient([at[0] - visit.at[0], at[1] - visit.at[1]]);
        (0..2).for_each(|j| force[j] += self.alpha * left * visit.spent * gradient[j]);
    }
}
