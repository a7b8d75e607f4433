//! The embedded system of the modes, `z_j' = 1 + s_j x0' z_j`, by an explicit method.

use super::case::Case;
use differential_equations::prelude::*;
use stickslip_tip::memory::{Fit, Retreat, Term, accuracy_needed};
use stickslip_tip::{InitialSurface, MemoryChoice, Model};

/// l at the ends of the steps.
pub(super) struct Solved {
    pub(super) l: Vec<(f64, f64)>,
    pub(super) evaluations: u64,
}

/// `None` where the method gives up.
pub(super) fn solve(case: &Case, tolerance: f64) -> Option<Solved> {
    let model = case.model();
    let fit = Fit::cached(model.tip(), accuracy_needed(&model, tolerance), Retreat::Small).ok()?;
    let terms = fit.terms();
    // The state has its size at compile time: fast, and enough sizes to waste little.
    match terms.len() {
        0..=6 => embedded::<13>(case, &model, terms, tolerance),
        7..=9 => embedded::<19>(case, &model, terms, tolerance),
        10..=12 => embedded::<25>(case, &model, terms, tolerance),
        13..=20 => embedded::<41>(case, &model, terms, tolerance),
        _ => embedded::<81>(case, &model, terms, tolerance),
    }
}

struct Embedded<'a> {
    model: &'a Model,
    surface: InitialSurface,
    terms: &'a [Term],
}

fn embedded<const D: usize>(
    case: &Case,
    model: &Model,
    terms: &[Term],
    tolerance: f64,
) -> Option<Solved> {
    let scenario = case.scenario(tolerance, MemoryChoice::Modes);
    let surface = scenario.initial_surface().ok()?;
    let system = Embedded { model, surface, terms };
    let (start, mut state) = (scenario.start_time(), [0.0; D]);
    state[0] = model.steady_l() + case.kick;
    // Factors as for our own control: the share of a step, and of what the motion amplifies.
    let method =
        ExplicitRungeKutta::dop853().rtol(0.0).atol(0.05 * tolerance).max_steps(10_000_000);
    let solution = IVP::ode(&system, start, case.until, state).method(method).solve().ok()?;
    let l = solution.t.iter().zip(&solution.y).map(|(t, y)| (*t, y[0])).collect();
    Some(Solved { l, evaluations: solution.evals.function as u64 })
}

/// y = (l, Re z_1, Im z_1, …)
impl<const D: usize> ODE<f64, [f64; D]> for Embedded<'_> {
    fn diff(&self, t: f64, y: &[f64; D], dydt: &mut [f64; D]) {
        let (r, alpha) = (self.model.r(), self.model.alpha());
        let x = r * t - r - y[0];
        let past: f64 = self
            .terms
            .iter()
            .zip(y[1..].chunks_exact(2))
            .map(|(term, z)| term.weight.re * z[0] - term.weight.im * z[1])
            .sum();
        let velocity = alpha * past - self.surface.slope_and_curvature(x).0 + y[0] + r;
        dydt[0] = r - velocity;
        let states = y[1..].chunks_exact(2).zip(dydt[1..].chunks_exact_mut(2));
        for (term, (z, rate)) in self.terms.iter().zip(states) {
            let (re, im) = (velocity * term.exponent.re, velocity * term.exponent.im);
            rate[0] = 1.0 + re * z[0] - im * z[1];
            rate[1] = re * z[1] + im * z[0];
        }
    }
}
