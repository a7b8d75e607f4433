//! The visits of a long step for a memory: positions of the tip, and times spent there.

mod zeros;

use super::series::Series;
use super::values::{BLOCK, Block, Table};
use crate::collocation::legendre;
use crate::elementary::{LARGEST, exp, exp_within, ln};
use multiversion::multiversion;
use std::sync::{LazyLock, OnceLock};
use zeros::ZEROS;

/// Radau's rule on the unit step: exact for polynomials of degree 2n - 2, with its last node at the end.
#[derive(Debug)]
pub(crate) struct Rule {
    pub(crate) nodes: Vec<f64>,
    pub(crate) weights: Vec<f64>,
    /// The table for values at the nodes.
    pub(crate) table: Table,
}

/// Numbers of nodes.
const COUNTS: [usize; 9] = [6, 8, 10, 12, 14, 16, 18, 20, 24];
pub(crate) const MOST_NODES: usize = 24;
/// Room for values at the nodes of any rule.
pub(crate) const ROOM: [Block; MOST_NODES.div_ceil(BLOCK)] =
    [[0.0; BLOCK]; MOST_NODES.div_ceil(BLOCK)];

/// The rule with the number of nodes at this index of [`COUNTS`], made at its first use, because no run uses all rules.
fn rule(index: usize) -> &'static Rule {
    static RULES: [OnceLock<Rule>; COUNTS.len()] = [const { OnceLock::new() }; COUNTS.len()];
    RULES[index].get_or_init(|| Rule::new(COUNTS[index], ZEROS[index]))
}

/// Logarithms of 2 (2n-1)!³/(n (n-1)!⁴), by which the error of the rule of n nodes is divided.
static LOGARITHMS: LazyLock<[f64; COUNTS.len()]> = LazyLock::new(|| {
    COUNTS.map(|n| {
        let factorials = 3.0 * log_factorial(2 * n - 1) - 4.0 * log_factorial(n - 1);
        ln(2.0 / n as f64) + factorials
    })
});

/// Choice of a sufficiently accurate rule for a step, from its displacement and the healing meanwhile.
#[derive(Debug, Clone)]
pub(crate) struct Visits {
    /// Largest displacement for which each rule is accurate.
    farthest: [f64; COUNTS.len()],
    /// The wave number for which the rules are chosen.
    wave: f64,
}

/// Largest length of a step in healing times, relative to the largest phase for which a rule is accurate.
const MOST_HEALING: f64 = 0.5;

impl Visits {
    /// The choice for a footprint of this bandwidth and this relative error of the integrals.
    ///
    /// For e^{iφτ} the rule of n nodes has an error of at most n (n-1)!⁴/(2 (2n-1)!³) φ^{2n-1}. A wave of f with the
    /// wave number q has the phase φ = qd over the displacement d. Waves above the chosen q are weaker than the error:
    /// they fall as those of a Gaussian, to round-off at the band limit. With β healing times in a step, healing is a
    /// factor e^{-β(1-τ)}. The derivatives of the product are those of e^{iφτ} with |iφ + β| instead of φ.
    pub(crate) fn new(band: f64, error: f64) -> Self {
        let digits = (-ln(error)).max(1.0);
        let wave = band * (digits / -ln(f64::EPSILON)).min(1.0).sqrt();
        let phase = |(n, logarithm)| exp((logarithm - digits) / (2 * n - 1) as f64) / wave;
        let mut farthest = [0.0; COUNTS.len()];
        let phases = COUNTS.into_iter().zip(*LOGARITHMS).map(phase);
        farthest.iter_mut().zip(phases).for_each(|(farthest, phase)| *farthest = phase);
        Self { farthest, wave }
    }

    /// The rule for a step over this distance and this number of healing times; `None` if no rule suffices.
    pub(crate) fn rule(&self, moved: f64, healing: f64) -> Option<&'static Rule> {
        let waning = healing / self.wave;
        let far = (moved * moved + waning * waning).sqrt();
        let index = self.farthest.iter().position(|farthest| far <= *farthest)?;
        Some(rule(index))
    }

    /// The largest distance of a step of this number of healing times.
    pub(crate) fn farthest(&self, healing: f64) -> f64 {
        let most = self.farthest[COUNTS.len() - 1];
        (most * most - (healing / self.wave).powi(2)).max(0.0).sqrt()
    }

    /// Largest length of a step, in healing times.
    pub(crate) fn most_healing(&self) -> f64 {
        MOST_HEALING * self.wave * self.farthest[COUNTS.len() - 1]
    }
}

/// The rule with the most nodes.
pub(crate) fn last() -> &'static Rule {
    rule(COUNTS.len() - 1)
}

/// Reduces the weights to their undecayed parts at the end of a step of this number of healing times.
fn fade(nodes: &[f64], times: f64, weights: &mut [f64]) {
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
    /// The weights of the nodes of a step of this length and number of healing times, stored in `room`. `felt` is the
    /// series of w, with a depth limit.
    pub(crate) fn weights<'a>(
        &self,
        (length, healing): (f64, f64),
        felt: Option<&Series>,
        room: &'a mut [f64; MOST_NODES],
    ) -> &'a [f64] {
        let weights = &mut room[..self.weights.len()];
        weights.iter_mut().zip(&self.weights).for_each(|(weight, spent)| *weight = spent * length);
        if let Some(felt) = felt {
            let mut room = ROOM;
            let felt = self.table.sums(&felt.over(length), &mut room);
            weights.iter_mut().zip(felt).for_each(|(weight, felt)| *weight *= *felt);
        }
        if healing > 0.0 {
            fade(&self.nodes, healing, weights);
        }
        weights
    }

    /// Nodes x on [-1, 1] are 1 and the zeros of (P_n - P_{n-1})/(x - 1), weights (1 + x)/(n P_{n-1}(x))²; Hairer &
    /// Wanner II, IV.5.
    fn new(n: usize, zeros: &[f64]) -> Self {
        let squared = |x: f64| (n as f64 * legendre(n, x).0).powi(2);
        let pair = |x: f64| (0.5 * (1.0 + x), 0.5 * (1.0 + x) / squared(x));
        let ends = zeros.iter().copied().chain([1.0]);
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
        for (n, rule) in COUNTS.into_iter().zip((0..COUNTS.len()).map(rule)) {
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
            let rule = visits.rule(farthest, 0.0).unwrap();
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

    /// Judged by the integral of a wave that fades, in closed form: (e^{iφ} - e^{-β})/(iφ + β).
    #[test]
    fn a_rule_is_as_near_where_the_groove_heals_within_the_step() {
        for error in [1e-6, 1e-9, 1e-12] {
            let visits = Visits::new(8.0, error);
            let most = visits.most_healing();
            for healing in [0.01, 0.1, 0.3, 0.6, 1.0].map(|part| part * most) {
                for part in [0.0, 0.3, 0.999] {
                    let moved = part * visits.farthest(healing);
                    let rule = visits.rule(moved, healing).unwrap();
                    let phase = visits.wave * moved;
                    let mut weights = rule.weights.clone();
                    fade(&rule.nodes, healing, &mut weights);
                    let wave = |x: f64| num_complex::Complex64::new(0.0, phase * x).exp();
                    let terms = rule.nodes.iter().zip(&weights);
                    let sum: num_complex::Complex64 = terms.map(|(x, w)| wave(*x) * w).sum();
                    let exact = (wave(1.0) - (-healing).exp())
                        / num_complex::Complex64::new(healing, phase);
                    let off = (sum - exact).norm();
                    assert!(off < 2.0 * error, "{error:e} {healing} {moved}: {off:e}");
                }
            }
        }
    }
}
