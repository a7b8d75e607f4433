//! Growth of small errors: the distance of two runs with slightly different initial conditions.

use std::ops::Range;
use stickslip_tip::sorting::ends;

/// Growth of a small initial disturbance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Growth {
    /// The largest resulting difference in l, over the initial one.
    pub amplification: f64,
    /// Estimate of the leading Lyapunov exponent, in k/Γ: the rate at which the difference grows, or decays if it is
    /// negative. The rate is that of the second half of the time in which the difference is above the errors and below
    /// the size of the motion; `None` if that time is too short.
    pub exponent: Option<f64>,
}

/// Number of windows of the run; each contributes its largest difference, because a shift in time is visible only at
/// the slips.
const WINDOWS: usize = 128;
/// Smallest number of windows for an estimate of the rate.
const LEAST_WINDOWS: usize = 8;
const TIMES_PER_WINDOW: usize = 64;
/// Fraction of the oscillation of l above which a difference has the size of the motion.
const SMALL: f64 = 0.05;
/// Multiple of the tolerance of the runs below which differences are errors.
const ERRORS: f64 = 30.0;

/// l and y0 of a run at the times of all windows; y0 is 0 in one coordinate.
pub(super) struct Probes {
    start: f64,
    end: f64,
    values: Vec<[f64; 2]>,
}

impl Probes {
    pub(super) fn over((start, end): (f64, f64)) -> Self {
        Self { start, end, values: Vec::with_capacity(WINDOWS * (TIMES_PER_WINDOW + 1)) }
    }

    fn width(&self) -> f64 {
        (self.end - self.start) / WINDOWS as f64
    }

    fn middle(&self, window: usize) -> f64 {
        self.start + self.width() * (window as f64 + 0.5)
    }

    /// Time of the next value. The last time of a window is the first of the next.
    fn due(&self) -> Option<f64> {
        let known = self.values.len();
        let (window, i) = (known / (TIMES_PER_WINDOW + 1), known % (TIMES_PER_WINDOW + 1));
        let part = i as f64 / TIMES_PER_WINDOW as f64;
        let t = self.start + self.width() * (window as f64 + part);
        (window < WINDOWS).then_some(t.min(self.end))
    }

    /// Adds the values at all remaining times before this one.
    pub(super) fn probe(&mut self, before: f64, values: impl Fn(f64) -> [f64; 2]) {
        while let Some(t) = self.due().filter(|t| *t < before) {
            self.values.push(values(t));
        }
    }

    /// The size of the motion: the larger of the ranges of l and y0.
    fn size(&self) -> f64 {
        let range = |axis: usize| {
            let (low, high) = ends(self.values.iter().map(|values| values[axis]));
            high - low
        };
        range(0).max(range(1))
    }

    /// The growth, in the coordinate in which errors grow most, from two runs to the same tolerance. The other one is
    /// shifted by `shift`, at the start or later.
    pub(super) fn growth(&self, twin: &Self, shift: f64, tolerance: f64) -> Growth {
        let meaningful = ERRORS * tolerance..SMALL * self.size().max(shift / SMALL);
        let [along, across] = [0, 1].map(|axis| self.growth_of(axis, twin, shift, &meaningful));
        if across.amplification > along.amplification { across } else { along }
    }

    fn growth_of(&self, axis: usize, twin: &Self, shift: f64, meaningful: &Range<f64>) -> Growth {
        let differences: Vec<f64> =
            self.values.iter().zip(&twin.values).map(|(a, b)| (a[axis] - b[axis]).abs()).collect();
        let windows = differences.chunks(TIMES_PER_WINDOW + 1);
        let envelope: Vec<f64> =
            windows.map(|window| window.iter().copied().fold(0.0, f64::max)).collect();
        let amplification = envelope.iter().copied().fold(0.0, f64::max) / shift;
        let points: Vec<(f64, f64)> = envelope
            .iter()
            .enumerate()
            // A push comes some time after the start.
            .skip_while(|(_, difference)| **difference < meaningful.start)
            .take_while(|(_, difference)| meaningful.contains(difference))
            .map(|(window, difference)| (self.middle(window), difference.ln()))
            .collect();
        // The first half still shows the disturbance itself, not only what grows fastest of it.
        let settled = &points[points.len() / 2..];
        let exponent = (settled.len() >= LEAST_WINDOWS).then(|| slope(settled));
        Growth { amplification, exponent: exponent.filter(|exponent| exponent.is_finite()) }
    }
}

/// Slope of the line of best fit.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / n;
    let (mx, my) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|(x, y)| (x - mx) * (y - my)).sum();
    covariance / points.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}
