//! Test functions, which change sign at special points.

use super::place::Place;
use crate::Cycle;
use num_complex::Complex;

/// Multipliers with a smaller imaginary part are real.
const REAL: f64 = 1e-9;

fn is_real(m: &Complex<f64>) -> bool {
    m.im.abs() < REAL
}

/// Numbers of multipliers outside the unit circle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Counts {
    /// Real ones below -1.
    pub(super) below: usize,
    /// Real ones above 1, except that of a shift in time.
    pub(super) above: usize,
    /// Complex ones outside the circle.
    pub(super) around: usize,
}

impl Counts {
    pub(super) fn of(cycle: &Cycle) -> Self {
        let count = |which: &dyn Fn(&Complex<f64>) -> bool| {
            cycle.nontrivial_multipliers().filter(which).count()
        };
        Self {
            below: count(&|m| is_real(m) && m.re < -1.0),
            above: count(&|m| is_real(m) && m.re > 1.0),
            around: count(&|m| !is_real(m) && m.norm() > 1.0),
        }
    }
}

/// det(M + 1), M the monodromy matrix: zero where a multiplier is -1.
pub(super) fn doubling(place: &Place) -> f64 {
    place.cycle.multipliers.iter().map(|m| m + 1.0).product::<Complex<f64>>().re
}

/// det(M - 1) without the factor that is always zero: zero where a second multiplier is 1.
pub(super) fn second_one(place: &Place) -> f64 {
    place.cycle.nontrivial_multipliers().map(|m| m - 1.0).product::<Complex<f64>>().re
}

/// The modulus of the largest complex multiplier, less 1.
pub(super) fn circle(place: &Place) -> f64 {
    let complex = place.cycle.nontrivial_multipliers().filter(|m| !is_real(m));
    complex.map(|m| m.norm()).fold(0.0, f64::max) - 1.0
}

/// The change of the parameter along the branch: zero at a fold.
pub(super) fn fold(place: &Place) -> f64 {
    place.tangent.parameter
}

/// l at the start less l half a period later. Positive where the start is the highest maximum; zero where
/// the cycle vanishes, or its halves become the same.
pub(super) fn difference_of_halves(cycle: &Cycle) -> f64 {
    cycle.motion().l(0.0) - cycle.motion().l(0.5 * cycle.period())
}
