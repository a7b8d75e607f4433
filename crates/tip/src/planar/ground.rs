//! The initial surface under the tip as a series: a polynomial of x and y along the path of the tip.
//!
//! With `R_ab = ∂x^a ∂y^b u0` at the tip, 0 where a or b exceeds 3,
//!
//! ```text
//!     R_ab' = x0' R_{a+1,b} + y0' R_{a,b+1} - R_ab/T
//! ```

use super::spline::Partials;
use crate::integrator::taylor::{INVERSE, MOST_ORDER};

/// Coefficients of powers of time of all `R_ab`.
#[derive(Debug, Clone)]
pub(super) struct Ground {
    rows: Vec<Partials>,
}

impl Ground {
    pub(super) fn new() -> Self {
        Self { rows: vec![] }
    }

    pub(super) fn start(&mut self, jet: &Partials) {
        self.rows.clear();
        self.rows.push(*jet);
    }

    pub(super) fn at(&self, k: usize) -> &Partials {
        &self.rows[k]
    }

    /// Computes the coefficients of order k + 1. `along` contains those of x0' up to order k, the highest first,
    /// `across` those of y0'.
    pub(super) fn advance(
        &mut self,
        along: &[f64; MOST_ORDER],
        across: &[f64; MOST_ORDER],
        healing: f64,
    ) {
        let k = self.rows.len() - 1;
        let along = &along[MOST_ORDER - 1 - k..];
        let mut next = self.rows[k].map(|row| row.map(|entry| -healing * entry));
        for (i, before) in self.rows.iter().enumerate() {
            let (x, y) = (along[i], across[k - i]);
            for a in 0..4 {
                for b in 0..4 {
                    let further = before.get(a + 1).map_or(0.0, |row| row[b]);
                    let beside = before[a].get(b + 1).map_or(0.0, |entry| *entry);
                    next[a][b] += x * further + y * beside;
                }
            }
        }
        self.rows.push(next.map(|row| row.map(|entry| INVERSE[k + 1] * entry)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A polynomial of a polynomial is multiplied out: u0 = Σ over a, b ≤ 3 of `c_ab` x^a y^b.
    #[test]
    fn the_series_is_that_of_the_polynomial_along_the_path() {
        let c = |a: usize, b: usize| 0.3 + 0.1 * a as f64 - 0.2 * (a * b) as f64 + 0.05 * b as f64;
        let (x, y) = ([0.4, 0.9, -0.2, 0.05], [-0.3, 0.5, 0.1, -0.07]);
        let value = |path: &[f64], t: f64| path.iter().rev().fold(0.0, |sum, c| sum * t + c);
        let height = |t: f64| {
            let (x, y) = (value(&x, t), value(&y, t));
            let term = |n: usize| c(n / 4, n % 4) * x.powi(n as i32 / 4) * y.powi(n as i32 % 4);
            (0..16).map(term).sum::<f64>() * (-0.3 * t).exp()
        };
        let falling = |n: usize, k: usize| (0..k).map(|i| n as f64 - i as f64).product::<f64>();
        let power = |x: f64, n: usize, k: usize| {
            if n < k { 0.0 } else { falling(n, k) * x.powi((n - k) as i32) }
        };
        let jet: Partials = std::array::from_fn(|a| {
            std::array::from_fn(|b| {
                let term =
                    |n: usize| c(n / 4, n % 4) * power(x[0], n / 4, a) * power(y[0], n % 4, b);
                (0..16).map(term).sum()
            })
        });
        let (mut along, mut across) = ([0.0; MOST_ORDER], [0.0; MOST_ORDER]);
        for i in 1..4 {
            along[MOST_ORDER - i] = i as f64 * x[i];
            across[i - 1] = i as f64 * y[i];
        }
        let mut ground = Ground::new();
        ground.start(&jet);
        (0..24).for_each(|_| ground.advance(&along, &across, 0.3));
        for t in [0.05, 0.2, 0.4] {
            let sum = (0..25).rev().fold(0.0, |sum, k| sum * t + ground.at(k)[0][0]);
            assert!((sum - height(t)).abs() < 1e-12, "{t}: {sum} {}", height(t));
        }
    }
}
