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

/// For x above this the terms of the divergent series for the tail fall below round-off before they grow.
const SERIES_FROM: f64 = 40.0;

/// ∫_x^∞ J0; ∫_0^∞ J0 = 1, so a negative x gives 2 - ∫_{|x|}^∞ J0.
pub(super) fn tail(x: f64) -> f64 {
    if x < 0.0 {
        2.0 - tail(-x)
    } else if x < SERIES_FROM {
        1.0 - integral_from_zero(x)
    } else {
        tail_by_parts(x)
    }
}

/// ∫_0^x J0 = 2 Σ J_{2k+1}(x) (Abramowitz & Stegun 11.1.2), by Miller's downward recurrence
/// normalised with J0 + 2 Σ J_{2k} = 1.
fn integral_from_zero(x: f64) -> f64 {
    if x < 1e-8 {
        return x;
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 ≤ x < 40")]
    let start = 2 * ((x + 40.0) as usize / 2);
    let (mut above, mut here) = (0.0, 1e-300);
    let (mut odd, mut even) = (0.0, 0.0);
    for n in (1..=start).rev() {
        if n % 2 == 0 {
            even += here;
        } else {
            odd += here;
        }
        #[expect(clippy::cast_precision_loss, reason = "n < 100")]
        let below = 2.0 * n as f64 / x * here - above;
        (above, here) = (here, below);
    }
    2.0 * odd / (here + 2.0 * even)
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

/// J0(x) = Σ (-x²/4)^k / k!²
pub(super) fn taylor(degree: usize) -> Vec<f64> {
    let mut sum = vec![0.0; degree + 1];
    let mut here = 1.0;
    for (k, coefficient) in sum.iter_mut().step_by(2).enumerate() {
        *coefficient = here;
        here *= -0.25 / ((k + 1) * (k + 1)) as f64;
    }
    sum
}
