//! The collocation equations of a step in two coordinates, and their Newton iteration.
//!
//! ```text
//!     d = hA F_x without inertia                     F_x = α (past_x + Σ_k b_ik f_x(d_i - d_k, e_i - e_k)) + R - x0 - d
//!     e = hA F_y                                     F_y = α (past_y + Σ_k b_ik f_y(d_i - d_k, e_i - e_k)) - κ_y (y0 + e)
//! ```
//!
//! with the Butcher matrix A, the weights `b_ik` of stage k in the groove at stage i, and external forces added to
//! both. The force of the past is that of all layers at the displacements d_i along and e_i across. With a [`Depth`]
//! limit the heights under the tip are further unknowns,
//!
//! ```text
//!     h = -α (past + Σ_k b_ik w_k f(d_i - d_k, e_i - e_k))        w_k = e^{-σ h_k/b}
//! ```
//!
//! and w multiplies the columns of b in all three equations.

use super::chain::Curvatures;
use super::jet::Jet;
use super::part::{Part, Room, sum};
use crate::collocation::{RADAU, STAGES, Stages, apply};
use crate::integrator::newton::newton;
use crate::step::{Depth, Factors, Inertia, Matrix};

/// The data at the start of a step.
pub(super) struct StageEquations<'a> {
    /// The products of the footprint with their pasts.
    pub(super) parts: &'a [Part],
    pub(super) alpha: f64,
    /// Stiffness κ_y of the spring across the scan.
    pub(super) stiffness: f64,
    /// y0 at the start.
    pub(super) y: f64,
    pub(super) h: f64,
    /// The parts of the forces along and across that do not depend on the displacements of the stages.
    pub(super) pull: [Stages; 2],
    /// Weights of each stage in the groove at each stage.
    pub(super) carving: Matrix,
    /// Undecayed part of the past at each stage.
    pub(super) left: Stages,
    pub(super) inertia: Option<&'a Inertia>,
    pub(super) depth: Option<Depth>,
    /// The initial surface, unless it is flat about the tip.
    pub(super) under: Option<Under<'a>>,
}

/// The surface at the start of the run, under a step.
pub(super) struct Under<'a> {
    /// The surface at a position, without decay.
    pub(super) surface: &'a dyn Fn([f64; 2]) -> Jet,
    /// Position of the tip at the start of the step.
    pub(super) from: [f64; 2],
    /// Undecayed part at each stage.
    pub(super) left: Stages,
}

/// Displacements at the nodes, along and across, and heights; the heights are 0 without a depth limit.
pub(super) type Unknowns = [Stages; 3];

/// Displacements at the nodes, along and across.
#[derive(Debug, Clone, Copy)]
pub(super) struct Solution {
    pub(super) displacement: [Stages; 2],
    /// Heights under the tip at the nodes, with a depth limit.
    pub(super) height: Option<Stages>,
    /// Undecayed part, at the end of the step, of the effective time of indentation at each node.
    pub(super) spent: Stages,
    /// Curvatures of the surface of the past under the last node.
    pub(super) curvatures: Curvatures,
}

/// Forces and heights at the stages, and their derivatives by the unknowns at the stages.
struct Forces {
    value: Unknowns,
    slope: [[Matrix; 3]; 3],
    curvatures: Curvatures,
}

/// The factored Jacobian.
#[expect(clippy::large_enum_variant, reason = "there is one, on the stack")]
enum Jacobian {
    /// Without a depth limit.
    Free(Factors<{ 2 * STAGES }>),
    Limited(Factors<{ 3 * STAGES }>),
}

