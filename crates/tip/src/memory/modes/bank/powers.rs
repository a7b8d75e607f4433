//! Real polynomials of the exponents, of which a state carried on is made: `Σ_m c_m s_j^m` is a table times a vector.

use super::super::local::HIGHEST_DEGREE;
use super::{Group, LANES, Lane, product, sum};
use multiversion::multiversion;

/// `s_j^m` of a group, m = 0, 1, …
pub(super) type Powers = [(Lane, Lane); HIGHEST_DEGREE + 1];
/// Coefficients `c_m`.
pub(super) type Coefficients = [f64; HIGHEST_DEGREE + 1];

/// Nodes that are summed over side by side.
const NODES: usize = 2 * LANES;

/// 1/m!
const INVERSE_FACTORIALS: Coefficients = {
    let mut inverse = [1.0; HIGHEST_DEGREE + 1];
    let mut m = 1;
    while m <= HIGHEST_DEGREE {
        inverse[m] = inverse[m - 1] / m as f64;
        m += 1;
    }
    inverse
};

/// Of a group's exponents.
pub(super) fn powers(exponent: (Lane, Lane)) -> Powers {
    let mut powers = [([1.0; LANES], [0.0; LANES]); HIGHEST_DEGREE + 1];
    for m in 0..HIGHEST_DEGREE {
        powers[m + 1] = product(powers[m], exponent);
    }
    powers
}

/// `x^m/m!`: the coefficients of `e^{sx}`.
fn exponential(x: f64, degree: usize) -> Coefficients {
    let mut coefficients = [0.0; HIGHEST_DEGREE + 1];
    let mut power = 1.0;
    for (c, inverse) in coefficients[..=degree].iter_mut().zip(INVERSE_FACTORIALS) {
        *c = power * inverse;
        power *= x;
    }
    coefficients
}

/// `Σ_k weight_k (from - position_k)^m/m!`: those of `Σ_k weight_k e^{s (from - position_k)}`.
#[inline(always)]
fn moments(position: &[f64], weight: &[f64], from: f64, degree: usize) -> Coefficients {
    let mut lanes = [[0.0; LANES]; HIGHEST_DEGREE + 1];
    for (position, weight) in position.chunks(NODES).zip(weight.chunks(NODES)) {
        let (mut offset, mut power) = ([0.0; NODES], [0.0; NODES]);
        offset.iter_mut().zip(position).for_each(|(offset, x)| *offset = from - x);
        power[..weight.len()].copy_from_slice(weight);
        for lanes in &mut lanes[..=degree] {
            for i in 0..LANES {
                lanes[i] += power[i] + power[i + LANES];
            }
            for i in 0..NODES {
                power[i] *= offset[i];
            }
        }
    }
    let mut moments = [0.0; HIGHEST_DEGREE + 1];
    for ((moment, [a, b, c, d]), inverse) in moments.iter_mut().zip(lanes).zip(INVERSE_FACTORIALS) {
        *moment = ((a + b) + (c + d)) * inverse;
    }
    moments
}

/// The state after visits: with E = e^{s half} it is `E (E z + Σ_k weight_k e^{s (half - position_k)})`.
///
/// Compiled for wider vectors too: lanes and the order of sums are the same.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn carry(
    groups: &mut [Group],
    powers: &[Powers],
    (position, weight): (&[f64], &[f64]),
    half: f64,
    degree: usize,
) {
    let moments = moments(position, weight, half, degree);
    let carried = exponential(half, degree);
    for (group, powers) in groups.iter_mut().zip(powers) {
        let zero = ([0.0; LANES], [0.0; LANES]);
        let (mut e, mut new) = (zero, zero);
        let coefficients = carried[..=degree].iter().zip(&moments[..=degree]);
        for ((re, im), (carried, moment)) in powers.iter().zip(coefficients) {
            for i in 0..LANES {
                e.0[i] += carried * re[i];
                e.1[i] += carried * im[i];
                new.0[i] += moment * re[i];
                new.1[i] += moment * im[i];
            }
        }
        group.state = product(e, sum(product(e, group.state), new));
    }
}
