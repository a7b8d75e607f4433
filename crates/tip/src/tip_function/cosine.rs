//! cos x with its derivatives and integrals, in a file of its own so that sums over other tips are not slowed down.

#[cold]
pub(super) fn value(x: f64) -> f64 {
    libm::cos(x)
}

#[cold]
pub(super) fn slope_and_curvature(x: f64) -> (f64, f64) {
    (-libm::sin(x), -libm::cos(x))
}

/// ∫_x^∞ cos in the mean: the limit of a slowly decaying cosine.
pub(super) fn tail(x: f64) -> f64 {
    -libm::sin(x)
}

/// ∫_0^∞ cos(x+y) e^{-sy}dy = Re e^{ix}/(s - i)
pub(super) fn fading(x: f64, s: f64) -> f64 {
    (s * libm::cos(x) - libm::sin(x)) / (s * s + 1.0)
}

/// cos x = Σ (-x²)^k / (2k)!
pub(super) fn taylor(degree: usize) -> Vec<f64> {
    let mut sum = vec![0.0; degree + 1];
    let mut here = 1.0;
    for (k, coefficient) in sum.iter_mut().step_by(2).enumerate() {
        *coefficient = here;
        here *= -1.0 / ((2 * k + 1) * (2 * k + 2)) as f64;
    }
    sum
}
