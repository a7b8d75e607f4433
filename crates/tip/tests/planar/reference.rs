//! The reference: the equations as they stand, summed over every visit of the history at every stage of a fixed step.
//!
//! ```text
//!     M x'' + x' = α ∫ w f_x(x - x', y - y') e^{-(t-t')/T} dt' + R(t) - x + F_x(t)
//!             y' = α ∫ w f_y(x - x', y - y') e^{-(t-t')/T} dt' - κ_y y + F_y(t)
//! ```
//!
//! with the weight w = e^{-|h|/b} of a depth limit, h the height of the same sum under the tip; 1 without.
//!
//! Gauss collocation of four stages, of order 8 at the ends of steps, its equations solved by plain iteration. The integral
//! over earlier steps is the method's own quadrature, and so is that over the step under way. A steady past is a list of
//! visits like any other. At a zero of h a step ends, found by false position. Nothing here is shared with the library: no layers, no exponentials, no forgetting.

use crate::gauss::{Method, STAGES, rule};

/// Corrections below so many roundings of a position end an iteration.
const ROUNDINGS: f64 = 4.0;
const MOST_ITERATIONS: usize = 200;
/// What lies farther behind than so many widths is below round-off of f, and left out of the steady past.
const FAR_BEHIND: f64 = 15.0;

/// f, `f_x` and `f_y` at a point.
pub(crate) struct Footprint(Box<dyn Fn([f64; 2]) -> [f64; 3]>);

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
    /// b
    pub(crate) depth_limit: Option<f64>,
    /// u0 and its slopes along and across.
    pub(crate) relief: fn([f64; 2]) -> [f64; 3],
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

/// Where the tip was, when, and for how long, times w.
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
        let term = |a: f64, c: f64| [a, c, 1.0, 0.0, width];
        Self::gaussians(vec![term(1.0, 0.0), term(-beta / 2.0, -2.0), term(-beta / 2.0, 2.0)])
    }

    /// Gaussians of these amplitudes, each with a center and a width along and across.
    pub(crate) fn gaussians(terms: Vec<[f64; 5]>) -> Self {
        Self::new(move |[x, y]| {
            let mut jet = [0.0; 3];
            for [a, c, w, d, v] in &terms {
                let (z, s) = ((x - c) / w, (y - d) / v);
                let term = a * (-0.5 * (z * z + s * s)).exp();
                jet[0] += term;
                jet[1] -= z / w * term;
                jet[2] -= s / v * term;
            }
            jet
        })
    }

    pub(crate) fn new(jet: impl Fn([f64; 2]) -> [f64; 3] + 'static) -> Self {
        Self(Box::new(jet))
    }

    fn jet(&self, at: [f64; 2]) -> [f64; 3] {
        (self.0)(at)
    }
}

/// What an iteration finds: positions at the stages of a step, x' and y' there, and forces.
struct Stages {
    at: [[f64; 2]; STAGES],
    rates: [[f64; 2]; STAGES],
    forces: [[f64; 2]; STAGES],
    /// w
    weights: [f64; STAGES],
}

/// The tip between two steps.
#[derive(Clone, Copy)]
struct Tip {
    t: f64,
    at: [f64; 2],
    v: f64,
    /// Of the kink of |h|: 1 above, -1 below.
    side: f64,
}

/// Weights that change by less are those of the solution.
const SETTLED: f64 = 2e-14;
/// Heights below this many α are 0.
const LEVEL: f64 = 1e-14;

impl Problem {
    /// The motion in so many equal steps; those that lead across a zero of h in two parts or more.
    pub(crate) fn motion(&self, until: f64, steps: usize) -> Motion {
        let (method, h) = (Method::new(), (until - self.start) / steps as f64);
        let mut visits = self.steady_visits();
        let mut tip = Tip { t: self.start, at: self.position, v: self.velocity, side: -1.0 };
        tip.side = if self.height_at(tip.t, tip.at, &visits) > 0.0 { 1.0 } else { -1.0 };
        let mut rates = [[0.0; 2]; STAGES];
        let mut motion = Motion { t: vec![], position: vec![], velocity: vec![] };
        for n in 0..=steps {
            tip.t = self.start + h * n as f64;
            let force = self.jet_at(tip.t, tip.at, &visits).1;
            motion.t.push(tip.t);
            motion.position.push(tip.at);
            motion.velocity.push(if self.inertia.is_some() { [tip.v, force[1]] } else { force });
            let mut rest = h;
            while rest > 1e-12 {
                rest -= self.advance((&method, rest), &mut tip, &mut visits, &mut rates);
            }
        }
        motion
    }