impl StageEquations<'_> {
    /// Solves the equations by Newton's iteration from a guess, to an error below `enough`, and counts the iterations;
    /// `None` if it does not converge. It stops when a displacement exceeds `most`.
    pub(super) fn solve(
        &self,
        guess: Unknowns,
        (enough, most): (f64, f64),
        count: &mut u64,
    ) -> Option<Solution> {
        let (mut at, mut curvatures) = (guess, [0.0; 3]);
        let mut jacobian = None;
        // Positions are rounded, and with them the slopes of the initial surface.
        let rounding = |Under { from: [x, y], .. }: &Under<'_>| f64::EPSILON * x.abs().max(y.abs());
        let rounding = self.under.as_ref().map_or(0.0, rounding);
        let is_solved = newton((enough, rounding), count, |is_new| {
            let forces = self.forces(&at);
            curvatures = forces.curvatures;
            if is_new {
                jacobian = self.jacobian(&forces);
            }
            let correction = jacobian.as_ref()?.corrections(&self.missed(&at, &forces));
            for (x, c) in at.as_flattened_mut().iter_mut().zip(correction.as_flattened()) {
                *x -= c;
            }
            let is_within = at[..2].as_flattened().iter().all(|d| d.abs() <= most);
            is_within.then(|| size(&correction, &at[2]))
        });
        is_solved.then(|| self.solution(&at, curvatures))
    }

    fn solution(&self, [along, across, height]: &Unknowns, curvatures: Curvatures) -> Solution {
        let (mut spent, weights) = (self.carving[STAGES - 1], self.weights(height));
        spent.iter_mut().zip(weights).for_each(|(spent, weight)| *spent *= weight);
        let displacement = [*along, *across];
        Solution { displacement, height: self.depth.map(|_| *height), spent, curvatures }
    }

    /// w at the stages.
    fn weights(&self, height: &Stages) -> Stages {
        self.depth.map_or([1.0; STAGES], |depth| depth.weights(height))
    }

    /// The unknowns minus their values from forces and surface.
    fn missed(&self, [d, e, height]: &Unknowns, forces: &Forces) -> Unknowns {
        let along = match self.inertia {
            Some(inertia) => inertia.residual(d, &forces.value[0]),
            None => self.residual(d, &forces.value[0]),
        };
        let across = self.residual(e, &forces.value[1]);
        [along, across, std::array::from_fn(|i| height[i] - forces.value[2][i])]
    }

    fn residual(&self, d: &Stages, force: &Stages) -> Stages {
        let carried = apply(&RADAU.a, force);
        std::array::from_fn(|i| d[i] - self.h * carried[i])
    }

    /// The factored Jacobian; `None` if it is singular.
    fn jacobian(&self, forces: &Forces) -> Option<Jacobian> {
        match self.depth {
            None => Factors::of(self.derivatives(forces)).map(Jacobian::Free),
            Some(_) => Factors::of(self.derivatives(forces)).map(Jacobian::Limited),
        }
    }

    /// Derivatives of [`missed`](Self::missed) by the unknowns, with or without heights.
    fn derivatives<const N: usize>(&self, forces: &Forces) -> [[f64; N]; N] {
        let mut derivatives = [[0.0; N]; N];
        for (n, row) in derivatives.iter_mut().enumerate() {
            let (of, i) = (n / STAGES, n % STAGES);
            if of == 2 {
                for (m, entry) in row.iter_mut().enumerate() {
                    *entry = -forces.slope[2][m / STAGES][i][m % STAGES];
                }
                row[n] += 1.0;
                continue;
            }
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
        derivatives
    }

    /// Forces and heights at these unknowns of the stages.
    fn forces(&self, at: &Unknowns) -> Forces {
        let zero = [[0.0; STAGES]; STAGES];
        let value = [self.pull[0], self.pull[1], [0.0; STAGES]];
        let mut forces = Forces { value, slope: [[zero; 3]; 3], curvatures: [0.0; 3] };
        let mut room = Room::default();
        let [along, across, _] = at;
        for (i, (&d, &e)) in along.iter().zip(across).enumerate() {
            let jet = sum(self.parts, |part| part.at(d, self.y + e, &mut room));
            let strength = self.alpha * self.left[i];
            forces.curvatures = jet.curvature.map(|bend| -strength * bend);
            forces.add(strength, i, &jet, [d, self.stiffness * e]);
            if let Some(under) = &self.under {
                forces.add_surface(i, &under.jet(i, [d, e]));
            }
            forces.slope[0][0][i][i] -= 1.0;
            forces.slope[1][1][i][i] -= self.stiffness;
        }
        self.add_own(at, &mut forces);
        forces
    }

    /// Adds the contribution of the step to the groove.
    fn add_own(&self, [d, e, height]: &Unknowns, forces: &mut Forces) {
        let weights = self.weights(height);
        for i in 0..STAGES {
            for k in 0..STAGES {
                let (x, y) = (d[i] - d[k], e[i] - e[k]);
                let jet = sum(self.parts, |part| part.of_visit(x, y));
                let strength = self.alpha * self.carving[i][k] * weights[k];
                forces.add(strength, i, &jet, [0.0; 2]);
                forces.move_visit(strength, (i, k), &jet);
                if let Some(depth) = &self.depth {
                    forces.weigh(-depth.side / depth.limit * strength, (i, k), &jet);
                }
            }
        }
    }
}

