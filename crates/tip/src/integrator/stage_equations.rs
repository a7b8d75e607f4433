//! The s equations for the tip's displacement at the nodes of one step, and their Newton iteration.

use super::linear_system::Factors;
use crate::collocation::{RADAU, STAGES, Stages};
use crate::initial_surface::Stretch;
use crate::memory::{Groove, Memory};
use crate::step::{Equations, Law, OwnGroove};
use crate::tip_function::Apex;
use crate::{Force, InitialSurface, Model};

/// The [`Equations`] of a step, with what memory and surface tell.
pub(super) struct StageEquations<'a> {
    model: &'a Model,
    apex: &'a Apex,
    surface: &'a InitialSurface,
    stretch: &'a Stretch,
    /// Position of the tip at the start of the step.
    x: f64,
    equations: Equations,
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

/// What one look at the groove tells.
struct Look {
    /// d - hAv
    residual: Stages,
    past_curvature: Stages,
    u0_curvature: Stages,
    own: OwnGroove,
}

impl<'a> StageEquations<'a> {
    /// For the step (t, h) that begins with the spring extended by the third number, rt - x0.
    #[inline]
    pub(super) fn new(
        (model, apex): (&'a Model, &'a Apex),
        (surface, stretch): (&'a InitialSurface, &'a Stretch),
        force: &Force,
        (t, h, extension): (f64, f64, f64),
    ) -> Self {
        let law = Law::of(model);
        // At the end of a step the force is its limit from before: it may jump there.
        let last = (t + h).next_down();
        let mut pull = law.pull(extension, h);
        for (pull, c) in pull.iter_mut().zip(RADAU.c) {
            *pull += force.value((t + h * c).min(last));
        }
        let x = model.r() * t - extension;
        Self { model, apex, surface, stretch, x, equations: Equations::new(law, h, pull) }
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
                factors = Factors::of(self.equations.jacobian(
                    &look.past_curvature,
                    &look.u0_curvature,
                    &look.own,
                ));
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
        let own = OwnGroove::near(self.apex, self.model.tip(), d);
        let (mut u0_slope, mut u0_curvature) = ([0.0; STAGES], [0.0; STAGES]);
        for i in 0..STAGES {
            (u0_slope[i], u0_curvature[i]) =
                self.surface.slope_and_curvature_on(self.stretch, self.x + d[i]);
        }
        let velocity = self.equations.velocity(d, &past_slope, &u0_slope, &own);
        let residual = self.equations.residual(d, &velocity);
        Look { residual, past_curvature, u0_curvature, own }
    }
}

impl Look {
    /// u_xx at the last node.
    fn curvature_at_end(&self, alpha: f64) -> f64 {
        self.u0_curvature[STAGES - 1] - alpha * self.past_curvature[STAGES - 1]
    }
}
