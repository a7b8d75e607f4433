//! One-sided transforms of a footprint in the characteristic equation: φ = ∫_0^∞ f e^{-py}dy, φ1 = ∫_0^∞ f' e^{-py}dy
//! = pφ - f(0) and G = ∫_0^∞ f'' e^{-py}dy = pφ1. For deviations across the scan, the stored function is `f_yy(x,0)`, and
//! its own transform replaces G.

use super::transform::{CurvatureTransform, Scaled};
use num_complex::Complex64;
use stickslip_tip::TipFunction;

/// A value and its derivative.
pub(super) type Jet = (Complex64, Complex64);

/// The transforms at one p, each multiplied by `unit`: e^{-`log_scale`} for Gaussians; √(p²+1) for J0 and p²+1 for
/// cos x, whose transforms are infinite at ±i.
#[derive(Debug, Clone, Copy)]
pub(super) struct Transforms {
    pub(super) unit: Jet,
    pub(super) height: Jet,
    pub(super) slope: Jet,
    pub(super) curvature: Jet,
    pub(super) log_scale: f64,
}

impl Transforms {
    /// The transforms of f = 0.
    pub(super) const NONE: Self = {
        let zero = (Complex64::ZERO, Complex64::ZERO);
        let unit = (Complex64::ONE, Complex64::ZERO);
        Self { unit, height: zero, slope: zero, curvature: zero, log_scale: 0.0 }
    };
}

/// φ, φ1 and G at a real p.
#[derive(Debug, Clone, Copy)]
pub(super) struct Steady {
    pub(super) height: f64,
    pub(super) slope: f64,
    pub(super) curvature: f64,
}

/// The transforms of one footprint.
#[derive(Debug, Clone)]
pub(super) struct OneSided {
    tip: TipFunction,
    apex: f64,
    /// G of a sum of Gaussians; the transforms of J0 and cos x are elementary.
    sum: Option<CurvatureTransform>,
    /// Whether G is the transform of the function itself.
    pub(super) is_across: bool,
}

/// φ, φ1 and G, with their derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct Values {
    pub(super) height: Jet,
    pub(super) slope: Jet,
    pub(super) curvature: Jet,
}

impl OneSided {
    pub(super) fn new(tip: &TipFunction) -> Self {
        let sum = match tip {
            TipFunction::Gaussians(sum) => Some(CurvatureTransform::new(sum.terms(), tip.band())),
            TipFunction::Bessel | TipFunction::Cosine => None,
        };
        Self { tip: tip.clone(), apex: tip.value(0.0), sum, is_across: false }
    }

    /// The transforms for deviations across the scan, given `f_yy(x,0)`.
    pub(super) fn across(curvature: &TipFunction) -> Self {
        Self { is_across: true, ..Self::new(curvature) }
    }

    /// f''(0), or `f_yy(0,0)`: for large p, G approaches this value divided by p.
    pub(super) fn peak(&self) -> f64 {
        if self.is_across { self.apex } else { self.tip.slope_and_curvature(0.0).1 }
    }

    pub(super) fn tip(&self) -> &TipFunction {
        &self.tip
    }

    /// Whether G has a closed form. For an even f its real part on the imaginary axis is then most accurate from f̂.
    pub(super) fn is_closed_form(&self) -> bool {
        !matches!(self.sum, Some(CurvatureTransform::Quadrature(..)))
    }

    pub(super) fn at(&self, p: Complex64) -> Transforms {
        let at = match &self.sum {
            Some(sum) => self.gaussians(sum, p),
            None if self.tip == TipFunction::Bessel => bessel(p),
            None => cosine(p),
        };
        if self.is_across { Transforms { curvature: at.height, ..at } } else { at }
    }

    /// The transforms divided by `unit`, for p at which they do not overflow.
    pub(super) fn plain(&self, p: Complex64) -> Values {
        let at = self.at(p);
        let (unit, change) = at.unit;
        let over = |(value, slope): Jet| {
            let value = value / unit;
            (value, (slope - value * change) / unit)
        };
        Values { height: over(at.height), slope: over(at.slope), curvature: over(at.curvature) }
    }

    pub(super) fn steady(&self, p: f64) -> Steady {
        let at = self.at(Complex64::new(p, 0.0));
        let real = |f: Jet| f.0.re / at.unit.0.re;
        Steady { height: real(at.height), slope: real(at.slope), curvature: real(at.curvature) }
    }

    /// Σ|terms| of φ, φ1 and G, each times `unit`. `at` contains the transforms at p.
    pub(super) fn sizes(&self, p: Complex64, at: &Transforms) -> [f64; 3] {
        let [height, slope, curvature] = self.sizes_along(p, at);
        [height, slope, if self.is_across { height } else { curvature }]
    }

    fn sizes_along(&self, p: Complex64, at: &Transforms) -> [f64; 3] {
        let Some(sum) = &self.sum else {
            return [at.height, at.slope, at.curvature].map(|f| f.0.norm());
        };
        let curvature = sum.size(p, at.log_scale);
        let distance = p.norm();
        let apex = self.apex.abs() * at.unit.0.norm();
        if sum.height_near_origin(p).is_some() {
            return [at.height.0.norm(), distance * at.height.0.norm() + apex, curvature];
        }
        let slope = curvature / distance;
        [(slope + apex) / distance, slope, curvature]
    }

