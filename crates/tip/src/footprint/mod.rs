//! The footprint f(x,y) of the tip in three dimensions, (56). The motion depends on f(x,0) only.
//!
//! Every f(x,y) is even in y and represented by a sum of layers, products of a g(x) and an even h(y):
//!
//! ```text
//!     f(x,y) = Σ_k g_k(x) h_k(y)
//! ```
//!
//! A separable tip (58) is one layer. A sum of two-dimensional Gaussians has one layer for every distinct center and
//! width in y. A table has one layer for every row of its lattice. The surface of a layer is h(y) times the surface
//! u(x) of a tip with f = g. So an image requires one u(x) per layer, not one per row of pixels.

mod layers;
mod table;

use crate::elementary::{cos, exp};
use crate::{TipFunction, TipFunctionError};
use std::f64::consts::{PI, SQRT_2};

/// One term a exp(-(x-c)²/(2w²)) exp(-(y-d)²/(2v²)). Lengths in units of σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaussian2d {
    /// Amplitude a.
    pub amplitude: f64,
    /// Center c in x.
    pub center: f64,
    /// Width w in x.
    pub width: f64,
    /// Center d in y.
    pub center_y: f64,
    /// Width v in y.
    pub width_y: f64,
}

/// h(y) = exp(-(y-d)²/(2v²)) + exp(-(y+d)²/(2v²)), or exp(-y²/(2v²)) for d = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Across {
    /// Center d ≥ 0, in σ.
    pub center: f64,
    /// Width v, in σ.
    pub width: f64,
}

/// One term g(x) h(y) of a footprint.
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// g(x), the factor along the scan.
    pub along: TipFunction,
    /// h(y), the factor across the scan.
    pub across: Across,
}

/// A footprint f(x,y) that is even in y, with the section f(x,0) that determines the motion. It is even in x if all layers
/// are.
#[derive(Debug, Clone, PartialEq)]
pub struct Footprint {
    layers: Vec<Layer>,
    path: TipFunction,
}

impl Across {
    /// exp(-y²/(2 `width`²)).
    pub fn central(width: f64) -> Self {
        Self { center: 0.0, width }
    }

    /// h(y).
    pub fn value(&self, y: f64) -> f64 {
        self.offsets(y).map(|z| exp(-0.5 * z * z)).sum()
    }

    /// h''(0).
    pub fn curvature_at_0(&self) -> f64 {
        let term = |z: f64| (z * z - 1.0) * exp(-0.5 * z * z);
        self.offsets(0.0).map(term).sum::<f64>() / (self.width * self.width)
    }

    /// ∫ h dy
    pub fn integral(&self) -> f64 {
        self.fourier(0.0)
    }

    /// ∫ h cos(ky) dy
    pub fn fourier(&self, k: f64) -> f64 {
        let wave = |z: f64| cos(k * self.width * z);
        let bell = self.width * (2.0 * PI).sqrt() * exp(-0.5 * (k * self.width).powi(2));
        bell * self.offsets(0.0).map(wave).sum::<f64>()
    }

    /// Distances of y from the centers, in widths.
    fn offsets(&self, y: f64) -> impl Iterator<Item = f64> {
        let twin = (self.center > 0.0).then_some(-self.center);
        let Self { center, width } = *self;
        std::iter::once(center).chain(twin).map(move |center| (y - center) / width)
    }

    fn is_valid(&self) -> bool {
        let Self { center, width } = *self;
        center.is_finite() && center >= 0.0 && width.is_finite() && width > 0.0
    }
}

impl Footprint {
    /// The separable footprint f(x) h(y), (58), with h(y) = exp(-y²/(2 `width_y`²)). A Gaussian f(x) of the same width
    /// makes it (59).
    ///
    /// # Errors
    /// `width_y` is not a positive finite number.
    pub fn separable(tip: TipFunction, width_y: f64) -> Result<Self, TipFunctionError> {
        let across = Across::central(width_y);
        if !across.is_valid() {
            return Err(TipFunctionError::Width { index: 1, width: width_y });
        }
        let path = tip.clone();
        Ok(Self { layers: vec![Layer { along: tip, across }], path })
    }

    /// Any sum of two-dimensional Gaussians that is even in y. Its sides in x may differ.
    ///
    /// # Errors
    /// A term is not finite, a width is not positive, f is not even in y or 0 for y = 0, or terms of the same width and
    /// center across have together a slope at x = 0.
    pub fn gaussian_sum(terms: &[Gaussian2d]) -> Result<Self, TipFunctionError> {
        Self::from_layers(layers::of(terms)?)
    }

    /// The smooth even function through f at the points (x, y). They form a rectangular grid of x ≥ 0 and y ≥ 0, with
    /// its rows in any order; beyond the last points f is 0. Between the points the accuracy is that of
    /// [`TipFunction::table`].
    ///
    /// # Errors
    /// The points are not a full grid from x = 0 and y = 0, too few, too many or not finite, or f does not decay.
    pub fn table(x: &[f64], y: &[f64], f: &[f64]) -> Result<Self, TipFunctionError> {
        Self::from_layers(table::layers_through(x, y, f)?)
    }

