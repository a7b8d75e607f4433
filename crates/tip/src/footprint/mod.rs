//! The footprint f(x,y) of the tip in three dimensions, (56), of which the motion needs f(x,0) alone.
//!
//! Every f(x,y) that is even in x and in y is held as a sum of layers, products of an even g(x) and an
//! even h(y):
//!
//! ```text
//!     f(x,y) = Σ_k g_k(x) h_k(y)
//! ```
//!
//! A separable tip (58) is one layer; a sum of two-dimensional Gaussians has one for every distinct
//! center and width in y; a table has one for every row of the lattice that it is put on. The surface
//! of a layer is that of the plane problem with the tip g times h(y), so that an image costs one plane
//! surface for each layer, and not one for each row of pixels.

mod layers;
mod table;

use crate::elementary::exp;
use crate::{TipFunction, TipFunctionError};
use std::f64::consts::{PI, SQRT_2};

/// One term a exp(-(x-c)²/(2w²)) exp(-(y-d)²/(2v²)). Lengths in units of σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaussian2d {
    /// a
    pub amplitude: f64,
    /// c
    pub center: f64,
    /// w
    pub width: f64,
    /// d
    pub center_y: f64,
    /// v
    pub width_y: f64,
}

/// h(y) = exp(-(y-d)²/(2v²)) + exp(-(y+d)²/(2v²)), or exp(-y²/(2v²)) for d = 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Across {
    /// d ≥ 0
    pub center: f64,
    /// v
    pub width: f64,
}

/// g(x) h(y).
#[derive(Debug, Clone, PartialEq)]
pub struct Layer {
    /// g
    pub along: TipFunction,
    /// h
    pub across: Across,
}

/// An f(x,y) that is even in both, with the f(x,0) that moves the tip.
#[derive(Debug, Clone, PartialEq)]
pub struct Footprint {
    layers: Vec<Layer>,
    path: TipFunction,
}

impl Across {
    /// exp(-y²/(2 `width`²)).
    #[must_use]
    pub fn central(width: f64) -> Self {
        Self { center: 0.0, width }
    }

    /// h(y).
    #[must_use]
    pub fn value(&self, y: f64) -> f64 {
        self.offsets(y).map(|z| exp(-0.5 * z * z)).sum()
    }

    /// h''(0).
    #[must_use]
    pub fn curvature_at_0(&self) -> f64 {
        let term = |z: f64| (z * z - 1.0) * exp(-0.5 * z * z);
        self.offsets(0.0).map(term).sum::<f64>() / (self.width * self.width)
    }

    /// ∫ h dy
    #[must_use]
    pub fn integral(&self) -> f64 {
        self.offsets(0.0).count() as f64 * self.width * (2.0 * PI).sqrt()
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
    /// f(x) h(y), (58), with h(y) = exp(-y²/(2 `width_y`²)): (59) for a Gaussian of that width.
    ///
    /// # Errors
    /// A width that is not a positive finite number.
    pub fn separable(tip: TipFunction, width_y: f64) -> Result<Self, TipFunctionError> {
        let across = Across::central(width_y);
        if !across.is_valid() {
            return Err(TipFunctionError::Width { index: 1, width: width_y });
        }
        let path = tip.clone();
        Ok(Self { layers: vec![Layer { along: tip, across }], path })
    }

    /// Any sum of two-dimensional Gaussians that is even in x and in y.
    ///
    /// # Errors
    /// Not finite, a width ≤ 0, zero along the path, not even in x or not even in y.
    pub fn gaussian_sum(terms: &[Gaussian2d]) -> Result<Self, TipFunctionError> {
        Self::from_layers(layers::of(terms)?)
    }

    /// The smooth even function through f at the points (x, y), sampled on a rectangular grid of x ≥ 0
    /// and y ≥ 0 whose rows may come in any order; 0 beyond the last of them. Between the points as
    /// accurate as [`TipFunction::table`].
    ///
    /// # Errors
    /// No full grid, too few or too many rows, not finite, not from 0, or not decaying.
    pub fn table(x: &[f64], y: &[f64], f: &[f64]) -> Result<Self, TipFunctionError> {
        Self::from_layers(table::layers_through(x, y, f)?)
    }

    /// A sum of layers. f(x,0) is the sum of their g, each times its h(0).
    ///
    /// # Errors
    /// No layer of Gaussians, an `across` that is not finite or of no width, or zero along the path.
    pub fn from_layers(layers: Vec<Layer>) -> Result<Self, TipFunctionError> {
        if let Some(i) = layers.iter().position(|layer| !layer.across.is_valid()) {
            let width = layers[i].across.width;
            return Err(TipFunctionError::Width { index: i + 1, width });
        }
        let path =
            TipFunction::gaussian_sum(layers::combined(&layers, |across| across.value(0.0)))?;
        Ok(Self { layers, path })
    }

    /// The layers.
    #[must_use]
    pub fn layers(&self) -> &[Layer] {
        &self.layers
    }

    /// f(x,0), which is all that the motion depends on.
    #[must_use]
    pub fn path(&self) -> &TipFunction {
        &self.path
    }

    /// f(x,y).
    #[must_use]
    pub fn value(&self, x: f64, y: f64) -> f64 {
        self.layers.iter().map(|layer| layer.along.value(x) * layer.across.value(y)).sum()
    }

    /// ∫∫ f dx dy: the volume of the surface that indentation takes away, per α and time.
    #[must_use]
    pub fn integral(&self) -> f64 {
        self.layers.iter().map(|layer| layer.along.integral() * layer.across.integral()).sum()
    }

    /// `f_yy(x,0)`: where it is positive, the groove may push the tip off its line.
    #[must_use]
    pub fn curvature_across(&self, x: f64) -> f64 {
        let layer = |layer: &Layer| layer.along.value(x) * layer.across.curvature_at_0();
        self.layers.iter().map(layer).sum()
    }

    /// `f_yy(x,0)` as a function of x, of Gaussian layers; `None` where it is 0 for all x, and where a layer is no Gaussian.
    #[must_use]
    pub fn curvature_across_path(&self) -> Option<TipFunction> {
        let is_gaussian = |layer: &Layer| matches!(layer.along, TipFunction::Gaussians(_));
        if !self.layers.iter().all(is_gaussian) {
            return None;
        }
        // A table's many layers are one sum of few Gaussians.
        TipFunction::gaussian_sum(layers::combined(&self.layers, Across::curvature_at_0)).ok()
    }

    /// The k'/k above which motion along y = 0 is certainly stable while it is steady, for a transverse
    /// spring k' (52); 0 where `f_yy(x,0)` ≤ 0 for all x, infinite where no k' is certain to do.
    ///
    /// A small y0 ~ exp(μt) obeys μ + k'/k = (α/r) [S(0) - S(μ/r)], S the Laplace transform of
    /// `f_yy(x,0)` over x > 0. The real part of the right side less μ is harmonic for Re μ > 0, hence
    /// largest on the imaginary axis, where Re S is half the Fourier transform of the even `f_yy`. So no
    /// μ with Re μ ≥ 0 is left once k'/k is above (α/2r) `max_q` [Ŝ(0) - Ŝ(q)], taken over all q, the
    /// infinite one among them. `depth` is α/r.
    #[must_use]
    pub fn transverse_stiffness_needed(&self, depth: f64) -> f64 {
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

/// Wave numbers scanned up to the band limit: the curve turns over no faster than one in a hundred.
const WAVE_NUMBERS: u32 = 4000;
