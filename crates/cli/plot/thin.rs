//! Fewer points, the same picture.

use super::axis::drawable;

/// The points of a curve that show when `columns` columns of pixels span `low` to `high`: of
/// consecutive points in one column only the lowest and the highest, in their order, besides the
/// ends of the curve. Curves without that many points stay as they are. Points that are not drawable
/// are left out, and the curve runs on past them.
pub(super) fn thin(
    x: &[f64],
    y: &[f64],
    (low, high): (f64, f64),
    columns: usize,
) -> Vec<(f64, f64)> {
    let shown = |p: &(f64, f64)| drawable(p.0) && drawable(p.1);
    let points: Vec<_> = x.iter().copied().zip(y.iter().copied()).filter(shown).collect();
    if points.len() <= 2 * columns {
        return points;
    }
    let column = |p: &(f64, f64)| ((p.0 - low) / (high - low) * columns as f64).floor() as i64;
    let mut kept = Vec::with_capacity(2 * columns + 2);
    for run in points.chunk_by(|a, b| column(a) == column(b)) {
        push_extremes(run, &mut kept);
    }
    with_ends(&points, kept)
}

/// Appends the lowest and the highest point of `run` in their order.
fn push_extremes(run: &[(f64, f64)], kept: &mut Vec<(f64, f64)>) {
    let (mut lowest, mut highest) = (0, 0);
    for (i, point) in run.iter().enumerate() {
        if point.1 < run[lowest].1 {
            lowest = i;
        }
        if point.1 > run[highest].1 {
            highest = i;
        }
    }
    kept.push(run[lowest.min(highest)]);
    if lowest != highest {
        kept.push(run[lowest.max(highest)]);
    }
}

/// Adds first and last of `points`; a repetition does not show.
fn with_ends(points: &[(f64, f64)], kept: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let ends = (points.first().copied(), points.last().copied());
    ends.0.into_iter().chain(kept).chain(ends.1).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(n: usize, f: impl Fn(f64) -> f64) -> (Vec<f64>, Vec<f64>) {
        let x: Vec<f64> = (0..n).map(|i| i as f64 / (n - 1) as f64).collect();
        let y = x.iter().map(|&x| f(x)).collect();
        (x, y)
    }

    #[test]
    fn thinning_keeps_a_spike_of_one_sample() {
        let (x, mut y) = sampled(100_000, |x| (40.0 * x).sin());
        y[54_321] = 7.5;
        y[77_777] = -9.25;
        let thinned = thin(&x, &y, (0.0, 1.0), 700);
        assert!(thinned.len() <= 2 * 700 + 4, "{} points", thinned.len());
        assert!(thinned.contains(&(x[54_321], 7.5)));
        assert!(thinned.contains(&(x[77_777], -9.25)));
    }

    #[test]
    fn thinning_keeps_the_order_and_the_ends() {
        let (x, y) = sampled(50_000, |x| (300.0 * x).cos());
        let thinned = thin(&x, &y, (0.0, 1.0), 500);
        assert!(thinned.is_sorted_by(|a, b| a.0 <= b.0));
        assert_eq!(thinned.first(), Some(&(x[0], y[0])));
        assert_eq!(thinned.last(), Some(&(x[49_999], y[49_999])));
    }

    #[test]
    fn short_curves_stay_as_they_are_but_for_what_is_not_finite() {
        let thinned = thin(&[0.0, 1.0, 2.0], &[1.0, f64::NAN, 3.0], (0.0, 2.0), 10);
        assert_eq!(thinned, [(0.0, 1.0), (2.0, 3.0)]);
    }
}
