//! What a memory is told of a long step: where the tip was, and for how long.

use super::values::{BLOCK, Block, Table};
use crate::elementary::{LARGEST, cos, exp, exp_within, ln};
use crate::roots::zero_between;
use multiversion::multiversion;
use std::sync::LazyLock;

/// Radau's rule on the unit step: exact for polynomials of degree 2n - 2, its last node the end.
#[derive(Debug)]
pub(super) struct Rule {
    pub(super) nodes: Vec<f64>,
    pub(super) weights: Vec<f64>,
    /// Of the nodes.
    pub(super) table: Table,
}

/// Numbers of nodes.
const COUNTS: [usize; 9] = [6, 8, 10, 12, 14, 16, 18, 20, 24];
pub(super) const MOST_NODES: usize = 24;
/// For values at the nodes of any of them.
pub(super) const ROOM: [Block; MOST_NODES.div_ceil(BLOCK)] =
    [[0.0; BLOCK]; MOST_NODES.div_ceil(BLOCK)];

static RULES: LazyLock<[Rule; COUNTS.len()]> = LazyLock::new(|| COUNTS.map(Rule::new));

/// Of what the error of each rule is divided by: 2 (2n-1)!³/(n (n-1)!⁴).
static LOGARITHMS: LazyLock<[f64; COUNTS.len()]> = LazyLock::new(|| {
    COUNTS.map(|n| {
        let factorials = 3.0 * log_factorial(2 * n - 1) - 4.0 * log_factorial(n - 1);
        ln(2.0 / n as f64) + factorials
    })
});

/// Which rule will do for a step, by how far it leads.
#[derive(Debug, Clone)]
pub(super) struct Visits {
    /// Up to here each of them will.
    farthest: [f64; COUNTS.len()],
}

impl Visits {
    /// For a footprint of this band, to an error of this part of what it integrates.
    ///
    /// The rule of n nodes errs on e^{iφτ} by at most n (n-1)!⁴/(2 (2n-1)!³) φ^{2n-1}. Waves of f that are shorter than
    /// those to φ = qd, d the displacement, are weaker than the error: at the band they are so by round-off, and they
    /// fall as those of a Gaussian.
    pub(super) fn new(band: f64, error: f64) -> Self {
        let digits = (-ln(error)).max(1.0);
        let wave = band * (digits / -ln(f64::EPSILON)).min(1.0).sqrt();
        let phase = |(n, logarithm)| exp((logarithm - digits) / (2 * n - 1) as f64) / wave;
        let mut farthest = [0.0; COUNTS.len()];
        let phases = COUNTS.into_iter().zip(*LOGARITHMS).map(phase);
        farthest.iter_mut().zip(phases).for_each(|(farthest, phase)| *farthest = phase);
        Self { farthest }
    }

    /// The rule for a step that leads so far; `None` if it leads too far for any.
    pub(super) fn rule(&self, moved: f64) -> Option<&'static Rule> {
        let index = self.farthest.iter().position(|farthest| moved <= *farthest)?;
        Some(&RULES[index])
    }

    /// The farthest that a step may lead.
    pub(super) fn farthest(&self) -> f64 {
        self.farthest[COUNTS.len() - 1]
    }
}

/// The rule of most nodes.
pub(super) fn last() -> &'static Rule {
    &RULES[COUNTS.len() - 1]
}

/// What is left of these weights at the end of a step, of so many healing times.
pub(super) fn fade(nodes: &[f64], times: f64, weights: &mut [f64]) {
    if times <= LARGEST {
        fade_side_by_side(nodes, times, weights);
    } else {
        let faded = weights.iter_mut().zip(nodes);
        faded.for_each(|(weight, node)| *weight *= exp((node - 1.0) * times));
    }
}

#[multiversion(targets("x86_64+avx2"))]
fn fade_side_by_side(nodes: &[f64], times: f64, weights: &mut [f64]) {
    for (weight, node) in weights.iter_mut().zip(nodes) {
        *weight *= exp_within((node - 1.0) * times);
    }
}

fn log_factorial(n: usize) -> f64 {
    libm::lgamma(n as f64 + 1.0)
}

impl Rule {
    /// Nodes x on [-1, 1] are 1 and the zeros of (P_n - P_{n-1})/(x - 1), weights (1 + x)/(n P_{n-1}(x))²; Hairer &
    /// Wanner II, IV.5.
    fn new(n: usize) -> Self {
        let legendre = |x: f64| {
            let (mut last, mut here) = (1.0, x);
            for k in 1..n {
                let k = k as f64;
                (last, here) = (here, ((2.0 * k + 1.0) * x * here - k * last) / (k + 1.0));
            }
            (last, here)
        };
        let difference = |x: f64| legendre(x).1 - legendre(x).0;
        // Zeros of P_n - P_{n-1} and points x = cos(kπ/n) alternate.
        let between = |k: usize| -cos(std::f64::consts::PI * k as f64 / n as f64);
        let zero = |k: usize| zero_between(difference, between(k), between(k + 1));
        let ends = (0..n - 1).map(zero).chain([1.0]);
        let squared = |x: f64| (n as f64 * legendre(x).0).powi(2);
        let pair = |x: f64| (0.5 * (1.0 + x), 0.5 * (1.0 + x) / squared(x));
        let (nodes, weights): (Vec<f64>, Vec<f64>) = ends.map(pair).unzip();
        let sum: f64 = weights.iter().sum();
        let weights = weights.iter().map(|weight| weight / sum).collect();
        Self { table: Table::of_parts(&nodes), nodes, weights }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rules_are_exact_to_their_degree_and_no_further() {
        for (n, rule) in COUNTS.into_iter().zip(&*RULES) {
            let miss = |degree: usize| {
                let terms = rule.nodes.iter().zip(&rule.weights);
                let sum: f64 = terms.map(|(x, w)| w * x.powi(degree as i32)).sum();
                (sum - 1.0 / (degree + 1) as f64).abs()
            };
            for degree in 0..=2 * n - 2 {
                assert!(miss(degree) < 5e-15, "{n} nodes, degree {degree}: {}", miss(degree));
            }
            assert!(n > 10 || miss(2 * n - 1) > 1e-14, "{n}");
            assert!((rule.nodes[n - 1] - 1.0).abs() < 1e-15);
        }
    }

    /// Judged by the integral of a wave in closed form.
    #[test]
    fn a_rule_is_as_near_as_promised_as_far_as_it_is_said_to_reach() {
        let (band, error) = (8.0, 1e-9);
        let visits = Visits::new(band, error);
        for farthest in visits.farthest {
            let rule = visits.rule(farthest).unwrap();
            let largest = |phase: f64| {
                let terms = rule.nodes.iter().zip(&rule.weights);
                let cos: f64 = terms.map(|(x, w)| w * (phase * x).cos()).sum();
                (cos - phase.sin() / phase).abs()
            };
            let wave = band * (error.ln() / f64::EPSILON.ln()).sqrt();
            assert!(largest(wave * farthest) < error, "{farthest}");
            assert!(largest(2.0 * wave * farthest) > error, "{farthest}");
        }
    }
}
