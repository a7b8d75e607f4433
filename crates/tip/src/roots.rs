//! Zeros of functions of one variable.

/// The zero of a function that changes sign between a and b, to round-off.
pub(crate) fn bisect(f: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let sign = f(a).signum();
    for _ in 0..52 {
        let middle = 0.5 * (a + b);
        *(if f(middle) * sign > 0.0 { &mut a } else { &mut b }) = middle;
    }
    0.5 * (a + b)
}
