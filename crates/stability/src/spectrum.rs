//! Growth exponents with their certificate.

use super::certificate::{Certificate, Region};
use num_complex::Complex64;
use stickslip_tip::sorting::sort_by_number;

/// Roots of (29) with their certificate.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// λ by falling real part, including both members of each conjugate pair (the one above the real axis first).
    pub roots: Vec<Complex64>,
    /// Certificate that no root is missing.
    pub certificate: Certificate,
}

impl Spectrum {
    /// An empty list, without a search.
    pub fn none() -> Self {
        let region = Region { re_min: 0.0, re_max: 0.0, im_max: 0.0 };
        let certificate =
            Certificate { region, counted: 0, found: 0, largest_residual: 0.0, largest_error: 0.0 };
        Self { roots: vec![], certificate }
    }
}

/// λ = rΛ of all roots, by falling real part, each followed by its conjugate.
pub(super) fn with_conjugates(upper: &[Complex64], r: f64) -> Vec<Complex64> {
    let mut upper = upper.to_vec();
    sort_by_number(&mut upper, |z| z.im);
    sort_by_number(&mut upper, |z| -z.re);
    let both = |z: &Complex64| {
        let lambda = z * r;
        if z.im > 0.0 { vec![lambda, lambda.conj()] } else { vec![lambda] }
    };
    upper.iter().flat_map(both).collect()
}
