//! A footprint f(x,y) as a sum of few products g(x) h(y).
//!
//! The layers of a [`Footprint`] that have the same width v across form a matrix of amplitudes. Its rows are shapes
//! along the scan, its columns centers across. The singular value decomposition yields the sum of the fewest products,
//! of which the negligible ones are omitted. A table of dozens of rows becomes a handful of products. Layers of another
//! width become further products.

use super::bells::Bells;
use crate::cache::Cache;
use crate::elementary::{log10, pow};
use crate::footprint::{Footprint, Layer};
use crate::memory::FINEST_OF_SWINGING;
use crate::sorting::sort_by_number;
use crate::{Gaussian, TipFunction, TipFunctionError};
use nalgebra::{DMatrix, SVD};
use std::sync::Arc;
use thiserror::Error;

/// g and h, with the required accuracy.
#[derive(Debug, Clone)]
pub(super) struct Product {
    pub(super) along: TipFunction,
    pub(super) bells: Bells,
    /// Bound on |g| Σ|`a_k`|.
    pub(super) size: f64,
    /// Largest error allowed in g'.
    pub(super) slope_error: f64,
    /// Largest error allowed in the layers of a Gaussian of height 1.
    pub(super) layer_error: f64,
}

#[derive(Debug, Clone)]
pub(super) struct Products {
    all: Vec<Product>,
    error: f64,
}

/// Reasons why a footprint is not a sum of few products.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ProductsError {
    /// The footprint requires too many products.
    #[error(
        "in two coordinates the footprint f(x,y) is a sum of products of a function of x and one of y: this one takes {needed} for the tolerance, at most {MOST} are possible; smooth its table, or take a larger tolerance"
    )]
    TooMany {
        /// Number of products required.
        needed: usize,
    },
    /// Several layers of which some are not sums of Gaussians.
    #[error(transparent)]
    Layer(#[from] TipFunctionError),
}

/// Largest number of products: each costs as much as a separable footprint.
const MOST: usize = 48;
/// Share of the allowed error for the omitted products.
const SHARE_OF_THE_REST: f64 = 0.1;
/// Singular values below this fraction of the largest are round-off.
const ROUND_OFF: f64 = 1e-15;
/// Number of points per width at which functions are evaluated for bounds.
const POINTS_PER_WIDTH: f64 = 16.0;

impl Products {
    /// As [`of`](Self::of), or an earlier result for the same arguments.
    pub(super) fn cached(
        footprint: &Footprint,
        accuracies: [f64; 2],
    ) -> Result<Arc<Self>, ProductsError> {
        type Known = Cache<(Footprint, [u64; 2]), Result<Arc<Products>, ProductsError>>;
        static CACHE: Known = Cache::new(8);
        let bits = accuracies.map(f64::to_bits);
        CACHE.get(|(of, at)| *at == bits && of == footprint).unwrap_or_else(|| {
            let products = Self::of(footprint, accuracies).map(Arc::new);
            CACHE.keep((footprint.clone(), bits), products.clone());
            products
        })
    }

    /// The products that represent f and its slopes to the first accuracy; along the scan, exponentials are to fit them
    /// to the second.
    pub(super) fn of(footprint: &Footprint, accuracies: [f64; 2]) -> Result<Self, ProductsError> {
        let [accuracy, _] = accuracies;
        let mut factors = vec![];
        for group in of_one_width(footprint.layers()) {
            factors.extend(Factors::of(&group)?);
        }
        // The largest first; an error of the sum is at most the sum of the sizes left out.
        sort_by_number(&mut factors, |item| -item.most());
        let mut error = 0.0;
        while factors.len() > 1
            && let Some(last) = factors.last()
            && error + last.most() <= SHARE_OF_THE_REST * accuracy
        {
            error += last.most();
            factors.pop();
        }
        let count = factors.len();
        if count > MOST {
            return Err(ProductsError::TooMany { needed: count });
        }
        let all = factors.into_iter().map(|factors| factors.product(accuracies, count)).collect();
        Ok(Self { all, error })
    }

    pub(super) fn all(&self) -> &[Product] {
        &self.all
    }

    /// Bound on the error of f and its slopes due to the omitted products.
    pub(super) fn error(&self) -> f64 {
        self.error
    }

    pub(super) fn width(&self) -> f64 {
        self.all.iter().map(|product| product.bells.width()).fold(f64::INFINITY, f64::min)
    }
}

/// The layers in groups of the same width across.
fn of_one_width(layers: &[Layer]) -> Vec<Vec<&Layer>> {
    let mut sorted: Vec<&Layer> = layers.iter().collect();
    sort_by_number(&mut sorted, |item| item.across.width);
    let alike = |a: &&Layer, b: &&Layer| close(a.across.width, b.across.width, a.across.width);
    sorted.chunk_by(alike).map(<[&Layer]>::to_vec).collect()
}

fn close(a: f64, b: f64, scale: f64) -> bool {
    (a - b).abs() <= 1e-12 * scale
}

/// g and h with bounds of both and of their slopes.
struct Factors {
    along: TipFunction,
    bells: Bells,
    along_most: [f64; 2],
    across_most: [f64; 2],
}

