//! The range across the scan of all past positions within reach.

use crate::state::{Damaged, Reader, State};
use std::collections::VecDeque;

/// Number of bins per reach that combine positions.
const BINS: f64 = 16.0;

/// Lowest and highest y of past positions, by their x.
#[derive(Debug, Clone)]
pub(super) struct Extent {
    reach: f64,
    bins: VecDeque<Bin>,
}

#[derive(Debug, Clone, Copy)]
struct Bin {
    /// x of the first and of the farthest-forward position.
    first: f64,
    last: f64,
    low: f64,
    high: f64,
}

impl Extent {
    /// An empty range for a footprint of this reach.
    pub(super) fn new(reach: f64) -> Self {
        Self { reach, bins: VecDeque::new() }
    }

    pub(super) fn reach(&self) -> f64 {
        self.reach
    }

    pub(super) fn save(&self, state: &mut State) {
        let numbers = self.bins.iter().flat_map(|bin| [bin.first, bin.last, bin.low, bin.high]);
        let numbers: Vec<f64> = numbers.collect();
        state.numbers(numbers.into_iter());
    }

    pub(super) fn restore(&mut self, state: &mut Reader) -> Result<(), Damaged> {
        let numbers = state.numbers()?;
        let (bins, rest) = numbers.as_chunks::<4>();
        if !rest.is_empty() {
            return Err(Damaged::OutOfRange);
        }
        let bin = |[first, last, low, high]: &[f64; 4]| Bin {
            first: *first,
            last: *last,
            low: *low,
            high: *high,
        };
        self.bins = bins.iter().map(bin).collect();
        Ok(())
    }

    pub(super) fn bins(&self) -> usize {
        self.bins.len()
    }

    /// Adds positions up to x with y in this range.
    pub(super) fn add(&mut self, x: f64, (low, high): (f64, f64)) {
        let length = self.reach / BINS;
        match self.bins.back_mut() {
            Some(bin) if x <= bin.first + length => {
                bin.last = bin.last.max(x);
                (bin.low, bin.high) = (bin.low.min(low), bin.high.max(high));
            }
            _ => self.bins.push_back(Bin { first: x, last: x, low, high }),
        }
    }

    /// The range in y of all positions within the reach of a tip at x, if there are any. Positions farther behind are
    /// removed.
    pub(super) fn about(&mut self, x: f64) -> Option<(f64, f64)> {
        while self.bins.front().is_some_and(|bin| bin.last < x - self.reach) {
            self.bins.pop_front();
        }
        let ranges = self.bins.iter().map(|bin| (bin.low, bin.high));
        ranges.reduce(|(low, high), (a, b)| (low.min(a), high.max(b)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_is_that_of_the_visits_within_reach() {
        let (mut extent, reach) = (Extent::new(10.0), 10.0);
        let visit = |i: u32| (0.1 * f64::from(i), (0.05 * f64::from(i)).sin());
        for i in 0..2000 {
            let (x, y) = visit(i);
            extent.add(x, (y, y));
            let (low, high) = extent.about(x).unwrap();
            // Bins end no sooner than their visits, and no later than by one bin.
            let within = |reach: f64| (0..=i).map(visit).filter(move |v| v.0 >= x - reach);
            assert!(within(reach).all(|(_, y)| low <= y && y <= high));
            let longer: Vec<f64> = within(reach * (1.0 + 1.01 / BINS)).map(|v| v.1).collect();
            assert!(longer.iter().any(|y| *y <= low) && longer.iter().any(|y| *y >= high));
            assert!(extent.bins.len() < 20);
        }
    }
}
