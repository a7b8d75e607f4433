//! J0 with its derivatives and integrals.

/// f' = -J1, f'' = J1/x - J0.
pub(super) fn slope_and_curvature(x: f64) -> (f64, f64) {
    let j1 = libm::j1(x);
    let j1_over_x = if x.abs() < 1e-8 { 0.5 } else { j1 / x };
    (-j1, j1_over_x - libm::j0(x))
}

/// ∫_{-∞}^∞ J0(x) cos(qx)dx = 2/√(1-q²) for |q| < 1, 0 beyond (and at the singular |q| = 1).
pub(super) fn fourier(q: f64) -> f64 {
    if q.abs() < 1.0 { 2.0 / (1.0 - q * q).sqrt() } else { 0.0 }
}

/// `J_0(x)`, `J_1(x)`, … up to the last one above round-off, by Miller's downward recurrence normalised with J0 + 2 Σ
/// `J_{2k}` = 1.
pub fn bessel_orders(x: f64) -> Vec<f64> {
    if x.abs() < 1e-8 {
        return vec![1.0, 0.5 * x];
    }
    // Beyond the turning point at n = |x| they fall within some |x|^{1/3}.
    let size = x.abs();
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let last = 2 * ((0.5 * (size + 16.0 * libm::cbrt(size) + 24.0)) as usize);
    let mut orders = vec![0.0; last + 2];
    orders[last] = 1e-300;
    for n in (1..=last).rev() {
        #[expect(clippy::cast_precision_loss, reason = "n < 2^52")]
        let factor = 2.0 * n as f64 / x;
        orders[n - 1] = factor * orders[n] - orders[n + 1];
        if orders[n - 1].abs() > 1e250 {
            orders[n - 1..].iter_mut().for_each(|order| *order *= 1e-250);
        }
    }
    let norm = orders[0] + 2.0 * orders.iter().skip(2).step_by(2).sum::<f64>();
    orders.iter_mut().for_each(|order| *order /= norm);
    let kept = orders.iter().rposition(|order| order.abs() > 1e-20).unwrap_or(0);
    orders.truncate(kept + 1);
    orders
}

/// For x above this the terms of the divergent series for the tail fall below round-off before they grow.
const SERIES_FROM: f64 = 40.0;

/// ∫_x^∞ J0; ∫_0^∞ J0 = 1, so a negative x gives 2 - ∫_{|x|}^∞ J0.
pub(super) fn tail(x: f64) -> f64 {
    if x < 0.0 {
        2.0 - tail(-x)
    } else if x < SERIES_FROM {
        // ∫_0^x J0 = 2 Σ `J_{2k+1}`(x), Abramowitz & Stegun 11.1.2.
        1.0 - 2.0 * bessel_orders(x).iter().skip(1).step_by(2).sum::<f64>()
    } else {
        tail_by_parts(x)
    }
}

/// Integration by parts, alternately with J1 = -J0' and x J0 = (x J1)':
/// ∫_x^∞ J0/t^m = -J1/x^m + (m+1) ∫ J1/t^{m+1} and ∫_x^∞ J1/t^m = J0/x^m - m ∫ J0/t^{m+1}.
fn tail_by_parts(x: f64) -> f64 {
    let (j0, j1) = (libm::j0(x), libm::j1(x));
    let mut sum = 0.0;
    let mut coefficient = 1.0;
    let mut m = 0.0;
    while f64::abs(coefficient) > 1e-18 && m < x {
        sum -= coefficient * j1;
        coefficient *= (m + 1.0) / x;
        m += 1.0;
        sum += coefficient * j0;
        coefficient *= -m / x;
        m += 1.0;
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against the functions of the C library, at orders that it has.
    #[test]
    fn orders_of_bessel_are_those_of_the_library() {
        for i in 1..400 {
            let x = 0.37 * f64::from(i) - 60.0;
            let orders = bessel_orders(x);
            for (n, order) in (0..).zip(&orders) {
                let right = libm::jn(n, x);
                assert!((order - right).abs() < 2e-15, "J_{n}({x}): {order} {right}");
            }
            assert!(libm::jn(orders.len().try_into().unwrap(), x).abs() < 1e-19);
        }
        assert_eq!(bessel_orders(0.0), [1.0, 0.0]);
    }
}
