//! The Floquet multipliers: eigenvalues of the monodromy matrix.
//!
//! The sum of exponentials that stands for f has states that no past of f leads to, and their multipliers,
//! e^{s rT} or thereabouts. Where these have not faded after a period they are told from those of f by another
//! sum, which has others; of sums of hundreds, whose [leading](super::leading) multipliers alone are had, those below
//! them are left out.

use super::embedding::Embedding;
use super::lattice;
use super::leading::{leading, sorted};
use super::solve::Closed;
use nalgebra::DMatrix;
use num_complex::Complex;
use std::sync::Arc;
use stickslip_tip::TipFunction;
use stickslip_tip::memory::{Fit, accuracy_needed};

/// What is left of an exponential after a period need not be told from multipliers if it is below this.
const FADED: f64 = 1e-3;
/// Of hundreds of exponentials the multipliers above this are had.
const LEADING: f64 = 1e-2;
/// Displacement that the other sum may bring about, and its most waves.
const ACCURACY_OF_ANOTHER: f64 = 1e-6;
const MOST_WAVES_OF_ANOTHER: usize = 160;
/// Fine sums of so many terms are dealt with as a whole.
const MOST_TERMS: usize = 64;
/// Multipliers in both sums differ by no more, absolutely and in parts of them.
const SAME: (f64, f64) = (1e-4, 1e-2);

/// By falling modulus, of a pair the one above the real axis first. `None` where there are none to be had.
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
    // What grows is of the motion, whatever told it.
    found.retain(|m| m.norm() >= 1.0 - SAME.1 || others.iter().any(|other| near(m, other)));
    Some(found)
}

/// In the short sum; under a depth limit in the fine one, as heights are forgotten more slowly than slopes.
fn monodromy(closed: &Closed) -> Option<DMatrix<f64>> {
    let Embedding { wider, fine, .. } = &closed.equation;
    if wider.depth_limit.is_some() && fine.terms().len() <= MOST_TERMS {
        return closed.monodromy_in(fine);
    }
    Some(closed.monodromy())
}

fn another(equation: &Embedding) -> Option<Arc<Fit>> {
    let wanted = accuracy_needed(&equation.model()?, ACCURACY_OF_ANOTHER);
    lattice::fit(&equation.tip, wanted, MOST_WAVES_OF_ANOTHER).ok()
}

/// What is left at this distance of the exponential that lasts longest.
fn slowest_left(fit: &Fit, distance: f64) -> f64 {
    fit.terms().iter().map(|term| (term.exponent.re * distance).exp()).fold(0.0, f64::max)
}