impl Under<'_> {
    /// The surface at a displacement from the start of the step.
    fn jet(&self, stage: usize, [d, e]: [f64; 2]) -> Jet {
        (self.surface)([self.from[0] + d, self.from[1] + e]).times(self.left[stage])
    }
}

/// Pairs of the component of a force and the coordinate by which it is differentiated.
const PAIRS: [(usize, usize); 4] = [(0, 0), (0, 1), (1, 0), (1, 1)];

impl Forces {
    /// Adds the force of a groove of this strength on stage i, minus the pull of the springs, and the derivatives by
    /// the position of the stage.
    fn add(&mut self, strength: f64, i: usize, jet: &Jet, springs: [f64; 2]) {
        for (of, (push, spring)) in jet.slope.iter().zip(springs).enumerate() {
            self.value[of][i] += strength * push - spring;
            self.slope[2][of][i][i] -= strength * push;
        }
        self.value[2][i] -= strength * jet.height;
        for (of, by) in PAIRS {
            self.slope[of][by][i][i] += strength * jet.curvature[of + by];
        }
    }

    /// Adds the initial surface under stage i.
    fn add_surface(&mut self, i: usize, jet: &Jet) {
        self.add(-1.0, i, jet, [0.0; 2]);
        self.curvatures.iter_mut().zip(jet.curvature).for_each(|(sum, bend)| *sum += bend);
    }

    /// Adds the derivatives by the position of stage k, which carved the groove under stage i.
    fn move_visit(&mut self, strength: f64, (i, k): (usize, usize), jet: &Jet) {
        for of in 0..2 {
            self.slope[2][of][i][k] += strength * jet.slope[of];
        }
        for (of, by) in PAIRS {
            self.slope[of][by][i][k] -= strength * jet.curvature[of + by];
        }
    }

    /// Adds the derivatives by the height at stage k, on which the weight of its groove depends.
    fn weigh(&mut self, change: f64, (i, k): (usize, usize), jet: &Jet) {
        for of in 0..2 {
            self.slope[of][2][i][k] += change * jet.slope[of];
        }
        self.slope[2][2][i][k] -= change * jet.height;
    }
}

impl Jacobian {
    /// Newton's corrections.
    fn corrections(&self, missed: &Unknowns) -> Unknowns {
        let mut corrections = [[0.0; STAGES]; 3];
        let all = corrections.as_flattened_mut();
        let missed = missed.as_flattened();
        match self {
            Self::Free(factors) => {
                let free = factors.solve(&std::array::from_fn(|n| missed[n]));
                all[..2 * STAGES].copy_from_slice(&free);
            }
            Self::Limited(factors) => {
                all.copy_from_slice(&factors.solve(&std::array::from_fn(|n| missed[n])));
            }
        }
        corrections
    }
}

