//! A single contribution to the initial surface: a height profile with two derivatives.

mod expanded;
mod on_lattice;

use crate::memory::ROOM;
use crate::series::{SeriesError, checked};
use crate::spline::{CubicSpline, Ends, piece_of};
use crate::{Model, TipFunction};
use chacha20::ChaCha8Rng;
use expanded::Expanded;
pub use expanded::Ground;
use on_lattice::OnLattice;
use rand::{RngExt, SeedableRng};
use std::sync::Arc;
use stickslip_convolution::Field;

/// A height as a function of x, smooth except at known breaks.
#[derive(Debug, Clone)]
pub struct Relief(Shape);

/// Heights uniform in [-amplitude, amplitude] on a grid, interpolated by a cubic spline.
///
/// The heights follow each other, from left to right, in a stream of `ChaCha8`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "NoiseParameters"))]
#[cfg_attr(
    feature = "schema",
    schemars(
        description = "Heights uniform in [-amplitude, amplitude] on a grid, interpolated by a cubic spline."
    )
)]
pub struct Noise {
    /// Largest height, 0 or above, in kσ²/a.
    pub amplitude: f64,
    /// Distance of the grid points, in σ; 0.1 by default. It is part of the initial condition: white noise has no
    /// limit as the spacing goes to 0.
    #[cfg_attr(feature = "serde", serde(default = "Noise::default_spacing"))]
    pub spacing: f64,
    /// Seed of the random numbers; 1 by default.
    #[cfg_attr(feature = "serde", serde(default = "Noise::default_seed"))]
    pub seed: u64,
}

impl Noise {
    /// Default distance of the grid points, in σ.
    pub const SPACING: f64 = 0.1;
    /// Default seed.
    pub const SEED: u64 = 1;
}

#[cfg(feature = "serde")]
impl Noise {
    fn default_spacing() -> f64 {
        Self::SPACING
    }

    fn default_seed() -> u64 {
        Self::SEED
    }
}

#[derive(Debug, Clone)]
enum Shape {
    SteadyPast(SteadyPast),
    /// A spline, and 0 outside of it.
    Spline(CubicSpline),
    OnLattice(OnLattice),
    Expanded(Expanded),
}

/// The profile (24) of a tip in steady motion that is now at `position`.
#[derive(Debug, Clone)]
struct SteadyPast {
    tip: TipFunction,
    /// Depth α/r, multiplied by w0 with a depth limit.
    depth: f64,
    /// Decay rate s = 1/(rT); 0 without healing.
    fading: f64,
    position: f64,
    /// Distance from `position`, ahead and behind, within which the profile has a slope.
    reach: f64,
    behind: f64,
}

/// A stretch of x on which a relief is one smooth function.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Piece {
    /// Ends of the piece.
    pub(crate) low: f64,
    pub(crate) high: f64,
    /// A step that ends at most this far beyond an end of the piece counts as ending there.
    pub(crate) slack: f64,
    /// Number of the piece, for a relief that has several; `None` outside of them.
    pub(crate) index: Option<usize>,
}

/// Largest distance at which a step evaluates the surface (`memory::longest_look`).
const FARTHEST_LOOK: f64 = 12.0;
/// Largest distance at which a tip counts as being at a knot, relative to the interval.
const AT_A_KNOT: f64 = 1e-9;
/// The same distance relative to |x|, 64 roundings; the larger of the two counts.
const ROUNDINGS_AT_A_KNOT: f64 = 64.0 * f64::EPSILON;
/// Upper limit of both distances, relative to the interval.
const MOST_AT_A_KNOT: f64 = 0.05;

impl Piece {
    pub(crate) const EVERYWHERE: Self =
        Self { low: f64::NEG_INFINITY, high: f64::INFINITY, slack: f64::INFINITY, index: None };

    /// Narrows the piece to its common part with another one.
    pub(crate) fn narrow(&mut self, other: &Self) {
        self.low = self.low.max(other.low);
        self.high = self.high.min(other.high);
        self.slack = self.slack.min(other.slack);
    }

    /// Distance of a tip at x from the end of the piece that it moves to.
    pub(crate) fn ahead(&self, x: f64, forward: bool) -> f64 {
        if forward { self.high - x } else { x - self.low }
    }
}

impl Relief {
    /// The profile -(α/r) ∫_{x-X}^∞ f, (24), for a tip at `position` X; in the extended model -(α w0/r) ∫_0^∞
    /// f(x-X+y) e^{-sy}dy, s = 1/(rT).
    pub fn steady(model: &Model, position: f64) -> Self {
        let tip = model.tip().clone();
        let reach = tip.reach().unwrap_or(f64::INFINITY);
        let (depth, fading) = (model.steady_density(), model.fading());
        // Where it fades, the slope goes on behind the reach of f.
        let behind = if fading > 0.0 { f64::INFINITY } else { reach };
        Self(Shape::SteadyPast(SteadyPast { tip, depth, fading, position, reach, behind }))
    }

