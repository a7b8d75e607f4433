//! The surface u0(x) that the tip finds at the start.
//!
//! Everything before the start is an initial surface: an infinite steady past is the profile (24), a
//! flat start is 0, noise and a measured profile are splines. (15) prints the force of u0 with a factor
//! α; from (14) it is -u0'(x0), for u0 is a height.

use crate::series::{SeriesError, spline_through};
use crate::spline::CubicSpline;
use crate::{Model, TipFunction};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// White noise on a grid, made smooth by a cubic spline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Heights are uniform in [-amplitude, amplitude].
    pub amplitude: f64,
    /// Distance of the grid points. White noise has no limit as it goes to 0: it is part of the start.
    pub spacing: f64,
    /// Seed of the `ChaCha8` stream that the heights are drawn from, left to right.
    pub seed: u64,
}

/// u0(x): a sum of a steady past, noise and a given profile.
#[derive(Debug, Clone, Default)]
pub struct InitialSurface {
    steady: Option<SteadyPast>,
    splines: Vec<CubicSpline>,
}

/// The profile (24) of a tip that has always moved steadily and is now at `position`.
#[derive(Debug, Clone)]
struct SteadyPast {
    tip: TipFunction,
    /// α/r
    depth: f64,
    position: f64,
    reach: f64,
}

/// Steps over a spline advance at most this many of its intervals.
const INTERVALS_PER_STEP: f64 = 3.0;

impl InitialSurface {
    /// u0 = 0.
    #[must_use]
    pub fn flat() -> Self {
        Self::default()
    }

    /// u0(x) = -(α/r) ∫_{x-X}^∞ f, (24), for a tip at `position` X.
    #[must_use]
    pub fn steady(model: &Model, position: f64) -> Self {
        let tip = model.tip().clone();
        let reach = tip.reach().unwrap_or(f64::INFINITY);
        let depth = model.alpha() / model.r();
        Self { steady: Some(SteadyPast { tip, depth, position, reach }), splines: vec![] }
    }

    /// Adds the natural cubic spline through (x, u), 0 outside.
    ///
    /// # Errors
    /// Too short, not finite, unsorted.
    pub fn with_profile(mut self, x: Vec<f64>, u: Vec<f64>) -> Result<Self, SeriesError> {
        self.splines.push(spline_through(x, u)?);
        Ok(self)
    }

    /// Adds noise on grid points `from`, `from` + spacing, … up to `to`.
    #[must_use]
    pub fn with_noise(mut self, noise: Noise, from: f64, to: f64) -> Self {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let points = ((to - from) / noise.spacing).ceil().max(3.0) as usize + 1;
        let mut rng = ChaCha8Rng::seed_from_u64(noise.seed);
        let height = |_| noise.amplitude * rng.random_range(-1.0..=1.0);
        let u: Vec<f64> = (0..points).map(height).collect();
        #[expect(clippy::cast_precision_loss, reason = "a count")]
        let x = (0..points).map(|i| from + noise.spacing * i as f64).collect();
        self.splines.push(CubicSpline::through(x, u));
        self
    }

    /// u0(x).
    #[must_use]
    pub fn height(&self, x: f64) -> f64 {
        let steady = self.steady.as_ref().map_or(0.0, |s| -s.depth * s.tip.tail(x - s.position));
        steady + self.splines_at(x).map(|s| s.value(x)).sum::<f64>()
    }

    /// u0'(x) and u0''(x).
    #[must_use]
    pub fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        if let Some(s) = self.steady.as_ref().filter(|s| (x - s.position).abs() < s.reach) {
            let slope = s.tip.slope(x - s.position);
            sum = (s.depth * s.tip.value(x - s.position), s.depth * slope);
        }
        for spline in self.splines_at(x) {
            let (_, slope, curvature) = spline.jet(x);
            sum = (sum.0 + slope, sum.1 + curvature);
        }
        sum
    }

    /// The longest displacement that a step beginning at x may make without skipping a feature.
    pub(crate) fn longest_displacement(&self, x: f64) -> f64 {
        let longest = |s: &CubicSpline| INTERVALS_PER_STEP * s.mean_interval();
        let near = |s: &&CubicSpline| (s.first() - longest(s)..=s.last() + longest(s)).contains(&x);
        self.splines.iter().filter(near).map(longest).fold(f64::INFINITY, f64::min)
    }

    fn splines_at(&self, x: f64) -> impl Iterator<Item = &CubicSpline> {
        self.splines.iter().filter(move |s| (s.first()..=s.last()).contains(&x))
    }
}
