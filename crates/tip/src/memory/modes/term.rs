//! One exponential of a fit.

use num_complex::Complex;

/// One term `Re(w e^{sξ})`: a conjugate pair, or a real exponential if Im s = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// Exponent s, with Im s ≥ 0, and Re s < 0 unless the footprint is cos x.
    pub exponent: Complex<f64>,
    /// Weight w.
    pub weight: Complex<f64>,
}
