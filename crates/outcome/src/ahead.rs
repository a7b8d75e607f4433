//! Slope of the groove ahead of the tip.

use crate::merged::merged;
use num_complex::Complex64;
use std::sync::Arc;
use stickslip_tip::TipFunction;
use stickslip_tip::elementary::{log10, pow};
use stickslip_tip::exponential::with_inverses;
use stickslip_tip::memory::{Fit, POINTS, Retreat, slopes_of};

/// ∫ f'(ξ + X - x0(t')) dt' at distances ξ ahead of a tip at X: by a sum of exponentials for f' if an accurate one
/// exists, else as a sum over visits, with neighbouring visits merged.
pub(crate) struct Ahead<'a> {
    tip: &'a TipFunction,
    /// Positions of the visits relative to the tip, and their durations; empty if there is a sum.
    visits: Vec<(f64, f64)>,
    sum: Option<Sum>,
}

/// `Σ_j Re(z_j e^{s_j ξ})`
struct Sum {
    fit: Arc<Fit>,
    states: Vec<Complex64>,
}

/// Smallest error required of a sum of exponentials; for tables a better one may not exist.
const FINEST: f64 = 1e-12;

impl<'a> Ahead<'a> {
    /// The slope for visits at these distances behind the tip, with these durations, within reach of a point ahead;
    /// the sum may have an error of `allowed`.
    pub(crate) fn new(tip: &'a TipFunction, visits: Vec<(f64, f64)>, allowed: f64) -> Self {
        let lasted: f64 = visits.iter().map(|(_, weight)| weight).sum();
        let nearest = visits.iter().fold(0.0, |m: f64, (x, _)| m.min(*x));
        // A power of ten as in the table of fits that come with the program.
        let wanted = pow(10.0, log10(allowed / lasted).floor());
        let fit =
            if wanted >= FINEST { Fit::cached(tip, wanted, Retreat::Small).ok() } else { None };
        let sum = fit.filter(|fit| nearest >= -fit.retreat()).map(|fit| Sum::new(fit, &visits));
        let visits = if sum.is_none() { merged(visits, tip.widths(1.0)) } else { vec![] };
        let visits = visits.into_iter().map(|(behind, weight)| (-behind, weight)).collect();
        Self { tip, visits, sum }
    }

    /// The slopes at these distances ahead.
    pub(crate) fn slopes(&self, ahead: &[f64; POINTS]) -> [f64; POINTS] {
        match &self.sum {
            Some(sum) => ahead.map(|ahead| sum.at(ahead)),
            None => slopes_of(&self.visits, self.tip, ahead),
        }
    }
}

impl Sum {
    fn new(fit: Arc<Fit>, visits: &[(f64, f64)]) -> Self {
        let mut states: Vec<_> = fit.terms().iter().map(|_| Complex64::ZERO).collect();
        let mut room = [vec![], vec![]];
        for (x, weight) in visits {
            let e = exponentials(&fit, *x, &mut room);
            states.iter_mut().zip(e).for_each(|(state, e)| *state += e * *weight);
        }
        states.iter_mut().zip(fit.terms()).for_each(|(state, term)| *state *= term.weight);
        Self { fit, states }
    }

    fn at(&self, ahead: f64) -> f64 {
        let mut room = [vec![], vec![]];
        let e = exponentials(&self.fit, ahead, &mut room);
        self.states.iter().zip(e).map(|(state, e)| (state * e).re).sum()
    }
}

/// e^{s x} for each term.
fn exponentials<'a>(fit: &Fit, x: f64, room: &'a mut [Vec<Complex64>; 2]) -> &'a [Complex64] {
    let [e, inverse] = room;
    e.clear();
    e.extend(fit.terms().iter().map(|term| term.exponent * x));
    inverse.resize(e.len(), Complex64::ZERO);
    with_inverses(e, inverse);
    e
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comparison of the sum of exponentials with the definition, a sum over visits.
    #[test]
    fn the_sum_of_exponentials_is_the_sum_over_visits() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let visits: Vec<_> =
            (0..200).map(|i| (0.04 * f64::from(i), 1.0 + f64::from(i).sin())).collect();
        let lasted: f64 = visits.iter().map(|v| v.1).sum();
        // Judged by the definition.
        let visited = |ahead: f64, visits: &[(f64, f64)]| -> f64 {
            visits.iter().map(|(x, weight)| weight * tip.slope(ahead + x)).sum()
        };
        let places = [0.0, 0.2, 0.7, 1.6, 2.8, 4.4, 7.0, 9.8];
        for allowed in [1e-3, 1e-6, 1e-8] {
            let ahead = Ahead::new(&tip, visits.clone(), allowed);
            assert!(ahead.sum.is_some());
            for (at, slope) in places.into_iter().zip(ahead.slopes(&places)) {
                let off = (slope - visited(at, &visits)).abs();
                assert!(off <= allowed, "{off:e} at {at}, allowed {allowed:e}");
            }
        }
        // What no sum is good enough for is added up visit by visit.
        let retreated: Vec<_> = visits.iter().map(|(x, w)| (x - 3.0, *w)).collect();
        for (visits, allowed) in [(&visits, 1e-13 * lasted), (&retreated, 1e-6)] {
            let ahead = Ahead::new(&tip, visits.clone(), allowed);
            assert!(ahead.sum.is_none());
            for (at, slope) in places.into_iter().zip(ahead.slopes(&places)) {
                let off = (slope - visited(at, visits)).abs();
                assert!(off <= 1e-14 * lasted, "{off:e} at {at}");
            }
        }
    }
}