impl Factors {
    /// The products of layers of one width across.
    fn of(layers: &[&Layer]) -> Result<Vec<Self>, TipFunctionError> {
        let width = layers[0].across.width;
        let centers = || layers.iter().map(|layer| layer.across.center);
        if let [layer] = layers {
            let bells = Bells::even(width, centers().map(|center| (1.0, center)));
            return Ok(vec![Self::new(layer.along.clone(), bells)]);
        }
        let shapes = shapes(layers)?;
        let mut matrix = DMatrix::zeros(shapes.len(), layers.len());
        for (j, layer) in layers.iter().enumerate() {
            for g in right_half(&layer.along)? {
                let place = shapes.iter().position(|shape| alike(shape, &g)).unwrap_or_default();
                matrix[(place, j)] += g.amplitude;
            }
        }
        let SVD { u: Some(u), v_t: Some(v), singular_values, .. } = SVD::new(matrix, true, true)
        else {
            return Err(TipFunctionError::Zero);
        };
        let least = ROUND_OFF * singular_values.max();
        let product = |(s, size): (usize, &f64)| {
            let term = |(i, shape): (usize, &Gaussian)| {
                let right = Gaussian { amplitude: size * u[(i, s)], ..*shape };
                let left = Gaussian { center: -shape.center, ..right };
                std::iter::once(right).chain((shape.center > 0.0).then_some(left))
            };
            let along =
                TipFunction::gaussian_sum(shapes.iter().enumerate().flat_map(term).collect());
            let heights = centers().enumerate().map(|(j, center)| (v[(s, j)], center));
            along.map(|along| Self::new(along, Bells::even(width, heights)))
        };
        let all = singular_values.iter().enumerate().filter(|(_, size)| **size > least);
        all.map(product).collect()
    }

    fn new(along: TipFunction, bells: Bells) -> Self {
        let reach = along.reach().unwrap_or(0.0);
        let narrowest = along.widths(1.0);
        let g = |x: f64| {
            let (value, slope) = along.value_and_slope(x);
            [value, slope]
        };
        let across = |y: f64| {
            let [value, slope, _] = bells.jet(y);
            [value, slope]
        };
        let (along_most, across_most) = (
            largest(g, reach, narrowest / POINTS_PER_WIDTH),
            largest(across, bells.reach(), bells.width() / POINTS_PER_WIDTH),
        );
        Self { along, bells, along_most, across_most }
    }

    /// Bound on the product and its slopes.
    fn most(&self) -> f64 {
        let ([g, g1], [h, h1]) = (self.along_most, self.across_most);
        (g * h).max(g1 * h).max(g * h1)
    }

    /// The product, with its share of the allowed error of f and its slopes.
    fn product(self, [accuracy, of_slopes]: [f64; 2], count: usize) -> Product {
        let Self { along, bells, along_most, across_most } = self;
        if count == 1 && bells.is_single() {
            let (slope_error, layer_error) = (of_slopes, accuracy);
            return Product { along, bells, size: 1.0, slope_error, layer_error };
        }
        let size = along_most[0] * bells.size();
        let share = accuracy / count as f64;
        let [coarse, fine] = [share, of_slopes / count as f64].map(|error| error / across_most[0]);
        let slope_error = quarter_decade(fine.max(coarse.min(FINEST_OF_SWINGING)));
        Product { along, bells, size, slope_error, layer_error: share / size }
    }
}

/// Rounds down to quarter decades, so that similar runs share a fit.
fn quarter_decade(x: f64) -> f64 {
    pow(10.0, (4.0 * log10(x)).floor() / 4.0)
}

/// Bounds on an even or odd function and its slope up to its reach: the largest samples, increased by the possible rise
/// of a smooth function between them.
fn largest(f: impl Fn(f64) -> [f64; 2], reach: f64, spacing: f64) -> [f64; 2] {
    /// Bound on the largest slope, relative to that of the samples.
    const BETWEEN: f64 = 1.1;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let count = (reach / spacing).ceil() as usize;
    let mut most = [0.0_f64; 2];
    for i in 0..=count {
        let [value, slope] = f(i as f64 * spacing);
        most = [most[0].max(value.abs()), most[1].max(slope.abs())];
    }
    let slope = BETWEEN * most[1];
    [most[0] + 0.5 * spacing * slope, slope]
}

/// The terms with centers ≥ 0; the others are their mirror images.
fn right_half(along: &TipFunction) -> Result<Vec<Gaussian>, TipFunctionError> {
    let TipFunction::Gaussians(sum) = along else { return Err(TipFunctionError::Zero) };
    Ok(sum.terms().iter().filter(|g| g.center >= 0.0).copied().collect())
}

/// Terms with all distinct centers and widths along the scan.
fn shapes(layers: &[&Layer]) -> Result<Vec<Gaussian>, TipFunctionError> {
    let mut shapes: Vec<Gaussian> = vec![];
    for layer in layers {
        for g in right_half(&layer.along)? {
            if !shapes.iter().any(|shape| alike(shape, &g)) {
                shapes.push(g);
            }
        }
    }
    Ok(shapes)
}

fn alike(a: &Gaussian, b: &Gaussian) -> bool {
    close(a.center, b.center, a.width) && close(a.width, b.width, a.width)
}
