//! Quadrature error of the sum over the nodes of a step for the groove of this step.
//!
//! At the node `c_i` its slope, divided by α, is h Σ_k `a_ik` g(`c_k`) with g(τ) = f'(`d_i` - d(τ)), exact for
//! polynomials g of degree 5. For other g the error is
//!
//! ```text
//!     h g[0, c_1 … c_6] ∫_0^{c_i} Π_k (τ - c_k) dτ
//! ```
//!
//! with the divided difference over one additional point, the start of the step. Multiplied by α, it is the residual
//! of (18) there. It vanishes at the last node, the end of the step. Where the seventh derivative of the motion passes
//! through zero, this error limits the step length.

use std::sync::LazyLock;
use stickslip_tip::TipFunction;
use stickslip_tip::collocation::{RADAU, STAGES, Stages};
use stickslip_tip::step::OwnGroove;

/// The node where the integral is largest, and the coefficients of f' at the start and at the nodes.
struct Rule {
    node: usize,
    at_start: f64,
    at_nodes: Stages,
}

static RULE: LazyLock<Rule> = LazyLock::new(Rule::new);

impl Rule {
    fn new() -> Self {
        let c = RADAU.c;
        // Coefficients of Π (τ - c_k), by rising powers.
        let mut product = [0.0; STAGES + 1];
        product[0] = 1.0;
        for (degree, c) in c.iter().enumerate() {
            for power in (0..=degree + 1).rev() {
                let lower = if power > 0 { product[power - 1] } else { 0.0 };
                product[power] = lower - c * product[power];
            }
        }
        let integral = |to: f64| -> f64 {
            product
                .iter()
                .rev()
                .zip((1..=STAGES + 1).rev())
                .fold(0.0, |sum, (p, power)| (sum + p / power as f64) * to)
        };
        let larger = |a: &usize, b: &usize| integral(c[*a]).abs().total_cmp(&integral(c[*b]).abs());
        let node = (0..STAGES).max_by(larger).unwrap_or(0);
        let weight = |place: f64, others: &dyn Fn(usize) -> bool| {
            let apart = (0..STAGES).filter(|k| others(*k)).map(|k| place - c[k]);
            integral(c[node]) / apart.product::<f64>()
        };
        let at_start = weight(0.0, &|_| true);
        let at_nodes = std::array::from_fn(|i| weight(c[i], &|k| k != i) / c[i]);
        Self { node, at_start, at_nodes }
    }
}

/// The largest error of the slope of the groove at a node, divided by α h.
pub(super) fn missed(tip: &TipFunction, d: &Stages, between: &OwnGroove) -> f64 {
    let Rule { node, at_start, at_nodes } = &*RULE;
    let slopes = &between.slopes()[*node];
    let at_nodes: f64 = at_nodes.iter().zip(slopes).map(|(weight, slope)| weight * slope).sum();
    (at_start * tip.slope(d[*node]) + at_nodes).abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comparison with the integral along a curved path, by Simpson's rule with 4,000 intervals.
    #[test]
    fn what_is_missed_is_foretold() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let node = RULE.node;
        for length in [0.6, 0.9, 1.2] {
            let path = |tau: f64| length * (tau - 0.2 * tau * tau);
            let d = RADAU.c.map(path);
            let slope = |tau: f64| tip.slope(d[node] - path(tau));
            let by_nodes: f64 = (0..STAGES).map(|k| RADAU.a[node][k] * slope(RADAU.c[k])).sum();
            let width = RADAU.c[node] / 4000.0;
            let weight = |i: i32| if i % 4000 == 0 { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            let sum: f64 = (0..=4000).map(|i| weight(i) * slope(width * f64::from(i))).sum();
            let off = (by_nodes - sum * width / 3.0).abs();
            let told = missed(&tip, &d, &OwnGroove::new(&tip, &d));
            println!("{length}: missed {off:.2e}, told {told:.2e}");
            assert!(told > off && told < 1.5 * off);
        }
    }
}
