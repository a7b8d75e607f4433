//! The interval on which exponentials represent f': from slightly behind the farthest point of the tip to the reach.

use crate::TipFunction;
use crate::elementary::cos;
use std::f64::consts::FRAC_PI_2;

/// Expected retreat of a tip behind its farthest point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Retreat {
    /// At most δ, half the width of a Gaussian footprint: without inertia a tip moves back only if it is pushed.
    Small,
    /// At most 2δ: with inertia the tip overshoots, and swings back after each slip. The fit requires one or two terms
    /// more.
    Swing,
}

/// δ, relative to the distance over which f decreases at its apex, and allowed retreat of a resonant tip, relative to
/// δ.
const DELTA: f64 = 0.5;
const SWING: f64 = 2.0;
/// Share of δ that a step must leave free at its start for evaluations of the groove.
const LOOKS: f64 = 0.5;
/// Number of samples for the largest slope.
const SAMPLES: usize = 191;

/// The interval from -(the retreat) to the reach.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    pub(super) reach: f64,
    pub(super) retreat: f64,
    /// Largest retreat at the start of a step.
    pub(super) between_steps: f64,
    delta: f64,
}

impl Window {
    pub(super) fn of(tip: &TipFunction, reach: f64, back: Retreat) -> Self {
        let delta = delta(tip, reach);
        let retreat = if back == Retreat::Swing { SWING * delta } else { delta };
        Self { reach, retreat, between_steps: retreat - LOOKS * delta, delta }
    }

    /// max |f'|, approximately.
    pub(super) fn largest_slope(&self, tip: &TipFunction) -> f64 {
        let samples = samples(tip, (self.retreat, self.reach), SAMPLES);
        samples.iter().map(|(_, slope)| slope.abs()).fold(0.0, f64::max)
    }

    /// The interval with this retreat.
    pub(super) fn reaching_back(self, retreat: f64) -> Self {
        Self { retreat, between_steps: LOOKS * retreat, ..self }
    }

    /// Allowed integral of an error of at most this size: as if it extended over two widths of a Gaussian.
    pub(super) fn area(&self, error: f64) -> f64 {
        4.0 * self.delta * error
    }
}

/// δ: half the width of a Gaussian; in general, half the distance over which f decreases at its apex.
fn delta(tip: &TipFunction, reach: f64) -> f64 {
    let (f, curvature) = (tip.value(0.0), tip.slope_and_curvature(0.0).1);
    let apex = (f / curvature).abs().sqrt();
    let apex = if apex.is_finite() { apex.min(reach / 8.0) } else { 0.0 };
    DELTA * apex.max(tip.widths(1.0))
}

/// Points (ξ, f'(ξ)) at n values from -(the retreat) to the end, denser near -(the retreat), where a fit is least
/// constrained.
pub(super) fn samples(tip: &TipFunction, (retreat, end): (f64, f64), n: usize) -> Vec<(f64, f64)> {
    let sample = |i: usize| {
        let part = 1.0 - cos(FRAC_PI_2 * i as f64 / (n - 1) as f64);
        let xi = (end + retreat) * part - retreat;
        (xi, tip.slope(xi))
    };
    (0..n).map(sample).collect()
}
