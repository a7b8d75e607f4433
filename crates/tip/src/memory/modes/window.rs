//! Where f' is to be told by exponentials: from a little behind the farthest point of the tip to its reach.

use crate::TipFunction;
use crate::elementary::cos;
use std::f64::consts::FRAC_PI_2;

/// How far behind its farthest point a tip is expected to come.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Retreat {
    /// By δ at most: where friction is all that holds it, it goes back only if it is pushed.
    Small,
    /// By 2δ: with inertia it overshoots, and swings back after each slip. A term or two more.
    Swing,
}

/// δ over the distance within which f falls about its apex, and what a tip that swings back is allowed over that.
const DELTA: f64 = 0.5;
const SWING: f64 = 2.0;
/// What a step begins with is to leave room for its looks: this part of δ.
const LOOKS: f64 = 0.5;
/// For the largest slope.
const SAMPLES: usize = 191;

/// From -(the retreat) to the reach.
#[derive(Debug, Clone, Copy)]
pub(super) struct Window {
    pub(super) reach: f64,
    pub(super) retreat: f64,
    /// The retreat that a step may begin with.
    pub(super) between_steps: f64,
    delta: f64,
}

impl Window {
    pub(super) fn of(tip: &TipFunction, reach: f64, back: Retreat) -> Self {
        let delta = delta(tip, reach);
        let retreat = if back == Retreat::Swing { SWING * delta } else { delta };
        Self { reach, retreat, between_steps: retreat - LOOKS * delta, delta }
    }

    /// max |f'|, about.
    pub(super) fn largest_slope(&self, tip: &TipFunction) -> f64 {
        let samples = samples(tip, (self.retreat, self.reach), SAMPLES);
        samples.iter().map(|(_, slope)| slope.abs()).fold(0.0, f64::max)
    }

    /// With this retreat instead.
    pub(super) fn reaching_back(self, retreat: f64) -> Self {
        Self { retreat, between_steps: LOOKS * retreat, ..self }
    }

    /// The largest area that an error of this size may have: over two widths of a Gaussian.
    pub(super) fn area(&self, error: f64) -> f64 {
        4.0 * self.delta * error
    }
}

/// δ: half the width of a Gaussian, and in general of what f falls by at its apex.
fn delta(tip: &TipFunction, reach: f64) -> f64 {
    let (f, curvature) = (tip.value(0.0), tip.slope_and_curvature(0.0).1);
    let apex = (f / curvature).abs().sqrt();
    let apex = if apex.is_finite() { apex.min(reach / 8.0) } else { 0.0 };
    DELTA * apex.max(tip.widths(1.0))
}

/// (ξ, f'(ξ)) at n points from -(the retreat) to the end, denser towards the first, where a fit is free to stray.
pub(super) fn samples(tip: &TipFunction, (retreat, end): (f64, f64), n: usize) -> Vec<(f64, f64)> {
    let sample = |i: usize| {
        let part = 1.0 - cos(FRAC_PI_2 * i as f64 / (n - 1) as f64);
        let xi = (end + retreat) * part - retreat;
        (xi, tip.slope(xi))
    };
    (0..n).map(sample).collect()
}