    /// Makes a step of this length, or to the next zero of h if that is within it; its length.
    fn advance(
        &self,
        (method, length): (&Method, f64),
        tip: &mut Tip,
        visits: &mut Vec<Visit>,
        rates: &mut [[f64; 2]; STAGES],
    ) -> f64 {
        let before = visits.len();
        let mut attempt = |h: f64| {
            visits.truncate(before);
            let mut end = *tip;
            let stages = self.stages((method, tip.t, h), tip, visits, rates);
            for k in 0..STAGES {
                let spent = h * method.b[k];
                let t = tip.t + h * method.c[k];
                visits.push(Visit { t, at: stages.at[k], spent: spent * stages.weights[k] });
                (0..2).for_each(|j| end.at[j] += spent * stages.rates[k][j]);
                let lost = stages.forces[k][0] - stages.rates[k][0];
                end.v += self.inertia.map_or(0.0, |mass| spent * lost / mass);
            }
            end.t = tip.t + h;
            let height =
                self.depth_limit.map_or(tip.side, |_| self.height_at(end.t, end.at, visits));
            (end, stages.rates, tip.side * height)
        };
        let level = LEVEL * self.alpha;
        let (mut end, mut last, height) = attempt(length);
        let mut made = length;
        if height < -level {
            let (mut low, mut high) =
                ((0.0, attempt(1e-6 * length).2.max(level)), (length, height));
            let mut side = 0;
            loop {
                made = (low.0 * high.1 - high.0 * low.1) / (high.1 - low.1);
                let height;
                (end, last, height) = attempt(made);
                if height.abs() <= level || high.0 - low.0 < 1e-14 {
                    break;
                }
                // Halving the value of an end that stays (Illinois).
                if height > 0.0 {
                    low = (made, height);
                    high.1 *= if side == 1 { 0.5 } else { 1.0 };
                    side = 1;
                } else {
                    high = (made, height);
                    low.1 *= if side == -1 { 0.5 } else { 1.0 };
                    side = -1;
                }
            }
            end.side = -tip.side;
        }
        (*tip, *rates) = (end, last);
        made
    }

    /// Visits of a tip that moved along the line with the velocity r for ever.
    fn steady_visits(&self) -> Vec<Visit> {
        let Some(end) = self.steady_past else { return vec![] };
        let (panels, rule) = (60, rule(8));
        let length = FAR_BEHIND / f64::from(panels);
        let panel = |i: u32| {
            rule.iter().map(move |(x, w)| (length * (f64::from(i) + x), w * length / self.r))
        };
        let visit = |(behind, spent): (f64, f64)| Visit {
            t: self.start - behind / self.r,
            at: [end - behind, 0.0],
            spent,
        };
        let mut visits: Vec<Visit> = (0..panels).flat_map(panel).map(visit).collect();
        let relief = (self.relief)([end, 0.0])[0];
        let height = self.height_at(self.start, [end, 0.0], &visits) - relief;
        let weight = self.steady_weight(height);
        visits.iter_mut().for_each(|visit| visit.spent *= weight);
        visits
    }

