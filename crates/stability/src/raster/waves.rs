//! The response of a line to its own ripple e^{iqx} and to those of earlier lines: transforms of f on intervals of q.

use super::patch::Patch;
use crate::extent::Extent;
use crate::one_sided::{Jet, OneSided};
use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::{Footprint, Gaussian, TipFunction};

/// The transforms of f(x,0) over x > 0 and of the layers over all x, at p = s + iq.
#[derive(Debug, Clone)]
pub(super) struct Waves {
    own: OneSided,
    own_extent: Extent,
    /// The transform of `f_yy(x,0)`, if the tip is flexible across the lines and `f_yy(x,0)` is not 0.
    across: Option<(OneSided, Extent)>,
    layers: Vec<(Terms, Extent)>,
    /// Centre and width of the Gaussians of all layers; layers of a table share theirs.
    shapes: Vec<(f64, f64)>,
    /// s = 1/(rT)
    pub(super) fading: f64,
    /// φ, φ1 and G at s.
    pub(super) steady: [f64; 3],
}

/// Area of each Gaussian of a layer, and its index in `shapes`.
type Terms = Vec<(f64, usize)>;

/// A function of q on an interval, for f, f' and f'' each.
pub(super) type Transformed = [Patch; 3];

impl Waves {
    pub(super) fn new(footprint: &Footprint, fading: f64) -> Self {
        let tips = || footprint.layers().iter().map(|layer| &layer.along);
        let mut shapes: Vec<(f64, f64)> =
            tips().flat_map(gaussians).map(|g| (g.center, g.width)).collect();
        sort_by_number(&mut shapes, |(_, width)| *width);
        sort_by_number(&mut shapes, |(center, _)| *center);
        let order = |a: &(f64, f64), b: &(f64, f64)| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1));
        shapes.dedup_by(|a, b| order(a, b).is_eq());
        let term = |g: &Gaussian| {
            let area = g.amplitude * g.width * (2.0 * PI).sqrt();
            let shape = shapes.binary_search_by(|shape| order(shape, &(g.center, g.width)));
            (area, shape.unwrap_or_default())
        };
        let layer = |tip: &TipFunction| {
            (gaussians(tip).iter().map(term).collect(), Extent::two_sided(tip, fading))
        };
        let own = OneSided::new(footprint.path());
        let still = own.steady(fading);
        let steady = [still.height, still.slope, still.curvature];
        Self {
            own,
            own_extent: Extent::one_sided(footprint.path()),
            across: None,
            layers: tips().map(layer).collect(),
            shapes,
            fading,
            steady,
        }
    }

    /// Adds the transform of `f_yy(x,0)`, for a tip that is flexible across the lines.
    pub(super) fn giving_way(mut self, footprint: &Footprint) -> Self {
        let curvature = footprint.curvature_across_path();
        let with_extent = |f: &TipFunction| (OneSided::across(f), Extent::one_sided(f));
        self.across = curvature.as_ref().map(with_extent);
        self
    }

    /// S(p) = ∫_0^∞ `f_yy(x,0)` e^{-px}dx and its derivative.
    pub(super) fn across_at(&self, p: Complex64) -> Jet {
        let zero = (Complex64::ZERO, Complex64::ZERO);
        self.across.as_ref().map_or(zero, |(across, _)| across.plain(p).curvature)
    }

    /// S for |q - centre| ≤ `half`.
    pub(super) fn across(&self, centre: f64, half: f64) -> Patch {
        let (p, nearest) = self.place(centre, half);
        let rest = self.across.as_ref().map_or(0.0, |(_, extent)| extent.curvature(nearest)[0]);
        on_axis(self.across_at(p), half, rest)
    }

    /// A bound of |S| where |p| ≥ `distance`.
    pub(super) fn across_bound(&self, distance: f64) -> f64 {
        self.across.as_ref().map_or(0.0, |(_, extent)| bounds(extent, distance)[0])
    }

    /// ĝ(s) of every layer.
    pub(super) fn steady_layers(&self) -> Vec<f64> {
        self.layers_at(self.fading.into()).iter().map(|jet| jet.0.re).collect()
    }

    /// φ, φ1, G at p, with derivatives with respect to p.
    pub(super) fn jets(&self, p: Complex64) -> [Jet; 3] {
        let at = self.own.plain(p);
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

    /// Bounds of |ĝ|, |pĝ|, |p²ĝ| of every layer where |p| ≥ `distance`.
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

/// A function of p = s + iq on an interval of q, from its value, its slope and a bound of its second derivative.
fn on_axis((value, slope): Jet, half: f64, second: f64) -> Patch {
    let along = [slope * Complex64::I * half, Complex64::ZERO];
    Patch { value, along, rest: 0.5 * half * half * second }
}

fn gaussians(tip: &TipFunction) -> &[Gaussian] {
    let TipFunction::Gaussians(sum) = tip else { return &[] };
    sum.terms()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The transforms themselves, at many places of many intervals.
    #[test]
    fn transforms_are_within_their_patches() {
        let x: Vec<f64> = (0..60).map(|i| 0.15 * f64::from(i)).collect();
        let f: Vec<f64> = x.iter().map(|x| (1.0 - 0.3 * x * x) * (-0.5 * x * x).exp()).collect();
        let tips = [
            TipFunction::gaussian(0.7).unwrap(),
            TipFunction::triple_gaussian(1.0, 1.0).unwrap(),
            TipFunction::table(&x, &f).unwrap(),
        ];
        for tip in tips {
            for fading in [0.0, 0.4] {
                let waves = Waves::new(&Footprint::separable(tip.clone(), 1.0).unwrap(), fading);
                for centre in [0.02, 0.5, 1.0, 2.3, 4.0, 7.0] {
                    for half in [0.01, 0.1, 0.5] {
                        are_within(&waves, centre, half);
                    }
                }
            }
        }
    }

    fn are_within(waves: &Waves, centre: f64, half: f64) {
        let (own, layers) = (waves.own(centre, half), &waves.layers(centre, half)[0]);
        for i in -8..=8 {
            let y = 0.125 * f64::from(i);
            let p = Complex64::new(waves.fading, centre + half * y);
            let here = waves.jets(p);
            let (g, _) = waves.layers_at(p)[0];
            let exact = [here[0].0, here[1].0, here[2].0, g, p * g, p * p * g];
            let distance = p.norm();
            let sizes = [waves.own_bounds(distance), waves.layer_bounds(distance)[0]].concat();
            for ((patch, exact), size) in own.iter().chain(layers).zip(exact).zip(sizes) {
                let off = (exact - patch.value - patch.along[0] * y).norm();
                assert!(off <= patch.rest + 1e-12, "{centre} {half} {y}: {off} {}", patch.rest);
                assert!(exact.norm() <= size + 1e-12, "{centre} {y}: {exact} {size}");
            }
        }
    }
}
