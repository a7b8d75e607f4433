//! Weights of a sum of exponentials by least squares, in real arithmetic.

use crate::elementary::complex_exp;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex;

/// The weights `w_j` for which `Σ_j Re(w_j e^{s_j ξ})` is nearest to the samples (ξ, f'(ξ)).
///
/// A pair of exponents is two real columns, `Re e^{sξ}` and `-Im e^{sξ}`; in complex arithmetic the weights
/// would lose the symmetry of the pair, and with it four digits.
pub(super) fn weights(
    exponents: &[Complex<f64>],
    samples: &[(f64, f64)],
) -> Option<Vec<Complex<f64>>> {
    let columns: usize = exponents.iter().map(columns_of).sum();
    let mut matrix = DMatrix::zeros(samples.len(), columns);
    for (row, (xi, _)) in samples.iter().enumerate() {
        let mut column = 0;
        for s in exponents {
            let value = complex_exp(s * xi);
            matrix[(row, column)] = value.re;
            if columns_of(s) == 2 {
                matrix[(row, column + 1)] = -value.im;
            }
            column += columns_of(s);
        }
    }
    // Fast and slow exponentials differ in size: the solution is that of columns of one size.
    let sizes: Vec<f64> = matrix.column_iter().map(|c| c.norm().max(f64::MIN_POSITIVE)).collect();
    for (mut column, size) in matrix.column_iter_mut().zip(&sizes) {
        column /= *size;
    }
    let qr = matrix.qr();
    let mut right = DVector::from_iterator(samples.len(), samples.iter().map(|(_, y)| *y));
    qr.q_tr_mul(&mut right);
    let right = right.rows(0, columns).into_owned();
    let solution = qr.unpack_r().solve_upper_triangular(&right)?;
    let mut scaled = solution.iter().zip(&sizes).map(|(w, size)| w / size);
    exponents
        .iter()
        .map(|s| {
            let re = scaled.next()?;
            let im = if columns_of(s) == 2 { scaled.next()? } else { 0.0 };
            (re.is_finite() && im.is_finite()).then_some(Complex::new(re, im))
        })
        .collect()
}

/// One for a real exponent, two for a pair.
fn columns_of(s: &Complex<f64>) -> usize {
    if s.im.abs() > 0.0 { 2 } else { 1 }
}
