//! Oscillation of a tip across the scan: whether it is periodic, and the errors of its figures.

use stickslip_tip::planar::{Step, Trajectory};

/// A motion is periodic if its largest deviation changes by at most this fraction of its amplitude from period to
/// period.
const REPEATS: f64 = 1e-3;
/// Evaluations of the velocity within a step: between two of them it changes sign at most once.
const LOOKS: u32 = 8;
/// Number of bisections for the time of a turning point: to the last bit of a step.
const BISECTIONS: u32 = 50;
/// Slowest decay per period that the extrapolation of a change assumes.
const SLOWEST: f64 = 0.98;

/// The periodic motion across the scan at the end of a run. The limiting motion lies within the errors if the changes
/// from period to period decay geometrically.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Snaking {
    /// Period of y0, in Γ/k; the motion along the scan has half this period.
    pub period: f64,
    /// Error of the period, in Γ/k.
    pub period_error: f64,
    /// Half the peak-to-peak value of y0, in σ.
    pub amplitude: f64,
    /// Error of the amplitude of y0, in σ.
    pub amplitude_error: f64,
    /// Half the peak-to-peak value of R - x0 over the last period, in σ.
    pub amplitude_along: f64,
    /// Change of the largest y0 from the last period but one to the last, divided by the amplitude.
    pub drift: f64,
}

/// A turning point of y0.
#[derive(Clone, Copy)]
struct Turn {
    t: f64,
    y: f64,
}

/// The periodic motion of y0 at the end of a run with this tolerance; `None` if the amplitude of y0 is not above the
/// tolerance, y0 has oscillated less than five times, or the motion is not periodic.
#[must_use]
pub fn snaking(trajectory: &Trajectory, tolerance: f64) -> Option<Snaking> {
    let (highest, lowest) = turns(trajectory);
    let [.., a, b, c] = highest[..] else { return None };
    let low = lowest.last()?;
    if highest.len() < 5 {
        return None;
    }
    let amplitude = 0.5 * (c.y - low.y);
    if amplitude <= 10.0 * tolerance {
        return None;
    }
    let drift = (c.y - b.y).abs() / amplitude;
    let periods = [b.t - a.t, c.t - b.t];
    if drift > REPEATS || (periods[1] - periods[0]).abs() > REPEATS * periods[1] {
        return None;
    }
    // Round-off of positions moves a turning point by that over the curvature there.
    let of_time = 10.0 * tolerance * periods[1] / amplitude;
    Some(Snaking {
        period: periods[1],
        period_error: left(
            [periods[1] - periods[0], (b.y - a.y) * periods[1] / amplitude],
            [c.y - b.y, b.y - a.y],
        ) + of_time,
        amplitude,
        amplitude_error: left([c.y - b.y, 0.0], [c.y - b.y, b.y - a.y]) + 4.0 * tolerance,
        amplitude_along: swing_along(trajectory, b.t, c.t),
        drift,
    })
}

/// Sum of a geometric series that begins with the larger of these sizes and decays as two changes did, the last of
/// which comes first.
fn left(sizes: [f64; 2], [last, before]: [f64; 2]) -> f64 {
    let fading = (last / before).abs();
    let fading = if fading.is_finite() { fading.min(SLOWEST) } else { SLOWEST };
    let size = sizes.into_iter().fold(0.0, |most: f64, size| most.max(size.abs()));
    size / (1.0 - fading)
}

/// Maxima and minima of y0, in the order of time.
fn turns(trajectory: &Trajectory) -> (Vec<Turn>, Vec<Turn>) {
    let (mut highest, mut lowest) = (vec![], vec![]);
    for step in trajectory.steps() {
        let time = |i: u32| step.along.t + step.along.h * f64::from(i) / f64::from(LOOKS);
        let velocity = |t: f64| step.velocity(t)[1];
        for i in 0..LOOKS {
            let (from, to) = (velocity(time(i)), velocity(time(i + 1)));
            if from * to < 0.0 {
                let turn = turn(step, (time(i), time(i + 1)));
                if from > 0.0 { highest.push(turn) } else { lowest.push(turn) }
            }
        }
    }
    (highest, lowest)
}

fn turn(step: &Step, (mut low, mut high): (f64, f64)) -> Turn {
    let rises = step.velocity(low)[1] > 0.0;
    for _ in 0..BISECTIONS {
        let middle = f64::midpoint(low, high);
        if (step.velocity(middle)[1] > 0.0) == rises { low = middle } else { high = middle }
    }
    let t = f64::midpoint(low, high);
    Turn { t, y: step.y0(t) }
}

/// Half the peak-to-peak value of R - x0 between two times.
fn swing_along(trajectory: &Trajectory, from: f64, to: f64) -> f64 {
    const SAMPLES: u32 = 2000;
    let lag = |i: u32| trajectory.lag(from + (to - from) * f64::from(i) / f64::from(SAMPLES));
    let (low, high) = (0..=SAMPLES)
        .map(lag)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), l| (low.min(l), high.max(l)));
    0.5 * (high - low)
}

/// The largest |y0| at the ends of steps from a given time on.
#[must_use]
pub fn largest_across(trajectory: &Trajectory, from: f64) -> f64 {
    let late = trajectory.steps().iter().filter(|step| step.end() >= from);
    late.map(|step| step.y_at_end().abs()).fold(0.0, f64::max)
}
