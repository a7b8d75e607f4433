//! Growth exponents and what is known about them.

use super::certificate::Certificate;
use num_complex::Complex64;

/// Roots of (29) and what is known about them.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// λ by falling real part, both of each conjugate pair (the one above the real axis first).
    pub roots: Vec<Complex64>,
    /// That none is missing.
    pub certificate: Certificate,
}

/// λ = rΛ of all roots, by falling real part, a conjugate after its twin.
pub(super) fn with_conjugates(upper: &[Complex64], r: f64) -> Vec<Complex64> {
    let mut upper = upper.to_vec();
    upper.sort_by(|a, b| b.re.total_cmp(&a.re).then(a.im.total_cmp(&b.im)));
    let both = |z: &Complex64| {
        let lambda = z * r;
        if z.im > 0.0 { vec![lambda, lambda.conj()] } else { vec![lambda] }
    };
    upper.iter().flat_map(both).collect()
}
