//! Growth exponents, with a certificate that their list is complete.

use super::cell::Cell;
use super::characteristic::Characteristic;
use num_complex::Complex64;
use stickslip_tip::sorting::sort_by_number;

/// A listed value whose residual, relative to the terms of h, is above this is not a root.
const LARGEST_RESIDUAL: f64 = 1e-9;
/// Relative error of h from which the errors of its roots are estimated.
pub(super) const ROUNDOFF: f64 = 3e-14;
/// Entries closer than this, in units of 1/width, are counted together.
const CLUSTER: f64 = 1e-5;

/// The rectangle re_min ≤ Re λ ≤ re_max, |Im λ| ≤ im_max.
///
/// No root lies right of, above or below this rectangle, so that the certificate holds for all of Re λ ≥ re_min. For J0
/// the cuts |Im λ| = r, Re λ < 0 are excepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region {
    /// Left edge.
    pub re_min: f64,
    /// Right edge.
    pub re_max: f64,
    /// Upper edge; the lower edge is its mirror image.
    pub im_max: f64,
}

/// Comparison of a list of roots with their number by the argument principle.
///
/// The count is a rounded floating-point number (it must lie within 1e-6 of a whole one) along a path
/// whose steps follow h', not an enclosure in interval arithmetic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Certificate {
    /// The region in which roots were counted.
    pub region: Region,
    /// Roots in the region, with multiplicity, by the argument principle.
    pub counted: usize,
    /// Roots in the list that lie in the region and solve (30), each counted once.
    pub found: usize,
    /// Largest |h| at the listed roots in the region, relative to the sizes of the terms of h.
    pub largest_residual: f64,
    /// Largest estimate of the error of a listed λ: its displacement by round-off in h.
    pub largest_error: f64,
}

impl Certificate {
    /// Whether the list is complete and each of its members a root.
    pub fn is_complete(&self) -> bool {
        self.counted == self.found && self.largest_residual <= LARGEST_RESIDUAL
    }

    pub(super) fn of(
        h: &Characteristic,
        region: Region,
        counted: usize,
        roots: &[Complex64],
    ) -> Self {
        let inside: Vec<Complex64> =
            roots.iter().filter(|z| region.contains(**z)).map(|z| z / h.r()).collect();
        let largest =
            |f: &dyn Fn(Complex64) -> f64| inside.iter().map(|z| f(*z)).fold(0.0, f64::max);
        Self {
            region,
            counted,
            found: distinct(h, &inside),
            largest_residual: largest(&|z| h.relative_residual(z)),
            largest_error: h.r() * largest(&|z| h.root_error(z, ROUNDOFF)),
        }
    }
}

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

impl Region {
    pub(super) fn contains(&self, z: Complex64) -> bool {
        (self.re_min..=self.re_max).contains(&z.re) && z.im.abs() <= self.im_max
    }
}

/// Number of entries that are roots, each counted once: entries close together count as often as h vanishes there.
fn distinct(h: &Characteristic, zeros: &[Complex64]) -> usize {
    let radius = CLUSTER / h.length;
    let near = |z: Complex64| move |k: &&Complex64| (*k - z).norm() < radius;
    let mut found = 0;
    for (i, z) in zeros.iter().enumerate() {
        if h.relative_residual(*z) > LARGEST_RESIDUAL || zeros[..i].iter().any(|k| near(*z)(&k)) {
            continue;
        }
        let together = zeros.iter().filter(near(*z)).count();
        found += if together == 1 {
            1
        } else {
            let cell = Cell::square(*z, 3.0 * radius, h.length);
            together.min(cell.count(&|z| h.at(z)).unwrap_or(0))
        };
    }
    found
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
