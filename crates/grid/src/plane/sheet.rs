//! The cells of the plane that the tip has reached so far.

use crate::patch::Patch;
use std::collections::VecDeque;

/// Values at the cells (i, j), column by column. Each column i has the cells j that were written; all others are 0.
#[derive(Debug, Default)]
pub(super) struct Sheet {
    first: i64,
    columns: VecDeque<Patch>,
}

impl Sheet {
    pub(super) fn add(&mut self, column: i64, values: &Patch) {
        let own = self.column(column);
        cover(own, values);
        own.add(1.0, values);
    }

    /// Σ along(i) across(j) cell(i, j): the value of a product of two stencils.
    pub(super) fn read(&self, along: &Patch, across: &Patch) -> f64 {
        let column =
            |(i, weight): (i64, &f64)| self.get(i).map_or(0.0, |c| weight * c.overlap(across));
        (along.first..).zip(&along.values).map(column).sum()
    }

    pub(super) fn at(&self, column: i64, j: i64) -> f64 {
        self.get(column).and_then(|own| own.at(j)).unwrap_or(0.0)
    }

    pub(super) fn scale(&mut self, factor: f64) {
        let cells = self.columns.iter_mut().flat_map(|column| &mut column.values);
        cells.for_each(|cell| *cell *= factor);
    }

    fn get(&self, column: i64) -> Option<&Patch> {
        self.columns.get(usize::try_from(column - self.first).ok()?)
    }

    fn column(&mut self, i: i64) -> &mut Patch {
        if self.columns.is_empty() {
            self.first = i;
        }
        while i < self.first {
            self.columns.push_front(Patch::default());
            self.first -= 1;
        }
        let index = (i - self.first) as usize;
        if index >= self.columns.len() {
            self.columns.resize_with(index + 1, Patch::default);
        }
        &mut self.columns[index]
    }
}

/// Extends a column to the cells of another; new cells are 0.
fn cover(own: &mut Patch, other: &Patch) {
    if own.values.is_empty() {
        own.reset(other.first, other.values.len());
        return;
    }
    if other.first < own.first {
        let missing = (own.first - other.first) as usize;
        own.values.splice(0..0, std::iter::repeat_n(0.0, missing));
        own.first = other.first;
    }
    let len = (other.end().max(own.end()) - own.first) as usize;
    own.values.resize(len, 0.0);
}
