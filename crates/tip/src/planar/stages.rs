//! The collocation equations of a step in two coordinates, and their Newton iteration.
//!
//! ```text
//!     d = hA F_x, or what inertia makes of it        F_x = α (past_x + Σ_k b_ik f_x(d_i - d_k, e_i - e_k)) + R - x0 - d
//!     e = hA F_y                                     F_y = α (past_y + Σ_k b_ik f_y(d_i - d_k, e_i - e_k)) - κ_y (y0 + e)
//! ```
//!
//! with external forces added to both. The force of the past is that of all layers at the displacement of the stage.

use super::chain::{Curvatures, dot};
use super::layers::{LANES, Lanes, slopes, values};
use super::past::Past;
use crate::TipFunction;
use crate::collocation::{RADAU, STAGES, Stages, apply};
use crate::footprint::Across;
use crate::step::{Factors, Inertia, Matrix};

/// The data at the start of a step.
pub(super) struct StageEquations<'a> {
    /// g and h.
    pub(super) footprint: (&'a TipFunction, Across),
    pub(super) alpha: f64,
    /// κ_y
    pub(super) stiffness: f64,
    pub(super) past: &'a Past,
    /// η of the tip at the start, and v.
    pub(super) eta: f64,
    pub(super) width: f64,
    pub(super) h: f64,
    /// The parts of the forces along and across that do not depend on the displacements of the stages.
    pub(super) pull: [Stages; 2],
    /// Weights of each stage in the groove at each stage.
    pub(super) carving: Matrix,
    /// Undecayed part of the past at each stage.
    pub(super) left: Stages,
    pub(super) inertia: Option<&'a Inertia>,
}

/// Result of an iteration.
pub(super) struct Solved {
    pub(super) iterations: u64,
    /// `None` if it did not converge.
    pub(super) solution: Option<Solution>,
}

/// Displacements at the nodes, along and across.
#[derive(Debug, Clone, Copy)]
pub(super) struct Solution {
    pub(super) displacement: [Stages; 2],
    /// Curvatures of the surface of the past under the last node.
    pub(super) curvatures: Curvatures,
}

/// Forces at the stages, and their derivatives by the displacements of the stages.
struct Forces {
    value: [Stages; 2],
    slope: [[Matrix; 2]; 2],
    curvatures: Curvatures,
}

/// Number of unknowns: both coordinates of all stages.
const UNKNOWNS: usize = 2 * STAGES;

const MOST_ITERATIONS: u64 = 12;
/// Corrections below this are round-off of displacements of order one.
const ROUND_OFF: f64 = 1e-15;
/// Largest ratio of successive corrections for which the Jacobian of an earlier iteration is kept.
const SLOWEST_WITH_OLD_JACOBIAN: f64 = 0.03;

