//! Elementary functions with the same bits on every machine.
//!
//! The functions of the C library differ in the last bit between processors, and those of browsers differ from them and
//! each other. A fit of exponentials amplifies such differences, and so does a motion. Therefore this crate, and all
//! code that determines a run, uses the functions of this module (`clippy.toml` of this crate lists the forbidden
//! ones). They come from the crate `libm`, which is the same code everywhere. Only the exponential is implemented here,
//! because that of `libm` is too slow.

use num_complex::Complex;
use std::f64::consts::LOG2_E;

pub use libm::{cos, log10, pow, sincos as sin_cos};
pub(crate) use libm::{exp2, hypot, log as ln, log2, sin};

/// Largest |x| for which both e^x and e^{-x} are in the normal range of f64, with some margin.
pub(crate) const LARGEST: f64 = 700.0;
/// Adding this number to another one leaves the nearest integer in the last bits.
pub(crate) const ROUNDS: f64 = 1.5 * (1_u64 << 52) as f64;
/// ln 2 in two parts, the first with so few bits that small integer multiples of it are exact.
const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

const INVERSE_FACTORIALS: [f64; 14] = inverse_factorials();

/// 1/m!, m = 0, 1, …
pub(crate) const fn inverse_factorials<const N: usize>() -> [f64; N] {
    let mut inverse = [1.0; N];
    let mut m = 1;
    while m < N {
        inverse[m] = inverse[m - 1] / m as f64;
        m += 1;
    }
    inverse
}

/// The larger of two numbers, the second one if the first is NaN: one operation, where [`f64::max`] takes five.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The smaller of two numbers, the second one if the first is NaN.
#[inline(always)]
pub(crate) fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// e^x with an error of one unit in the last place.
#[inline]
pub fn exp(x: f64) -> f64 {
    if x.abs() <= LARGEST { exp_within(x) } else { libm::exp(x) }
}

/// e^x for |x| up to [`LARGEST`]: x = k ln 2 + ρ (Cody & Waite, *Software Manual for the Elementary Functions*,
/// 1980), and e^ρ from its Taylor series, whose terms are combined in pairs (Estrin's scheme), so that they can be
/// evaluated in parallel.
#[inline(always)]
pub(crate) fn exp_within(x: f64) -> f64 {
    let rounded = x * LOG2_E + ROUNDS;
    let k = rounded - ROUNDS;
    let rho = (x - k * LN_2[0]) - k * LN_2[1];
    let c = &INVERSE_FACTORIALS;
    let (square, last) = (rho * rho, c[12] + rho * c[13]);
    let fourth = square * square;
    let high = (c[8] + rho * c[9]) + square * (c[10] + rho * c[11]);
    let middle = (c[4] + rho * c[5]) + square * (c[6] + rho * c[7]);
    let low = square * (c[2] + rho * c[3]);
    let sum = (last * fourth + high) * (fourth * fourth) + (middle * fourth + low);
    // 2^k: the last bits of what was rounded, as an exponent.
    let power = f64::from_bits((rounded.to_bits() << 52).wrapping_add(1023 << 52));
    (1.0 + (rho + sum)) * power
}

/// e^z.
pub fn complex_exp(z: Complex<f64>) -> Complex<f64> {
    let (sin, cos) = sin_cos(z.im);
    let size = exp(z.re);
    Complex::new(size * cos, size * sin)
}

/// ln z, with its imaginary part within ±π.
pub(crate) fn complex_ln(z: Complex<f64>) -> Complex<f64> {
    Complex::new(ln(norm(z)), libm::atan2(z.im, z.re))
}

/// |z|
pub(crate) fn norm(z: Complex<f64>) -> f64 {
    hypot(z.re, z.im)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The exponential of the C library, which is correct to little more than half a unit of the last place, is the oracle.
    #[test]
    fn it_is_that_of_the_library_to_a_unit_of_the_last_place() {
        for i in -70_000..70_000 {
            let x = f64::from(i) * 0.010_000_123;
            let (told, right) = (exp(x), x.exp());
            assert!((told - right).abs() <= f64::EPSILON * right, "{x}: {told} {right}");
        }
    }

    #[test]
    fn it_ends_where_that_of_the_library_does() {
        for x in [-1e300, -746.0, -744.9, -710.0, 0.0, -0.0, 709.7, 710.0, f64::INFINITY] {
            assert_eq!(exp(x).to_bits(), libm::exp(x).to_bits(), "{x}");
        }
        assert!(exp(f64::NAN).is_nan());
    }
}
