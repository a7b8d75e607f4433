//! Eigenvalues of a real matrix: balancing, reduction to its range, Hessenberg form, Francis's QR iteration.
//!
//! Matrices here are graded over dozens of orders of magnitude. Most of the exponentials that represent the past have
//! decayed after a period, and a monodromy matrix maps the whole state to the few directions in which a deviation
//! persists; the other eigenvalues are zero except for round-off. So the matrix is reduced to its range first: if the
//! columns of V are an orthonormal basis of the range, M V = V (Vᵀ M V), and the nonzero eigenvalues are those of the
//! small matrix Vᵀ M V. Every negligible entry is set to zero where it is detected, shifts change when they do not
//! help, and the number of iterations is bounded.
//!
//! References: Golub & Van Loan, *Matrix Computations*, sections 5.2 and 7.5; Parlett & Reinsch, Numer. Math.
//! 13, 293 (1969).

use crate::elementary::{exp2, log2};
use crate::stop;
use nalgebra::linalg::{Hessenberg, SymmetricEigen};
use nalgebra::{DMatrix, DVector, Dyn};
use num_complex::Complex;

/// Columns with a smaller norm, relative to that of the largest column, are round-off.
const ROUND_OFF: f64 = 1e-15;
/// Largest number of sweeps for one eigenvalue or pair; ordinary matrices need two or three.
const MOST_SWEEPS: usize = 90;
/// Number of unsuccessful sweeps after which one sweep uses exceptional shifts instead of those from the corner.
const SWEEPS_PER_STALL: usize = 10;
/// Number of sweeps after which an entry is compared with the norm of the matrix instead of its neighbours on the
/// diagonal.
const PATIENCE: usize = 40;

/// All eigenvalues, with an error of about the round-off of the norm of the balanced matrix. In a conjugate pair the
/// eigenvalue above the real axis is first. `None` if the matrix is not square, an entry is not finite, or the
/// iteration does not converge or is [interrupted](stop).
///
/// ```
/// use nalgebra::DMatrix;
/// let turn = DMatrix::from_row_slice(2, 2, &[0.0, -1.0, 1.0, 0.0]);
/// let found = stickslip_tip::eigenvalues(turn).unwrap();
/// assert!((found[0].im - 1.0).abs() < 1e-15 && (found[1].im + 1.0).abs() < 1e-15);
/// ```
pub fn eigenvalues(mut matrix: DMatrix<f64>) -> Option<Vec<Complex<f64>>> {
    let largest = matrix.amax();
    if !matrix.is_square() || !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    if largest <= 0.0 {
        return Some(vec![Complex::ZERO; matrix.nrows()]);
    }
    matrix /= largest;
    balance(&mut matrix);
    let rows = matrix.nrows();
    let basis = range(matrix.clone());
    let reduced = if basis.ncols() < rows {
        basis.tr_mul(&matrix).transpose().tr_mul(&basis)
    } else {
        matrix
    };
    let upper = if reduced.nrows() > 2 { Hessenberg::new(reduced).unpack_h() } else { reduced };
    let mut found = Deflation::new(upper).eigenvalues()?;
    found.resize(rows, Complex::ZERO);
    Some(found.into_iter().map(|value| value * largest).collect())
}

/// Eigenvalues and orthonormal eigenvectors of a symmetric matrix, of which the lower triangle is read; `None` if the
/// iteration does not converge.
pub fn symmetric_eigen(matrix: DMatrix<f64>) -> Option<SymmetricEigen<f64, Dyn>> {
    const MOST_ITERATIONS: usize = 1000;
    SymmetricEigen::try_new(matrix, f64::EPSILON, MOST_ITERATIONS)
}

