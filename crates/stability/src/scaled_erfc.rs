//! The scaled complementary error function at complex argument, and its remainder.

use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::error_function::erfcx;

/// |z|² above which the asymptotic series reaches round-off: its smallest term is about e^{-|z|²}.
const SERIES_FROM: f64 = 40.0;

/// erfcx(z) = e^{z²} erfc(z) and R(z) = √π z erfcx(z) - 1, for Re z ≥ 0.
///
/// R falls like -1/(2z²), so that computing it from erfcx would lose about log10(2|z|²) digits. For
/// |z|² > 40 it is therefore summed from its asymptotic series Σ_{n≥1} (-1)^n (2n-1)!!/(2z²)^n (Abramowitz &
/// Stegun 7.1.23), and erfcx follows from it.
///
/// Nothing overflows for Re z ≥ 0. For Re z < 0 erfcx(z) = 2e^{z²} - erfcx(-z) and
/// R(z) = 2√π z e^{z²} + R(-z); the caller treats the exponential separately.
pub(super) fn scaled_erfc(z: Complex64) -> (Complex64, Complex64) {
    if z.norm_sqr() > SERIES_FROM {
        let remainder = asymptotic_remainder(z);
        return ((remainder + 1.0) / (z * PI.sqrt()), remainder);
    }
    let value = erfcx(z);
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
        if term.norm_sqr() <= 1e-34 * sum.norm_sqr() {
            break;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::super::tables::records;
    use super::*;

    /// `data/stability_reference.json`: mpmath at 40 digits and more, 195 points that reach every branch.
    #[test]
    fn erfcx_and_its_remainder_have_the_digits_of_the_table() {
        let rows = records("stability_reference.json", "erfcx");
        assert_eq!(rows.len(), 195);
        let (mut worst, mut worst_remainder) = (0.0_f64, 0.0_f64);
        for row in rows {
            let z = Complex64::new(row[0], row[1]);
            let exact = Complex64::new(row[2], row[3]);
            let (value, remainder) = scaled_erfc(z);
            worst = worst.max((value - exact).norm() / exact.norm());
            // The remainder against -1/(2z²) + 3/(4z⁴) where that suffices, else by its definition.
            let wanted = if z.norm() > 200.0 {
                let step = -0.5 * z.inv().powi(2);
                step + step * step * 3.0 + step.powi(3) * 15.0
            } else {
                z * exact * PI.sqrt() - 1.0
            };
            let allowed = 1e-15 * z.norm() * exact.norm();
            let error = ((remainder - wanted).norm() - allowed).max(0.0);
            worst_remainder = worst_remainder.max(error / wanted.norm());
        }
        println!("erfcx {worst:.1e}, remainder {worst_remainder:.1e}");
        assert!(worst < 3e-14 && worst_remainder < 1e-12);
    }

    #[test]
    fn the_remainder_joins_smoothly_where_the_series_takes_over() {
        for angle in [0.0, 0.3, 0.8, 1.2, 1.5, 0.5 * PI] {
            let below = Complex64::from_polar((SERIES_FROM - 1e-12).sqrt(), angle);
            let above = Complex64::from_polar((SERIES_FROM + 1e-12).sqrt(), angle);
            let (a, b) = (scaled_erfc(below).1, scaled_erfc(above).1);
            assert!((a - b).norm() < 1e-12 * b.norm(), "{angle} {a} {b}");
        }
    }
}
