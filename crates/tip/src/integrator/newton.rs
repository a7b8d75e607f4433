//! Newton's iteration for the equations of a step.

const MOST_ITERATIONS: u64 = 12;
/// Corrections below this are round-off of displacements of order one.
const ROUND_OFF: f64 = 1e-15;
/// Largest ratio of successive corrections for which the Jacobian of an earlier iteration is kept.
const SLOWEST_WITH_OLD_JACOBIAN: f64 = 0.03;

/// Iterates to an error below `enough`, or to round-off, which is at least `rounding`; returns whether it converged.
///
/// `correct` applies one correction and returns its size, `None` if the iteration is to end. Its argument is whether it
/// must compute the Jacobian anew: it is kept as long as this requires no additional iteration.
#[inline]
pub(crate) fn newton(
    (enough, rounding): (f64, f64),
    count: &mut u64,
    mut correct: impl FnMut(bool) -> Option<f64>,
) -> bool {
    let round_off = ROUND_OFF.max(rounding);
    let (mut previous, mut ratio) = (f64::INFINITY, 1.0);
    for iterations in 1..=MOST_ITERATIONS {
        *count += 1;
        let Some(size) = correct(ratio > SLOWEST_WITH_OLD_JACOBIAN) else { return false };
        // The next correction would be smaller by this ratio at least.
        ratio = (size / previous).min(1.0);
        if iterations > 3 && ratio > 0.9 && size > 100.0 * round_off {
            return false;
        }
        if ratio * size <= enough.max(round_off) && (iterations > 1 || size <= enough) {
            return true;
        }
        previous = size;
    }
    false
}
