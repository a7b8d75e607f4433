//! The scaled complementary error function at complex argument, and its remainder.

use errorfunctions::ComplexErrorFunctions;
use num_complex::Complex64;
use std::f64::consts::PI;

/// |z|² above which the asymptotic series reaches round-off: its smallest term is about e^{-|z|²}.
const SERIES_FROM: f64 = 40.0;

/// erfcx(z) = e^{z²} erfc(z) and R(z) = √π z erfcx(z) - 1, for Re z ≥ 0.
///
/// R falls like -1/(2z²), so that forming it from erfcx would lose as many digits as 2|z|² has; for
/// |z|² > 40 it is summed from its asymptotic series Σ_{n≥1} (-1)^n (2n-1)!!/(2z²)^n (Abramowitz &
/// Stegun 7.1.23) and erfcx follows from it. Below, erfcx is S. G. Johnson's Faddeeva algorithm.
///
/// Nothing overflows for Re z ≥ 0. Left of it erfcx(z) = 2e^{z²} - erfcx(-z) and
/// R(z) = 2√π z e^{z²} + R(-z): the caller keeps the exponential apart.
pub(super) fn scaled_erfc(z: Complex64) -> (Complex64, Complex64) {
    if z.norm_sqr() > SERIES_FROM {
        let remainder = asymptotic_remainder(z);
        return ((remainder + 1.0) / (z * PI.sqrt()), remainder);
    }
    let value = z.erfcx();
    (value, z * value * PI.sqrt() - 1.0)
}

fn asymptotic_remainder(z: Complex64) -> Complex64 {
    let step = -0.5 * z.inv().powi(2);
    let mut term = step;
    let mut sum = step;
    let mut odd = 1.0;
    while odd < 2.0 * SERIES_FROM {
        odd += 2.0;
        term *= step * odd;
        sum += term;
        if term.norm() <= 1e-17 * sum.norm() {
            break;
        }
    }
    sum
}
