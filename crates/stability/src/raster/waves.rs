//! What one line, and a line beside it, says to a ripple e^{iqx}: functions of q, on intervals of q.

use super::extent::Extent;
use super::patch::Patch;
use crate::wider::{Jet, PlainTransforms};
use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::{Footprint, Gaussian, TipFunction};

/// The transforms of f(x,0) over x > 0 and of the layers over all x, at p = s + iq.
#[derive(Debug, Clone)]
pub(super) struct Waves {
    own: PlainTransforms,
    own_extent: Extent,
    layers: Vec<(Terms, Extent)>,
    /// Centre and width of all Gaussians of all layers, those of tables the same in each.
    shapes: Vec<(f64, f64)>,
    /// s = 1/(rT)
    pub(super) fading: f64,
    /// φ, φ1 and G at s.
    pub(super) steady: [f64; 3],
}

/// Area of a Gaussian of a layer, and which shape it has.
type Terms = Vec<(f64, usize)>;

/// A function of q on an interval, for f, f' and f'' each.
pub(super) type Transformed = [Patch; 3];

impl Waves {
    pub(super) fn new(footprint: &Footprint, fading: f64) -> Self {
        let tips = || footprint.layers().iter().map(|layer| &layer.along);
        let mut shapes: Vec<(f64, f64)> =
            tips().flat_map(gaussians).map(|g| (g.center, g.width)).collect();
        let order = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
        shapes.sort_by(order);
        shapes.dedup_by(|a, b| order(a, b).is_eq());
        let term = |g: &Gaussian| {
            let area = g.amplitude * g.width * (2.0 * PI).sqrt();
            let shape = shapes.binary_search_by(|shape| order(shape, &(g.center, g.width)));
            (area, shape.unwrap_or_default())
        };
        let layer = |tip: &TipFunction| {
            (gaussians(tip).iter().map(term).collect(), Extent::two_sided(tip, fading))
        };
        let own = PlainTransforms::new(footprint.path());
        let still = own.at(fading.into());
        let steady = [still.height, still.slope, still.curvature].map(|jet| jet.0.re);
        Self {
            own,
            own_extent: Extent::one_sided(footprint.path()),
            layers: tips().map(layer).collect(),
            shapes,
            fading,
            steady,
        }
    }

    /// ĝ(s) of every layer.
    pub(super) fn steady_layers(&self) -> Vec<f64> {
        self.layers_at(self.fading.into()).iter().map(|jet| jet.0.re).collect()
    }

    /// φ, φ1, G at p, with derivatives with respect to p.
    pub(super) fn jets(&self, p: Complex64) -> [Jet; 3] {
        let at = self.own.at(p);
        [at.height, at.slope, at.curvature]
    }

    /// ĝ(p) = ∫ g e^{-px}dx of every layer, with derivatives.
    pub(super) fn layers_at(&self, p: Complex64) -> Vec<Jet> {
        let shape = |(center, width): &(f64, f64)| {
            let square = p * (width * width);
            let value = (0.5 * p * square - p * center).exp();
            (value, value * (square - center))
        };
        let shapes: Vec<Jet> = self.shapes.iter().map(shape).collect();
        let layer = |(terms, _): &(Terms, Extent)| {
            let zero = (Complex64::ZERO, Complex64::ZERO);
            terms.iter().fold(zero, |sum, (area, index)| {
                let (value, slope) = shapes[*index];
                (sum.0 + value * area, sum.1 + slope * area)
            })
        };
        self.layers.iter().map(layer).collect()
    }

    /// φ, φ1 and G for |q - centre| ≤ `half`.
    pub(super) fn own(&self, centre: f64, half: f64) -> Transformed {
        let (p, nearest) = self.place(centre, half);
        let (jets, rest) = (self.jets(p), self.own_extent.curvature(nearest));
        [0, 1, 2].map(|i: usize| on_axis(jets[i], half, rest[i]))
    }

    /// ĝ, pĝ and p²ĝ of every layer.
    pub(super) fn layers(&self, centre: f64, half: f64) -> Vec<Transformed> {
        let (p, nearest) = self.place(centre, half);
        let each = self.layers.iter().zip(self.layers_at(p));
        each.map(|((_, extent), jet)| {
            let rest = extent.curvature(nearest);
            let times = |(value, slope): Jet| (p * value, value + p * slope);
            let jets = [jet, times(jet), times(times(jet))];
            [0, 1, 2].map(|i: usize| on_axis(jets[i], half, rest[i]))
        })
        .collect()
    }

    /// Bounds of |φ|, |φ1|, |G| where |p| ≥ `distance`.
    pub(super) fn own_bounds(&self, distance: f64) -> [f64; 3] {
        bounds(&self.own_extent, distance)
    }

    /// Of |ĝ|, |pĝ|, |p²ĝ| of every layer.
    pub(super) fn layer_bounds(&self, distance: f64) -> Vec<[f64; 3]> {
        self.layers.iter().map(|(_, extent)| bounds(extent, distance)).collect()
    }

    fn place(&self, centre: f64, half: f64) -> (Complex64, f64) {
        (Complex64::new(self.fading, centre), self.fading.hypot((centre - half).max(0.0)))
    }
}

fn bounds(extent: &Extent, distance: f64) -> [f64; 3] {
    [0, 1, 2].map(|i: usize| extent.area[i].min(extent.decay[i] / distance))
}

/// A function of p = s + iq with a bound of its second derivative.
fn on_axis((value, slope): Jet, half: f64, second: f64) -> Patch {
    let along = [slope * Complex64::I * half, Complex64::ZERO];
    Patch { value, along, rest: 0.5 * half * half * second }
}

fn gaussians(tip: &TipFunction) -> &[Gaussian] {
    let TipFunction::Gaussians(sum) = tip else { return &[] };
    sum.terms()
}
