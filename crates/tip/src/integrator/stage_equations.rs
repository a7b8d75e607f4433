//! The s equations for the tip's displacement at the nodes of one step, and their Newton iteration.

use crate::collocation::{RADAU, STAGES, Stages};
use crate::initial_surface::Stretch;
use crate::memory::Memory;
use crate::{Force, InitialSurface, Model};
use nalgebra::{SMatrix, SVector};

/// `d_i = h Σ_j a_ij v_j`, with the velocities
/// `v_i = -u0'(x_i) + α (past groove + h Σ_k a_ik f'(d_i - d_k)) + rt_i - x_i + Fext(t_i)`.
pub(super) struct StageEquations<'a> {
    model: &'a Model,
    surface: &'a InitialSurface,
    stretch: &'a Stretch,
    h: f64,
    /// Position of the tip at the start of the step.
    x: f64,
    /// rt - x0(start) + Fext at the nodes: all of the velocity that does not depend on d.
    pull: Stages,
}

/// How an iteration ended.
pub(super) struct Solved {
    pub(super) iterations: u64,
    /// `None` if it did not converge.
    pub(super) solution: Option<Solution>,
}

pub(super) struct Solution {
    pub(super) displacement: Stages,
    /// u_xx at the last node.
    pub(super) curvature_at_end: f64,
}

type Jacobian = SMatrix<f64, STAGES, STAGES>;

const MOST_ITERATIONS: u64 = 12;
/// Corrections below this are round-off of displacements of order one.
const ROUND_OFF: f64 = 1e-15;

impl<'a> StageEquations<'a> {
    /// For the step (t, h) that begins with the spring extended by the third number, rt - x0.
    pub(super) fn new(
        model: &'a Model,
        (surface, stretch): (&'a InitialSurface, &'a Stretch),
        force: &Force,
        (t, h, extension): (f64, f64, f64),
    ) -> Self {
        let r = model.r();
        // At the end of a step the force is its limit from before: it may jump there.
        let last = (t + h).next_down();
        let pull = RADAU.c.map(|c| extension + r * h * c + force.value((t + h * c).min(last)));
        Self { model, surface, stretch, h, x: r * t - extension, pull }
    }

    /// Newton's iteration from `guess`, to an error below `enough`; given up when a displacement
    /// exceeds `most`.
    pub(super) fn solve(
        &self,
        memory: &mut dyn Memory,
        guess: Stages,
        enough: f64,
        most: f64,
    ) -> Solved {
        let mut displacement = guess;
        let mut previous = f64::INFINITY;
        let round_off = ROUND_OFF.max(self.surface.rounding(self.x));
        for iterations in 1..=MOST_ITERATIONS {
            let (residual, jacobian, curvature_at_end) = self.linearise(memory, &displacement);
            let Some(correction) = jacobian.lu().solve(&residual) else {
                return Solved { iterations, solution: None };
            };
            let size = correction.amax();
            for (d, c) in displacement.iter_mut().zip(correction.iter()) {
                *d -= c;
            }
            let in_range = displacement.iter().all(|d| d.abs() <= most);
            // The next correction would be smaller by the square of this ratio: Newton is quadratic.
            let ratio = (size / previous).min(1.0);
            if !in_range || (iterations > 3 && ratio > 0.9 && size > 100.0 * round_off) {
                return Solved { iterations, solution: None };
            }
            if ratio * ratio * size <= enough.max(round_off) && (iterations > 1 || size <= enough) {
                return Solved {
                    iterations,
                    solution: Some(Solution { displacement, curvature_at_end }),
                };
            }
            previous = size;
        }
        Solved { iterations: MOST_ITERATIONS, solution: None }
    }

    /// Residual d - hAv, its Jacobian, and u_xx at the last node.
    fn linearise(
        &self,
        memory: &mut dyn Memory,
        d: &Stages,
    ) -> (SVector<f64, STAGES>, Jacobian, f64) {
        let (alpha, h) = (self.model.alpha(), self.h);
        let (mut past_slope, mut past_curvature) = ([0.0; STAGES], [0.0; STAGES]);
        memory.groove(d, &mut past_slope, &mut past_curvature);
        let (own, own_derivative) = self.own_groove(d);
        let mut velocity = [0.0; STAGES];
        let mut velocity_derivative = own_derivative * alpha;
        let mut curvature_at_end = 0.0;
        for i in 0..STAGES {
            let (u0_slope, u0_curvature) =
                self.surface.slope_and_curvature_on(self.stretch, self.x + d[i]);
            velocity[i] = self.pull[i] - d[i] - u0_slope + alpha * (past_slope[i] + own[i]);
            velocity_derivative[(i, i)] += alpha * past_curvature[i] - u0_curvature - 1.0;
            curvature_at_end = u0_curvature - alpha * past_curvature[i];
        }
        let a = Jacobian::from_fn(|i, j| h * RADAU.a[i][j]);
        let residual = SVector::from(*d) - a * SVector::from(velocity);
        (residual, Jacobian::identity() - a * velocity_derivative, curvature_at_end)
    }

    /// `h Σ_k a_ik f'(d_i - d_k)`, what the step itself has carved until each node, and its derivatives
    /// with respect to d.
    fn own_groove(&self, d: &Stages) -> (Stages, Jacobian) {
        let mut slope = [0.0; STAGES];
        let mut derivative = Jacobian::zeros();
        for i in 0..STAGES {
            for k in 0..i {
                let (f1, f2) = self.model.tip().slope_and_curvature(d[i] - d[k]);
                let (to_i, to_k) = (self.h * RADAU.a[i][k], self.h * RADAU.a[k][i]);
                slope[i] += to_i * f1;
                slope[k] -= to_k * f1;
                derivative[(i, i)] += to_i * f2;
                derivative[(i, k)] -= to_i * f2;
                derivative[(k, k)] += to_k * f2;
                derivative[(k, i)] -= to_k * f2;
            }
        }
        (slope, derivative)
    }
}
