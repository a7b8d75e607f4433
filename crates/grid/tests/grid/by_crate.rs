//! The paper's grid by the stepper of another crate, which shares no code with ours: N + 1 ordinary differential
//! equations, the slope at the tip by central differences, interpolated linearly.

use crate::common::{Kicked, REACH, triple_gaussian};
use differential_equations::methods::{DormandPrince, ExplicitRungeKutta, Ordinary};
use differential_equations::ode::{ODE, OrdinaryNumericalMethod};
use differential_equations::status::Status;
use differential_equations::{tolerance::Tolerance, traits::State};
use stickslip_grid::{Footprint, Start, Stepping};

type Dopri5 = ExplicitRungeKutta<Ordinary, DormandPrince, f64, Unknowns, 5, 7, 7>;

/// The cells x_k = from + k spacing.
struct FullGrid {
    alpha: f64,
    spacing: f64,
    from: f64,
}

impl FullGrid {
    fn x(&self, k: usize) -> f64 {
        self.from + k as f64 * self.spacing
    }

    /// The cell left of x, and the distance of x from it in cells.
    fn locate(&self, x: f64) -> (usize, f64) {
        let cells = (x - self.from) / self.spacing;
        (cells as usize, cells.fract())
    }
}

impl ODE<f64, Unknowns> for FullGrid {
    fn diff(&self, t: f64, y: &Unknowns, dydt: &mut Unknowns) {
        let (x0, u) = (y.0[0], &y.0[1..]);
        let (j, s) = self.locate(x0);
        let central = |k: usize| (u[k + 1] - u[k - 1]) / (2.0 * self.spacing);
        dydt.0[0] = t - x0 - ((1.0 - s) * central(j) + s * central(j + 1));
        for (k, rate) in dydt.0[1..].iter_mut().enumerate() {
            let distance = self.x(k) - x0;
            let f = if distance.abs() <= REACH { triple_gaussian(distance) } else { 0.0 };
            *rate = -self.alpha * f;
        }
    }
}

/// x0 at the times of the case, u at its points, and the number of accepted steps, with r = 1.
pub(crate) fn run(
    case: &Kicked,
    (spacing, from, to): (f64, f64, f64),
    stepping: &Stepping,
) -> (Vec<f64>, Vec<f64>, u64) {
    let footprint = Footprint::new(&triple_gaussian, REACH).expect("a reach above 0");
    let start = Start::steady(case.alpha, 1.0, footprint, 14.0, case.kick);
    let grid = FullGrid { alpha: case.alpha, spacing, from };
    let cells = ((to - from) / spacing).round() as usize + 1;
    let heights = (0..cells).map(|k| start.height(grid.x(k)));
    let unknowns = Unknowns(std::iter::once(start.x0).chain(heights).collect());
    let (times, points) = case.request(start.time);
    let first = stepping.first_step.min(stepping.max_step);
    let mut solver: Dopri5 = Dopri5::dopri5()
        .rtol(stepping.rtol)
        .atol(stepping.atol)
        .h0(first)
        .h_max(stepping.max_step)
        .max_steps(usize::MAX);
    solver.init(&grid, start.time, times[times.len() - 1], &unknowns).expect("a first step");
    let (mut x0, mut steps) = (vec![], 0);
    for time in times {
        while time - solver.t() > 4.0 * f64::EPSILON * time {
            let (left, proposed) = (time - solver.t(), solver.h());
            let is_last = left <= proposed * (1.0 + 1e-9);
            solver.set_h(if is_last { left } else { proposed });
            solver.step(&grid).expect("a step");
            if matches!(solver.status(), Status::RejectedStep) {
                continue;
            }
            steps += 1;
            if is_last {
                solver.set_h(proposed.max(solver.h()));
            }
        }
        x0.push(solver.y().0[0]);
    }
    let u = &solver.y().0[1..];
    let height = |x: &f64| {
        if *x >= to {
            return start.height(*x);
        }
        let (j, s) = grid.locate(*x);
        (1.0 - s) * u[j] + s * u[j + 1]
    };
    (x0, points.iter().map(height).collect(), steps)
}

/// x0, u(x_1), …, u(x_N). The error of a step is the largest error of any unknown, as in ode45; in the crate's root
/// mean square the many cells out of reach would hide the error of the tip.
#[derive(Debug, Clone)]
struct Unknowns(Vec<f64>);

impl State<f64> for Unknowns {
    fn len(&self) -> usize {
        self.0.len()
    }

    fn get_component(&self, index: usize) -> f64 {
        self.0[index]
    }

    fn set_component(&mut self, index: usize, value: f64) {
        self.0[index] = value;
    }

    fn map_components_mut<F: FnMut(usize, &mut f64)>(&mut self, mut f: F) {
        self.0.iter_mut().enumerate().for_each(|(i, value)| f(i, value));
    }

    fn zeros_like(&self) -> Self {
        Self(vec![0.0; self.0.len()])
    }

    fn zeros() -> Self {
        Self(Vec::new())
    }

    fn mul_add_assign(&mut self, alpha: f64, other: &Self) {
        for (own, its) in self.0.iter_mut().zip(&other.0) {
            *own += alpha * its;
        }
    }

    fn scale_mut(&mut self, alpha: f64) {
        self.0.iter_mut().for_each(|value| *value *= alpha);
    }

    // The defaults of these two go through `get_component` and do not vectorise.
    fn add_scaled(&mut self, alpha: f64, other: &Self) -> &mut Self {
        self.mul_add_assign(alpha, other);
        self
    }

    fn diff_norm_squared(&self, other: &Self) -> f64 {
        self.0.iter().zip(&other.0).map(|(a, b)| (a - b) * (a - b)).sum()
    }

    /// n max (error/allowed)²: the crate divides by n and takes the root.
    fn error_norm(
        &self,
        after: &Self,
        error: &Self,
        atol: &Tolerance<f64>,
        rtol: &Tolerance<f64>,
    ) -> f64 {
        let (atol, rtol) = (atol[0], rtol[0]);
        let relative = |((before, after), error): ((&f64, &f64), &f64)| {
            error.abs() / (atol + rtol * before.abs().max(after.abs()))
        };
        // `max` would swallow a NaN.
        let total: f64 = error.0.iter().sum();
        let unknowns = self.0.iter().zip(&after.0).zip(&error.0);
        let largest =
            if total.is_nan() { total } else { unknowns.map(relative).fold(0.0, f64::max) };
        largest * largest * self.0.len() as f64
    }
}
