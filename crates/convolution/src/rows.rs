//! Parallel rows of cells, spread and evaluated together: sources and sums in two dimensions.

use std::ops::RangeInclusive;

use multiversion::multiversion;

use crate::lattice::Lattice;
use crate::window::{BELOW, WIDTH, Window};

/// Number of rows that are summed in SIMD lanes.
const LANES: usize = 4;

/// Rows of cells over the range of one [`Spectra`](crate::Spectra): densities of sources, or sums `S(x)`.
///
/// A source or a target at x uses the same sixteen cells with the same weights on all rows, so that the window is
/// evaluated once for all of them. Cells are stored column by column.
#[derive(Clone, Debug)]
pub struct Rows {
    window: &'static Window,
    lattice: Lattice,
    /// Index of the first cell of every row.
    first: i64,
    /// Number of rows; `stride` is this number rounded up to whole SIMD lanes.
    count: usize,
    stride: usize,
    cells: Vec<f64>,
}

impl Rows {
    /// Empty rows of this many cells from `first` on.
    pub(crate) fn new(spacing: f64, first: i64, length: usize, count: usize) -> Self {
        let (window, lattice) = (Window::shared(), Lattice::new(spacing));
        let stride = count.next_multiple_of(LANES);
        Self { window, lattice, first, count, stride, cells: vec![0.0; length * stride] }
    }

    /// Number of rows.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Valid positions of sources and targets.
    pub fn range(&self) -> RangeInclusive<f64> {
        let length = self.cells.len() / self.stride.max(1);
        let at = |cell: i64| (self.first + cell) as f64 * self.lattice.spacing;
        at(WIDTH as i64)..=at(length as i64 - 1 - WIDTH as i64)
    }

    /// Adds a source at x, with one weight for each of the rows from `row` on.
    ///
    /// # Panics
    /// The position is outside of the range, or there are more weights than rows.
    pub fn add(&mut self, x: f64, row: usize, weights: &[f64]) {
        let (start, offset) = self.locate(x);
        let window = self.window.weights(offset);
        let columns = self.cells[start * self.stride..].chunks_exact_mut(self.stride);
        for (column, window) in columns.zip(window) {
            let column = &mut column[row..row + weights.len()];
            column.iter_mut().zip(weights).for_each(|(cell, weight)| *cell += window * weight);
        }
    }

    /// `S(x)` and `dS/dx` of the rows from `row` on, as many as `values` holds; 0 beyond the last row.
    ///
    /// # Panics
    /// The position is outside of the range.
    pub fn read(&self, x: f64, row: usize, values: &mut [f64], slopes: &mut [f64]) {
        let (start, offset) = self.locate(x);
        let (window, mut steep) = self.window.weights_and_slopes(offset);
        steep.iter_mut().for_each(|steep| *steep *= self.lattice.per_unit);
        values.fill(0.0);
        slopes.fill(0.0);
        let rows = values.len().min(self.stride.saturating_sub(row));
        let cells = &self.cells[start * self.stride + row..];
        sums((cells, self.stride), (&window, &steep), &mut values[..rows], &mut slopes[..rows]);
    }

    /// The first of the sixteen cells of a position, and the offset of the position from its own cell.
    fn locate(&self, x: f64) -> (usize, f64) {
        let (cell, offset) = self.lattice.locate(x);
        let start = usize::try_from(cell - BELOW - self.first).unwrap_or(usize::MAX);
        let columns = self.cells.len() / self.stride.max(1);
        assert!(start <= columns.saturating_sub(WIDTH), "{x} outside of {:?}", self.range());
        (start, offset)
    }

    pub(crate) fn copy(&self, row: usize, out: &mut [f64]) {
        let cells = self.cells[row..].iter().step_by(self.stride);
        out.iter_mut().zip(cells).for_each(|(out, cell)| *out = *cell);
    }

    pub(crate) fn set(&mut self, row: usize, from: &[f64]) {
        let cells = self.cells[row..].iter_mut().step_by(self.stride);
        cells.zip(from).for_each(|(cell, from)| *cell = *from);
    }
}

