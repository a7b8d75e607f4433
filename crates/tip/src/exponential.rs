//! `e^{s x}` for many complex s in SIMD lanes.
//!
//! Half of the time for a limit cycle goes into exponentials. With library functions each takes some forty
//! instructions, and as many again for the sine and cosine; in SIMD lanes it takes a quarter of that. The real part is
//! reduced to k ln 2 + ρ and the imaginary part to q π/2 + ρ, without loss of digits. The polynomial for e^ρ is in
//! [`crate::elementary`], those for sin ρ and cos ρ are from fdlibm. No multiplication is fused with an addition, so
//! that all machines agree to the last bit.

use crate::elementary::{self, LARGEST, ROUNDS, exp_within};
use multiversion::multiversion;
use num_complex::Complex;
use std::f64::consts::FRAC_2_PI;

/// Number of SIMD lanes: several vectors, so that the compiler vectorises the loops.
const LANES: usize = 12;

/// Largest phase evaluated here; larger ones are left to the library. Up to it all multiples of π/2 are exact in parts
/// of 33 bits.
const LARGEST_PHASE: f64 = 1e6;
/// π/2 in parts; all but the last have few bits.
const HALF_PI: [f64; 3] =
    [1.570_796_326_734_125_6, 6.077_100_506_303_966e-11, 2.022_266_248_795_950_6e-21];

/// Coefficients of the powers of ρ² in (sin ρ - ρ)/ρ³.
const SIN: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
/// Coefficients of the powers of ρ² in (cos ρ - 1 + ρ²/2)/ρ⁴.
const COS: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

/// Replaces each of these z by e^z, and the number at its place in `inverses` by e^{-z}. The relative errors of both
/// are about four roundings times the larger of 1 and |Im z|. Real parts are limited to ±700.
///
/// ```
/// use num_complex::Complex;
/// use stickslip_tip::exponential::with_inverses;
///
/// let (mut e, mut inverse) = ([Complex::new(-1.5, 3.0)], [Complex::ZERO]);
/// with_inverses(&mut e, &mut inverse);
/// assert!((e[0] - Complex::new(-1.5, 3.0).exp()).norm() < 1e-15);
/// assert!((e[0] * inverse[0] - 1.0).norm() < 1e-15);
/// ```
///
/// Also compiled for wider vectors: lanes are independent of each other.
#[multiversion(targets("x86_64+avx2"))]
pub fn with_inverses(values: &mut [Complex<f64>], inverses: &mut [Complex<f64>]) {
    let (whole, rest) = values.as_chunks_mut();
    let (whole_inverses, rest_inverses) = inverses.as_chunks_mut();
    for (values, inverses) in whole.iter_mut().zip(whole_inverses) {
        some(values, inverses);
    }
    if rest.is_empty() {
        return;
    }
    let (mut values, mut inverses) = ([Complex::ZERO; LANES], [Complex::ZERO; LANES]);
    values[..rest.len()].copy_from_slice(rest);
    some(&mut values, &mut inverses);
    rest.copy_from_slice(&values[..rest.len()]);
    rest_inverses.copy_from_slice(&inverses[..rest.len()]);
}

/// e^{(re + i im) x}, as real and imaginary parts.
#[inline(always)]
pub(crate) fn of_lanes<const N: usize>(
    (re, im): ([f64; N], [f64; N]),
    x: f64,
) -> ([f64; N], [f64; N]) {
    // Loops: what maps arrays is a function of its own, not compiled for wider vectors.
    let (mut a, mut b) = (re, im);
    for i in 0..N {
        (a[i], b[i]) = (re[i] * x, im[i] * x);
    }
    let size = exp(a);
    let (mut sin, mut cos) = sin_cos(b);
    for i in 0..N {
        (sin[i], cos[i]) = (size[i] * sin[i], size[i] * cos[i]);
    }
    (cos, sin)
}