    /// The cubic spline through (x, u) with slope 0 at both ends, and 0 outside. The slope, which determines the force,
    /// is therefore continuous. (A kink in a hollow would hold a slow tip permanently, because it is pushed back from
    /// either side.)
    ///
    /// # Errors
    /// The profile is too short, not finite or not sorted by x.
    pub fn profile(x: Vec<f64>, u: Vec<f64>) -> Result<Self, SeriesError> {
        let (x, u) = checked(x, u)?;
        Ok(Self(Shape::Spline(CubicSpline::through(x, u, Ends::Level))))
    }

    /// Noise on grid points `from`, `from` + spacing, … up to `to`.
    pub fn noise(noise: Noise, from: f64, to: f64) -> Self {
        let points = noise_points(noise, from, to);
        let u = noise_heights(noise, points, 0);
        #[expect(clippy::cast_precision_loss, reason = "a count")]
        let x = (0..points).map(|i| from + noise.spacing * i as f64).collect();
        Self(Shape::Spline(CubicSpline::through(x, u, Ends::Straight)))
    }

    /// The groove of other scans of a tip: its height and slope as fields on one lattice. Beyond the ends of the
    /// fields, where both must have decayed, they are 0. With `along` = (X, mirrored) the relief at x is the field at
    /// `X + x`, or at `X - x` if mirrored.
    pub fn on_lattice(heights: Field, slopes: Field, along: (f64, bool)) -> Self {
        Self(Shape::OnLattice(OnLattice::new(heights, slopes, along)))
    }

    /// A height given by power series: the groove of earlier scan lines. `along` is as in
    /// [`on_lattice`](Self::on_lattice).
    pub fn expanded(ground: Arc<dyn Ground>, along: (f64, bool)) -> Self {
        Self(Shape::Expanded(Expanded::new(ground, along)))
    }

    /// Height at x.
    pub fn height(&self, x: f64) -> f64 {
        match &self.0 {
            Shape::SteadyPast(past) => past.height(x),
            Shape::Spline(spline) if is_inside(spline, x) => spline.value(x),
            Shape::Spline(_) => 0.0,
            Shape::OnLattice(relief) => relief.height(x),
            Shape::Expanded(relief) => relief.height(x),
        }
    }

    /// Height of the smooth function of a piece, evaluated at any x.
    pub(crate) fn height_on(&self, piece: Option<usize>, x: f64) -> f64 {
        match (&self.0, piece) {
            (Shape::SteadyPast(past), _) => past.height(x),
            (Shape::Spline(spline), Some(piece)) => spline.jet_on(piece, x).0,
            (Shape::Spline(_), None) => 0.0,
            (Shape::OnLattice(relief), _) => relief.height(x),
            (Shape::Expanded(relief), _) => relief.height(x),
        }
    }

    /// Slope and curvature at x.
    pub fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        self.slope_and_curvature_on(self.piece(x, true, 0.0).index, x)
    }

    /// Slope and curvature of the smooth function of a piece, evaluated at any x.
    #[inline]
    pub(crate) fn slope_and_curvature_on(&self, piece: Option<usize>, x: f64) -> (f64, f64) {
        match (&self.0, piece) {
            (Shape::SteadyPast(past), _) => past.slope_and_curvature(x),
            (Shape::Spline(spline), Some(piece)) => {
                let (_, slope, curvature) = spline.jet_on(piece, x);
                (slope, curvature)
            }
            (Shape::Spline(_), None) => (0.0, 0.0),
            (Shape::OnLattice(relief), _) => relief.slope_and_curvature(x),
            (Shape::Expanded(relief), _) => relief.slope_and_curvature(x),
        }
    }

    /// Adds the height and its derivatives on a piece to `jet`, without the groove of steady motion. Returns the number
    /// of entries that may differ from 0, or `None` if derivatives are unknown.
    pub(crate) fn add_jet_on(
        &self,
        piece: Option<usize>,
        x: f64,
        jet: &mut [f64; ROOM],
    ) -> Option<usize> {
        let mut add = |terms: &[f64]| {
            jet.iter_mut().zip(terms).for_each(|(sum, term)| *sum += term);
            Some(terms.len())
        };
        match (&self.0, piece) {
            (Shape::SteadyPast(_), _) | (Shape::Spline(_), None) => Some(0),
            (Shape::Spline(spline), Some(piece)) => {
                let (height, slope, curvature) = spline.jet_on(piece, x);
                add(&[height, slope, curvature, spline.third_on(piece)])
            }
            (Shape::Expanded(relief), _) => add(&relief.derivatives(x)),
            (Shape::OnLattice(_), _) => None,
        }
    }

    /// Position of the tip in steady motion that carved the profile; `None` for other reliefs.
    pub fn steady_position(&self) -> Option<f64> {
        if let Shape::SteadyPast(past) = &self.0 { Some(past.position) } else { None }
    }

    /// The largest x of a spline; `None` for other reliefs.
    pub(crate) fn end(&self) -> Option<f64> {
        if let Shape::Spline(spline) = &self.0 { Some(spline.last()) } else { None }
    }

    /// Whether the relief has a slope at x.
    pub(crate) fn covers(&self, x: f64) -> bool {
        match &self.0 {
            Shape::SteadyPast(past) => past.covers(x),
            Shape::Spline(spline) => is_inside(spline, x),
            Shape::OnLattice(relief) => relief.covers(x),
            Shape::Expanded(_) => true,
        }
    }

    /// Whether slope and height are 0 on this piece, within the largest distance from x at which a step evaluates
    /// them.
    pub(crate) fn is_flat_about(&self, piece: &Piece, x: f64) -> bool {
        match &self.0 {
            Shape::SteadyPast(past) => x - past.position > past.reach + FARTHEST_LOOK,
            Shape::Spline(_) => piece.index.is_none(),
            Shape::OnLattice(_) | Shape::Expanded(_) => false,
        }
    }

    /// The piece that contains a tip at x, or that the tip is about to enter if it is at a break; x has an error of
    /// at most `accuracy`.
    pub(crate) fn piece(&self, x: f64, forward: bool, accuracy: f64) -> Piece {
        let Shape::Spline(spline) = &self.0 else { return Piece::EVERYWHERE };
        Axis(spline.knots()).piece(x, forward, accuracy)
    }
}