/// The largest correction; that of a height above 1 counts relative to the height.
fn size([along, across, height]: &Unknowns, heights: &Stages) -> f64 {
    let largest = |all: &Stages| all.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    let relative = height.iter().zip(heights).map(|(c, height)| c.abs() / height.abs().max(1.0));
    relative.fold(largest(along).max(largest(across)), f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::part::Storage;
    use super::super::products::Products;
    use super::super::texture::Texture;
    use super::*;
    use crate::memory::Retreat;
    use crate::step::healing;
    use crate::{Across, Footprint, Layer, TipFunction};

    /// The Jacobian by differences of what is missed, far from a solution.
    #[test]
    fn the_jacobian_is_that_of_the_equations() {
        let of = |width: f64, across: Across| Layer {
            along: TipFunction::triple_gaussian(0.6, width).unwrap(),
            across,
        };
        let layers =
            vec![of(1.0, Across::central(1.3)), of(1.2, Across { center: 0.7, width: 0.9 })];
        let footprint = Footprint::from_layers(layers).unwrap();
        let products = Products::of(&footprint, [1e-10; 2]).unwrap();
        let storage = Storage::Modes(Retreat::Small, false);
        let part = |product| {
            let mut part = Part::new(product, storage).unwrap();
            part.past.resize(4);
            let moved = ([0.3, 0.9, 1.1], [-0.65, -0.13, 0.39]);
            part.remember((&moved.0, &moved.1), &[1.0; 3], (0.0, 1.0), &mut vec![]);
            part
        };
        let parts: Vec<Part> = products.all().iter().map(part).collect();
        assert_eq!(parts.len(), 2);
        let inertia = Inertia::new(0.4, 0.6, 0.7);
        let limit = Depth { limit: 1.7, side: -1.0 };
        let texture = Texture::waves();
        let field = texture.field([0.5, 0.1], [true; 2], 0.0);
        for (inertia, depth) in
            [(None, None), (Some(&inertia), None), (Some(&inertia), Some(limit))]
        {
            let equations = StageEquations {
                parts: &parts,
                alpha: 1.4,
                stiffness: 0.7,
                y: 0.26,
                h: 0.6,
                pull: [[0.9; STAGES], [-0.2; STAGES]],
                carving: healing(0.6, 2.0),
                left: RADAU.c.map(|c| 1.0 - 0.2 * c),
                inertia,
                depth,
                under: Some(Under {
                    surface: &|at| Jet::of(&texture.jet(&field, at)),
                    from: [0.5, 0.1],
                    left: RADAU.c.map(|c| 0.8 - 0.1 * c),
                }),
            };
            let start = [
                RADAU.c.map(|c| 0.7 * c - 0.2),
                RADAU.c.map(|c| 0.4 * c * (1.0 - c) + 0.1),
                RADAU.c.map(|c| -1.8 - 0.9 * c),
            ];
            let jacobian: [[f64; 3 * STAGES]; 3 * STAGES] =
                equations.derivatives(&equations.forces(&start));
            for m in 0..3 * STAGES {
                let missed = |by: f64| {
                    let mut moved = start;
                    moved.as_flattened_mut()[m] += by;
                    equations.missed(&moved, &equations.forces(&moved))
                };
                let e = 1e-3;
                let [a, b, c, d] = [e, -e, 2.0 * e, -2.0 * e].map(missed);
                let at = |missed: &Unknowns, n: usize| missed.as_flattened()[n];
                for (n, row) in jacobian.iter().enumerate() {
                    let [near, far] = [at(&a, n) - at(&b, n), at(&c, n) - at(&d, n)];
                    let difference = (8.0 * near - far) / (12.0 * e);
                    let miss = (difference - row[m]).abs();
                    assert!(miss < 1e-9, "{n} {m}: {difference} {}", row[m]);
                }
            }
        }
    }
}
