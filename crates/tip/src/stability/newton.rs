//! Newton's method for one zero of an analytic function, plain and deflated.

use super::transform::Scaled;
use num_complex::Complex64;

/// Iterations before a start is given up.
const MOST_ITERATIONS: usize = 40;

/// Newton's method to round-off: until the steps no longer shrink.
pub(super) fn polish(h: impl Fn(Complex64) -> Scaled, start: Complex64) -> Complex64 {
    let mut z = start;
    let mut last = f64::INFINITY;
    for _ in 0..MOST_ITERATIONS {
        let at = h(z);
        let step = at.value / at.derivative;
        let size = step.norm();
        if !size.is_finite() || (size >= last && size <= 1e-9 * (z.norm() + 1e-300)) {
            break;
        }
        z -= step;
        last = size;
        if size <= 0.5 * f64::EPSILON * z.norm() {
            break;
        }
    }
    z
}

/// A zero other than the `known` ones and their conjugates: Newton's method on h/Π(z - z_k) (Maehly),
/// steps at most `longest`. `None` if it does not settle.
pub(super) fn another(
    h: impl Fn(Complex64) -> Scaled,
    start: Complex64,
    known: &[Complex64],
    longest: f64,
) -> Option<Complex64> {
    let mut z = start;
    for _ in 0..MOST_ITERATIONS {
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