    /// φ1 = G/p and φ = (φ1 + f(0))/p; near p = 0, where these terms cancel, φ1 and G follow from φ.
    fn gaussians(&self, sum: &CurvatureTransform, p: Complex64) -> Transforms {
        if let Some(height) = sum.height_near_origin(p) {
            let slope = (p * height.0 - self.apex, height.0 + p * height.1);
            let curvature = (p * slope.0, slope.0 + p * slope.1);
            let unit = (Complex64::ONE, Complex64::ZERO);
            return Transforms { unit, height, slope, curvature, log_scale: 0.0 };
        }
        let Scaled { value, derivative, log_scale } = sum.at(p);
        let unit = Complex64::new((-log_scale).exp(), 0.0);
        let slope = value / p;
        let slope = (slope, (derivative - slope) / p);
        let height = (slope.0 + unit * self.apex) / p;
        let height = (height, (slope.1 - height) / p);
        let curvature = (value, derivative);
        Transforms { unit: (unit, Complex64::ZERO), height, slope, curvature, log_scale }
    }
}

/// √(p²+1), positive for positive p, with cuts from ±i straight to the left.
pub(super) fn bessel_root(p: Complex64) -> Complex64 {
    (p + Complex64::I).sqrt() * (p - Complex64::I).sqrt()
}

/// With S = √(p²+1): φ = 1/S, φ1 = p/S - 1, times S.
fn bessel(p: Complex64) -> Transforms {
    let root = bessel_root(p);
    let slope_of_root = p / root;
    // p - S = -1/(p + S), without cancellation.
    let difference = if (root + p).norm_sqr() > 1.0 { -(root + p).inv() } else { p - root };
    let slope = (difference, Complex64::ONE - slope_of_root);
    Transforms {
        unit: (root, slope_of_root),
        height: (Complex64::ONE, Complex64::ZERO),
        slope,
        curvature: (p * slope.0, slope.0 + p * slope.1),
        log_scale: 0.0,
    }
}

/// φ = p/(p²+1), φ1 = -1/(p²+1), times p²+1.
fn cosine(p: Complex64) -> Transforms {
    Transforms {
        unit: (p * p + 1.0, p * 2.0),
        height: (p, Complex64::ONE),
        slope: (-Complex64::ONE, Complex64::ZERO),
        curvature: (-p, -Complex64::ONE),
        log_scale: 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Comparison with Simpson's rule for the definition, up to the point where e^{-py} is 1e-17.
    fn by_simpson(f: impl Fn(f64) -> f64, p: Complex64, reach: f64) -> Complex64 {
        let panels = 40_000;
        let h = reach / f64::from(panels);
        let term = |i: i32| {
            let weight = if i == 0 || i == panels { 1.0 } else { f64::from(2 + 2 * (i % 2)) };
            let y = h * f64::from(i);
            (-p * y).exp() * (weight * f(y))
        };
        (0..=panels).map(term).sum::<Complex64>() * (h / 3.0)
    }

    #[test]
    fn transforms_are_the_integrals_that_they_stand_for() {
        let x: Vec<f64> = (0..=80).map(|i| 0.1 * f64::from(i)).collect();
        let f: Vec<f64> = x.iter().map(|x| (-x * x / 2.0).exp() * (1.0 - 0.3 * x * x)).collect();
        let tips = [
            (TipFunction::triple_gaussian(0.7, 1.0).unwrap(), 12.0),
            (TipFunction::gaussian(0.3).unwrap(), 4.0),
            (TipFunction::table(&x, &f).unwrap(), 14.0),
            (TipFunction::Bessel, 80.0),
            (TipFunction::Cosine, 80.0),
        ];
        let points = [(0.5, 0.0), (0.5, 0.9), (0.6, 3.0), (2.0, 0.3), (1e-3, 1e-2), (-1.5, 0.7)];
        for (tip, reach) in tips {
            let footprint = OneSided::new(&tip);
            for (re, im) in points.into_iter().filter(|p| reach < 20.0 || p.0 > 0.4) {
                let p = Complex64::new(re, im);
                let at = footprint.at(p);
                let told = [at.height, at.slope, at.curvature].map(|f| f.0 / at.unit.0);
                let sums = [
                    by_simpson(|y| tip.value(y), p, reach),
                    by_simpson(|y| tip.slope(y), p, reach),
                    by_simpson(|y| tip.slope_and_curvature(y).1, p, reach),
                ];
                for (told, sum) in told.iter().zip(sums) {
                    assert!(
                        (told - sum).norm() < 2e-10 * (1.0 + sum.norm()),
                        "{tip:?} {p} {told} {sum}"
                    );
                }
            }
        }
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let tips = [
            TipFunction::triple_gaussian(0.7, 1.0).unwrap(),
            TipFunction::Bessel,
            TipFunction::Cosine,
        ];
        let parts: [fn(&Transforms) -> Jet; 4] =
            [|t| t.unit, |t| t.height, |t| t.slope, |t| t.curvature];
        for tip in tips {
            let footprint = OneSided::new(&tip);
            for p in [(0.1, 0.2), (0.4, 1.9), (2.0, 0.1)].map(|(re, im)| Complex64::new(re, im)) {
                for part in parts {
                    let at = |h: f64| part(&footprint.at(p + h)).0;
                    let h = 1e-3;
                    let difference =
                        ((at(h) - at(-h)) * 8.0 - at(2.0 * h) + at(-2.0 * h)) / (12.0 * h);
                    let error = (difference - part(&footprint.at(p)).1).norm();
                    assert!(error < 1e-8 * (1.0 + difference.norm()), "{tip:?} {p} {error:e}");
                }
            }
        }
    }
}