    /// A sum of layers. f(x,0) is the sum of their g, each multiplied by its h(0).
    ///
    /// # Errors
    /// No layer is a sum of Gaussians, an `across` is not finite or has no positive width, or f(x,0) is 0.
    pub fn from_layers(layers: Vec<Layer>) -> Result<Self, TipFunctionError> {
        if let Some(i) = layers.iter().position(|layer| !layer.across.is_valid()) {
            let width = layers[i].across.width;
            return Err(TipFunctionError::Width { index: i + 1, width });
        }
        let path =
            TipFunction::asymmetric_sum(layers::combined(&layers, |across| across.value(0.0)))?;
        Ok(Self { layers, path })
    }

    /// Whether f(-x,y) = f(x,y).
    pub fn is_even(&self) -> bool {
        self.layers.iter().all(|layer| layer.along.is_even())
    }

    /// f(-x,y): the footprint of a tip that moves to smaller x, in the frame of its motion.
    pub fn mirrored(&self) -> Self {
        let mirrored = |layer: &Layer| Layer { along: layer.along.mirrored(), ..layer.clone() };
        Self { layers: self.layers.iter().map(mirrored).collect(), path: self.path.mirrored() }
    }

    /// The layers.
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// The section f(x,0), on which alone the motion depends.
    pub fn path(&self) -> &TipFunction {
        &self.path
    }

    /// f(x,y).
    pub fn value(&self, x: f64, y: f64) -> f64 {
        self.layers.iter().map(|layer| layer.along.value(x) * layer.across.value(y)).sum()
    }

    /// ∫∫ f dx dy: the rate of volume loss of the surface, per α.
    pub fn integral(&self) -> f64 {
        self.layers.iter().map(|layer| layer.along.integral() * layer.across.integral()).sum()
    }

    /// `f_yy(x,0)`: if it is positive, the groove may push the tip off its line.
    pub fn curvature_across(&self, x: f64) -> f64 {
        let layer = |layer: &Layer| layer.along.value(x) * layer.across.curvature_at_0();
        self.layers.iter().map(layer).sum()
    }

    /// `f_yy(x,0)` as a function of x, for Gaussian layers; `None` if it is 0 for all x, or if a layer is not
    /// Gaussian.
    pub fn curvature_across_path(&self) -> Option<TipFunction> {
        let is_gaussian = |layer: &Layer| matches!(layer.along, TipFunction::Gaussians(_));
        if !self.layers.iter().all(is_gaussian) {
            return None;
        }
        // A table's many layers are one sum of few Gaussians.
        TipFunction::gaussian_sum(layers::combined(&self.layers, Across::curvature_at_0)).ok()
    }

    /// A bound on the transverse stiffness k'/k (52), above which steady motion along y = 0 is stable; 0 if `f_yy(x,0)`
    /// ≤ 0 for all x, infinite if the argument below yields no bound.
    ///
    /// A small y0 ~ exp(μt) obeys μ + k'/k = (α/r) [S(0) - S(μ/r)], S the Laplace transform of `f_yy(x,0)` over x > 0.
    /// The real part of the right side minus μ is harmonic for Re μ > 0, hence largest on the imaginary axis,
    /// where Re S is half the Fourier transform of the even `f_yy`. So no μ with Re μ ≥ 0 exists if k'/k is above
    /// (α/2r) `max_q` [Ŝ(0) - Ŝ(q)], the maximum over all q including infinity. `depth` is α/r. A footprint that is not even
    /// in x has no bound unless `f_yy` ≤ 0 ahead of the tip.
    pub fn transverse_stiffness_needed(&self, depth: f64) -> f64 {
        if !self.is_even() {
            let reach =
                self.layers.iter().filter_map(|layer| layer.along.reach()).fold(0.0, f64::max);
            let ahead = (0..=WAVE_NUMBERS).map(|i| reach * f64::from(i) / f64::from(WAVE_NUMBERS));
            let ahead = ahead.map(|x| self.curvature_across(x));
            let (least, most) =
                ahead.fold((0.0, 0.0), |(low, high): (f64, f64), c| (low.min(c), high.max(c)));
            return if most <= -1e-12 * least { 0.0 } else { f64::INFINITY };
        }
        let gaussians = self.curvature_across_path();
        let transform = |q: f64| -> f64 {
            let layer = |layer: &Layer| layer.across.curvature_at_0() * layer.along.fourier(q);
            let each = || self.layers.iter().map(layer).sum();
            gaussians.as_ref().map_or_else(each, |sum| sum.fourier(q))
        };
        let band = self.layers.iter().map(|layer| layer.along.band()).fold(0.0, f64::max);
        let at_rest = transform(0.0);
        let scanned = (0..=WAVE_NUMBERS).map(|i| {
            // The irrational factor keeps off the singular q = 1 of J0 without missing its peak.
            let q = SQRT_2 * band * f64::from(i) / f64::from(WAVE_NUMBERS);
            at_rest - transform(q)
        });
        let most = scanned.fold(at_rest, f64::max);
        // Round-off of a difference that vanishes is no push.
        if most <= 1e-12 * at_rest.abs() { 0.0 } else { 0.5 * depth * most }
    }
}

/// Number of wave numbers scanned up to the band limit: the curve has at most one extremum in a hundred of them.
const WAVE_NUMBERS: u32 = 4000;
