//! The s equations for the tip's displacement at the nodes of one step, and their Newton iteration.

use super::linear_system::Factors;
use crate::collocation::{RADAU, STAGES, Stages, apply};
use crate::initial_surface::Stretch;
use crate::memory::{Groove, Memory};
use crate::tip_function::Apex;
use crate::{Force, InitialSurface, Model};

/// `d_i = h Σ_j a_ij v_j`, with the velocities
/// `v_i = -u0'(x_i) + α (past groove + h Σ_k a_ik f'(d_i - d_k)) + rt_i - x_i + Fext(t_i)`.
pub(super) struct StageEquations<'a> {
    model: &'a Model,
    apex: &'a Apex,
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

const MOST_ITERATIONS: u64 = 12;
/// Corrections below this are round-off of displacements of order one.
const ROUND_OFF: f64 = 1e-15;
/// As long as corrections shrink at least so fast, the Jacobian of an earlier iteration will do.
const SLOWEST_WITH_OLD_JACOBIAN: f64 = 0.03;

/// Pairs of stages i > k, and one idle pair (0, 0) that fills the machine's vectors.
const PAIRS: [(usize, usize); 16] = pairs();
type Pairs = [f64; PAIRS.len()];

const fn pairs() -> [(usize, usize); 16] {
    let mut all = [(0, 0); 16];
    let (mut n, mut i) = (0, 1);
    while i < STAGES {
        let mut k = 0;
        while k < i {
            all[n] = (i, k);
            n += 1;
            k += 1;
        }
        i += 1;
    }
    all
}

/// What one look at the groove tells.
struct Look {
    /// d - hAv
    residual: Stages,
    past_curvature: Stages,
    u0_curvature: Stages,
    own_curvature: Pairs,
}

impl<'a> StageEquations<'a> {
    /// For the step (t, h) that begins with the spring extended by the third number, rt - x0.
    pub(super) fn new(
        (model, apex): (&'a Model, &'a Apex),
        (surface, stretch): (&'a InitialSurface, &'a Stretch),
        force: &Force,
        (t, h, extension): (f64, f64, f64),
    ) -> Self {
        let r = model.r();
        // At the end of a step the force is its limit from before: it may jump there.
        let last = (t + h).next_down();
        let pull = RADAU.c.map(|c| extension + r * h * c + force.value((t + h * c).min(last)));
        Self { model, apex, surface, stretch, h, x: r * t - extension, pull }
    }

    /// Newton's iteration from `guess`, to an error below `enough`; given up when a displacement
    /// exceeds `most`. The Jacobian is kept while that costs no iteration.
    pub(super) fn solve(
        &self,
        memory: &mut impl Memory,
        guess: Stages,
        enough: f64,
        most: f64,
    ) -> Solved {
        let mut displacement = guess;
        let mut previous = f64::INFINITY;
        let mut ratio = 1.0;
        let mut factors = None;
        let round_off = ROUND_OFF.max(self.surface.rounding(self.x));
        for iterations in 1..=MOST_ITERATIONS {
            let look = self.look(memory, &displacement);
            if ratio > SLOWEST_WITH_OLD_JACOBIAN {
                factors = Factors::of(self.jacobian(&look));
            }
            let Some(factors) = &factors else { return Solved { iterations, solution: None } };
            let correction = factors.solve(&look.residual);
            let size = correction.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
            for (d, c) in displacement.iter_mut().zip(correction) {
                *d -= c;
            }
            let in_range = displacement.iter().all(|d| d.abs() <= most);
            // The next correction would be smaller by this ratio at least.
            ratio = (size / previous).min(1.0);
            if !in_range || (iterations > 3 && ratio > 0.9 && size > 100.0 * round_off) {
                return Solved { iterations, solution: None };
            }
            if ratio * size <= enough.max(round_off) && (iterations > 1 || size <= enough) {
                let curvature_at_end = look.curvature_at_end(self.model.alpha());
                let solution = Some(Solution { displacement, curvature_at_end });
                return Solved { iterations, solution };
            }
            previous = size;
        }
        Solved { iterations: MOST_ITERATIONS, solution: None }
    }

    fn look(&self, memory: &mut impl Memory, d: &Stages) -> Look {
        let (mut past_slope, mut past_curvature) = ([0.0; STAGES], [0.0; STAGES]);
        memory.groove(d, &mut Groove::new(&mut past_slope, &mut past_curvature));
        let (own_slope, own_curvature) = self.between_stages(d);
        let mut force = past_slope;
        for (pair, (i, k)) in PAIRS.into_iter().enumerate() {
            force[i] += self.h * RADAU.a[i][k] * own_slope[pair];
            force[k] -= self.h * RADAU.a[k][i] * own_slope[pair];
        }
        let mut u0_curvature = [0.0; STAGES];
        let mut velocity = [0.0; STAGES];
        for i in 0..STAGES {
            let u0_slope;
            (u0_slope, u0_curvature[i]) =
                self.surface.slope_and_curvature_on(self.stretch, self.x + d[i]);
            velocity[i] = self.pull[i] - d[i] - u0_slope + self.model.alpha() * force[i];
        }
        let carried = apply(&RADAU.a, &velocity);
        let residual = std::array::from_fn(|i| d[i] - self.h * carried[i]);
        Look { residual, past_curvature, u0_curvature, own_curvature }
    }

    /// 1 - hA ∂v/∂d
    fn jacobian(&self, look: &Look) -> [Stages; STAGES] {
        let (alpha, h) = (self.model.alpha(), self.h);
        let mut derivative = [[0.0; STAGES]; STAGES];
        for (i, row) in derivative.iter_mut().enumerate() {
            row[i] = alpha * look.past_curvature[i] - look.u0_curvature[i] - 1.0;
        }
        for (curvature, (i, k)) in look.own_curvature.iter().zip(PAIRS) {
            let (to_i, to_k) =
                (alpha * h * RADAU.a[i][k] * curvature, alpha * h * RADAU.a[k][i] * curvature);
            derivative[i][i] += to_i;
            derivative[i][k] -= to_i;
            derivative[k][k] += to_k;
            derivative[k][i] -= to_k;
        }
        let mut jacobian = [[0.0; STAGES]; STAGES];
        for (i, row) in jacobian.iter_mut().enumerate() {
            row[i] = 1.0;
            for (a, derivatives) in RADAU.a[i].iter().zip(&derivative) {
                let factor = h * a;
                row.iter_mut().zip(derivatives).for_each(|(entry, d)| *entry -= factor * d);
            }
        }
        jacobian
    }

    /// f' and f'' at `d_i - d_k` for all pairs of stages: what the step itself carves until node i is
    /// `h Σ_k a_ik f'(d_i - d_k)`.
    fn between_stages(&self, d: &Stages) -> (Pairs, Pairs) {
        let distance = PAIRS.map(|(i, k)| d[i] - d[k]);
        let (mut slope, mut curvature) = ([0.0; PAIRS.len()], [0.0; PAIRS.len()]);
        if !self.apex.slopes_and_curvatures(&distance, &mut slope, &mut curvature) {
            for (pair, distance) in distance.into_iter().enumerate() {
                (slope[pair], curvature[pair]) = self.model.tip().slope_and_curvature(distance);
            }
        }
        (slope, curvature)
    }
}

impl Look {
    /// u_xx at the last node.
    fn curvature_at_end(&self, alpha: f64) -> f64 {
        self.u0_curvature[STAGES - 1] - alpha * self.past_curvature[STAGES - 1]
    }
}
