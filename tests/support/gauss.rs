//! Gauss's rules and his method of four stages, for references that share nothing with the library.

use std::array::from_fn;
use std::f64::consts::PI;

/// Number of stages; the method is of order 8 at the ends of steps.
pub(crate) const STAGES: usize = 4;

/// Nodes c, weights b, matrix a = `∫_0^{c_i} ℓ_k`.
pub(crate) struct Method {
    pub(crate) c: [f64; STAGES],
    pub(crate) b: [f64; STAGES],
    pub(crate) a: [[f64; STAGES]; STAGES],
}

/// Nodes and weights of n points on the unit interval: Newton's iteration for the zeros of Legendre's polynomial.
pub(crate) fn rule(n: usize) -> Vec<(f64, f64)> {
    // P_n and its derivative, by recurrence.
    let legendre = |x: f64| {
        let next = |(before, now): (f64, f64), k: usize| {
            let k = k as f64;
            (now, ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0))
        };
        let (before, now) = (1..n).fold((1.0, x), next);
        (now, n as f64 * (before - x * now) / (1.0 - x * x))
    };
    let point = |i: usize| {
        let guess = -(PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let newton = |x: f64, _| {
            let (value, slope) = legendre(x);
            x - value / slope
        };
        let x = (0..8).fold(guess, newton);
        let slope = legendre(x).1;
        (0.5 * (1.0 + x), 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(point).collect()
}

/// ℓ_k, the polynomial that is 1 at node k and 0 at the others.
pub(crate) fn lagrange(c: &[f64; STAGES], k: usize, x: f64) -> f64 {
    (0..STAGES).filter(|&j| j != k).map(|j| (x - c[j]) / (c[k] - c[j])).product()
}

impl Method {
    pub(crate) fn new() -> Self {
        let rule = rule(STAGES);
        let c: [f64; STAGES] = from_fn(|i| rule[i].0);
        let integral = |k: usize, end: f64| -> f64 {
            rule.iter().map(|(x, w)| w * end * lagrange(&c, k, x * end)).sum()
        };
        Self { b: from_fn(|k| rule[k].1), a: from_fn(|i| from_fn(|k| integral(k, c[i]))), c }
    }
}
