//! The number of directions: J0 as a mean of plane waves.
//!
//! The mean over N equidistant directions is
//!
//! ```text
//!     (1/N) Σ_j e^{i k_j·d} = J0(|d|) + 2 Σ_{m≥1} i^{Nm} J_{Nm}(|d|) cos(Nm φ)
//! ```
//!
//! for even N, with φ the angle between d and the first direction. The error of the gradient of the term of order n is at
//! most the larger of |J_{n-1}| and |J_{n+1}|. A particle whose speed never exceeded V is within d = Vτ of where it was a
//! time τ ago, and for 0 < d < n
//!
//! ```text
//!     |J_n(d)| ≤ g(d/n)^n,   g(z) = z e^{√(1-z²)}/(1 + √(1-z²))
//! ```
//!
//! (W. Kapteyn; NIST Digital Library of Mathematical Functions, 10.14.8). This bound rises with d to 1 and falls as n
//! rises.

use crate::elementary::{exp, ln};

/// Largest number of directions, sufficient for a distance VT = 300 in the healing time T.
const MOST: usize = 8192;
/// Number of pieces of an upper sum of an integral.
const PIECES: u32 = 256;

/// The smallest multiple of 4 directions for which ∇Q/T errs by at most `allowed`, for a particle that moves by at most
/// `range` = VT in the time T; `None` if 8192 are not sufficient.
pub fn directions(range: f64, allowed: f64) -> Option<usize> {
    let suffices = |quarter: &usize| error_of_directions(range, 4 * quarter) <= allowed;
    // The error falls as the number rises.
    let (mut low, mut high) = (1, 2);
    while !suffices(&high) {
        (low, high) = (high, 2 * high);
        if 4 * low >= MOST {
            return None;
        }
    }
    while high - low > 1 {
        let middle = usize::midpoint(low, high);
        *(if suffices(&middle) { &mut high } else { &mut low }) = middle;
    }
    Some(4 * high)
}

/// A bound on the error of ∇Q/T with this even number of directions, for `range` = VT.
fn error_of_directions(range: f64, count: usize) -> f64 {
    if range <= 0.0 {
        return 0.0;
    }
    let mut sum = 0.0;
    for m in 1.. {
        let term = 2.0 * mean_of_bound(range, m * count - 1);
        sum += term;
        if term <= 1e-3 * sum {
            // Terms fall faster than geometrically.
            return 1.01 * sum;
        }
    }
    sum
}

/// An upper sum of ∫ min(1, g(range s/n)^n) e^{-s}ds: the first factor rises, the second one falls.
fn mean_of_bound(range: f64, n: usize) -> f64 {
    let n = n as f64;
    let end = n / range;
    let left = |i: u32| exp(-end * f64::from(i) / f64::from(PIECES));
    let piece = |i: u32| bound(n, f64::from(i + 1) / f64::from(PIECES)) * (left(i) - left(i + 1));
    (0..PIECES).map(piece).sum::<f64>() + left(PIECES)
}

/// g(z)^n for 0 < z ≤ 1
fn bound(n: f64, z: f64) -> f64 {
    let root = (1.0 - z * z).max(0.0).sqrt();
    exp(n * (ln(z / (1.0 + root)) + root))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elementary::{cos, sin};
    use std::f64::consts::TAU;

    /// For uniform motion the error has a closed form: ∫ J_n(Vτ) e^{-τ/T}dτ/T = ρ^n/√(1 + V²T²), ρ = (√(1 + V²T²) -
    /// 1)/(VT).
    #[test]
    fn the_bound_exceeds_the_error_of_uniform_motion_by_little() {
        for range in [0.2, 0.835, 3.9, 30.0] {
            for count in [16, 32, 64] {
                let root = f64::hypot(1.0, range);
                let rho: f64 = (root - 1.0) / range;
                let exact = 2.0 * rho.powi(count) / root;
                let bound = error_of_directions(range, count as usize);
                // One order lower, and the part of the bound that is 1.
                assert!(bound >= exact, "{range} {count}: {bound} {exact}");
                assert!(bound < 200.0 * exact / rho, "{range} {count}: {bound} {exact}");
            }
        }
    }

    /// Directions as counted for 1e-12 give the gradient of J0 that closely at all distances that weigh as much.
    #[test]
    fn plane_waves_sum_to_the_slope_of_j0() {
        for range in [0.5, 2.0, 8.0] {
            let count = directions(range, 1e-12).unwrap();
            let smaller = error_of_directions(range, count - 4);
            assert!(smaller > 1e-12, "{count} directions are more than needed");
            let mut worst = 0.0_f64;
            for i in 1..4000 {
                let s = 0.01 * f64::from(i);
                let d = range * s;
                let angle = 0.3 + 0.1 * s;
                let slope = |j: usize| {
                    let theta = TAU * j as f64 / count as f64 - angle;
                    -cos(theta) * sin(d * cos(theta))
                };
                let mean: f64 = (0..count).map(slope).sum::<f64>() / count as f64;
                worst = worst.max((mean + libm::j1(d)).abs() * exp(-s));
            }
            println!("{range}: {count} directions, {worst:e}");
            assert!(worst < 1e-12, "{range}: {worst:e}");
        }
    }

    #[test]
    fn a_memory_beyond_all_directions_is_refused() {
        assert!(directions(1e5, 1e-10).is_none());
        assert!(directions(200.0, 1e-10).is_some());
        assert_eq!(directions(0.0, 1e-10), Some(8));
    }
}
