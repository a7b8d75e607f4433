//! Conversion of a table (x, y, f) to layers: Gaussians on a lattice, first along x, then along y.

use super::{Across, Layer};
use crate::sorting::{ascending, sort_by_number, sort_numbers};
use crate::tip_function::table::{self, Lattice};
use crate::{Gaussian, TipFunction, TipFunctionError};

/// Largest number of rows of the lattice: each is a layer, and an image requires one surface u(x) per layer.
const MOST_ROWS_ACROSS: usize = 200;
/// Rows below this fraction of the largest value are round-off of the interpolation.
const NOTHING: f64 = 1e-17;

pub(super) fn layers_through(
    x: &[f64],
    y: &[f64],
    f: &[f64],
) -> Result<Vec<Layer>, TipFunctionError> {
    let grid = Grid::of(x, y, f)?;
    let largest = f.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    // Coefficients along x for every y, then along y for every x of the lattice.
    let columns = transposed(&grid.rows);
    let lattice = Lattice::through(&grid.x, &slices(&grid.rows));
    let lattice_across = Lattice::through(&grid.y, &slices(&columns));
    let along = lattice.coefficients(&slices(&grid.rows));
    let across = lattice_across.coefficients(&slices(&transposed(&along)));
    let layer = |k: usize| -> Option<Layer> {
        let along: Vec<f64> = across.iter().map(|column| column[k]).collect();
        let size = along.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
        if size <= NOTHING * largest {
            return None;
        }
        let terms: Vec<Gaussian> = lattice.gaussians(&along);
        let across =
            Across { center: k as f64 * lattice_across.spacing, width: lattice_across.width() };
        TipFunction::gaussian_sum(terms).ok().map(|along| Layer { along, across })
    };
    Ok((0..across[0].len()).filter_map(layer).collect())
}

fn transposed(rows: &[Vec<f64>]) -> Vec<Vec<f64>> {
    (0..rows[0].len()).map(|i| rows.iter().map(|row| row[i]).collect()).collect()
}

fn slices(rows: &[Vec<f64>]) -> Vec<&[f64]> {
    rows.iter().map(Vec::as_slice).collect()
}

/// Values of f on a full rectangular grid, one row for every y.
struct Grid {
    x: Vec<f64>,
    y: Vec<f64>,
    rows: Vec<Vec<f64>>,
}

impl Grid {
    fn of(x: &[f64], y: &[f64], f: &[f64]) -> Result<Self, TipFunctionError> {
        let points = x.len().min(y.len()).min(f.len());
        if points == 0 {
            let (min, max) = (table::MIN_ROWS, MOST_ROWS_ACROSS);
            return Err(TipFunctionError::TableLength { found: 0, min, max });
        }
        let bad = |i: &usize| !(x[*i].is_finite() && y[*i].is_finite() && f[*i].is_finite());
        if let Some(i) = (0..points).find(bad) {
            return Err(TipFunctionError::TableNotFinite { row: i + 1 });
        }
        let (xs, ys) = (distinct(x), distinct(y));
        if xs.len() * ys.len() != points {
            return Err(TipFunctionError::TableGrid { points, x: xs.len(), y: ys.len() });
        }
        let mut order = ascending(x);
        sort_by_number(&mut order, |i| y[*i]);
        let rows: Vec<Vec<f64>> =
            order.chunks(xs.len()).map(|row| row.iter().map(|&i| f[i]).collect()).collect();
        // A point given twice shifts another out of its row.
        let full = order.chunks(xs.len()).zip(&ys).all(|(row, at)| {
            row.iter().zip(&xs).all(|(&i, x_at)| same(x[i], *x_at) && same(y[i], *at))
        });
        if !full {
            return Err(TipFunctionError::TableGrid { points, x: xs.len(), y: ys.len() });
        }
        let grid = Self { x: xs, y: ys, rows };
        grid.validate()?;
        Ok(grid)
    }

    /// Checks both axes as for a table of f(x), and the decay at both ends.
    fn validate(&self) -> Result<(), TipFunctionError> {
        table::validate_axis(&self.x, table::MAX_ROWS)?;
        table::validate_axis(&self.y, MOST_ROWS_ACROSS)?;
        let size = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |m, v| v.abs().max(m));
        let largest = size(&mut self.rows.iter().flatten().copied());
        let last_x = size(&mut self.rows.iter().map(|row| row[row.len() - 1]));
        let last_y = size(&mut self.rows[self.rows.len() - 1].iter().copied());
        table::validate_decay(last_x.max(last_y), largest)
    }
}

/// The distinct values, in increasing order.
fn distinct(values: &[f64]) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sort_numbers(&mut sorted);
    sorted.dedup_by(|a, b| same(*a, *b));
    sorted
}

fn same(a: f64, b: f64) -> bool {
    (a - b).abs() <= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_table_without_rows_is_refused() {
        assert!(matches!(
            Grid::of(&[], &[], &[]).err(),
            Some(TipFunctionError::TableLength { found: 0, .. })
        ));
    }
}
