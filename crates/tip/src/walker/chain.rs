//! The Taylor series of a walker and of its field.
//!
//! For each direction k the field has one number, relative to the particle:
//!
//! ```text
//!     z' = 1 - z/T + i (k·x') z,   z = ∫ e^{i k·(x(t) - x(t'))} e^{-(t-t')/T} dt'
//!     ∇Q = -(2/N) Σ k Im z
//! ```
//!
//! over half of the N directions, because opposite ones have conjugate z. The system is quadratic, so that its Taylor
//! coefficients obey a recurrence.

use super::scenario::{WalkerPast, WalkerScenario};
use crate::elementary::{complex_exp, sin_cos};
use crate::integrator::taylor::length::length;
use crate::integrator::taylor::pieces::value;
use crate::tip_function::bessel_orders;
use num_complex::Complex64;
use std::f64::consts::PI;

/// A walker at the start of a step, and the Taylor coefficients of the step.
pub(super) struct Chain<'a> {
    scenario: &'a WalkerScenario,
    order: usize,
    /// Half of the directions k, as unit vectors.
    directions: Vec<[f64; 2]>,
    /// Coefficients of x and y.
    pub(super) position: [Vec<f64>; 2],
    /// Coefficients of x' and y'.
    pub(super) velocity: [Vec<f64>; 2],
    /// Coefficients of the external force.
    pub(super) force: [Vec<f64>; 2],
    /// Real and imaginary parts of z: for each order the coefficients of all directions.
    re: Vec<f64>,
    im: Vec<f64>,
    /// k·x', in the same order.
    phase: Vec<f64>,
}

impl<'a> Chain<'a> {
    /// The walker at t = 0, with an even number of directions.
    pub(super) fn new(scenario: &'a WalkerScenario, count: usize, order: usize) -> Self {
        let half = count / 2;
        let direction = |j: usize| {
            let (sin, cos) = sin_cos(PI * j as f64 / half as f64);
            [cos, sin]
        };
        let zeros = |len: usize| vec![0.0; len];
        let mut chain = Self {
            scenario,
            order,
            directions: (0..half).map(direction).collect(),
            position: [zeros(order + 1), zeros(order + 1)],
            velocity: [zeros(order + 1), zeros(order + 1)],
            force: [zeros(order), zeros(order)],
            re: zeros((order + 1) * half),
            im: zeros((order + 1) * half),
            phase: zeros(order * half),
        };
        let field = field_of_past(scenario, &chain.directions);
        for (j, z) in field.iter().enumerate() {
            // The particle is displaced, its field is not.
            let [x, y] = chain.directions[j];
            let turned =
                complex_exp(Complex64::i() * (x * scenario.kick[0] + y * scenario.kick[1]));
            (chain.re[j], chain.im[j]) = ((z * turned).re, (z * turned).im);
        }
        for axis in 0..2 {
            chain.position[axis][0] = scenario.position[axis] + scenario.kick[axis];
            chain.velocity[axis][0] = scenario.velocity[axis];
        }
        chain
    }

    /// Computes all coefficients from the state and the force.
    pub(super) fn expand(&mut self) {
        let (scenario, half) = (self.scenario, self.directions.len());
        let healing = 1.0 / scenario.healing_time;
        for m in 0..self.order {
            let pull = self.pull(m);
            let over = 1.0 / (m + 1) as f64;
            match scenario.inertia {
                None => [0, 1].map(|axis| self.velocity[axis][m] = self.yields(pull)[axis]),
                Some(mass) => {
                    let [x, y] = [self.velocity[0][m], self.velocity[1][m]];
                    let turning = [scenario.rotation * y, -scenario.rotation * x];
                    let before = [x, y];
                    [0, 1].map(|axis| {
                        let force = pull[axis] + turning[axis] - before[axis];
                        self.velocity[axis][m + 1] = force * over / mass;
                    })
                }
            };
            for axis in 0..2 {
                self.position[axis][m + 1] = self.velocity[axis][m] * over;
            }
            let phases = self.phase[m * half..].iter_mut().zip(&self.directions);
            for (phase, [x, y]) in phases {
                *phase = x * self.velocity[0][m] + y * self.velocity[1][m];
            }
            self.expand_field(m, healing, over);
        }
    }

    /// α ∇Q - K x + F at one order.
    fn pull(&self, m: usize) -> [f64; 2] {
        let half = self.directions.len();
        let of_field = self.im[m * half..(m + 1) * half].iter().zip(&self.directions);
        let gradient = of_field.fold([0.0; 2], |[gx, gy], (im, [x, y])| [gx - x * im, gy - y * im]);
        [0, 1].map(|axis| {
            let drive = self.scenario.alpha * gradient[axis] / half as f64;
            drive - self.scenario.trap * self.position[axis][m] + self.force[axis][m]
        })
    }

    /// x' + Ω ẑ × x' = pull, solved for x'.
    fn yields(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let rotation = self.scenario.rotation;
        let over = 1.0 / (1.0 + rotation * rotation);
        [over * (x + rotation * y), over * (y - rotation * x)]
    }

