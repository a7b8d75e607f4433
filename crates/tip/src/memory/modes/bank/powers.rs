//! Real polynomials in the exponents, which advance the states by a step: `Σ_m c_m s_j^m` is a table times a vector.

use super::super::local::HIGHEST_DEGREE;
use super::{Group, LANES, Lane, product, sum};
use crate::elementary::inverse_factorials;
use multiversion::multiversion;

/// `s_j^m` of a group, m = 0, 1, …
pub(super) type Powers = [(Lane, Lane); HIGHEST_DEGREE + 1];
/// Coefficients `c_m`, with room to fill the lanes.
const ROOM: usize = (HIGHEST_DEGREE + 1).next_multiple_of(LANES);
type Coefficients = [f64; ROOM];

const INVERSE_FACTORIALS: Coefficients = inverse_factorials();

/// The powers of the exponents of a group.
pub(super) fn powers(exponent: (Lane, Lane)) -> Powers {
    let mut powers = [([1.0; LANES], [0.0; LANES]); HIGHEST_DEGREE + 1];
    for m in 0..HIGHEST_DEGREE {
        powers[m + 1] = product(powers[m], exponent);
    }
    powers
}

/// `Σ_k weight_k (from - position_k)^m/m!`: the coefficients of `Σ_k weight_k e^{s (from - position_k)}` in powers of
/// s, four in the SIMD lanes.
#[inline(always)]
fn moments<const GROUPS: usize>(position: &[f64], weight: &[f64], from: f64) -> Coefficients {
    let mut sums = [[0.0; LANES]; GROUPS];
    for (position, weight) in position.iter().zip(weight) {
        let y = from - position;
        let square = y * y;
        let mut power = [*weight, weight * y, weight * square, weight * (square * y)];
        let fourth = square * square;
        for sum in &mut sums {
            for i in 0..LANES {
                sum[i] += power[i];
                power[i] *= fourth;
            }
        }
    }
    let mut moments = [0.0; ROOM];
    let inverse = INVERSE_FACTORIALS.as_chunks::<LANES>().0;
    let of_groups = moments.as_chunks_mut::<LANES>().0.iter_mut().zip(inverse);
    for ((moments, inverse), sum) in of_groups.zip(&sums) {
        for i in 0..LANES {
            moments[i] = sum[i] * inverse[i];
        }
    }
    moments
}

/// Advances each state z by visits, to `E (E z + Σ_k weight_k e^{s (middle - position_k)})` with E = e^{s half}.
///
/// Also compiled for wider vectors: lanes and the order of sums are the same.
#[multiversion(targets("x86_64+avx2"))]
pub(super) fn carry(
    groups: &mut [Group],
    powers: &[Powers],
    (position, weight): (&[f64], &[f64]),
    about: (f64, f64),
    degree: usize,
) {
    let visits = (position, weight);
    match degree / LANES + 1 {
        0..=3 => carry_by::<3>(groups, powers, visits, about, degree),
        4 => carry_by::<4>(groups, powers, visits, about, degree),
        5 => carry_by::<5>(groups, powers, visits, about, degree),
        6 => carry_by::<6>(groups, powers, visits, about, degree),
        7 => carry_by::<7>(groups, powers, visits, about, degree),
        8 => carry_by::<8>(groups, powers, visits, about, degree),
        _ => carry_by::<11>(groups, powers, visits, about, degree),
    }
}

#[inline(always)]
fn carry_by<const GROUPS: usize>(
    groups: &mut [Group],
    powers: &[Powers],
    (position, weight): (&[f64], &[f64]),
    (middle, half): (f64, f64),
    degree: usize,
) {
    let moments = moments::<GROUPS>(position, weight, middle);
    // Of e^{s half}: as of one visit.
    let carried = self::moments::<GROUPS>(&[0.0], &[1.0], half);
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
