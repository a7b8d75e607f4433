//! Reduction of diverged parameters of the extended model to the range in which they have an effect on the data.
//!
//! A search may end with a healing time of 1e30, where neither this value nor a change of it has an effect. From such a
//! value no search finds the interval of the healing time, nor the parts of other intervals at shorter healing times.

use super::parameters::Name;
use super::problem::Problem;
use crate::least_squares::{Minimum, minimum};

/// Largest increase of χ² by the reduction.
const LOST: f64 = 0.05;
/// Largest number of steps, each by a factor of 2.
const MOST_STEPS: usize = 24;

/// The best fit, or a nearly equal one with diverged parameters reduced as far as possible.
pub(super) fn retreated(problem: &Problem, mut best: Minimum) -> Minimum {
    let freedom = (problem.rows() as f64 - problem.parameters() as f64).max(1.0);
    for (i, name) in problem.free.iter().enumerate() {
        // Where the law is as good as without it, and on which side of that it is felt.
        let (unfelt, side) = match name {
            Name::DepthLimit | Name::HealingTime => (1e4_f64, -1.0),
            Name::Inertia => (1e-5, 1.0),
            _ => continue,
        };
        let most = best.sum * (1.0 + LOST / freedom);
        let ran_off = best.parameters[i];
        let first = if side < 0.0 { ran_off.min(unfelt.ln()) } else { ran_off.max(unfelt.ln()) };
        for step in 0..MOST_STEPS {
            let at = first + side * 2_f64.ln() * step as f64;
            if (at - ran_off).abs() <= 0.0 {
                continue;
            }
            match held_at(problem, &best, i, at).filter(|found| found.sum <= most) {
                Some(found) => best = found,
                None => break,
            }
        }
    }
    best
}

/// The best fit with the i-th parameter fixed, started from `best`.
fn held_at(problem: &Problem, best: &Minimum, i: usize, at: f64) -> Option<Minimum> {
    let mut others = best.parameters.clone();
    others.remove(i);
    let mut found = minimum(&problem.holding(i, at.exp()), &others)?;
    found.parameters.insert(i, at);
    Some(found)
}
