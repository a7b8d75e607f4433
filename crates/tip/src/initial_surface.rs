//! The surface u0(x) that the tip finds at the start.
//!
//! Everything before the start is an initial surface: an infinite steady past is the profile (24), a
//! flat start is 0, noise and a measured profile are splines. (15) prints the force of u0 with a factor
//! α; from (14) it is -u0'(x0), for u0 is a height.

use crate::series::{SeriesError, checked};
use crate::spline::CubicSpline;
use crate::{Model, TipFunction};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// White noise on a grid, made smooth by a cubic spline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Noise {
    /// Heights are uniform in [-amplitude, amplitude]; 0 or above.
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
    profile: Option<CubicSpline>,
    noise: Option<CubicSpline>,
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

/// A stretch of x on which u0 is one smooth function: between knots of its splines, or outside.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stretch {
    /// Its ends.
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// How far beyond an end a step may go and still count as ending there.
    pub(crate) slack: f64,
    /// Pieces of the profile and of the noise, `None` outside of them.
    pieces: [Option<usize>; 2],
}

/// A knot within this fraction of an interval counts as reached,
const AT_A_KNOT: f64 = 1e-9;
/// or within this many roundings of x; but never within more than this fraction of an interval.
const ROUNDINGS_AT_A_KNOT: f64 = 64.0 * f64::EPSILON;
const MOST_AT_A_KNOT: f64 = 0.05;

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
        Self { steady: Some(SteadyPast { tip, depth, position, reach }), ..Self::default() }
    }

    /// Adds the cubic spline through (x, u) that ends level, 0 outside: the slope, which is what the tip
    /// feels, is continuous. (A corner that is hollow would hold a slow tip for ever, pushed back from
    /// either side.)
    ///
    /// # Errors
    /// Too short, not finite, unsorted.
    pub fn with_profile(mut self, x: Vec<f64>, u: Vec<f64>) -> Result<Self, SeriesError> {
        let (x, u) = checked(x, u)?;
        self.profile = Some(CubicSpline::level(x, u));
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
        self.noise = Some(CubicSpline::through(x, u));
        self
    }

    /// u0(x).
    #[must_use]
    pub fn height(&self, x: f64) -> f64 {
        let steady = self.steady.as_ref().map_or(0.0, |s| -s.depth * s.tip.tail(x - s.position));
        steady + self.texture(x)
    }

    /// The part of u0(x) that no tip has carved: the given profile and the noise.
    #[must_use]
    pub fn texture(&self, x: f64) -> f64 {
        let inside = |s: &&CubicSpline| (s.first()..=s.last()).contains(&x);
        self.splines().into_iter().flatten().filter(inside).map(|s| s.value(x)).sum()
    }

    /// Where the given profile and the noise end, if there are any.
    #[must_use]
    pub fn texture_ends(&self) -> Option<f64> {
        self.splines().into_iter().flatten().map(CubicSpline::last).reduce(f64::max)
    }

    /// Position of the tip whose steady past, (24), is part of u0.
    #[must_use]
    pub fn steady_position(&self) -> Option<f64> {
        self.steady.as_ref().map(|steady| steady.position)
    }

    /// u0'(x) and u0''(x).
    #[must_use]
    pub fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        self.slope_and_curvature_on(&self.stretch(x, true, 0.0), x)
    }

    /// u0' and u0'' of the function that u0 is on the stretch, wherever x is: within a step that begins
    /// there, all is smooth.
    pub(crate) fn slope_and_curvature_on(&self, stretch: &Stretch, x: f64) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        if let Some(s) = self.steady.as_ref().filter(|s| (x - s.position).abs() < s.reach) {
            let slope = s.tip.slope(x - s.position);
            sum = (s.depth * s.tip.value(x - s.position), s.depth * slope);
        }
        for (spline, piece) in self.splines().into_iter().zip(stretch.pieces) {
            if let (Some(spline), Some(piece)) = (spline, piece) {
                let (_, slope, curvature) = spline.jet_on(piece, x);
                sum = (sum.0 + slope, sum.1 + curvature);
            }
        }
        sum
    }

    /// What the rounding of x may amount to in u0', per unit of curvature: 0 where u0 is flat.
    pub(crate) fn rounding(&self, x: f64) -> f64 {
        let over_the_past = self.steady.as_ref().is_some_and(|s| (x - s.position).abs() < s.reach);
        let inside = |s: &CubicSpline| (s.first()..=s.last()).contains(&x);
        let textured = over_the_past || self.splines().into_iter().flatten().any(inside);
        if textured { f64::EPSILON * x.abs() } else { 0.0 }
    }

    /// The stretch that a tip at x is on, or about to enter if it is at a knot; x is known to `accuracy`.
    pub(crate) fn stretch(&self, x: f64, forward: bool, accuracy: f64) -> Stretch {
        let mut all = Stretch {
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
            slack: f64::INFINITY,
            pieces: [None; 2],
        };
        for (spline, piece) in self.splines().into_iter().zip(&mut all.pieces) {
            let Some(spline) = spline else { continue };
            let (low, high) = spline.ends_of(spline.piece_of(x));
            let interval = high - low;
            let least = accuracy.max(ROUNDINGS_AT_A_KNOT * x.abs());
            let slack = least.max(AT_A_KNOT * interval).min(MOST_AT_A_KNOT * interval);
            // What ended within the slack before a knot begins beyond it.
            let (low, high);
            (low, high, *piece) = stretch_of(spline, if forward { x + slack } else { x - slack });
            (all.low, all.high) = (all.low.max(low), all.high.min(high));
            all.slack = all.slack.min(0.5 * slack);
        }
        all
    }

    fn splines(&self) -> [Option<&CubicSpline>; 2] {
        [self.profile.as_ref(), self.noise.as_ref()]
    }
}

/// Ends and piece of one spline at x.
fn stretch_of(spline: &CubicSpline, x: f64) -> (f64, f64, Option<usize>) {
    if x < spline.first() {
        (f64::NEG_INFINITY, spline.first(), None)
    } else if x >= spline.last() {
        (spline.last(), f64::INFINITY, None)
    } else {
        let piece = spline.piece_of(x);
        let (low, high) = spline.ends_of(piece);
        (low, high, Some(piece))
    }
}
