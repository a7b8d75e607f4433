//! Patches of consecutive cells.

use std::ops::Range;

/// Values at the cells `first`, `first` + 1, …; 0 elsewhere.
#[derive(Debug, Clone, Default)]
pub(crate) struct Patch {
    pub(crate) first: i64,
    pub(crate) values: Vec<f64>,
}

impl Patch {
    /// Sets `len` cells to 0, and reuses the storage.
    pub(crate) fn reset(&mut self, first: i64, len: usize) {
        self.first = first;
        self.values.clear();
        self.values.resize(len, 0.0);
    }

    /// One past the last cell.
    pub(crate) fn end(&self) -> i64 {
        self.first + self.values.len() as i64
    }

    /// The value at a cell; `None` outside of the patch.
    pub(crate) fn at(&self, cell: i64) -> Option<f64> {
        self.values.get(usize::try_from(cell - self.first).ok()?).copied()
    }

    /// The places in `values` of the cells `first` to `end`; empty unless `first` is below `end`.
    fn places(&self, first: i64, end: i64) -> Range<usize> {
        if first < end { (first - self.first) as usize..(end - self.first) as usize } else { 0..0 }
    }

    /// Adds `factor` times `other` where the two overlap.
    pub(crate) fn add(&mut self, factor: f64, other: &Patch) {
        let (first, end) = (self.first.max(other.first), self.end().min(other.end()));
        let own = self.places(first, end);
        let its = &other.values[other.places(first, end)];
        for (own, its) in self.values[own].iter_mut().zip(its) {
            *own += factor * its;
        }
    }

    /// Σ own · other over the cells of both.
    pub(crate) fn overlap(&self, other: &Patch) -> f64 {
        let (first, end) = (self.first.max(other.first), self.end().min(other.end()));
        let own = &self.values[self.places(first, end)];
        let its = &other.values[other.places(first, end)];
        own.iter().zip(its).map(|(own, its)| own * its).sum()
    }

    /// Σ own · other over the same cells.
    pub(crate) fn dot(&self, other: &[f64]) -> f64 {
        self.values.iter().zip(other).map(|(a, b)| a * b).sum()
    }
}
