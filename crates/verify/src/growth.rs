//! Growth of small errors: the distance of two runs with slightly different initial conditions.

use super::repeat::Witness;
use stickslip_tip::{RunError, Scenario, Step, Support};

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

/// l of a run at the times of all windows.
pub(super) struct Probes {
    support: Support,
    start: f64,
    end: f64,
    l: Vec<f64>,
}

impl Probes {
    pub(super) fn of(scenario: &Scenario) -> Self {
        let l = Vec::with_capacity(WINDOWS * (TIMES_PER_WINDOW + 1));
        Self { support: scenario.support(), start: scenario.start_time(), end: scenario.until, l }
    }

    fn width(&self) -> f64 {
        (self.end - self.start) / WINDOWS as f64
    }

    fn middle(&self, window: usize) -> f64 {
        self.start + self.width() * (window as f64 + 0.5)
    }

    /// Time of the next value. The last time of a window is the first of the next.
    fn due(&self) -> Option<f64> {
        let (window, i) =
            (self.l.len() / (TIMES_PER_WINDOW + 1), self.l.len() % (TIMES_PER_WINDOW + 1));
        let part = i as f64 / TIMES_PER_WINDOW as f64;
        let t = self.start + self.width() * (window as f64 + part);
        (window < WINDOWS).then_some(t.min(self.end))
    }

    fn probe(&mut self, step: &Step, is_due: impl Fn(f64) -> bool) {
        while let Some(t) = self.due().filter(|t| is_due(*t)) {
            self.l.push(step.followed(&self.support, t));
        }
    }

    /// Adds the values at all remaining times before this one.
    pub(super) fn probe_before(&mut self, before: f64, value: impl Fn(f64) -> f64) {
        while let Some(t) = self.due().filter(|t| *t < before) {
            self.l.push(value(t));
        }
    }

    /// The size of the motion: the range of l.
    pub(super) fn range(&self) -> f64 {
        let ends = (f64::INFINITY, f64::NEG_INFINITY);
        let (low, high) = self.l.iter().fold(ends, |(low, high), l| (low.min(*l), high.max(*l)));
        high - low
    }

    fn windows(&self) -> std::slice::Chunks<'_, f64> {
        self.l.chunks(TIMES_PER_WINDOW + 1)
    }
}

impl Witness for Probes {
    fn begin(&mut self) {
        self.l.clear();
    }

    fn see(&mut self, step: &Step) -> Result<(), RunError> {
        self.probe(step, |t| t < step.end());
        Ok(())
    }

    fn end(&mut self, last: &Step) {
        self.probe(last, |_| true);
    }
}

/// The growth from two runs to the same tolerance. One of them is shifted by `shift` in l, at the start or later.
pub(super) fn growth(one: &Probes, twin: &Probes, shift: f64, tolerance: f64) -> Growth {
    growth_within(one, twin, shift, (tolerance, one.range()))
}

/// The [`growth`] for a motion of the given size, in σ.
pub(super) fn growth_within(
    one: &Probes,
    twin: &Probes,
    shift: f64,
    (tolerance, size): (f64, f64),
) -> Growth {
    let largest =
        |(a, b): (&[f64], &[f64])| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let envelope: Vec<f64> = one.windows().zip(twin.windows()).map(largest).collect();
    let amplification = envelope.iter().copied().fold(0.0, f64::max) / shift;
    let meaningful = ERRORS * tolerance..SMALL * size.max(shift / SMALL);
    let points: Vec<(f64, f64)> = envelope
        .iter()
        .enumerate()
        // A push comes some time after the start.
        .skip_while(|(_, difference)| **difference < meaningful.start)
        .take_while(|(_, difference)| meaningful.contains(difference))
        .map(|(window, difference)| (one.middle(window), difference.ln()))
        .collect();
    // The first half still shows the disturbance itself, not only what grows fastest of it.
    let settled = &points[points.len() / 2..];
    let exponent = (settled.len() >= LEAST_WINDOWS).then(|| slope(settled));
    Growth { amplification, exponent: exponent.filter(|exponent| exponent.is_finite()) }
}

/// Slope of the line of best fit.
fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let mean = |part: fn(&(f64, f64)) -> f64| points.iter().map(part).sum::<f64>() / n;
    let (mx, my) = (mean(|p| p.0), mean(|p| p.1));
    let covariance: f64 = points.iter().map(|(x, y)| (x - mx) * (y - my)).sum();
    covariance / points.iter().map(|(x, _)| (x - mx).powi(2)).sum::<f64>()
}
