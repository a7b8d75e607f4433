//! Growth of a ripple from line to line, and from pass to pass.

use super::Raster;
use num_complex::Complex64;

/// Lines after which a growth from line to line has settled.
const MOST_PASSES: usize = 100_000;

impl Raster {
    /// By how much another pass over the same line changes a ripple e^{iqx} of the groove at a given α: 1 + C/D. It
    /// grows from pass to pass where this is larger than 1 in modulus.
    #[must_use]
    pub fn repeat_gain(&self, alpha: f64, q: f64) -> Complex64 {
        let ratio = alpha / self.r;
        let d = self.denominator(q, ratio);
        let own = q * q * self.footprint.path().fourier(q);
        1.0 + ratio * own / d
    }

    /// The z with A_n ∝ zⁿ at a given α and q of a one-way raster that is largest in modulus, by the first lines of
    /// the recurrence until it settles; the growth from line to line.
    #[must_use]
    pub fn growth(&self, alpha: f64, q: f64) -> Complex64 {
        let ratio = alpha / self.r;
        let d = self.denominator(q, ratio);
        let most = self.heights.iter().map(Vec::len).max().unwrap_or(0);
        let couplings: Vec<Complex64> =
            (0..most).map(|j| ratio * self.coupling(q, j) / d).collect();
        settled(&couplings)
    }
}

/// The ratio of A_n to A_{n-1} that comes to be after many lines of A_n = Σ_j c_j A_{n-1-j}.
pub(super) fn settled(couplings: &[Complex64]) -> Complex64 {
    let most = couplings.len();
    let mut tracks = vec![Complex64::new(1.0, 0.0)];
    let mut z = Complex64::new(0.0, 0.0);
    for _ in 0..MOST_PASSES {
        let earlier = tracks.iter().rev().zip(couplings);
        let next: Complex64 = earlier.map(|(a, c)| a * c).sum();
        let before = z;
        z = next / tracks.last().copied().unwrap_or(next);
        tracks.push(next);
        if tracks.len() > 2 * most {
            tracks.drain(..tracks.len() - most.max(1));
            let size = next.norm();
            tracks.iter_mut().for_each(|a| *a /= size);
        }
        if (z - before).norm() < 1e-15 * z.norm() {
            break;
        }
    }
    z
}
