//! Elimination of linear parameters at every value of the others: variable projection (Golub and Pereyra 1973).

use nalgebra::{DMatrix, DVector};

/// The projection of data on the span of some columns.
#[derive(Debug, Clone)]
pub(crate) struct Projected {
    /// Coefficient of each column.
    pub(crate) coefficients: Vec<f64>,
    /// Residuals of the data.
    pub(crate) residuals: Vec<f64>,
    /// An orthonormal basis of the columns, extended by the rows of the ridge.
    basis: DMatrix<f64>,
}

impl Projected {
    /// The projection on no columns.
    pub(crate) fn nothing(residuals: Vec<f64>) -> Self {
        Self { coefficients: vec![], residuals, basis: DMatrix::zeros(0, 0) }
    }

    /// The component of these values orthogonal to the columns. If the values are c_k ∂columns_k, the component is
    /// Kaufman's (1975) derivative of the residuals, except for its sign.
    pub(crate) fn beyond(&self, mut values: Vec<f64>) -> Vec<f64> {
        for column in self.basis.column_iter() {
            let column = &column.as_slice()[..values.len()];
            let along: f64 = column.iter().zip(&values).map(|(a, b)| a * b).sum();
            values.iter_mut().zip(column).for_each(|(v, q)| *v -= along * q);
        }
        values
    }
}

/// Ridge parameter: a column in the span of the others gets a coefficient close to 0, without an effect on the
/// others.
const RIDGE: f64 = 1e-9;

/// Least squares of `Σ_k c_k columns_k` to the data by a QR factorisation; `None` if a value is not finite.
pub(crate) fn project(columns: &[Vec<f64>], data: &[f64]) -> Option<Projected> {
    let (rows, count) = (data.len(), columns.len());
    let sizes: Vec<f64> = columns
        .iter()
        .map(|column| column.iter().map(|v| v * v).sum::<f64>().sqrt().max(f64::MIN_POSITIVE))
        .collect();
    let mut matrix = DMatrix::zeros(rows + count, count);
    for (k, (column, size)) in columns.iter().zip(&sizes).enumerate() {
        for (i, value) in column.iter().enumerate() {
            matrix[(i, k)] = value / size;
        }
        matrix[(rows + k, k)] = RIDGE;
    }
    let mut right = DVector::zeros(rows + count);
    right.rows_mut(0, rows).copy_from_slice(data);
    let factors = matrix.qr();
    factors.q_tr_mul(&mut right);
    let scaled = factors.r().solve_upper_triangular(&right.rows(0, count))?;
    let coefficients: Vec<f64> = scaled.iter().zip(&sizes).map(|(c, size)| c / size).collect();
    if !coefficients.iter().all(|c| c.is_finite()) {
        return None;
    }
    let mut residuals = data.to_vec();
    for (column, c) in columns.iter().zip(&coefficients) {
        residuals.iter_mut().zip(column).for_each(|(left, v)| *left -= c * v);
    }
    Some(Projected { coefficients, residuals, basis: factors.q() })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A straight line is found from its points; a duplicate column does not change the others.
    #[test]
    fn what_columns_make_up_is_found() {
        let x: Vec<f64> = (0..9).map(f64::from).collect();
        let data: Vec<f64> = x.iter().map(|x| 2.0 - 0.5 * x).collect();
        let ones = vec![1.0; 9];
        let found = project(&[ones.clone(), x.clone()], &data).unwrap();
        assert!((found.coefficients[0] - 2.0).abs() < 1e-12);
        assert!((found.coefficients[1] + 0.5).abs() < 1e-12);
        assert!(found.residuals.iter().all(|v| v.abs() < 1e-12));
        let twins = project(&[ones.clone(), x, ones], &data).unwrap();
        assert!((twins.coefficients[0] + twins.coefficients[2] - 2.0).abs() < 1e-9);
        assert!(twins.residuals.iter().all(|v| v.abs() < 1e-9));
        assert!(project(&[vec![f64::NAN; 9]], &data).is_none());
    }
}