#[inline(always)]
fn some(values: &mut [Complex<f64>; LANES], inverses: &mut [Complex<f64>; LANES]) {
    let (mut x, mut y) = ([0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        (x[i], y[i]) = (values[i].re, values[i].im);
    }
    let size = exp(x);
    let (sin, cos) = sin_cos(y);
    for i in 0..LANES {
        let left = 1.0 / size[i];
        values[i] = Complex::new(size[i] * cos[i], size[i] * sin[i]);
        inverses[i] = Complex::new(left * cos[i], -(left * sin[i]));
    }
}

/// e^x, with x limited to ±700.
#[inline(always)]
fn exp<const N: usize>(mut x: [f64; N]) -> [f64; N] {
    // Not `map`, which is no part of the loop over lanes unless it happens to be inlined.
    for x in &mut x {
        *x = exp_within(x.clamp(-LARGEST, LARGEST));
    }
    x
}

#[inline(always)]
fn sin_cos<const N: usize>(y: [f64; N]) -> ([f64; N], [f64; N]) {
    let (mut sin, mut cos) = ([0.0; N], [0.0; N]);
    let mut beyond = false;
    for i in 0..N {
        beyond |= y[i].abs() > LARGEST_PHASE;
        let rounded = y[i] * FRAC_2_PI + ROUNDS;
        let (q, quarter) = (rounded - ROUNDS, rounded.to_bits());
        let rest = ((y[i] - q * HALF_PI[0]) - q * HALF_PI[1]) - q * HALF_PI[2];
        let square = rest * rest;
        let (mut s, mut c) = (SIN[5], COS[5]);
        for m in (0..5).rev() {
            s = s * square + SIN[m];
            c = c * square + COS[m];
        }
        let s = rest + rest * (square * s);
        let c = 1.0 - (0.5 * square - square * (square * c));
        let (first, second) = if quarter & 1 == 0 { (s, c) } else { (c, s) };
        // Signs: of the sine in the third and fourth quarter, of the cosine in the second and third.
        sin[i] = f64::from_bits(first.to_bits() ^ ((quarter & 2) << 62));
        cos[i] = f64::from_bits(second.to_bits() ^ (((quarter + 1) & 2) << 62));
    }
    if beyond {
        for i in 0..N {
            (sin[i], cos[i]) = elementary::sin_cos(y[i]);
        }
    }
    (sin, cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// e^{s x} and e^{-s x}.
    fn exponentials(s: &[Complex<f64>], x: &[f64]) -> [Vec<Complex<f64>>; 2] {
        let mut e: Vec<_> = s.iter().flat_map(|s| x.iter().map(move |x| s * x)).collect();
        let mut inverse = e.clone();
        with_inverses(&mut e, &mut inverse);
        [e, inverse]
    }

    /// The functions of the C library, correct to a rounding, are the oracle; arguments over all that is allowed.
    #[test]
    fn they_are_those_of_the_library_to_some_roundings() {
        let parts = |i: u32| f64::from(i).mul_add(0.618_033_988_749_895, 0.1).fract() - 0.5;
        for size in [1e-12, 1e-3, 1.0, 20.0, 1400.0] {
            let s: Vec<_> = (0..500).map(|i| Complex::new(parts(i), parts(7 * i + 3))).collect();
            let x = [size, 0.37 * size, -0.8 * size, 0.999 * size, 0.0];
            let [e, inverse] = exponentials(&s, &x);
            let (e, inverse) = (e.chunks(x.len()), inverse.chunks(x.len()));
            for ((s, e), inverse) in s.iter().zip(e).zip(inverse) {
                for ((x, e), inverse) in x.iter().zip(e).zip(inverse) {
                    let argument = s * x;
                    let right = Complex::from_polar(argument.re.exp(), argument.im);
                    let allowed = 8.0 * f64::EPSILON;
                    assert!((e - right).norm() <= allowed * right.norm(), "{argument} {e} {right}");
                    assert!((e * inverse - 1.0).norm() <= allowed, "{argument} {e} {inverse}");
                }
            }
        }
    }

    #[test]
    fn what_leaves_the_range_is_held_within_it() {
        let s = [Complex::new(-1e5, 1e9), Complex::new(3e5, f64::NAN)];
        let [e, inverse] = exponentials(&s, &[1.0]);
        assert!((e[0].norm() / (-700.0_f64).exp() - 1.0).abs() < 1e-15);
        assert!((e[0].arg() - Complex::from_polar(1.0, 1e9).arg()).abs() < 1e-15);
        assert!(inverse[0].is_finite() && !e[1].is_finite());
    }

    /// Lanes, whoever compiled them: single numbers, of which each is a lane beside idle ones, are the same to the last
    /// bit.
    #[test]
    fn lanes_do_not_know_of_each_other() {
        let s: Vec<_> = (0..9).map(|i| Complex::new(-0.3 * f64::from(i), f64::from(i))).collect();
        let [e, _] = exponentials(&s, &[0.7]);
        for (s, e) in s.iter().zip(e) {
            let (x, y) = (exp([s.re * 0.7; LANES])[1], sin_cos([s.im * 0.7; LANES]));
            let plain = Complex::new(x * y.1[2], x * y.0[2]);
            assert_eq!((plain.re.to_bits(), plain.im.to_bits()), (e.re.to_bits(), e.im.to_bits()));
        }
    }
}
