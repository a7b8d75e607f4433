//! The leading Floquet multipliers for a history of hundreds of exponentials: the period map is applied to a few
//! deviations instead of all.
//!
//! The tip is kicked at several times of a period. A block Krylov space is built from the effects at its end, because
//! these are deviations that correspond to a history of the tip. The projection of the period map on this space
//! (Rayleigh-Ritz) has accurate leading multipliers long before the others. Multipliers on which two successive spaces
//! agree are returned.

use super::carved::Carved;
use super::embedding::{Embedding, Parameter};
use super::linearisation::along;
use super::orbit::Orbit;
use super::past::{Grooves, Past};
use super::sensitivity::Sensitivity;
use super::solve::Closed;
use super::step::{Factors, LinearStep, OfStages};
use nalgebra::DMatrix;
use num_complex::Complex;
use std::sync::Arc;
use stickslip_tip::eigenvalues;
use stickslip_tip::sorting::sort_by_number;

/// Number of kicks, and of deviations that are carried through a period together.
const BLOCK: usize = 8;
/// Largest dimension of the space.
const MOST_DIMENSIONS: usize = 320;
/// Growth factor of the dimension between computations of the multipliers.
const GROWTH: f64 = 1.2;
/// Largest difference of a returned multiplier between the last two spaces.
const AGREED: f64 = 1e-8;
/// Largest difference of a returned multiplier if the space has its largest dimension.
const NEARLY: f64 = 1e-4;
/// A part of a deviation outside the present space is round-off if it is below this fraction of the deviation.
const HELD: f64 = 1e-11;

/// The multipliers in the fine sum, by decreasing modulus: those above `least`, and others if available. `None` if the
/// equations are singular, or after a request to stop.
pub(super) fn leading(closed: &Closed, least: f64) -> Option<Vec<Complex<f64>>> {
    let Closed { equation, orbit, .. } = closed;
    let map = PeriodMap::new(equation, orbit);
    let past = map.past()?;
    let grooves = past.grooves(!orbit.heights.is_empty());
    let history = (&past, &grooves);
    let mut space = DMatrix::zeros(map.len(), 0);
    let mut images = space.clone();
    let mut block = outside(&space, map.kicks(history)?);
    let (mut before, mut looked_at) = (vec![], 0.0);
    loop {
        let image = map.of(history, &block)?;
        (space, images) = (beside(&space, &block), beside(&images, &image));
        block = outside(&space, image);
        let (is_closed, is_full) = (block.ncols() == 0, space.ncols() + BLOCK > MOST_DIMENSIONS);
        if !is_closed && !is_full && (space.ncols() as f64) < GROWTH * looked_at {
            continue;
        }
        looked_at = space.ncols() as f64;
        let mut found = sorted(space.tr_mul(&images))?;
        let is_told = |m: &Complex<f64>, within: f64| {
            before.iter().any(|other: &Complex<f64>| (m - other).norm() <= within)
        };
        // That of a shift in time is always among them.
        let mut wanted = found.iter().take_while(|m| m.norm() > least).peekable();
        let enough = wanted.peek().is_some() && wanted.all(|m| is_told(m, AGREED));
        if is_closed {
            return Some(found);
        }
        if enough || is_full {
            let within = if enough { AGREED } else { NEARLY };
            found.retain(|m| is_told(m, within));
            return Some(found);
        }
        before = found;
    }
}

/// The eigenvalues of a matrix, by decreasing modulus.
pub(super) fn sorted(matrix: DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let mut found = eigenvalues(matrix)?;
    // Both of a pair have the same modulus to the last bit, and stay in their order.
    sort_by_number(&mut found, |item| -item.norm());
    Some(found)
}

/// The map from deviations of the state at the start of a period to those at its end.
struct PeriodMap<'a> {
    /// The equations, linearised in the fine sum.
    equation: Embedding,
    orbit: &'a Orbit,
    carved: Vec<Carved>,
}

impl<'a> PeriodMap<'a> {
    fn new(equation: &Embedding, orbit: &'a Orbit) -> Self {
        Self {
            equation: Embedding { short: Arc::clone(&equation.fine), ..equation.clone() },
            orbit,
            carved: orbit.carved(&equation.wider),
        }
    }

    fn past(&self) -> Option<Past<'_>> {
        Past::of(&self.equation.short, (self.orbit, &self.carved))
    }

    fn len(&self) -> usize {
        self.equation.state_len()
    }

    /// The deviations after a period, one per column.
    fn of(&self, history: (&Past, &Grooves), block: &DMatrix<f64>) -> Option<DMatrix<f64>> {
        let (mut state, mut passing) = (Sensitivity::of(block), Passing::default());
        let carry = |_, step: &LinearStep, share: f64| passing.carry(step, share, &mut state);
        along(&self.equation, (self.orbit, &self.carved), history, carry).ok()?;
        Some(state.columns())
    }

    /// Deviations at the end of a period after a shift of the tip by 1 at evenly spaced steps.
    fn kicks(&self, history: (&Past, &Grooves)) -> Option<DMatrix<f64>> {
        let steps = self.orbit.stages.len();
        let mut state = Sensitivity::of(&DMatrix::zeros(self.len(), BLOCK));
        let mut passing = Passing::default();
        let carry = |n, step: &LinearStep, share: f64| {
            for kick in (0..BLOCK).filter(|kick| kick * steps / BLOCK == n) {
                state.set_column(kick, history.0.of_step(n).moved_on());
            }
            passing.carry(step, share, &mut state)
        };
        along(&self.equation, (self.orbit, &self.carved), history, carry).ok()?;
        Some(state.columns())
    }
}

/// What a step needs only while the state is carried over it.
#[derive(Default)]
struct Passing {
    stages: OfStages,
    factors: Factors,
}

impl Passing {
    fn carry(&mut self, step: &LinearStep, share: f64, state: &mut Sensitivity) -> Option<()> {
        let Self { stages, factors } = self;
        stages.clear();
        step.carry((Parameter::Alpha, share), state, stages, factors)
    }
}

/// Two matrices side by side.
fn beside(left: &DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    let columns: Vec<_> = left.column_iter().chain(right.column_iter()).collect();
    if columns.is_empty() { left.clone() } else { DMatrix::from_columns(&columns) }
}

/// An orthonormal basis of the part of these columns outside the space.
fn outside(space: &DMatrix<f64>, columns: DMatrix<f64>) -> DMatrix<f64> {
    let mut basis = space.clone();
    for column in columns.column_iter() {
        let size = column.norm();
        let mut left = column.into_owned();
        // Once more: the first time leaves round-off of what was large.
        for _ in 0..2 {
            left -= &basis * basis.tr_mul(&left);
        }
        let rest = left.norm();
        if rest > HELD * size {
            basis = beside(&basis, &DMatrix::from_columns(&[left / rest]));
        }
    }
    basis.columns(space.ncols(), basis.ncols() - space.ncols()).into_owned()
}