/// An orthonormal basis of the span of the columns, by Gram-Schmidt, the largest column first.
fn range(mut left: DMatrix<f64>) -> DMatrix<f64> {
    let (rows, columns) = left.shape();
    let mut basis: Vec<DVector<f64>> = vec![];
    let mut least = 0.0;
    while basis.len() < columns {
        let sizes = left.column_iter().map(|column| column.norm());
        let largest = sizes.enumerate().max_by(|a, b| a.1.total_cmp(&b.1));
        let Some((at, size)) = largest.filter(|(_, size)| *size > least) else { break };
        if basis.is_empty() {
            least = ROUND_OFF * size;
        }
        let mut column: DVector<f64> = left.column(at).into_owned();
        // Once more: what round-off left of the others in it.
        for other in &basis {
            column -= other * other.dot(&column);
        }
        column.normalize_mut();
        let shares = left.tr_mul(&column);
        left -= &column * shares.transpose();
        basis.push(column);
    }
    if basis.is_empty() { DMatrix::zeros(rows, 0) } else { DMatrix::from_columns(&basis) }
}

/// Makes each row about as large as its column, by a diagonal similarity in powers of two.
fn balance(matrix: &mut DMatrix<f64>) {
    const MOST_ROUNDS: usize = 100;
    const GAIN: f64 = 0.95;
    for _ in 0..MOST_ROUNDS {
        let mut settled = true;
        for i in 0..matrix.nrows() {
            let beside = matrix[(i, i)].abs();
            let row = matrix.row(i).iter().map(|e| e.abs()).sum::<f64>() - beside;
            let column = matrix.column(i).iter().map(|e| e.abs()).sum::<f64>() - beside;
            if !(row.is_normal() && column.is_normal()) {
                continue;
            }
            // f² = row / column: both become their geometric mean.
            let factor = exp2((0.5 * (log2(row) - log2(column))).round().clamp(-200.0, 200.0));
            if column * factor + row / factor < GAIN * (column + row) {
                settled = false;
                matrix.row_mut(i).scale_mut(1.0 / factor);
                matrix.column_mut(i).scale_mut(factor);
            }
        }
        if settled {
            return;
        }
    }
}

/// A Hessenberg matrix whose upper left corner still contains unknown eigenvalues.
struct Deflation {
    h: DMatrix<f64>,
    norm: f64,
}

impl Deflation {
    fn new(h: DMatrix<f64>) -> Self {
        let norm = h.norm();
        Self { h, norm }
    }

    fn eigenvalues(mut self) -> Option<Vec<Complex<f64>>> {
        let mut found = vec![Complex::ZERO; self.h.nrows()];
        let (mut end, mut sweeps) = (self.h.nrows(), 0);
        while end > 0 {
            let start = self.start_of_block(end, sweeps > PATIENCE);
            match end - start {
                1 => found[start] = self.h[(start, start)].into(),
                2 => found[start..end].copy_from_slice(&self.pair(start)),
                _ if sweeps == MOST_SWEEPS || stop::is_requested() => return None,
                _ => {
                    sweeps += 1;
                    self.sweep(start, end, sweeps.is_multiple_of(SWEEPS_PER_STALL));
                    continue;
                }
            }
            (end, sweeps) = (start, 0);
        }
        Some(found)
    }

    /// Start of the last irreducible block; the entry that couples it to the rest is set to zero.
    fn start_of_block(&mut self, end: usize, in_a_hurry: bool) -> usize {
        for i in (1..end).rev() {
            let beside = self.h[(i, i)].abs() + self.h[(i - 1, i - 1)].abs();
            let scale = if in_a_hurry || beside <= 0.0 { self.norm } else { beside };
            if self.h[(i, i - 1)].abs() <= f64::EPSILON * scale {
                self.h[(i, i - 1)] = 0.0;
                return i;
            }
        }
        0
    }

    /// The eigenvalues of the two by two block that starts at row i.
    fn pair(&self, i: usize) -> [Complex<f64>; 2] {
        let (a, d) = (self.h[(i, i)], self.h[(i + 1, i + 1)]);
        let product = self.h[(i, i + 1)] * self.h[(i + 1, i)];
        let half = 0.5 * (a - d);
        let discriminant = half * half + product;
        if discriminant < 0.0 {
            let (re, im) = (0.5 * (a + d), (-discriminant).sqrt());
            return [Complex::new(re, im), Complex::new(re, -im)];
        }
        // The one farther from d, and by their product the other, so that nothing cancels.
        let far = half + discriminant.sqrt().copysign(half);
        let near = if far.abs() > 0.0 { d - product / far } else { d };
        [(d + far).into(), near.into()]
    }