/// Number of grid points of a noise.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
pub(crate) fn noise_points(noise: Noise, from: f64, to: f64) -> usize {
    ((to - from) / noise.spacing).ceil().max(3.0) as usize + 1
}

/// Heights of a noise, from one of the streams of its seed; a noise u0(x) uses stream 0.
pub(crate) fn noise_heights(noise: Noise, points: usize, stream: u64) -> Vec<f64> {
    let mut rng = ChaCha8Rng::seed_from_u64(noise.seed);
    rng.set_stream(stream);
    (0..points).map(|_| noise.amplitude * rng.random_range(-1.0..=1.0)).collect()
}

impl SteadyPast {
    #[inline]
    fn covers(&self, x: f64) -> bool {
        let ahead = x - self.position;
        ahead < self.reach && -ahead < self.behind
    }

    /// Slope and curvature from φ' = sφ - f; the height is -depth φ.
    #[cold]
    fn fading_slope_and_curvature(&self, x: f64) -> (f64, f64) {
        let s = self.fading;
        let steep = self.tip.value(x) - s * self.tip.fading_tail(x, s);
        (self.depth * steep, self.depth * (self.tip.slope(x) + s * steep))
    }

    fn height(&self, x: f64) -> f64 {
        if x - self.position >= self.reach {
            return 0.0;
        }
        -self.depth * self.tip.fading_tail(x - self.position, self.fading)
    }

    #[inline]
    fn slope_and_curvature(&self, x: f64) -> (f64, f64) {
        if !self.covers(x) {
            return (0.0, 0.0);
        }
        if self.fading > 0.0 {
            return self.fading_slope_and_curvature(x - self.position);
        }
        let (value, slope) = self.tip.value_and_slope(x - self.position);
        (self.depth * value, self.depth * slope)
    }
}

fn is_inside(spline: &CubicSpline, x: f64) -> bool {
    (spline.first()..=spline.last()).contains(&x)
}

/// The knots of a spline along one axis.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Axis<'a>(pub(crate) &'a [f64]);

impl Axis<'_> {
    /// The piece that contains a tip at x, or that the tip is about to enter if it is at a knot; x has an error of at
    /// most `accuracy`.
    pub(crate) fn piece(&self, x: f64, forward: bool, accuracy: f64) -> Piece {
        let nearest = piece_of(self.0, x);
        let interval = self.0[nearest + 1] - self.0[nearest];
        let least = accuracy.max(ROUNDINGS_AT_A_KNOT * x.abs());
        let slack = least.max(AT_A_KNOT * interval).min(MOST_AT_A_KNOT * interval);
        // What ended within the slack before a knot begins beyond it.
        let (low, high, index) = self.ends_at(if forward { x + slack } else { x - slack });
        Piece { low, high, slack: 0.5 * slack, index }
    }

    /// Ends and number of the piece that contains x.
    fn ends_at(&self, x: f64) -> (f64, f64, Option<usize>) {
        let (first, last) = (self.0[0], self.0[self.0.len() - 1]);
        if x < first {
            (f64::NEG_INFINITY, first, None)
        } else if x >= last {
            (last, f64::INFINITY, None)
        } else {
            let piece = piece_of(self.0, x);
            (self.0[piece], self.0[piece + 1], Some(piece))
        }
    }
}
