//! The full equations on rows of points.

use stickslip_raster::{Area, Path, Plan};
use stickslip_tip::{Model, Wider};

pub(crate) type Formula = fn(f64, f64) -> f64;

const SPACING: f64 = 0.4;
const BEYOND: f64 = 12.0;
/// Of a Runge-Kutta step; its error is its fourth power.
const STEP: f64 = 0.002;

/// Position and velocity of the tip, and heights on every row.
#[derive(Clone)]
pub(crate) struct State {
    x0: f64,
    /// Of a tip with inertia.
    v: f64,
    pub(crate) u: Vec<Vec<f64>>,
}

pub(crate) struct Definition {
    f: Formula,
    wider: Wider,
    alpha: f64,
    r: f64,
    /// y of every row.
    y: Vec<f64>,
    pub(crate) x: Vec<f64>,
    pub(crate) state: State,
    /// Before the first line.
    is_new: bool,
}

impl Definition {
    pub(crate) fn new(f: Formula, model: &Model, y: Vec<f64>, (from, to): (f64, f64)) -> Self {
        let points = ((to - from + 2.0 * BEYOND) / SPACING) as usize;
        let x: Vec<f64> = (0..points).map(|i| from + SPACING * i as f64 - BEYOND).collect();
        let state = State { x0: 0.0, v: 0.0, u: vec![vec![0.0; points]; y.len()] };
        let (wider, alpha, r) = (*model.wider(), model.alpha(), model.r());
        Self { f, wider, alpha, r, y, x, state, is_new: true }
    }

    /// u_x on a row.
    fn slope(&self, u: &[f64], at: f64) -> f64 {
        let pi = std::f64::consts::PI;
        let term = |(x, u): (&f64, &f64)| {
            let z = (at - x) / SPACING;
            let sinc = if z.abs() < 1e-4 {
                -pi * pi * z / 3.0
            } else {
                (pi * z).cos() / z - (pi * z).sin() / (pi * z * z)
            };
            u * sinc / SPACING
        };
        self.x.iter().zip(u).map(term).sum()
    }

    /// u on a row.
    fn height(&self, u: &[f64], at: f64) -> f64 {
        let pi = std::f64::consts::PI;
        let term = |(x, u): (&f64, &f64)| {
            let z = pi * (at - x) / SPACING;
            if z.abs() < 1e-8 { *u } else { u * z.sin() / z }
        };
        self.x.iter().zip(u).map(term).sum()
    }

    fn rate(&self, state: &State, row: usize, support: f64) -> State {
        let weight = match self.wider.depth_limit {
            Some(limit) => (-self.height(&state.u[row], state.x0).abs() / limit).exp(),
            None => 1.0,
        };
        let healing = self.wider.healing_time.map_or(0.0, |time| 1.0 / time);
        let carve = |n: usize| {
            let y = self.y[n] - self.y[row];
            let at = self.x.iter().zip(&state.u[n]);
            at.map(|(x, u)| -self.alpha * weight * (self.f)(x - state.x0, y) - healing * u)
                .collect()
        };
        let force = support - state.x0 - self.slope(&state.u[row], state.x0);
        let (x0, v) = match self.wider.inertia {
            Some(mass) => (state.v, (force - state.v) / mass),
            None => (force, 0.0),
        };
        State { x0, v, u: (0..state.u.len()).map(carve).collect() }
    }

    /// One line, from x to x; x0 at the end of every hundredth step. On a zigzag the tip stays where it was.
    pub(crate) fn line(
        &mut self,
        row: usize,
        (from, to): (f64, f64),
        is_zigzag: bool,
    ) -> Vec<(f64, f64)> {
        if !is_zigzag || self.is_new {
            (self.state.x0, self.state.v) = (from, 0.0);
        }
        self.is_new = false;
        let steps = ((to - from).abs() / self.r / STEP).round() as usize;
        let mut told = vec![];
        for i in 0..steps {
            let support = |c: f64| from + (to - from).signum() * self.r * STEP * (i as f64 + c);
            let s = &self.state;
            let a = self.rate(s, row, support(0.0));
            let b = self.rate(&s.moved(&a, 0.5 * STEP), row, support(0.5));
            let c = self.rate(&s.moved(&b, 0.5 * STEP), row, support(0.5));
            let d = self.rate(&s.moved(&c, STEP), row, support(1.0));
            let s = s.moved(&a, STEP / 6.0).moved(&b, STEP / 3.0);
            self.state = s.moved(&c, STEP / 3.0).moved(&d, STEP / 6.0);
            if (i + 1) % 100 == 0 {
                told.push((STEP * (i as f64 + 1.0), self.state.x0));
            }
        }
        told
    }
}

impl State {
    fn moved(&self, rate: &Self, by: f64) -> Self {
        let row = |(u, v): (&Vec<f64>, &Vec<f64>)| -> Vec<f64> {
            u.iter().zip(v).map(|(u, v)| u + by * v).collect()
        };
        let v = self.v + by * rate.v;
        Self { x0: self.x0 + by * rate.x0, v, u: self.u.iter().zip(&rate.u).map(row).collect() }
    }
}

/// y, smallest and largest x of every line.
pub(crate) fn given(plan: &Plan) -> Vec<(f64, f64, f64)> {
    match &plan.area {
        Area::Rectangle { pitch, lines, length } => {
            let pitch = if plan.path == Path::Repeat { 0.0 } else { *pitch };
            (0..*lines).map(|n| (pitch * n as f64, 0.0, *length)).collect()
        }
        Area::Lines(lines) => lines.iter().map(|l| (l.y, l.start, l.start + l.length)).collect(),
    }
}
