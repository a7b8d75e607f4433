//! Measured series (x_i, y_i) from a user's file, checked before their interpolation by a spline.

use thiserror::Error;

/// Errors in a series. Rows are counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum SeriesError {
    /// Columns of different lengths.
    #[error("the columns have {0} and {1} rows: each row is a pair")]
    Uneven(usize, usize),
    /// Fewer than three rows, which a spline needs.
    #[error("{0} rows were found: at least 3 are needed")]
    Short(usize),
    /// A row that is not finite.
    #[error("row {0} is not a pair of finite numbers")]
    NotFinite(usize),
    /// A first column that does not increase.
    #[error("row {row} has {value} in its first column: it must increase from row to row")]
    Unsorted {
        /// Number of the row.
        row: usize,
        /// Value in this row.
        value: f64,
    },
}

/// Checks that a spline can interpolate the series.
pub(crate) fn checked(x: Vec<f64>, y: Vec<f64>) -> Result<(Vec<f64>, Vec<f64>), SeriesError> {
    if x.len() != y.len() {
        return Err(SeriesError::Uneven(x.len(), y.len()));
    }
    let rows = x.len();
    if rows < 3 {
        return Err(SeriesError::Short(rows));
    }
    if let Some(i) = (0..rows).find(|&i| !(x[i].is_finite() && y[i].is_finite())) {
        return Err(SeriesError::NotFinite(i + 1));
    }
    if let Some(i) = (1..rows).find(|&i| x[i] <= x[i - 1]) {
        return Err(SeriesError::Unsorted { row: i + 1, value: x[i] });
    }
    Ok((x, y))
}
