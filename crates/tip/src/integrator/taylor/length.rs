//! Order of a series from the tolerance, and length of a step from the last coefficients.
//!
//! A. Jorba, M. Zou, A software package for the numerical integration of ODEs by means of high-order Taylor methods,
//! Experimental Mathematics 14 (2005) 99: for coefficients that fall as ρ^{-k}, a step of length `ρ ε^{1/p}` has the
//! error ε for any ρ. The order is the one with the least work per time.

use super::chain::INVERSE;
use super::series::MOST_ORDER;

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
        let size = coefficients[order - before].abs();
        let digits = wanted - log2(size.max(f64::MIN_POSITIVE)) + before as f64;
        digits * INVERSE[order - before]
    };
    exp2((0..LAST).map(of).fold(f64::INFINITY, f64::min))
}

/// The length L for which `size` L^k = `most`.
pub(crate) fn root(most: f64, size: f64, k: usize) -> f64 {
    exp2((log2(most) - log2(size.max(f64::MIN_POSITIVE))) * INVERSE[k])
}

/// The binary logarithm of a normal number above 0, to 0.01, by a parabola in its mantissa.
#[inline(always)]
pub(super) fn log2(x: f64) -> f64 {
    let bits = x.to_bits();
    let mantissa = f64::from_bits(bits & MANTISSA | 1.0_f64.to_bits()) - 1.0;
    let biased = f64::from_bits(bits >> MANTISSA.count_ones() | WHOLE.to_bits()) - WHOLE;
    biased - 1023.0 + mantissa * (1.0 + BEND * (1.0 - mantissa))
}

/// 2^y, to half a per cent; y is limited to ±1000.
#[inline(always)]
pub(super) fn exp2(y: f64) -> f64 {
    let above = y.clamp(-1000.0, 1000.0) + 1023.0;
    let nearest = (above + WHOLE) - WHOLE;
    let whole = if nearest > above { nearest - 1.0 } else { nearest };
    let part = above - whole;
    let power = f64::from_bits((whole + WHOLE).to_bits() << MANTISSA.count_ones());
    power * (1.0 + part * (1.0 - BEND * (1.0 - part)))
}

const MANTISSA: u64 = (1 << 52) - 1;
/// Numbers from here on are whole, and the last bits of one are those of a small integer added to it. Unlike a conversion
/// to integers, such an addition is one instruction on every processor.
const WHOLE: f64 = (MANTISSA + 1) as f64;
const BEND: f64 = 0.34;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roots_are_near_enough_to_plan_with() {
        for i in 0..2000 {
            let size = libm::exp(0.05 * f64::from(i) - 60.0);
            for k in [7, 18, 28] {
                let length = root(1e-12, size, k);
                let exact = (1e-12 / size).powf(1.0 / k as f64);
                assert!((length / exact - 1.0).abs() < 0.01, "{size} {k}: {length} {exact}");
            }
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
