//! A long polynomial as steps: each of them its interpolant of degree s on a piece.

use super::chain::MOST_ORDER;
use super::length;
use crate::collocation::{RADAU, STAGES, Stages};
use crate::history::Step;
use crate::state::{Damaged, Reader, State};

/// Of one series at most.
pub(super) const MOST_PIECES: usize = 8;

/// Steps made, not yet handed out: the first `next` of `steps` have been.
#[derive(Debug, Clone)]
pub(super) struct Pieces {
    steps: [Step; MOST_PIECES],
    next: usize,
    end: usize,
}

impl Pieces {
    pub(super) fn none() -> Self {
        let zero = [0.0; STAGES];
        let nothing = Step { t: 0.0, h: 0.0, extension: 0.0, displacement: zero, height: None };
        Self { steps: [nothing; MOST_PIECES], next: 0, end: 0 }
    }

    pub(super) fn clear(&mut self) {
        (self.next, self.end) = (0, 0);
    }

    pub(super) fn push(&mut self, step: Step) {
        self.steps[self.end] = step;
        self.end += 1;
    }

    /// All that have not been handed out.
    pub(super) fn left(&self) -> &[Step] {
        &self.steps[self.next..self.end]
    }

    /// The next one; as far as `until`, if that is within it.
    pub(super) fn take(&mut self, until: f64, support: f64) -> Option<Step> {
        let step = *self.left().first()?;
        if until > step.t && until < step.end() {
            let (first, rest) = parted(&step, until, support);
            self.steps[self.next] = rest;
            return Some(first);
        }
        self.next += 1;
        Some(step)
    }

    pub(super) fn save(&self, state: &mut State) {
        state.steps(self.left().iter());
    }

    /// Of a tip that is at this time and so far behind its support.
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
        self.clear();
        steps.into_iter().for_each(|step| self.push(step));
        Ok(())
    }
}

/// The same polynomial as two steps.
fn parted(step: &Step, at: f64, support: f64) -> (Step, Step) {
    let h = at - step.t;
    let part = |from: f64, h: f64| {
        let before = RADAU.value(&step.displacement, from);
        RADAU.c.map(|c| RADAU.value(&step.displacement, from + c * h / step.h) - before)
    };
    let first = Step { h, displacement: part(0.0, h), ..*step };
    let rest = step.end() - first.end();
    let second = Step {
        t: first.end(),
        h: rest,
        extension: first.extension_at_end(support),
        displacement: part(h / step.h, rest),
        height: None,
    };
    (first, second)
}

/// The longest pieces, if they are equal, on which interpolation errs by at most `error`.
pub(super) fn longest(displacement: &[f64], length: f64, error: f64) -> f64 {
    let size = RADAU.interpolation_bound(steepest(displacement, length), 1.0);
    length::root(error, size, STAGES + 1)
}

/// The largest divided difference that interpolation leaves out: the derivative of order s + 1, over (s + 1)!, at
/// points of [0, length].
fn steepest(displacement: &[f64], length: f64) -> f64 {
    const AT: [f64; 4] = [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0];
    let t = AT.map(|at| at * length);
    let mut sums = [0.0; AT.len()];
    for (coefficient, binomial) in displacement.iter().zip(&BINOMIALS).skip(STAGES + 1).rev() {
        for (sum, t) in sums.iter_mut().zip(t) {
            *sum = *sum * t + binomial * coefficient;
        }
    }
    sums.iter().fold(0.0, |most: f64, sum| most.max(sum.abs()))
}

/// `k` over s + 1.
const BINOMIALS: [f64; MOST_ORDER + 1] = {
    let mut row = [0.0; MOST_ORDER + 1];
    let mut k = STAGES + 1;
    row[k] = 1.0;
    while k < MOST_ORDER {
        row[k + 1] = row[k] * (k + 1) as f64 / (k - STAGES) as f64;
        k += 1;
    }
    row
};

/// The polynomial at the nodes of a piece.
pub(super) fn nodes(displacement: &[f64], from: f64, h: f64) -> Stages {
    let t = RADAU.c.map(|c| from + c * h);
    let mut sums = [0.0; STAGES];
    for coefficient in displacement.iter().rev() {
        for (sum, t) in sums.iter_mut().zip(t) {
            *sum = *sum * t + coefficient;
        }
    }
    sums
}

/// A polynomial at the first of each pair.
pub(super) fn values(coefficients: &[f64], at: &[(f64, f64)], values: &mut [f64]) {
    const LANES: usize = 8;
    for (at, values) in at.chunks(LANES).zip(values.chunks_mut(LANES)) {
        let (mut t, mut sums) = ([0.0; LANES], [0.0; LANES]);
        t.iter_mut().zip(at).for_each(|(t, at)| *t = at.0);
        for coefficient in coefficients.iter().rev() {
            for (sum, t) in sums.iter_mut().zip(t) {
                *sum = *sum * t + coefficient;
            }
        }
        values.copy_from_slice(&sums[..values.len()]);
    }
}

/// A polynomial at one point.
pub(super) fn value(coefficients: &[f64], t: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * t + coefficient)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1/(1 + t) - 1, about 0: a pole at the distance 1.
    fn coefficients() -> Vec<f64> {
        (0..=20).map(|k| if k == 0 { 0.0 } else { (-1.0_f64).powi(k) }).collect()
    }

    #[test]
    fn pieces_as_long_as_said_interpolate_as_well_as_asked() {
        let (length, error) = (0.4, 1e-9);
        let piece = longest(&coefficients(), length, error);
        let worst = |h: f64| {
            let nodes = nodes(&coefficients(), 0.0, h);
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
    fn a_step_in_two_parts_is_the_same_motion() {
        let displacement = RADAU.c.map(|c| c * (1.0 - 0.3 * c * c));
        let step = Step { t: 2.0, h: 0.5, extension: 1.1, displacement, height: None };
        let mut pieces = Pieces::none();
        pieces.push(step);
        let first = pieces.take(2.125, 0.9).unwrap();
        let rest = pieces.take(9.0, 0.9).unwrap();
        assert!(pieces.left().is_empty());
        assert!((first.end() - 2.125).abs() < 1e-15 && (rest.end() - step.end()).abs() < 1e-15);
        for i in 0..=50 {
            let t = 2.0 + 0.01 * f64::from(i);
            let part = if t < 2.125 { &first } else { &rest };
            assert!((part.l(0.9, t) - step.l(0.9, t)).abs() < 1e-14, "{t}");
        }
    }
}
