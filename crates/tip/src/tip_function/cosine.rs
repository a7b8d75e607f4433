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
