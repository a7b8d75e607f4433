//! Sources, spread over a lattice that grows to hold them.

use multiversion::multiversion;
use std::ops::Range;

use crate::lattice::Lattice;
use crate::window::{BELOW, WIDTH, Window};

/// The density of all sources so far, `D_i = Σ_j w_j φ((i − y_j/spacing)/8)`, on the cells `i` of a lattice that is
/// extended in both directions as sources are added. Cell `i` is at position `i · spacing`.
///
/// Sums are compensated (Kahan): a tip that sticks adds a million sources to the same few cells,
/// where plain sums drift by as many roundings, all of one sign. The error of a cell is then two
/// roundings of `Σ|w|`, whatever the number of sources.
///
/// Storage is doubled on growth, so that `n` calls of [`add`](Self::add) cost O(n). Memory is sixteen bytes per cell
/// between the first and the last source, times four at most.
#[derive(Clone, Debug)]
pub struct Density {
    window: &'static Window,
    lattice: Lattice,
    sums: Vec<f64>,
    /// Compensation: the difference of each sum from its exact value.
    excess: Vec<f64>,
    /// Index of the cell in `sums[0]`.
    first: i64,
    /// The cells that sources have changed; the storage may be larger.
    touched: Range<i64>,
}

impl Density {
    /// An empty density on the lattice with the given spacing: that of a [`Plan`](crate::Plan), or any positive
    /// number with few significant bits.
    pub fn new(spacing: f64) -> Self {
        Self {
            window: Window::shared(),
            lattice: Lattice::new(spacing),
            sums: Vec::new(),
            excess: Vec::new(),
            first: 0,
            touched: 0..0,
        }
    }

    /// Makes room for sources between two positions, before the first source.
    pub fn reserve(&mut self, (from, to): (f64, f64)) {
        if self.sums.is_empty() && from <= to {
            self.first = self.lattice.locate(from).0 - BELOW;
            let cells = self.lattice.locate(to).0 - BELOW + WIDTH as i64 - self.first;
            self.sums = vec![0.0; cells as usize];
            self.excess = vec![0.0; cells as usize];
        }
    }

    /// The distance between cells.
    pub fn spacing(&self) -> f64 {
        self.lattice.spacing
    }

    /// The cells changed by sources; empty before the first.
    pub fn range(&self) -> Range<i64> {
        self.touched.clone()
    }

    /// Adds a source of the given weight.
    ///
    /// The position must be finite, and so close to the other sources that the cells between them fit in memory.
    #[inline]
    pub fn add(&mut self, position: f64, weight: f64) {
        debug_assert!(position.is_finite(), "a source at {position}");
        let (cell, offset) = self.lattice.locate(position);
        let start = cell - BELOW;
        if start < self.touched.start || start + WIDTH as i64 > self.touched.end {
            self.touch(start);
        }
        let at = (start - self.first) as usize;
        let (Some(sums), Some(excess)) =
            (self.sums[at..].first_chunk_mut(), self.excess[at..].first_chunk_mut())
        else {
            unreachable!("the sixteen cells have been touched")
        };
        spread(self.window, (sums, excess), offset, weight);
    }

    /// Multiplies all sources so far by a factor.
    pub fn scale(&mut self, factor: f64) {
        self.sums.iter_mut().chain(&mut self.excess).for_each(|sum| *sum *= factor);
    }

    /// Copies the cells from `first_cell` on into `out`, with zeros beyond the sources.
    pub fn copy_window(&self, first_cell: i64, out: &mut [f64]) {
        let end = first_cell + out.len() as i64;
        let from = self.touched.start.clamp(first_cell, end);
        let to = self.touched.end.clamp(from, end);
        let (head, rest) = out.split_at_mut((from - first_cell) as usize);
        let (body, tail) = rest.split_at_mut((to - from) as usize);
        head.fill(0.0);
        tail.fill(0.0);
        if from < to {
            let at = (from - self.first) as usize;
            body.copy_from_slice(&self.sums[at..at + body.len()]);
        }
    }

