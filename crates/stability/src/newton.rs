//! Newton's method for one zero of an analytic function, plain and deflated, and for all zeros of a polynomial.

use super::transform::Scaled;
use num_complex::Complex64;
use std::f64::consts::TAU;

/// Largest number of iterations from one start.
pub(super) const MOST_ITERATIONS: usize = 40;

/// Newton's method to round-off: until the steps no longer decrease. Close to a double zero they never converge; the
/// iterate of smallest |h| is returned.
pub(super) fn polish(h: impl Fn(Complex64) -> Scaled, start: Complex64) -> Complex64 {
    let mut z = start;
    let mut last = f64::INFINITY;
    let (mut best, mut smallest) = (start, f64::INFINITY);
    for _ in 0..MOST_ITERATIONS {
        let at = h(z);
        let logarithm = at.value.norm().ln() + at.log_scale;
        if logarithm <= smallest {
            (best, smallest) = (z, logarithm);
        }
        let step = at.value / at.derivative;
        let size = step.norm();
        if !size.is_finite() {
            break;
        }
        if size >= last && size <= 1e-9 * (z.norm() + 1e-300) {
            return z;
        }
        z -= step;
        last = size;
        if size <= 0.5 * f64::EPSILON * z.norm() {
            return z;
        }
    }
    best
}

/// Both zeros close to a double one, from the zero m of h': h ≈ h(m) + h''(m)(z-m)²/2, with h'' by differences over a
/// small part of `scale`, the distance over which h varies. h is real on the real axis: if m is real, the zeros are
/// real or conjugate. `None` if h' has no zero close to `start`.
pub(super) fn pair(
    h: impl Fn(Complex64) -> Scaled,
    start: Complex64,
    scale: f64,
) -> Option<[Complex64; 2]> {
    let step = 1e-3 * scale;
    let second = |z: Complex64| {
        let (base, far, near) = (h(z), h(z + step), h(z - step));
        let at = |h: &Scaled| h.derivative * (h.log_scale - base.log_scale).exp();
        ((at(&far) - at(&near)) / (2.0 * step), base)
    };
    let mut middle = start;
    for _ in 0..4 {
        let (curvature, at) = second(middle);
        middle -= at.derivative / curvature;
    }
    let away = (middle - start).norm();
    if away.is_nan() || away >= step {
        return None;
    }
    if middle.im.abs() < 1e-7 * scale {
        middle.im = 0.0;
    }
    let (curvature, at) = second(middle);
    let mut squared = at.value / curvature * -2.0;
    if middle.im.abs() <= 0.0 {
        squared.im = 0.0;
    }
    let half = squared.sqrt();
    let zeros = [middle + half, middle - half];
    // Closer than this, one step of Newton's method leads from one to the other.
    let distinct = half.norm() > 1e-6 * scale;
    Some(if distinct { zeros.map(|z| polish(&h, z)) } else { zeros })
}

/// A zero other than the `known` ones and their conjugates: Newton's method on h/Π(z - z_k) (Maehly), with at most
/// `most` steps, each no longer than `longest`. `None` if it does not converge.
pub(super) fn another(
    h: impl Fn(Complex64) -> Scaled,
    start: Complex64,
    known: &[Complex64],
    (longest, most): (f64, usize),
) -> Option<Complex64> {
    let mut z = start;
    for _ in 0..most {
        let at = h(z);
        let logarithmic = |k: &Complex64| {
            let own = (z - k).inv();
            if k.im.abs() > 0.0 { own + (z - k.conj()).inv() } else { own }
        };
        let poles: Complex64 = known.iter().map(logarithmic).sum();
        let mut step = (at.derivative / at.value - poles).inv();
        let size = step.norm();
        if at.value.norm() <= 0.0 {
            return Some(z);
        }
        if !size.is_finite() {
            return None;
        }
        if size > longest {
            step *= longest / size;
        }
        z -= step;
        if size <= 1e-9 * (z.norm() + 1e-3 * longest) {
            return Some(polish(h, z));
        }
    }
    None
}

/// The real a and b with a x + b y = `value`.
pub(super) fn real_steps(value: Complex64, [x, y]: [Complex64; 2]) -> [f64; 2] {
    let cross = |a: Complex64, b: Complex64| a.re * b.im - a.im * b.re;
    [cross(value, y), cross(x, value)].map(|part| part / cross(x, y))
}

/// The N zeros of z^N + c₁z^{N-1} + … + c_N, by simultaneous iteration (Durand and Kerner).
pub(super) fn simultaneous<const N: usize>(coefficients: [f64; N]) -> [Complex64; N] {
    let value = |z: Complex64| coefficients.iter().fold(Complex64::ONE, |sum, c| sum * z + c);
    let size = (1..=N).zip(coefficients).map(|(k, c)| c.abs().powf(1.0 / k as f64));
    let radius = size.fold(0.1, f64::max);
    let start = |k| Complex64::from_polar(radius, 0.4 + TAU / N as f64 * k as f64);
    let mut zeros: [Complex64; N] = std::array::from_fn(start);
    for _ in 0..300 {
        let mut moved = 0.0_f64;
        for i in 0..N {
            let others = (0..N).filter(|j| *j != i).map(|j| zeros[i] - zeros[j]);
            let step = value(zeros[i]) / others.product::<Complex64>();
            if step.is_finite() {
                zeros[i] -= step;
                moved = moved.max(step.norm() / (zeros[i].norm() + f64::MIN_POSITIVE));
            }
        }
        if moved < 1e-15 {
            break;
        }
    }
    zeros
}

/// The zeros of z^n + c₁z^{n-1} + … + c_n with complex coefficients, by simultaneous iteration.
pub(super) fn zeros_of(coefficients: &[Complex64]) -> Vec<Complex64> {
    let degree = coefficients.len();
    let value = |z: Complex64| coefficients.iter().fold(Complex64::ONE, |sum, c| sum * z + c);
    let size = (1..=degree).zip(coefficients).map(|(k, c)| c.norm().powf(1.0 / k as f64));
    let radius = size.fold(f64::MIN_POSITIVE, f64::max);
    let start = |k| Complex64::from_polar(radius, 0.4 + TAU / degree as f64 * k as f64);
    let mut zeros: Vec<Complex64> = (0..degree).map(start).collect();
    for _ in 0..100 {
        let mut moved = 0.0_f64;
        for i in 0..degree {
            let others = (0..degree).filter(|j| *j != i).map(|j| zeros[i] - zeros[j]);
            let step = value(zeros[i]) / others.product::<Complex64>();
            if step.is_finite() {
                zeros[i] -= step;
                moved = moved.max(step.norm());
            }
        }
        if moved < 1e-15 * radius {
            break;
        }
    }
    zeros
}