    /// w = e^{-w|h|/b}, where h is the height that the same motion leaves without a depth limit.
    fn steady_weight(&self, height: f64) -> f64 {
        let Some(limit) = self.depth_limit else { return 1.0 };
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            let is_low = middle < f64::exp(-middle * height.abs() / limit);
            (low, high) = if is_low { (middle, high) } else { (low, middle) };
        }
        low
    }

    /// The stages of a step, from x' and y' in the step before.
    fn stages(
        &self,
        step: (&Method, f64, f64),
        Tip { at, v, side, .. }: &Tip,
        visits: &[Visit],
        before: &[[f64; 2]; STAGES],
    ) -> Stages {
        let (method, _, h) = step;
        let carried = |values: &[[f64; 2]; STAGES], i: usize, j: usize| -> f64 {
            h * (0..STAGES).map(|k| method.a[i][k] * values[k][j]).sum::<f64>()
        };
        let enough = ROUNDINGS * f64::EPSILON * at[0].abs().max(1.0);
        let mut stages =
            Stages { at: [*at; STAGES], rates: *before, forces: *before, weights: [1.0; STAGES] };
        let mut settled = self.depth_limit.is_none();
        for n in 0..MOST_ITERATIONS {
            let rates = &stages.rates;
            let new = std::array::from_fn(|i| [0, 1].map(|j| at[j] + carried(rates, i, j)));
            let old = std::mem::replace(&mut stages.at, new);
            let pairs = old.iter().flatten().zip(new.iter().flatten());
            if pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < enough && n > 0 && settled {
                return stages;
            }
            let told: [_; STAGES] = std::array::from_fn(|i| {
                self.jet_on_stage(step, (&new, &stages.weights), i, visits)
            });
            stages.forces = told.map(|(_, force)| force);
            if let Some(limit) = self.depth_limit {
                let weights = told.map(|(height, _)| (-side * height / limit).exp());
                let pairs = weights.iter().zip(&stages.weights);
                settled = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < SETTLED;
                stages.weights = weights;
            }
            let mut rates = stages.forces;
            if let Some(mass) = self.inertia {
                let gains: [_; STAGES] = std::array::from_fn(|i| {
                    [(stages.forces[i][0] - stages.rates[i][0]) / mass, 0.0]
                });
                (0..STAGES).for_each(|i| rates[i][0] = *v + carried(&gains, i, 0));
            }
            stages.rates = rates;
        }
        panic!("the iteration of the reference does not converge: take shorter steps");
    }

    /// Height and forces at a stage: earlier visits, and the step under way.
    fn jet_on_stage(
        &self,
        (method, t, h): (&Method, f64, f64),
        (stages, weights): (&[[f64; 2]; STAGES], &[f64; STAGES]),
        i: usize,
        visits: &[Visit],
    ) -> (f64, [f64; 2]) {
        let now = t + h * method.c[i];
        let mut jet = self.jet_at(now, stages[i], visits);
        for k in 0..STAGES {
            let spent = h * method.a[i][k] * weights[k];
            let visit = Visit { t: t + h * method.c[k], at: stages[k], spent };
            self.add(now, stages[i], &visit, &mut jet);
        }
        jet
    }

    fn height_at(&self, t: f64, at: [f64; 2], visits: &[Visit]) -> f64 {
        self.jet_at(t, at, visits).0
    }

    /// Height of the surface at a place and all that acts there: the sum over these visits, springs, and external
    /// forces.
    fn jet_at(&self, t: f64, at: [f64; 2], visits: &[Visit]) -> (f64, [f64; 2]) {
        let mut force = (self.force)(t);
        force[0] += (self.support)(self, t) - at[0];
        force[1] -= self.stiffness * at[1];
        let left = self.healing.map_or(1.0, |time| (-(t - self.start) / time).exp());
        let [height, along, across] = (self.relief)(at).map(|told| left * told);
        let mut jet = (height, [force[0] - along, force[1] - across]);
        for visit in visits {
            self.add(t, at, visit, &mut jet);
        }
        jet
    }

    fn add(&self, t: f64, at: [f64; 2], visit: &Visit, (height, force): &mut (f64, [f64; 2])) {
        let left = self.healing.map_or(1.0, |time| (-(t - visit.t) / time).exp());
        let jet = self.footprint.jet([at[0] - visit.at[0], at[1] - visit.at[1]]);
        let strength = self.alpha * left * visit.spent;
        *height -= strength * jet[0];
        (0..2).for_each(|j| force[j] += strength * jet[j + 1]);
    }
}
