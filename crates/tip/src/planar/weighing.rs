//! The depth limit (61) in a series: the height under the tip, and the weight of its indentation.
//!
//! With the depth `D = Σ_m φ_m A_m0` of the groove and the height u0 of the initial surface,
//!
//! ```text
//!     h = u0 - D          w' = -(σ/b) h' w          A_mn' = α w φ_m g⁽ⁿ⁾(0) + …
//! ```
//!
//! where σ is the side of the kink of |h| on which the step lies.

use super::layers::{LANES, Lanes};
use crate::integrator::taylor::{INVERSE, MOST_ORDER, Series};

/// Coefficients of h and w.
#[derive(Debug, Clone)]
pub(super) struct Weighing {
    height: Series,
    weights: Series,
    /// Coefficients of -(σ/b) h'.
    rate: [f64; MOST_ORDER],
    /// Coefficients of `w φ_m` of the latest order.
    carved: Vec<Lanes>,
}

impl Weighing {
    pub(super) fn new(order: usize) -> Self {
        let zero = Series::zero(order - 1);
        Self { height: zero, weights: zero, rate: [0.0; MOST_ORDER], carved: vec![] }
    }

    /// The series of the height under the tip.
    pub(super) fn height(&self) -> &Series {
        &self.height
    }

    /// The series of w.
    pub(super) fn weights(&self) -> &Series {
        &self.weights
    }

    pub(super) fn start(&mut self, height: f64, weight: f64) {
        self.height.set(0, height);
        self.weights.set(0, weight);
    }

    /// Computes the coefficients of order k + 1 from that of the height; `rate` is σ/b.
    #[inline(always)]
    pub(super) fn advance(&mut self, k: usize, height: f64, rate: f64) {
        self.height.set(k + 1, height);
        self.rate[k] = -rate * (k + 1) as f64 * height;
        let terms = self.rate[..=k].iter().zip(self.weights.coefficients()[..=k].iter().rev());
        let sum: f64 = terms.map(|(rate, weight)| rate * weight).sum();
        self.weights.set(k + 1, INVERSE[k + 1] * sum);
    }

    /// The coefficients of order k of `w φ_m`. `layers` are ψ and φ of this number of groups, the highest power first.
    #[inline(always)]
    pub(super) fn carve(&mut self, k: usize, groups: usize, layers: &[Lanes]) -> &[Lanes] {
        self.carved.clear();
        self.carved.resize(groups, [0.0; LANES]);
        let weights = &self.weights.coefficients()[..=k];
        for (weight, layers) in weights.iter().zip(layers.chunks_exact(2 * groups)) {
            for (carved, phi) in self.carved.iter_mut().zip(&layers[groups..]) {
                for i in 0..LANES {
                    carved[i] += weight * phi[i];
                }
            }
        }
        &self.carved
    }
}
