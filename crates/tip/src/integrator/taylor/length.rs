//! Order of a series from the tolerance, and length of a step from the last coefficients.
//!
//! A. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of high-order Taylor methods,
//! Experimental Mathematics 14 (2005) 99: for coefficients that fall as ρ^{-k}, a step of length `ρ ε^{1/p}` has the
//! error ε for any ρ. The order is the one with the least work per time.

use super::chain::INVERSE;
use super::series::MOST_ORDER;
use crate::elementary::{ROUNDS, larger, smaller};

/// The order for an error ε of a step: `per_digit` ln(1/ε), rounded and limited.
pub(crate) fn order(error: f64, per_digit: f64) -> usize {
    let digits = -libm::log(error);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let order = (per_digit * digits).round().max(0.0) as usize;
    order.clamp(LEAST_ORDER, MOST_ORDER)
}

pub(crate) const ORDER_PER_DIGIT: f64 = 1.0;
const LEAST_ORDER: usize = 10;

/// Number of last coefficients that are examined: in an even function every other one vanishes, and with pairs of poles
/// several in a row may be small.
pub(super) const LAST: usize = 4;

/// The length for which the last term of the series amounts to `error`. Earlier coefficients count too, with a factor
/// 1/2 for each order below the last.
pub(crate) fn length(coefficients: &[f64], error: f64) -> f64 {
    let order = coefficients.len() - 1;
    let wanted = log2(error);
    let of = |before: usize| {
        let size = larger(coefficients[order - before].abs(), f64::MIN_POSITIVE);
        let digits = f64::from(wanted - log2(size)) + before as f64 * f64::from(ONE);
        digits * INVERSE[order - before]
    };
    // The last one comes last: the others are known before.
    exp2((0..LAST).rev().map(of).fold(f64::INFINITY, |least, digits| smaller(digits, least)))
}

// The bits of a number above 0 are its binary logarithm, but for a bend between powers of two. The whole step waits for
// its length, and integers wait less than numbers do.

/// 1 in the units of these logarithms.
const ONE: i32 = 1 << 20;
const BIAS: f64 = 1023.0 * ONE as f64;

/// The binary logarithm of a normal number above 0, to 0.01, plus 1023.
fn log2(x: f64) -> i32 {
    let straight = (x.to_bits() >> 32) as i32;
    straight + bend(straight)
}

/// 2^y, to half a per cent; y is limited to ±1000.
fn exp2(y: f64) -> f64 {
    let most = 1000.0 * f64::from(ONE);
    // The last bits of such a sum are those of the nearest integer.
    let rounded = smaller(larger(y, -most), most) + (ROUNDS + BIAS);
    #[expect(clippy::cast_possible_truncation, reason = "the last bits")]
    let straight = rounded.to_bits() as i32;
    f64::from_bits(u64::from((straight - bend(straight)).cast_unsigned()) << 32)
}

/// `log2(1 + f) - f` for the fractional part f, by a parabola.
fn bend(y: i32) -> i32 {
    let part = i64::from(y & (ONE - 1));
    let product = (part * (i64::from(ONE) - part)) >> ONE.trailing_zeros();
    #[expect(clippy::cast_possible_truncation, reason = "below a tenth")]
    let bend = ((product * 87) >> 8) as i32;
    bend
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithms_and_powers_are_near_enough_to_plan_with() {
        for i in 0..2000 {
            let x = libm::exp(0.05 * f64::from(i) - 60.0);
            let (found, exact) = (f64::from(log2(x)) / f64::from(ONE) - 1023.0, libm::log2(x));
            assert!((found - exact).abs() < 0.01, "{x}: {found} {exact}");
            let back = exp2(exact * f64::from(ONE)) / x;
            assert!((back - 1.0).abs() < 0.006, "{x}: {back}");
        }
    }

    /// Coefficients ρ^{-k}, of which the last fall faster than expected, and those of an even function.
    #[test]
    fn the_last_coefficient_over_such_a_length_is_the_error_allowed() {
        let (rho, error) = (0.8_f64, 1e-11);
        let coefficients: Vec<f64> = (0..=20).map(|k| rho.powi(-k)).collect();
        let h = length(&coefficients, error);
        let last = h.powi(20) * coefficients[20];
        assert!(last <= 1.2 * error && last > 1e-2 * error, "{last}");
        let even: Vec<f64> = coefficients
            .iter()
            .enumerate()
            .map(|(k, c)| if k % 2 == 0 { 0.0 } else { *c })
            .collect();
        let shorter = length(&even, error);
        assert!((0.9..1.3).contains(&(shorter / h)), "{shorter} {h}");
    }
}
