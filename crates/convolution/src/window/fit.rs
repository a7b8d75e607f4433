//! The polynomials of the window: a power series, economised to the necessary degree.

use super::{COEFFICIENTS, HALF, SHAPE, Window};

/// Terms of the power series before economisation: the slowest series, of the outermost cell whose end is the branch
/// point of the square root, is below 1e-17 from here on.
const TERMS: usize = 40;

/// Polynomial coefficients of the lower eight weights in `s = 2·offset − 1`, which lies in [−1, 1].
pub(super) fn lower_weights() -> [[f64; COEFFICIENTS]; HALF] {
    let chebyshev = chebyshev();
    std::array::from_fn(|cell| {
        // Weight `cell` is φ((cell − 7 − offset)/8).
        let center = (cell as f64 - 7.5) / HALF as f64;
        economised(series(center, -0.5 / HALF as f64), &chebyshev)
    })
}

/// The power series in `s` of `φ(center + step·s)`, by the recurrences of the square root and of the exponential.
/// Unlike those of an interpolant of rounded samples, its high coefficients have a small relative error, which the
/// slopes require.
fn series(center: f64, step: f64) -> [f64; TERMS] {
    // r² = 1 − z², and then φ' = β r' φ.
    let square = [1.0 - center * center, -2.0 * center * step, -step * step];
    let mut root = [0.0; TERMS];
    let mut phi = [0.0; TERMS];
    root[0] = square[0].sqrt();
    phi[0] = Window::formula(center);
    for n in 1..TERMS {
        let cross: f64 = (1..n).map(|i| root[i] * root[n - i]).sum();
        root[n] = (square.get(n).unwrap_or(&0.0) - cross) / (2.0 * root[0]);
        let sum: f64 = (1..=n).map(|i| i as f64 * root[i] * phi[n - i]).sum();
        phi[n] = SHAPE * sum / n as f64;
    }
    phi
}

/// Lowers the degree on [−1, 1]: from the top, each power is replaced by means of the Chebyshev polynomial of its
/// degree (Lanczos).
fn economised(mut powers: [f64; TERMS], chebyshev: &[[f64; TERMS]; TERMS]) -> [f64; COEFFICIENTS] {
    for n in (COEFFICIENTS..TERMS).rev() {
        let factor = powers[n] / chebyshev[n][n];
        for (power, t) in powers.iter_mut().zip(&chebyshev[n]) {
            *power -= factor * t;
        }
    }
    std::array::from_fn(|n| powers[n])
}

/// Coefficients of the Chebyshev polynomials, integers exact up to 2⁵³, by
/// `T_n = 2s T_{n−1} − T_{n−2}`.
fn chebyshev() -> [[f64; TERMS]; TERMS] {
    let mut all = [[0.0; TERMS]; TERMS];
    (all[0][0], all[1][1]) = (1.0, 1.0);
    for n in 2..TERMS {
        for d in 0..=n {
            let shifted = if d == 0 { 0.0 } else { all[n - 1][d - 1] };
            all[n][d] = 2.0 * shifted - all[n - 2][d];
        }
    }
    all
}