impl StageEquations<'_> {
    /// Solves the equations by Newton's iteration from a guess, to an error below `enough`. It stops when a
    /// displacement along exceeds `most[0]`, or one across `most[1]`.
    pub(super) fn solve(&self, guess: [Stages; 2], enough: f64, most: [f64; 2]) -> Solved {
        let mut displacement = guess;
        let (mut previous, mut ratio) = (f64::INFINITY, 1.0);
        let mut jacobian = None;
        for iterations in 1..=MOST_ITERATIONS {
            let forces = self.forces(&displacement);
            if ratio > SLOWEST_WITH_OLD_JACOBIAN {
                jacobian = Factors::of(self.jacobian(&forces));
            }
            let Some(factors) = &jacobian else { return Solved { iterations, solution: None } };
            let correction = factors.solve(&self.missed(&displacement, &forces));
            for (d, c) in displacement.as_flattened_mut().iter_mut().zip(correction) {
                *d -= c;
            }
            let size = correction.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
            ratio = (size / previous).min(1.0);
            let within = |j: usize| displacement[j].iter().all(|d| d.abs() <= most[j]);
            let stuck = iterations > 3 && ratio > 0.9 && size > 100.0 * ROUND_OFF;
            if !(within(0) && within(1)) || stuck {
                return Solved { iterations, solution: None };
            }
            if ratio * size <= enough.max(ROUND_OFF) && (iterations > 1 || size <= enough) {
                let solution = Solution { displacement, curvatures: forces.curvatures };
                return Solved { iterations, solution: Some(solution) };
            }
            previous = size;
        }
        Solved { iterations: MOST_ITERATIONS, solution: None }
    }

    /// d and e minus their values from the forces.
    fn missed(&self, [d, e]: &[Stages; 2], forces: &Forces) -> [f64; UNKNOWNS] {
        let along = match self.inertia {
            Some(inertia) => inertia.residual(d, &forces.value[0]),
            None => self.residual(d, &forces.value[0]),
        };
        let across = self.residual(e, &forces.value[1]);
        std::array::from_fn(|i| if i < STAGES { along[i] } else { across[i - STAGES] })
    }

    fn residual(&self, d: &Stages, force: &Stages) -> Stages {
        let carried = apply(&RADAU.a, force);
        std::array::from_fn(|i| d[i] - self.h * carried[i])
    }

    fn jacobian(&self, forces: &Forces) -> [[f64; UNKNOWNS]; UNKNOWNS] {
        let mut jacobian = [[0.0; UNKNOWNS]; UNKNOWNS];
        for (n, row) in jacobian.iter_mut().enumerate() {
            let (of, i) = (n / STAGES, n % STAGES);
            let carried = match self.inertia {
                Some(inertia) if of == 0 => inertia.carried()[i],
                _ => RADAU.a[i].map(|a| self.h * a),
            };
            for (m, entry) in row.iter_mut().enumerate() {
                let slope = &forces.slope[of][m / STAGES];
                *entry = -(0..STAGES).map(|k| carried[k] * slope[k][m % STAGES]).sum::<f64>();
            }
            row[n] += 1.0;
        }
        jacobian
    }

    /// Forces at these displacements of the stages.
    fn forces(&self, displacement: &[Stages; 2]) -> Forces {
        let zero = [[0.0; STAGES]; STAGES];
        let mut forces = Forces { value: self.pull, slope: [[zero; 2]; 2], curvatures: [0.0; 3] };
        let mut room = Room::new(self.past.groups());
        let [along, across] = displacement;
        for (i, (&d, &e)) in along.iter().zip(across).enumerate() {
            let (push, bend) = room.past(self, d, e);
            let strength = self.alpha * self.left[i];
            forces.curvatures = bend.map(|bend| -strength * bend);
            forces.value[0][i] += strength * push[0] - d;
            forces.value[1][i] += strength * push[1] - self.stiffness * e;
            forces.slope[0][0][i][i] += strength * bend[0] - 1.0;
            forces.slope[0][1][i][i] += strength * bend[1];
            forces.slope[1][0][i][i] += strength * bend[1];
            forces.slope[1][1][i][i] += strength * bend[2] - self.stiffness;
        }
        self.add_own(displacement, &mut forces);
        forces
    }

    /// Adds the contribution of the step to the groove.
    fn add_own(&self, [d, e]: &[Stages; 2], forces: &mut Forces) {
        for i in 0..STAGES {
            for k in 0..STAGES {
                let (push, bend) = self.of_visit(d[i] - d[k], e[i] - e[k]);
                let strength = self.alpha * self.carving[i][k];
                forces.value[0][i] += strength * push[0];
                forces.value[1][i] += strength * push[1];
                for (of, by) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let slope = strength * bend[of + by];
                    forces.slope[of][by][i][i] += slope;
                    forces.slope[of][by][i][k] -= slope;
                }
            }
        }
    }

    /// First and second derivatives of f at this distance.
    fn of_visit(&self, x: f64, y: f64) -> ([f64; 2], [f64; 3]) {
        let (along, across) = self.footprint;
        let (g, (g1, g2)) = (along.value(x), along.slope_and_curvature(x));
        let (h, z) = (across.value(y), y / self.width);
        let (h1, h2) = (-z * h / self.width, (z * z - 1.0) * h / (self.width * self.width));
        ([g1 * h, g * h1], [g2 * h, g1 * h1, g * h2])
    }
}

