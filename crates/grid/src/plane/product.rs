//! The footprint f(x,y) of a tip in the plane: a sum of products of Gaussians.

use crate::{Gaussian, GridError};

/// Distance in widths beyond which a Gaussian is below 1e-17 of its largest value.
const REACH_OF_A_GAUSSIAN: f64 = 8.85;

/// One term g(x) h(y) of f(x,y), where g and h are sums of Gaussians.
#[derive(Debug, Clone, PartialEq)]
pub struct Product {
    /// Terms of g.
    pub along: Vec<Gaussian>,
    /// Terms of h.
    pub across: Vec<Gaussian>,
}

impl Product {
    /// The terms of g and of h.
    pub(super) fn factors(&self) -> [&[Gaussian]; 2] {
        [&self.along, &self.across]
    }
}

/// Σ a exp(-(x-c)²/2w²)
pub(super) fn value(terms: &[Gaussian], x: f64) -> f64 {
    terms.iter().map(|term| term_and_z(term, x).0).sum()
}

/// The derivative of [`value`].
pub(super) fn slope(terms: &[Gaussian], x: f64) -> f64 {
    let one = |term| {
        let (value, z) = term_and_z(term, x);
        -value * z / term.width
    };
    terms.iter().map(one).sum()
}

fn term_and_z(term: &Gaussian, x: f64) -> (f64, f64) {
    let z = (x - term.center) / term.width;
    (term.amplitude * (-0.5 * z * z).exp(), z)
}

/// Distances in x and in y beyond which f is taken as 0.
pub(super) fn reach(products: &[Product]) -> [f64; 2] {
    let of = |axis: usize| {
        let terms = products.iter().flat_map(|product| product.factors()[axis]);
        terms.map(|g| g.center.abs() + REACH_OF_A_GAUSSIAN * g.width).fold(0.0, f64::max)
    };
    [of(0), of(1)]
}

/// Smallest widths in x and in y.
pub(super) fn smallest_widths(products: &[Product]) -> [f64; 2] {
    let of = |axis: usize| {
        let terms = products.iter().flat_map(|product| product.factors()[axis]);
        terms.map(|g| g.width).fold(f64::INFINITY, f64::min)
    };
    [of(0), of(1)]
}

/// # Errors
/// No product, or one without terms, with a number that is not finite, or with a width that is not above 0.
pub(super) fn check(products: &[Product]) -> Result<(), GridError> {
    if products.is_empty() {
        return Err(GridError::Gaussians);
    }
    products.iter().flat_map(Product::factors).try_for_each(Gaussian::check)
}