    /// Removes all cells outside of `cells`, and releases their memory.
    pub fn keep(&mut self, cells: &Range<i64>) {
        let start = self.touched.start.clamp(cells.start, cells.end);
        let end = self.touched.end.clamp(start, cells.end.max(start));
        if start == self.touched.start && end == self.touched.end {
            return;
        }
        let kept = (start - self.first) as usize..(end - self.first) as usize;
        self.sums = self.sums[kept.clone()].to_vec();
        self.excess = self.excess[kept].to_vec();
        (self.first, self.touched) = (start, start..end);
    }

    /// The complete state of the density: first cell, sums and their compensation, cell by cell.
    pub fn parts(&self) -> (i64, &[f64], &[f64]) {
        let at = (self.touched.start - self.first) as usize;
        let held = at..at + (self.touched.end - self.touched.start) as usize;
        (self.touched.start, &self.sums[held.clone()], &self.excess[held])
    }

    /// The density with these [`parts`](Self::parts); `None` if they are inconsistent.
    pub fn from_parts(spacing: f64, first: i64, sums: Vec<f64>, excess: Vec<f64>) -> Option<Self> {
        let touched = first..first + sums.len() as i64;
        let same = sums.len() == excess.len();
        same.then(|| Self { sums, excess, first, touched, ..Self::new(spacing) })
    }

    /// Moves the origin of positions and cells by `cells`: cell `i` becomes `i − cells`, position `x` becomes `x −
    /// cells · spacing`. Exact, and without copying.
    ///
    /// The lattice is exact far from the origin, but positions are rounded to one part in 2⁵³ of their distance from
    /// it. A [`Field`](crate::Field) has its own `rebase`.
    pub fn rebase(&mut self, cells: i64) {
        self.first -= cells;
        self.touched = self.touched.start - cells..self.touched.end - cells;
    }

    /// Extends the lattice to the sixteen cells from `start` on.
    #[cold]
    fn touch(&mut self, start: i64) {
        let end = start + WIDTH as i64;
        if self.touched.is_empty() {
            self.touched = start..end;
        }
        if self.sums.is_empty() {
            self.first = start;
        }
        self.touched = self.touched.start.min(start)..self.touched.end.max(end);
        let doubled = 2 * self.sums.len();
        if start < self.first {
            let more = ((self.first - start) as usize).max(self.sums.len());
            self.first -= more as i64;
            prepend_zeros(&mut self.sums, more);
            prepend_zeros(&mut self.excess, more);
        }
        let needed = (self.touched.end - self.first) as usize;
        if needed > self.sums.len() {
            self.sums.resize(needed.max(doubled), 0.0);
            self.excess.resize(needed.max(doubled), 0.0);
        }
    }
}

/// Also compiled for wider vectors: each cell is a separate sum, so that the bits are the same.
#[multiversion(targets("x86_64+avx2"))]
fn spread(
    window: &Window,
    (sums, excess): (&mut [f64; WIDTH], &mut [f64; WIDTH]),
    offset: f64,
    weight: f64,
) {
    accumulate(sums, excess, &window.weights(offset), weight);
}

/// One compensated addition per cell; a separate function, so that the compiler can assume distinct arrays.
#[inline(always)]
fn accumulate(
    sums: &mut [f64; WIDTH],
    excess: &mut [f64; WIDTH],
    weights: &[f64; WIDTH],
    weight: f64,
) {
    for k in 0..WIDTH {
        let term = weight * weights[k] - excess[k];
        let next = sums[k] + term;
        excess[k] = (next - sums[k]) - term;
        sums[k] = next;
    }
}

fn prepend_zeros(values: &mut Vec<f64>, count: usize) {
    let old = values.len();
    values.resize(old + count, 0.0);
    values.copy_within(..old, count);
    values[..count].fill(0.0);
}
