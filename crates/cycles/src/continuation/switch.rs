//! From a period doubling to the branch of twice the period.

use super::place::{Place, solved_again};
use super::{Continuation, Special, SpecialKind};
use crate::CycleError;
use crate::change::{Change, Direction};
use crate::linearisation::Linearisation;
use crate::solve::{Closed, Condition, close};
use nalgebra::{DMatrix, DVector};

/// Deviations of the first cycle from the one that doubles, in widths, in the order in which they are tried.
const DEVIATIONS: [f64; 4] = [0.02, 0.06, 0.006, 0.2];
/// Halves whose difference is a smaller fraction of the deviation are the same.
const LEAST_SHARE: f64 = 0.1;
/// Steps of inverse iteration: the eigenvalue is known to nearly all digits.
const ITERATIONS: usize = 4;

/// The first cycle of the branch of twice the period.
pub(super) fn to_doubled(settings: &Continuation, special: &Special) -> Result<Place, CycleError> {
    let lost = CycleError::NotConverged { alpha: special.alpha, r: special.r };
    let cycle = special.cycle.as_ref().filter(|_| special.kind == SpecialKind::PeriodDoubling);
    let Closed { equation, orbit, linearisation, .. } =
        solved_again(cycle.ok_or(lost.clone())?, settings)?;
    let deviation = alternating(&linearisation).ok_or(lost.clone())?;
    let width = equation.width();
    // The higher maximum is to be the first.
    let unit = deviation.state[0].signum() / deviation.size();
    let first = DEVIATIONS.iter().find_map(|size| {
        let mut doubled = orbit.doubled();
        doubled.move_by(&deviation, size * width * unit);
        let condition = Condition { free: settings.over, fixed: Direction::L };
        let closed = close(equation.clone(), doubled, condition, settings.tolerance).ok()?;
        let apart = closed.orbit.difference_of_halves(equation.r);
        (apart > LEAST_SHARE * size * width).then_some(closed)
    });
    Place::new(first.ok_or(lost.clone())?, settings.over, &Direction::L).ok_or(lost)
}

/// The deviation that a period turns into its opposite, over two periods.
fn alternating(linearisation: &Linearisation) -> Option<Change> {
    let monodromy = linearisation.monodromy();
    let n = monodromy.nrows();
    // Shifted a little, so as not to be singular.
    let shifted = monodromy + DMatrix::identity(n, n) * (1.0 + 1e-9);
    let factorised = shifted.lu();
    let mut vector = DVector::from_element(n, 1.0);
    for _ in 0..ITERATIONS {
        vector = factorised.solve(&vector)?.normalize();
    }
    let mut change = linearisation.carried(vector.as_slice());
    for part in [&mut change.stages, &mut change.heights] {
        let opposite: Vec<_> = part.iter().map(|d| d.map(|d| -d)).collect();
        part.extend(opposite);
    }
    Some(change)
}
