//! How a small error grows: the distance of two runs that start a little apart.

use stickslip_tip::Trajectory;

/// What becomes of a small disturbance of the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// The largest difference in l that it makes, over its own size.
    pub amplification: f64,
    /// The leading Lyapunov exponent, in k/Γ, as far as this run shows it: the rate at which the difference
    /// grows (falls, if negative) in the second half of the time in which it is neither lost in the errors
    /// nor as large as the motion. `None` where that is too short a time to tell.
    pub exponent: Option<f64>,
}

/// The run in so many windows: in each the largest difference counts, for a shift in time shows only at the
/// slips.
const WINDOWS: usize = 128;
/// A rate is read from at least so many.
const LEAST_WINDOWS: usize = 8;
const TIMES_PER_WINDOW: usize = 64;
/// Of the swing of l: differences above are as large as the motion.
const SMALL: f64 = 0.05;
/// Multiple of the runs' tolerance: differences below are errors.
const ERRORS: f64 = 30.0;

/// From two runs to the same tolerance, whose starts differ by `shift` in l.
pub(super) fn growth(one: &Trajectory, twin: &Trajectory, shift: f64, tolerance: f64) -> Growth {
    let (start, end) = (one.start().max(twin.start()), one.end().min(twin.end()));
    let width = (end - start) / WINDOWS as f64;
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut largest = |window: usize| {
        let times = (0..=TIMES_PER_WINDOW).map(|i| i as f64 / TIMES_PER_WINDOW as f64);
        let differences = times.map(|part| {
            let t = (start + width * (window as f64 + part)).min(end);
            let l = one.l(t);
            (low, high) = (low.min(l), high.max(l));
            (l - twin.l(t)).abs()
        });
        differences.fold(0.0, f64::max)
    };
    let envelope: Vec<f64> = (0..WINDOWS).map(&mut largest).collect();
    let amplification = envelope.iter().copied().fold(0.0, f64::max) / shift;
    let meaningful = ERRORS * tolerance..SMALL * (high - low).max(shift / SMALL);
    let points: Vec<(f64, f64)> = envelope
        .iter()
        .enumerate()
        .take_while(|(_, difference)| meaningful.contains(difference))
        .map(|(window, difference)| (start + width * (window as f64 + 0.5), difference.ln()))
        .collect();
    // The first half still shows the disturbance itself, not only what grows fastest of it.
    let settled = &points[points.len() / 2..];
    let exponent = (settled.len() >= LEAST_WINDOWS).then(|| slope(settled));
    Growth { amplification, exponent: exponent.filter(|exponent| exponent.is_finite()) }
}

/// Of the straight line that fits best.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / n;
    let (mx, my) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|(x, y)| (x - mx) * (y - my)).sum();
    covariance / points.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}
