//! Zeros of functions of one variable.

/// Bisections in the worst case: 52 reach round-off; smooth functions take about six iterations.
const MOST_ITERATIONS: usize = 60;

/// The zero of a function that changes sign between a and b, to round-off.
///
/// Ridders' method: false position for `f e^{kx}`, with k such that its values at a, b and the midpoint lie on a line.
/// Reference: C. Ridders, IEEE Trans. Circuits Syst. 26, 979 (1979).
pub fn zero_between(f: impl Fn(f64) -> f64, a: f64, b: f64) -> f64 {
    zero_to(f, (a, b), 0.0)
}

/// As [`zero_between`], but returns the first iterate x at which |f(x)| is at most `enough`.
pub fn zero_to(f: impl Fn(f64) -> f64, (mut a, mut b): (f64, f64), enough: f64) -> f64 {
    let (mut at_a, mut at_b) = (f(a), f(b));
    let mut last = a;
    for _ in 0..MOST_ITERATIONS {
        let middle = 0.5 * (a + b);
        let at_middle = f(middle);
        let scale = (at_middle * at_middle - at_a * at_b).sqrt();
        let shift = (middle - a) * at_middle * (at_a - at_b).signum() / scale;
        // Underflow or a function that is 0 at both ends leaves the midpoint.
        let x = if shift.is_finite() { middle + shift } else { middle };
        let at_x = f(x);
        let narrow = 2.0 * f64::EPSILON * x.abs().max(f64::MIN_POSITIVE);
        if at_x.abs() <= enough || (b - a).abs().min((x - last).abs()) <= narrow {
            return x;
        }
        last = x;
        // The narrowest of the brackets that a, b, the middle and x make.
        if at_middle * at_x < 0.0 {
            ((a, at_a), (b, at_b)) = ((middle, at_middle), (x, at_x));
        } else if at_a * at_x < 0.0 {
            (b, at_b) = (x, at_x);
        } else {
            (a, at_a) = (x, at_x);
        }
    }
    0.5 * (a + b)
}

/// As [`zero_between`], by bisection: slower, but it ends at the sign change for any function.
pub fn halved_between(f: impl Fn(f64) -> f64, low: f64, high: f64) -> f64 {
    let sign = f(low).signum();
    let mut halvings = 0..MOST_ITERATIONS;
    let (low, high) = bisected((low, high), |x| f(x) * sign > 0.0, |_| halvings.next().is_none());
    0.5 * (low + high)
}

/// A bracket of the point where a property is lost, from a point with the property to one without it. It is halved
/// until `is_narrow`, or until no floating-point number lies within it.
pub fn bisected(
    (mut has, mut has_not): (f64, f64),
    is_before: impl Fn(f64) -> bool,
    mut is_narrow: impl FnMut((f64, f64)) -> bool,
) -> (f64, f64) {
    while !is_narrow((has, has_not)) {
        let middle = 0.5 * (has + has_not);
        if middle.to_bits() == has.to_bits() || middle.to_bits() == has_not.to_bits() {
            break;
        }
        *(if is_before(middle) { &mut has } else { &mut has_not }) = middle;
    }
    (has, has_not)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn zeros_are_found_to_round_off_in_a_few_looks() {
        let looks = Cell::new(0);
        let counted = |f: fn(f64) -> f64| {
            let looks = &looks;
            move |x: f64| {
                looks.set(looks.get() + 1);
                f(x)
            }
        };
        let judge = |f: fn(f64) -> f64, (a, b): (f64, f64), zero: f64, most: i32| {
            looks.set(0);
            let found = zero_between(counted(f), a, b);
            assert!((found - zero).abs() < 1e-15, "{found} for {zero}");
            assert!(looks.get() <= most, "{} looks", looks.get());
        };
        judge(|x| x.cos() - x, (0.0, 1.0), 0.739_085_133_215_160_6, 14);
        judge(|x| x - 0.3, (1.0, 0.0), 0.3, 6);
        judge(|x| x.powi(9) - 1e-9, (0.0, 1.0), 0.1, 40);
        judge(f64::signum, (-0.7, 1.0), 0.0, 130);
    }

    #[test]
    fn halving_ends_at_the_change_of_sign() {
        for (low, high) in [(0.0, 1.0), (1.0, 0.0)] {
            let found = halved_between(|x| x.cos() - x, low, high);
            assert!((found - 0.739_085_133_215_160_6).abs() < 1e-15, "{found}");
        }
        let step = |x: f64| if x < 0.3 { -1.0 } else { 2.0 };
        assert!((halved_between(step, -1.0, 1.0) - 0.3).abs() < 1e-15);
    }
}
