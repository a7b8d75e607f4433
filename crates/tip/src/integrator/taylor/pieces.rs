//! A long polynomial divided into steps: each is the interpolant of degree s (the number of stages) on a piece.

use super::chain::INVERSE;
use super::heights::Along;
use super::values::{BLOCK, Block, Table};
use crate::collocation::{RADAU, STAGES, Stages};
use crate::elementary::pow;
use crate::history::Step;
use crate::state::{Damaged, Reader, State};
use std::sync::OnceLock;

pub(crate) const MOST_PIECES: usize = 8;
/// Room for values at the nodes of all pieces.
pub(crate) const ROOM_FOR_NODES: [Block; (MOST_PIECES * STAGES).div_ceil(BLOCK)] =
    [[0.0; BLOCK]; (MOST_PIECES * STAGES).div_ceil(BLOCK)];

/// The steps of a series: those before `next` have been returned, the others have not.
#[derive(Debug, Clone, Default)]
pub(super) struct Pieces {
    steps: Vec<Step>,
    next: usize,
}

impl Pieces {
    pub(super) fn clear(&mut self) {
        self.steps.clear();
        self.next = 0;
    }

    pub(super) fn push(&mut self, step: Step) {
        self.steps.push(step);
    }

    /// The steps that have not been returned.
    pub(super) fn left(&self) -> &[Step] {
        &self.steps[self.next..]
    }

    /// The step that was returned last.
    pub(super) fn taken(&self) -> Option<&Step> {
        self.next.checked_sub(1).map(|last| &self.steps[last])
    }

    /// Returns the next step.
    pub(super) fn take(&mut self) -> Option<&Step> {
        let step = self.steps.get(self.next)?;
        self.next += 1;
        Some(step)
    }

    pub(super) fn save(&self, state: &mut State) {
        state.steps(self.left().iter());
    }

    /// Restores the steps for a tip at this time, with this extension of its spring.
    pub(super) fn restore(
        &mut self,
        state: &mut Reader,
        (mut t, extension): (f64, f64),
    ) -> Result<(), Damaged> {
        let steps = state.steps()?;
        let same = |a: f64, b: f64| a.to_bits() == b.to_bits();
        let first = steps.first().is_none_or(|step| same(step.extension, extension));
        let follows = |step: &Step| same(std::mem::replace(&mut t, step.end()), step.t);
        if steps.len() > MOST_PIECES || !first || !steps.iter().all(follows) {
            return Err(Damaged::OutOfRange);
        }
        *self = Self { steps, next: 0 };
        Ok(())
    }
}

/// The pieces of a step of length `total` from t as steps, from the displacements at the nodes of each. `extension` is
/// that of the spring at t, `support` the velocity of the support.
pub(crate) fn steps(
    (mut t, total): (f64, f64),
    (mut extension, support): (f64, f64),
    pieces: impl ExactSizeIterator<Item = Stages>,
    heights: Option<Along>,
) -> impl Iterator<Item = Step> {
    let (start, mut before, count) = (t, 0.0, pieces.len());
    pieces.enumerate().map(move |(i, positions)| {
        let part = (i + 1) as f64 / count as f64;
        // Ends are representable times.
        let end = if i + 1 < count { start + part * total } else { start + total };
        let mut displacement = positions;
        displacement.iter_mut().for_each(|position| *position -= before);
        let height = heights.map(|heights| heights.piece(i));
        let step = Step { t, h: end - t, extension, displacement, height };
        before = positions[STAGES - 1];
        (t, extension) = (step.end(), step.extension_at_end(support));
        step
    })
}

/// The longest fraction of a step that can be a piece with an interpolation error of at most `error`. The largest
/// divided difference of the step is `steepest`.
pub(crate) fn longest(steepest: f64, error: f64) -> f64 {
    pow(error / RADAU.interpolation_bound(steepest), INVERSE[STAGES + 1])
}

/// The least number of pieces of a step with an interpolation error of at most `error`; more than the largest number if
/// that does not suffice.
pub(crate) fn fewest(steepest: f64, error: f64) -> usize {
    let bound = RADAU.interpolation_bound(steepest);
    1 + SMALLER_BY.iter().filter(|smaller| bound > error * **smaller).count()
}

/// Factor by which the interpolation error of n pieces is smaller than that of one, from n = 1 on.
const SMALLER_BY: [f64; MOST_PIECES] = {
    let mut factors = [1.0; MOST_PIECES];
    let mut n = 1;
    while n <= MOST_PIECES {
        let mut power = 0;
        while power < STAGES + 1 {
            factors[n - 1] *= n as f64;
            power += 1;
        }
        n += 1;
    }
    factors
};

/// The nodes of all pieces of a step, as fractions of the step.
#[derive(Debug)]
pub(crate) struct Nodes {
    pub(crate) parts: Vec<f64>,
    pub(crate) table: Table,
}

/// The nodes of a step in this number of pieces, made at their first use, because no run needs all.
pub(crate) fn nodes(pieces: usize) -> &'static Nodes {
    static NODES: [OnceLock<Nodes>; MOST_PIECES] = [const { OnceLock::new() }; MOST_PIECES];
    NODES[pieces - 1].get_or_init(|| Nodes::new(pieces))
}

impl Nodes {
    fn new(pieces: usize) -> Self {
        let piece = |i: usize| RADAU.c.map(|c| (i as f64 + c) / pieces as f64);
        let parts: Vec<f64> = (0..pieces).flat_map(piece).collect();
        Self { table: Table::of_parts(&parts), parts }
    }
}

/// A polynomial at one point.
pub(crate) fn value(coefficients: &[f64], t: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * t + coefficient)
}

#[cfg(test)]
mod tests {
    use super::super::series::Series;
    use super::super::values::Outlook;
    use super::*;

    /// 1/(1 + t) - 1, about 0: a pole at the distance 1.
    fn coefficients() -> [f64; 21] {
        std::array::from_fn(|k| if k == 0 { 0.0 } else { (-1.0_f64).powi(k as i32) })
    }

    fn series() -> Series {
        Series::of(&coefficients())
    }

    #[test]
    fn pieces_as_long_as_said_interpolate_as_well_as_asked() {
        let (length, error) = (0.4, 1e-9);
        let outlook = Outlook::of(&series().over(length));
        let piece = length * longest(outlook.steepest, error);
        let worst = |h: f64| {
            let nodes = RADAU.c.map(|c| value(&coefficients(), c * h));
            let miss = |i: i32| {
                let tau = f64::from(i) / 200.0;
                (RADAU.value(&nodes, tau) - value(&coefficients(), tau * h)).abs()
            };
            (0..200).map(miss).fold(0.0, f64::max)
        };
        assert!(worst(piece) <= 1.05 * error, "{piece}: {}", worst(piece));
        assert!(worst(1.5 * piece) > error);
    }

    #[test]
    fn nodes_of_pieces_are_those_of_each() {
        let (length, pieces) = (0.3, 3);
        let mut room = ROOM_FOR_NODES;
        let found = nodes(pieces).table.sums(&series().over(length), &mut room);
        assert_eq!(found.len(), pieces * STAGES);
        for (i, found) in found.iter().enumerate() {
            let from = (i / STAGES) as f64 * length / 3.0;
            let t = from + RADAU.c[i % STAGES] * length / 3.0;
            assert!((found - (1.0 / (1.0 + t) - 1.0)).abs() < 1e-11, "{i}: {found}");
        }
    }
}