    /// One double-shift step of the QR iteration on the block.
    fn sweep(&mut self, start: usize, end: usize, stalled: bool) {
        let mut column = self.first_column(start, end, stalled);
        for k in start..end - 1 {
            let rows = (end - k).min(3);
            if k > start {
                column =
                    std::array::from_fn(|i| if i < rows { self.h[(k + i, k - 1)] } else { 0.0 });
            }
            let Some((reflector, head)) = reflector(&column) else { continue };
            if k > start {
                self.h[(k, k - 1)] = head;
                (1..rows).for_each(|i| self.h[(k + i, k - 1)] = 0.0);
            }
            self.reflect(&reflector[..rows], k, (start, end));
        }
    }

    /// A multiple of the first column of (H - a)(H - b), with the shifts a and b.
    fn first_column(&self, start: usize, end: usize, stalled: bool) -> [f64; 3] {
        let h = |i: usize, k: usize| self.h[(i, k)];
        let last = end - 1;
        let (mut a, mut b) = (h(last, last), h(last - 1, last - 1));
        let mut product = h(last, last - 1) * h(last - 1, last);
        if stalled {
            // A pair beside the corner, at the distance of what couples it to the rest.
            let coupling = h(last, last - 1).abs() + h(last - 1, last - 2).abs();
            a += 0.75 * coupling;
            b = a;
            product = -0.4375 * coupling * coupling;
        }
        let (a, b) = (a - h(start, start), b - h(start, start));
        [
            (a * b - product) / h(start + 1, start) + h(start, start + 1),
            h(start + 1, start + 1) - h(start, start) - a - b,
            h(start + 2, start + 1),
        ]
    }

    /// Applies the reflection 1 - 2vvᵀ/vᵀv to the rows and to the columns from k on, within the block.
    fn reflect(&mut self, v: &[f64], k: usize, (start, end): (usize, usize)) {
        let factor = 2.0 / v.iter().map(|v| v * v).sum::<f64>();
        for column in k..end {
            let along: f64 = v.iter().enumerate().map(|(i, v)| v * self.h[(k + i, column)]).sum();
            for (i, v) in v.iter().enumerate() {
                self.h[(k + i, column)] -= factor * along * v;
            }
        }
        for row in start..(k + 4).min(end) {
            let along: f64 = v.iter().enumerate().map(|(i, v)| v * self.h[(row, k + i)]).sum();
            for (i, v) in v.iter().enumerate() {
                self.h[(row, k + i)] -= factor * along * v;
            }
        }
    }
}

/// The vector v of the reflection that maps a vector to a multiple of the first unit vector, and this multiple;
/// `None` for the zero vector.
fn reflector(vector: &[f64; 3]) -> Option<([f64; 3], f64)> {
    let scale = vector.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
    if scale <= 0.0 {
        return None;
    }
    let mut v = vector.map(|v| v / scale);
    let length = v.iter().map(|v| v * v).sum::<f64>().sqrt().copysign(v[0]);
    v[0] += length;
    Some((v, -length * scale))
}

#[cfg(test)]
mod tests {
    use super::*;
    use chacha20::ChaCha20Rng;
    use rand::{RngExt, SeedableRng};

    fn sorted(mut values: Vec<Complex<f64>>) -> Vec<Complex<f64>> {
        values.sort_by(|a, b| a.re.total_cmp(&b.re).then(a.im.total_cmp(&b.im)));
        values
    }

    /// Block diagonal of these values (pairs by the one above the axis), in a random basis of sheared axes.
    fn with_eigenvalues(upper: &[Complex<f64>], rng: &mut ChaCha20Rng) -> DMatrix<f64> {
        let n = upper.iter().map(|z| if z.im > 0.0 { 2 } else { 1 }).sum();
        let (mut matrix, mut i) = (DMatrix::zeros(n, n), 0);
        for z in upper {
            matrix[(i, i)] = z.re;
            if z.im > 0.0 {
                matrix[(i + 1, i + 1)] = z.re;
                (matrix[(i, i + 1)], matrix[(i + 1, i)]) = (z.im, -z.im);
                i += 1;
            }
            i += 1;
        }
        let basis = DMatrix::from_fn(n, n, |_, _| rng.random_range(-1.0..1.0)).qr().q();
        let shear = DMatrix::from_fn(n, n, |i, k| match k.cmp(&i) {
            std::cmp::Ordering::Less => 0.0,
            std::cmp::Ordering::Equal => 1.0,
            std::cmp::Ordering::Greater => rng.random_range(-0.3..0.3),
        });
        let basis = basis * shear;
        let inverse = basis.clone().try_inverse().unwrap();
        basis * matrix * inverse
    }