    /// Computes z at order m + 1.
    fn expand_field(&mut self, m: usize, healing: f64, over: f64) {
        let half = self.directions.len();
        let (re, re_next) = self.re.split_at_mut((m + 1) * half);
        let (im, im_next) = self.im.split_at_mut((m + 1) * half);
        let (re_next, im_next) = (&mut re_next[..half], &mut im_next[..half]);
        re_next.fill(0.0);
        im_next.fill(0.0);
        for l in 0..=m {
            let phase = &self.phase[l * half..(l + 1) * half];
            let at = (m - l) * half;
            let (re, im) = (&re[at..at + half], &im[at..at + half]);
            for j in 0..half {
                re_next[j] -= phase[j] * im[j];
                im_next[j] += phase[j] * re[j];
            }
        }
        let source = if m == 0 { 1.0 } else { 0.0 };
        let (re, im) = (&re[m * half..], &im[m * half..]);
        for j in 0..half {
            re_next[j] = (re_next[j] + source - healing * re[j]) * over;
            im_next[j] = (im_next[j] - healing * im[j]) * over;
        }
    }

    /// The length of a step for which the last terms of the position and of the drive amount to `error`.
    pub(super) fn length(&self, error: f64) -> f64 {
        let half = self.directions.len();
        let largest = |m: usize| {
            let range = m * half..(m + 1) * half;
            let parts = self.re[range.clone()].iter().chain(&self.im[range]);
            parts.fold(0.0, |largest, part| f64::max(largest, part.abs()))
        };
        let drive: Vec<f64> = (0..=self.order).map(|m| self.scenario.alpha * largest(m)).collect();
        let motion = self.position.iter().map(|x| length(x, error));
        let velocity = self.scenario.inertia.map(|mass| {
            let coasting = |v: &Vec<f64>| v.iter().map(|v| mass * v).collect::<Vec<f64>>();
            self.velocity.iter().map(|v| length(&coasting(v), error)).fold(f64::INFINITY, f64::min)
        });
        motion.chain(velocity).fold(length(&drive, error), f64::min)
    }

    /// A bound on the speed over a step: the largest speed in the middle of a few pieces, plus a bound on the change
    /// within half a piece.
    pub(super) fn largest_speed(&self, h: f64) -> f64 {
        const PIECES: u32 = 16;
        let order = self.order;
        let change: f64 = (1..order)
            .map(|k| {
                let size = crate::elementary::hypot(self.velocity[0][k], self.velocity[1][k]);
                k as f64 * size * h.powi(i32::try_from(k).unwrap_or(i32::MAX))
            })
            .sum();
        let at = |i: u32| {
            let t = h * (f64::from(i) + 0.5) / f64::from(PIECES);
            let [x, y] = [0, 1].map(|axis| value(&self.velocity[axis][..order], t));
            crate::elementary::hypot(x, y)
        };
        (0..PIECES).map(at).fold(0.0, f64::max) + 0.5 * change / f64::from(PIECES)
    }

    /// Moves the walker to the end of a step.
    pub(super) fn advance(&mut self, h: f64) {
        for axis in 0..2 {
            self.position[axis][0] = value(&self.position[axis], h);
            if self.scenario.inertia.is_some() {
                self.velocity[axis][0] = value(&self.velocity[axis], h);
            }
        }
        let half = self.directions.len();
        for parts in [&mut self.re, &mut self.im] {
            for j in 0..half {
                let here = (0..=self.order).rev().fold(0.0, |sum, m| sum * h + parts[m * half + j]);
                parts[j] = here;
            }
        }
    }
}

/// z of each direction after the past of a scenario.
fn field_of_past(scenario: &WalkerScenario, directions: &[[f64; 2]]) -> Vec<Complex64> {
    let healing = 1.0 / scenario.healing_time;
    match scenario.past {
        WalkerPast::Flat => vec![Complex64::ZERO; directions.len()],
        WalkerPast::Straight([vx, vy]) => {
            let z = |[x, y]: &[f64; 2]| 1.0 / Complex64::new(healing, -(x * vx + y * vy));
            directions.iter().map(z).collect()
        }
        WalkerPast::Circle(frequency) => {
            let [px, py] = scenario.position;
            let radius = crate::elementary::hypot(px, py);
            let orders = bessel_orders(radius);
            let z = |[x, y]: &[f64; 2]| {
                circle(&orders, (healing, frequency), [px * x + py * y, py * x - px * y])
            };
            directions.iter().map(z).collect()
        }
    }
}

/// z of a direction after motion on a circle. The end point has the coordinates `along` and `across` the direction:
///
/// z = e^{i along} Σ_m (-i)^m J_m(r) e^{imψ}/(1/T + imω), with the angle ψ from the direction to the end point (Jacobi
/// and Anger).
fn circle(
    orders: &[f64],
    (healing, frequency): (f64, f64),
    [along, across]: [f64; 2],
) -> Complex64 {
    let radius = crate::elementary::hypot(along, across);
    let unit = if radius > 0.0 { Complex64::new(along, across) / radius } else { Complex64::ONE };
    let (mut sum, mut turn) = (Complex64::from(orders[0] / healing), Complex64::ONE);
    // (-i)^m e^{imψ}, and of order -m its conjugate times (-1)^m from J_{-m} and (-i)^{-m} = i^m.
    let (mut back, step) = (Complex64::ONE, Complex64::new(unit.im, -unit.re));
    let step_back = Complex64::new(-unit.im, -unit.re);
    for (m, order) in orders.iter().enumerate().skip(1) {
        (turn, back) = (turn * step, back * step_back);
        let rate = m as f64 * frequency;
        sum +=
            order * (turn / Complex64::new(healing, rate) + back / Complex64::new(healing, -rate));
    }
    complex_exp(Complex64::new(0.0, along)) * sum
}