/// Sums over the columns of cells times their weights, separately for each row.
///
/// Also compiled for wider vectors: every row is a separate sum in the order of the columns, so that the bits are the
/// same.
#[multiversion(targets("x86_64+avx2"))]
fn sums(
    (cells, stride): (&[f64], usize),
    (window, steep): (&[f64; WIDTH], &[f64; WIDTH]),
    values: &mut [f64],
    slopes: &mut [f64],
) {
    let blocks = values.chunks_mut(2 * LANES).zip(slopes.chunks_mut(2 * LANES));
    for (block, (values, slopes)) in blocks.enumerate() {
        let from = 2 * LANES * block;
        let (mut value, mut slope) = ([0.0; 2 * LANES], [0.0; 2 * LANES]);
        for k in 0..WIDTH {
            let column = &cells[k * stride + from..];
            match column.first_chunk::<{ 2 * LANES }>() {
                Some(column) if values.len() == 2 * LANES => {
                    for i in 0..2 * LANES {
                        value[i] += window[k] * column[i];
                        slope[i] += steep[k] * column[i];
                    }
                }
                _ => {
                    for i in 0..values.len() {
                        value[i] += window[k] * column[i];
                        slope[i] += steep[k] * column[i];
                    }
                }
            }
        }
        for i in 0..values.len() {
            (values[i], slopes[i]) = (value[i], slope[i]);
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::{Density, Spectra};

    /// Of each row by itself: a density with its field.
    #[test]
    fn rows_are_densities_and_fields_side_by_side() {
        let mut spectra = Spectra::new(8.7, -15.0, 40.0);
        let sources: Vec<(f64, f64)> = (0..60)
            .map(|j| (25.0 * (0.618 * f64::from(j)).fract(), 0.3 + (0.7 * f64::from(j)).sin()))
            .collect();
        let mut rows = spectra.rows(13);
        let shares = [0.2, 1.0, -0.7, 0.4];
        for (x, weight) in &sources {
            rows.add(*x, 6, &shares.map(|share| share * weight));
        }
        let mut density = Density::new(spectra.spacing());
        sources.iter().for_each(|(x, weight)| density.add(*x, *weight));
        let alone = spectra.of(&density);
        let k: Vec<f64> = spectra.wave_numbers().collect();
        let smooth = |k: &f64| (-0.5 * k * k).exp();
        let alone: Vec<_> = alone.iter().zip(&k).map(|(rho, k)| rho * smooth(k)).collect();
        let field = spectra.field(&alone);
        let mut fields = spectra.rows(13);
        for row in 0..13 {
            let spectrum = spectra.of_row(&rows, row);
            let spectrum: Vec<_> =
                spectrum.iter().zip(&k).map(|(rho, k)| rho * smooth(k)).collect();
            spectra.set_row(&mut fields, row, &spectrum);
        }
        assert_eq!(fields.count(), 13);
        for x in [-3.0, 0.123, 7.77, 12.5, 31.0] {
            let (wanted, wanted_slope) = field.value_and_derivative(x);
            // From any row on, in any number.
            for (row, count) in [(0, 13), (3, 9), (5, 16), (7, 1)] {
                let (mut values, mut slopes) = (vec![9.0; count], vec![9.0; count]);
                fields.read(x, row, &mut values, &mut slopes);
                for i in 0..count {
                    let share = (row + i).checked_sub(6).and_then(|i| shares.get(i));
                    let share = share.copied().unwrap_or(0.0);
                    let miss = (values[i] - share * wanted).abs();
                    let miss_of_slope = (slopes[i] - share * wanted_slope).abs();
                    assert!(miss < 1e-13 && miss_of_slope < 1e-12, "{x} {row} {i}: {miss:e}");
                }
            }
        }
    }

    #[test]
    #[should_panic(expected = "outside of")]
    fn a_source_outside_is_refused() {
        Spectra::new(8.7, 0.0, 10.0).rows(3).add(1e4, 0, &[1.0]);
    }
}