    #[test]
    fn known_eigenvalues_are_found() {
        let mut rng = ChaCha20Rng::seed_from_u64(1);
        for n in 1..=24 {
            let value = |i: usize, rng: &mut ChaCha20Rng| {
                let size = 10_f64.powf(-0.2 * i as f64);
                let im: f64 = rng.random_range(-1.0..1.0);
                Complex::new(size * rng.random_range(-1.0..1.0), (size * im).max(0.0))
            };
            let upper: Vec<_> = (0..n).map(|i| value(i, &mut rng)).collect();
            let wanted =
                upper.iter().flat_map(|z| if z.im > 0.0 { vec![*z, z.conj()] } else { vec![*z] });
            let found = sorted(eigenvalues(with_eigenvalues(&upper, &mut rng)).unwrap());
            for (a, b) in found.iter().zip(sorted(wanted.collect())) {
                assert!((a - b).norm() < 1e-11, "{n}: {a} for {b}");
            }
        }
    }

    /// What a monodromy matrix is: a few directions that matter, all others zero but for round-off, in
    /// scales dozens of orders apart.
    #[test]
    fn graded_matrices_of_low_rank_end() {
        let mut rng = ChaCha20Rng::seed_from_u64(2);
        for case in 0..400 {
            let n = 3 + case % 90;
            let rank = 1 + case % 7;
            let mut entry = |_: usize, _: usize| rng.random_range(-1.0..1.0);
            let (left, right) =
                (DMatrix::from_fn(n, rank, &mut entry), DMatrix::from_fn(rank, n, &mut entry));
            let mut matrix = left * right;
            let steepness = f64::from(u32::try_from(case % 5).unwrap());
            for i in 0..n {
                let scale = (-steepness * i as f64).exp2();
                matrix.row_mut(i).scale_mut(scale);
                matrix.column_mut(i).scale_mut(1.0 / scale);
            }
            let found = eigenvalues(matrix.clone()).unwrap();
            let trace: f64 = found.iter().map(|z| z.re).sum();
            let size = found.iter().map(|z| z.norm()).fold(1.0, f64::max);
            assert!((trace - matrix.trace()).abs() < 1e-10 * size, "{case}: {trace}");
            let left_over = found.iter().filter(|z| z.norm() > 1e-9 * size).count();
            assert!(
                left_over <= rank,
                "{case}: {left_over} eigenvalues of a matrix of rank {rank}"
            );
        }
    }

    /// The cyclic shift, whose corner never tells a shift that helps; the zero matrix; what is no matrix.
    #[test]
    fn matrices_that_stall_end_too() {
        for n in 1..40 {
            let shift = DMatrix::from_fn(n, n, |i, k| if (k + 1) % n == i { 1.0 } else { 0.0 });
            let found = eigenvalues(shift).unwrap();
            assert!(found.iter().all(|z| (z.norm() - 1.0).abs() < 1e-12), "{n}: {found:?}");
            let nilpotent = DMatrix::from_fn(n, n, |i, k| if k == i + 1 { 1e200 } else { 0.0 });
            assert!(eigenvalues(nilpotent).unwrap().iter().all(|z| z.norm() <= 0.0));
        }
        assert_eq!(eigenvalues(DMatrix::zeros(4, 4)).unwrap(), [Complex::ZERO; 4]);
        assert!(eigenvalues(DMatrix::from_element(3, 3, f64::NAN)).is_none());
        assert_eq!(eigenvalues(DMatrix::zeros(0, 0)).unwrap(), []);
    }
}
