//! Patches of consecutive cells.

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

    /// Adds `factor` times `other` where the two overlap.
    pub(crate) fn add(&mut self, factor: f64, other: &Patch) {
        let first = self.first.max(other.first);
        let end = self.end().min(other.end());
        if first >= end {
            return;
        }
        let own = &mut self.values[(first - self.first) as usize..(end - self.first) as usize];
        let its = &other.values[(first - other.first) as usize..(end - other.first) as usize];
        for (own, its) in own.iter_mut().zip(its) {
            *own += factor * its;
        }
    }

    /// Σ own · other over the cells of both.
    pub(crate) fn overlap(&self, other: &Patch) -> f64 {
        let first = self.first.max(other.first);
        let end = self.end().min(other.end());
        if first >= end {
            return 0.0;
        }
        let own = &self.values[(first - self.first) as usize..(end - self.first) as usize];
        let its = &other.values[(first - other.first) as usize..(end - other.first) as usize];
        own.iter().zip(its).map(|(own, its)| own * its).sum()
    }

    /// Σ own · other over the same cells.
    pub(crate) fn dot(&self, other: &[f64]) -> f64 {
        self.values.iter().zip(other).map(|(a, b)| a * b).sum()
    }
}
