//! Reduction of the number of points without a visible change.

/// A point of a figure.
pub(crate) type Point = (f64, f64);

/// Number of columns into which a column of pixels is divided if the path turns back: it then contains arcs, not spikes.
const FINER: usize = 8;

/// The visible points of a stretch of curve, if `columns` columns of pixels span `low` to `high`: of consecutive
/// points in one column only the lowest and the highest are kept, in their order, and the ends of the curve. The columns
/// of a path that goes back are finer. Stretches with fewer points are unchanged.
pub(crate) fn thin(points: Vec<Point>, (low, high): (f64, f64), columns: usize) -> Vec<Point> {
    let goes_back = !points.is_sorted_by(|a, b| a.0 <= b.0);
    let columns = if goes_back { FINER * columns } else { columns };
    if points.len() <= 2 * columns {
        return points;
    }
    let column = |p: &Point| ((p.0 - low) / (high - low) * columns as f64).floor() as i64;
    let mut kept = Vec::with_capacity(2 * columns + 2);
    // A repetition of an end is invisible.
    kept.extend(points.first());
    for run in points.chunk_by(|a, b| column(a) == column(b)) {
        push_extremes(run, &mut kept);
    }
    kept.extend(points.last());
    kept
}

/// Appends the lowest and the highest point of `run` in their order.
fn push_extremes(run: &[Point], kept: &mut Vec<Point>) {
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

#[cfg(test)]
mod tests {
    use super::*;

    fn sampled(n: usize, f: impl Fn(f64) -> f64) -> Vec<Point> {
        let x = (0..n).map(|i| i as f64 / (n - 1) as f64);
        x.map(|x| (x, f(x))).collect()
    }

    #[test]
    fn thinning_keeps_a_spike_of_one_sample() {
        let mut points = sampled(100_000, |x| (40.0 * x).sin());
        points[54_321].1 = 7.5;
        points[77_777].1 = -9.25;
        let (up, down) = (points[54_321], points[77_777]);
        let thinned = thin(points, (0.0, 1.0), 700);
        assert!(thinned.len() <= 2 * 700 + 4, "{} points", thinned.len());
        assert!(thinned.contains(&up) && thinned.contains(&down));
    }

    #[test]
    fn thinning_keeps_the_order_and_the_ends() {
        let points = sampled(50_000, |x| (300.0 * x).cos());
        let thinned = thin(points.clone(), (0.0, 1.0), 500);
        assert!(thinned.is_sorted_by(|a, b| a.0 <= b.0));
        assert_eq!(thinned.first(), points.first());
        assert_eq!(thinned.last(), points.last());
    }

    #[test]
    fn a_circle_stays_round() {
        let columns = 280;
        let angles = (0..200_000).map(|i| std::f64::consts::TAU * f64::from(i) / 2000.0);
        let points: Vec<Point> = angles.map(|a| (a.cos(), a.sin())).collect();
        let thinned = thin(points, (-1.0, 1.0), columns);
        // Distance of the chords from the circle, in columns: 1 with columns of pixels.
        let off = |pair: &[Point]| {
            let middle = ((pair[0].0 + pair[1].0) / 2.0, (pair[0].1 + pair[1].1) / 2.0);
            (1.0 - middle.0.hypot(middle.1)) * columns as f64 / 2.0
        };
        let worst = thinned.windows(2).map(off).fold(0.0, f64::max);
        println!("{worst}");
        assert!(worst < 0.2, "{worst}");
    }

    #[test]
    fn short_curves_stay_as_they_are() {
        let points = vec![(0.0, 1.0), (1.0, 9.0), (2.0, 3.0)];
        assert_eq!(thin(points.clone(), (0.0, 2.0), 10), points);
    }
}
