//! The Floquet multipliers: eigenvalues of the monodromy matrix.
//!
//! The sum of exponentials for f has states that correspond to no history; their multipliers are approximately e^{s
//! rT}. If these have not decayed after a period, a second sum with other exponents separates them from the
//! multipliers of f. For sums of hundreds of terms only the [leading](super::leading) multipliers are available, and
//! those below them are left out.

use super::embedding::Embedding;
use super::lattice;
use super::leading::{leading, sorted};
use super::linearisation::Linearisation;
use super::solve::Closed;
use nalgebra::DMatrix;
use num_complex::Complex;
use std::sync::Arc;
use stickslip_tip::TipFunction;
use stickslip_tip::memory::{Fit, accuracy_needed};

/// An exponential that decays below this in a period needs no separation from the multipliers.
const FADED: f64 = 1e-3;
/// Smallest multiplier computed for sums of hundreds of exponentials.
const LEADING: f64 = 1e-2;
/// Largest displacement of the tip by the residual of the second sum.
const ACCURACY_OF_ANOTHER: f64 = 1e-6;
/// Largest number of waves of the second sum.
const MOST_WAVES_OF_ANOTHER: usize = 160;
/// Largest number of terms of a fine sum for which all eigenvalues are computed.
const MOST_TERMS: usize = 64;
/// Largest difference of a multiplier between the two sums, absolute and relative.
const SAME: (f64, f64) = (1e-4, 1e-2);

/// The multipliers by decreasing modulus; in a pair the one above the real axis comes first. `None` if they are not
/// available.
pub(super) fn multipliers(closed: &Closed) -> Option<Vec<Complex<f64>>> {
    let equation = &closed.equation;
    let healed = equation.wider.left_after(closed.orbit.period);
    let distance = equation.r * closed.orbit.period;
    if !equation.short_is_precise {
        let left = healed * slowest_left(&equation.fine, distance);
        let mut found = leading(closed, left.max(LEADING))?;
        found.retain(|m| m.norm() > left);
        return Some(found);
    }
    let mut found = sorted(monodromy(closed)?)?;
    let left = healed * slowest_left(&equation.short, distance);
    // The sum that stands for cos x is cos x.
    if left < FADED || equation.tip == TipFunction::Cosine {
        return Some(found);
    }
    let others = sorted(closed.monodromy_in(&another(equation)?)?)?;
    let near = |m: &Complex<f64>, other: &Complex<f64>| {
        (m - other).norm() <= SAME.0 + SAME.1 * m.norm().min(1.0)
    };
    // Growing deviations belong to the motion, whichever sum of exponentials gave them.
    found.retain(|m| m.norm() >= 1.0 - SAME.1 || others.iter().any(|other| near(m, other)));
    Some(found)
}

/// Largest modulus of the multipliers except that of a shift in time, in the sum of this linearisation; 0 if they are
/// not available.
pub(super) fn largest_multiplier(linearisation: &Linearisation) -> f64 {
    let Some(found) = sorted(linearisation.monodromy()) else { return 0.0 };
    without_shift(&found).map(|m| m.norm()).fold(0.0, f64::max)
}

/// These multipliers except that of a shift in time, the one nearest to 1.
pub(super) fn without_shift(all: &[Complex<f64>]) -> impl Iterator<Item = Complex<f64>> {
    let distance = |m: &Complex<f64>| (m - 1.0).norm();
    let nearest = (0..all.len()).min_by(|a, b| distance(&all[*a]).total_cmp(&distance(&all[*b])));
    all.iter().enumerate().filter(move |(i, _)| Some(*i) != nearest).map(|(_, m)| *m)
}

/// The monodromy matrix in the short sum; under a depth limit in the fine one, because heights decay more slowly than
/// slopes.
fn monodromy(closed: &Closed) -> Option<DMatrix<f64>> {
    let Embedding { wider, fine, .. } = &closed.equation;
    if wider.depth_limit.is_some() && fine.terms().len() <= MOST_TERMS {
        return closed.monodromy_in(fine);
    }
    Some(closed.linearisation.monodromy())
}

fn another(equation: &Embedding) -> Option<Arc<Fit>> {
    let wanted = accuracy_needed(&equation.model()?, ACCURACY_OF_ANOTHER);
    lattice::fit(&equation.tip, wanted, MOST_WAVES_OF_ANOTHER).ok()
}

/// Value at this distance of the exponential with the slowest decay.
fn slowest_left(fit: &Fit, distance: f64) -> f64 {
    fit.terms().iter().map(|term| (term.exponent.re * distance).exp()).fold(0.0, f64::max)
}
