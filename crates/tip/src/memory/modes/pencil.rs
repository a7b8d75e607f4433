//! Exponents of a sum of exponentials from its samples: the matrix pencil, ESPRIT.
//!
//! References: Hua & Sarkar, IEEE Trans. ASSP 38, 814 (1990); Roy & Kailath, IEEE Trans. ASSP 37,
//! 984 (1989).

use crate::cache::Cache;
use crate::eigenvalues::symmetric_eigen;
use crate::elementary::complex_ln;
use crate::sorting::ascending;
use nalgebra::{DMatrix, Schur};
use num_complex::Complex;
use std::sync::Arc;

/// The signal space of an odd number of evenly spaced samples `y_n`: the singular vectors of the Hankel matrix `H_ij =
/// y_{i+j}`. The matrix is symmetric, so that its eigenvectors serve, for half the work.
///
/// For `y_n = Σ_j c_j λ_j^n` with p terms, the first p singular vectors span the same space as the vectors `(1, λ_j,
/// λ_j², …)`. A shift by one row multiplies this space by a matrix with the eigenvalues `λ_j`.
pub(super) struct Pencil {
    spacing: f64,
    vectors: DMatrix<f64>,
    singular: Vec<f64>,
}

const MOST_SWEEPS: usize = 1000;

/// Number of pencils kept: a run and its classification need fits of several accuracies from the same samples.
const MOST_KEPT: usize = 4;

impl Pencil {
    /// As [`new`](Self::new), or an earlier pencil of the same samples.
    pub(super) fn cached(samples: &[f64], spacing: f64) -> Option<Arc<Self>> {
        static CACHE: Cache<Vec<u64>, Option<Arc<Pencil>>> = Cache::new(MOST_KEPT);
        let bits: Vec<u64> = samples.iter().chain([&spacing]).map(|v| v.to_bits()).collect();
        CACHE.get(|known| *known == bits).unwrap_or_else(|| {
            let pencil = Self::new(samples, spacing).map(Arc::new);
            CACHE.keep(bits, pencil.clone());
            pencil
        })
    }

    /// The pencil of samples that are `spacing` apart; the last one is omitted if their number is even.
    fn new(samples: &[f64], spacing: f64) -> Option<Self> {
        let rows = samples.len().div_ceil(2);
        let hankel = DMatrix::from_fn(rows, rows, |i, j| samples[i + j]);
        let found = symmetric_eigen(hankel)?;
        let falling: Vec<f64> = found.eigenvalues.iter().map(|value| -value.abs()).collect();
        let order = ascending(&falling);
        let columns: Vec<_> = order.iter().map(|k| found.eigenvectors.column(*k)).collect();
        let vectors = DMatrix::from_columns(&columns);
        Some(Self { spacing, vectors, singular: order.into_iter().map(|k| -falling[k]).collect() })
    }

    /// The smallest number of terms for which the remainder, per sample, may be below `error`.
    pub(super) fn fewest_terms(&self, error: f64) -> usize {
        self.singular.partition_point(|s| *s > error)
    }

    /// The most terms that samples rounded to f64 determine.
    pub(super) fn most_terms(&self) -> usize {
        let floor = self.singular[0] * f64::EPSILON;
        self.singular.partition_point(|s| *s > floor).min(self.vectors.nrows() - 2)
    }

    /// Exponents s of p terms `e^{sξ}`, one of each conjugate pair; `None` if one of them grows or is not resolved.
    pub(super) fn exponents(&self, p: usize) -> Option<Vec<Complex<f64>>> {
        // Of no terms there are no eigenvalues, which nalgebra looks for all the same.
        if p == 0 {
            return None;
        }
        let rows = self.vectors.nrows() - 1;
        let upper = self.vectors.view((0, 0), (rows, p));
        let lower = self.vectors.view((1, 0), (rows, p));
        // The columns of `vectors` are orthonormal, so those of `upper` nearly are: U1ᵀU1 = 1 - vvᵀ with
        // v the row left out, inverted by Sherman & Morrison.
        let v = self.vectors.view((rows, 0), (1, p)).transpose();
        let product = upper.tr_mul(&lower);
        let rest = 1.0 - v.norm_squared();
        let shift = &product + &v * (v.transpose() * &product) / rest;
        let eigenvalues = Schur::try_new(shift, f64::EPSILON, MOST_SWEEPS)?.complex_eigenvalues();
        let exponents = eigenvalues.iter().map(|l| complex_ln(*l) / self.spacing);
        let kept: Vec<_> = exponents.filter(|s| s.im >= 0.0).collect();
        // The logarithm of a negative eigenvalue is at the end of what the samples resolve.
        let resolved = |s: &Complex<f64>| s.im * self.spacing < 3.0;
        kept.iter().all(|s| s.re.is_finite() && s.re < 0.0 && resolved(s)).then_some(kept)
    }
}