/// Scratch space for the layers at a stage.
struct Room {
    groups: usize,
    /// φ, φ', φ'', and integrals over g, g', g''.
    layers: Vec<Lanes>,
}

impl Room {
    fn new(groups: usize) -> Self {
        Self { groups, layers: vec![[0.0; LANES]; 6 * groups] }
    }

    /// First and second derivatives of ∫ f over the past, at this displacement from the tip.
    fn past(&mut self, begin: &StageEquations<'_>, d: f64, e: f64) -> ([f64; 2], [f64; 3]) {
        let (of_place, of_past) = self.layers.split_at_mut(3 * self.groups);
        let [phi, slope, bend] = in_three(of_place, self.groups);
        let [value, first, second] = in_three(of_past, self.groups);
        let eta = begin.eta + e / begin.width;
        values(eta, 1.0, phi);
        slopes(eta, phi, slope);
        slopes(eta, slope, bend);
        bend.as_flattened_mut().iter_mut().zip(phi.as_flattened()).for_each(|(b, phi)| *b -= phi);
        begin.past.at(d, &mut [&mut *value, &mut *first, &mut *second]);
        let v = begin.width;
        (
            [dot(phi, first), dot(slope, value) / v],
            [dot(phi, second), dot(slope, first) / v, dot(bend, value) / (v * v)],
        )
    }
}

fn in_three(all: &mut [Lanes], groups: usize) -> [&mut [Lanes]; 3] {
    let (first, rest) = all.split_at_mut(groups);
    let (second, third) = rest.split_at_mut(groups);
    [first, second, third]
}

#[cfg(test)]
mod tests {
    use super::super::modes::Modes;
    use super::*;
    use crate::memory::{Fit, Retreat};
    use crate::step::healing;

    /// The Jacobian by differences of what is missed, far from a solution.
    #[test]
    fn the_jacobian_is_that_of_the_equations() {
        let tip = TipFunction::default();
        let fit = Fit::cached(&tip, 1e-10, Retreat::Small).unwrap();
        let mut past = Past::new(Modes::new(fit), None);
        past.resize(4);
        let mut weighted = vec![[0.0; LANES]; 12];
        for (k, weighted) in weighted.chunks_exact_mut(4).enumerate() {
            values(0.4 * k as f64 - 0.5, 1.0, weighted);
        }
        past.remember(&[0.3, 0.9, 1.1], &weighted);
        let inertia = Inertia::new(0.4, 0.6, 0.7);
        for inertia in [None, Some(&inertia)] {
            let equations = StageEquations {
                footprint: (&tip, Across::central(1.3)),
                alpha: 1.4,
                stiffness: 0.7,
                past: &past,
                eta: 0.2,
                width: 1.3,
                h: 0.6,
                pull: [[0.9; STAGES], [-0.2; STAGES]],
                carving: healing(0.6, 2.0),
                left: RADAU.c.map(|c| 1.0 - 0.2 * c),
                inertia,
            };
            let start =
                [RADAU.c.map(|c| 0.7 * c - 0.2), RADAU.c.map(|c| 0.4 * c * (1.0 - c) + 0.1)];
            let jacobian = equations.jacobian(&equations.forces(&start));
            for m in 0..UNKNOWNS {
                let missed = |by: f64| {
                    let mut moved = start;
                    moved.as_flattened_mut()[m] += by;
                    equations.missed(&moved, &equations.forces(&moved))
                };
                let e = 1e-3;
                let [a, b, c, d] = [e, -e, 2.0 * e, -2.0 * e].map(missed);
                for (n, row) in jacobian.iter().enumerate() {
                    let difference = (8.0 * (a[n] - b[n]) - (c[n] - d[n])) / (12.0 * e);
                    let miss = (difference - row[m]).abs();
                    assert!(miss < 1e-9, "{n} {m}: {difference} {}", row[m]);
                }
            }
        }
    }
}
