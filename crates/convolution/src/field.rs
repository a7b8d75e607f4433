//! The sum on a window of the lattice, evaluated at any position in it.

use std::ops::RangeInclusive;

use crate::Plan;
use crate::lattice::Lattice;
use crate::window::{BELOW, WIDTH, Window};

/// `S(x)` on one window, computed by [`Convolver::convolve`](crate::Convolver::convolve).
///
/// Evaluation changes nothing, so that any number of threads may evaluate simultaneously. An empty field
/// ([`Field::new`]) takes the size of its first window, and is reused without allocation.
#[derive(Clone, Debug)]
pub struct Field {
    window: &'static Window,
    lattice: Lattice,
    cells: Vec<f64>,
    first: i64,
    margin: f64,
}

impl Default for Field {
    fn default() -> Self {
        Self::new()
    }
}

impl Field {
    /// An empty field.
    pub fn new() -> Self {
        let (window, lattice) = (Window::shared(), Lattice::new(1.0));
        Self { window, lattice, cells: Vec::new(), first: 0, margin: 0.0 }
    }

    /// The field with these cells from `first` on, valid wherever it can be evaluated.
    pub(crate) fn of_cells(spacing: f64, first: i64, cells: Vec<f64>) -> Self {
        let (window, lattice) = (Window::shared(), Lattice::new(spacing));
        let margin = (WIDTH / 2) as f64 * spacing;
        Self { window, lattice, cells, first, margin }
    }

    /// The targets at which the sum is valid: those at least [`Plan::margin`] inside the window.
    pub fn range(&self) -> RangeInclusive<f64> {
        let position = |cell: i64| cell as f64 * self.lattice.spacing;
        let last = self.first + self.cells.len() as i64 - 1;
        position(self.first) + self.margin..=position(last) - self.margin
    }

    /// The first cell of the window, as passed to [`Convolver::convolve`](crate::Convolver::convolve).
    pub fn first_cell(&self) -> i64 {
        self.first
    }

    /// The sum `S(x)`.
    ///
    /// # Panics
    /// `x` is not at least 8 cells inside the window. Inside the window but outside of [`range`](Self::range) the value
    /// lacks the sources outside the window.
    #[inline]
    pub fn value(&self, x: f64) -> f64 {
        self.value_and_derivative(x).0
    }

    /// The sum `S(x)` and its derivative `dS/dx`.
    ///
    /// # Panics
    /// As [`value`](Self::value).
    #[inline]
    pub fn value_and_derivative(&self, x: f64) -> (f64, f64) {
        let (cell, offset) = self.lattice.locate(x);
        let start = usize::try_from(cell - BELOW - self.first).unwrap_or(usize::MAX);
        let cells = self.cells.get(start..).and_then(|rest| rest.first_chunk::<WIDTH>());
        let Some(cells) = cells else { self.outside(x) };
        let (value, slope) = self.window.read(cells, offset);
        (value, slope * self.lattice.per_unit)
    }

    /// Moves the origin of positions by `cells`, as [`Density::rebase`](crate::Density::rebase) does.
    pub fn rebase(&mut self, cells: i64) {
        self.first -= cells;
    }

    /// Allocates the window of a plan; earlier values are lost.
    pub(crate) fn reset(&mut self, plan: &Plan, first_cell: i64) -> &mut [f64] {
        self.lattice = Lattice::new(plan.spacing);
        self.first = first_cell;
        self.margin = plan.margin();
        self.cells.resize(plan.length, 0.0);
        &mut self.cells
    }

    #[cold]
    fn outside(&self, x: f64) -> ! {
        panic!("target {x} outside the window, good for {:?}", self.range())
    }
}
