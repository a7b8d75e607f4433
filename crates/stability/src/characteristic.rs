//! The characteristic function h(Λ) = rΛ + 1 + (α/r) G(Λ) of (30), that of creep, 1 + (α/r) G(p), in which the
//! drag of the tip is nothing, and where they cannot vanish.

use super::StabilityError;
use super::analytic::Analytic;
use super::transform::{CurvatureTransform, Scaled};
use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::{Model, TipFunction};

/// Samples of f'' over the reach, from which its integrals are bounded.
const SAMPLES: u32 = 1000;
/// Kept between those sums and the bounds that use them.
const MARGIN: f64 = 1.1;

/// How many widths^{-1} to the left anyone may want to look.
const WIDENINGS: f64 = 60.0;
/// Round-off of 1e-16 in f, 1e-11 in f'' of a dense table, is no longer small times e to this.
const ROUNDOFF_EXPONENT: f64 = 24.0;

/// h of (30) for one model with a Gaussian tip function.
#[derive(Debug, Clone)]
pub(super) struct Characteristic {
    transform: CurvatureTransform,
    /// λ = rΛ; 1 for creep, whose roots are not times.
    r: f64,
    /// The coefficient of Λ: r, or 0 for creep.
    drag: f64,
    /// α/r
    pub(super) ratio: f64,
    /// A length of the order of the tip's width.
    length: f64,
    /// Re Λ left of which the roots are not those of the tip but of the round-off in its table.
    leftmost: f64,
    bounds: Bounds,
}

/// What bounds G: ∫|f''|, |f''(0)| + ∫|f'''|, f''(0), and for each Gaussian (a w √(2π), c, w).
#[derive(Debug, Clone)]
struct Bounds {
    area: f64,
    variation: f64,
    /// f''(0)
    peak: f64,
    terms: Vec<(f64, f64, f64)>,
}

impl Characteristic {
    /// That of small deviations from steady motion.
    pub(super) fn new(model: &Model) -> Self {
        Self::with_drag(model, model.r(), model.r())
    }

    /// That of the logarithmic creep of a trapped tip, whose roots are its rates p.
    pub(super) fn of_creep(model: &Model) -> Self {
        Self::with_drag(model, 0.0, 1.0)
    }

    fn with_drag(model: &Model, drag: f64, r: f64) -> Self {
        let tip = model.tip();
        let transform = CurvatureTransform::new(tip);
        let length = tip.reach().unwrap_or(9.0) / 9.0;
        let leftmost = if transform.is_closed_form() {
            -WIDENINGS / length
        } else {
            -ROUNDOFF_EXPONENT / (9.0 * length)
        };
        Self {
            transform,
            r,
            drag,
            ratio: model.alpha() / model.r(),
            length,
            leftmost,
            bounds: Bounds::new(tip),
        }
    }

    /// Whether the terms of h, of sizes r/width, 1 and (α/r) ∫|f''|, are out of all proportion: the first two
    /// cancel at the root -1/r, the last two near 0, and what is left of them is round-off.
    pub(super) fn is_out_of_proportion(&self) -> bool {
        let (drag, pull) = (self.r / self.length, self.ratio * self.bounds.area);
        let relative = pull / drag.max(1.0);
        !(1e-12..=1e12).contains(&drag) || (self.ratio > 0.0 && !(1e-50..=1e14).contains(&relative))
    }

    /// The reason behind an error: numbers out of all proportion, if they are.
    pub(super) fn explain(&self, error: StabilityError) -> StabilityError {
        if self.is_out_of_proportion() {
            return StabilityError::TooFarApart { alpha: self.ratio * self.r, r: self.r };
        }
        error
    }
}

impl Analytic for Characteristic {
    fn at(&self, lambda: Complex64) -> Scaled {
        if self.ratio <= 0.0 {
            let derivative = Complex64::new(self.drag, 0.0);
            return Scaled { value: lambda * self.drag + 1.0, derivative, log_scale: 0.0 };
        }
        let g = self.transform.at(lambda);
        let down = (-g.log_scale).exp();
        Scaled {
            value: (lambda * self.drag + 1.0) * down + g.value * self.ratio,
            derivative: self.drag * down + g.derivative * self.ratio,
            log_scale: g.log_scale,
        }
    }

    /// Σ|terms| of h, those of G each by itself: they may cancel.
    fn size_of_terms(&self, lambda: Complex64, log_scale: f64) -> f64 {
        let linear = (self.drag * lambda.norm() + 1.0) * (-log_scale).exp();
        let transform = self.ratio * self.transform.size(lambda, log_scale);
        (linear + transform).max(f64::MIN_POSITIVE)
    }

    /// Zeros of rΛ + 1 + (α/r) f''(0)/Λ, or for creep of 1 + (α/r) f''(0)/p, on or above the real axis: those
    /// of h far from 0, where G(Λ) = f''(0)/Λ + O(Λ^{-3}).
    /// And the root of α = 0.
    fn likely_roots(&self) -> Vec<Complex64> {
        let alone = Complex64::new(-1.0 / self.r, 0.0);
        if self.drag <= 0.0 {
            return vec![alone, Complex64::new(-self.ratio * self.bounds.peak, 0.0)];
        }
        let squared = 1.0 - 4.0 * self.drag * self.ratio * self.bounds.peak;
        let root = Complex64::new(squared, 0.0).sqrt();
        let zeros = [root, -root].map(|root| (root - 1.0) / (2.0 * self.drag));
        [alone].into_iter().chain(zeros).filter(|z| z.im >= 0.0).collect()
    }

    fn r(&self) -> f64 {
        self.r
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn leftmost(&self) -> f64 {
        self.leftmost
    }

    fn left_of_all(&self) -> Option<f64> {
        (self.ratio <= 0.0).then(|| -2.0 / self.r)
    }

    fn too_far_apart(&self) -> StabilityError {
        StabilityError::TooFarApart { alpha: self.ratio * self.r, r: self.r }
    }

    /// R such that h has no zero with Re Λ ≥ 0 and |Λ| ≥ R: there |rΛ + 1| ≥ r|Λ|, and |G| is below
    /// ∫|f''| and below (|f''(0)| + ∫|f'''|)/|Λ|. For creep what is left of h is 1.
    fn right_bound(&self) -> f64 {
        let Bounds { area, variation, .. } = self.bounds;
        if self.drag <= 0.0 {
            return if self.ratio * area < 1.0 { 0.0 } else { self.ratio * variation };
        }
        (self.ratio * area / self.drag).min((self.ratio * variation / self.drag).sqrt())
    }

    /// T such that h has no zero with `left` ≤ Re Λ and |Im Λ| ≥ T.
    ///
    /// For Re Λ < 0, G(Λ) = E(Λ) - G(-Λ) with E the two-sided transform, whose Gaussians fade as
    /// e^{w²(Re² - Im²)/2}, and G(-Λ) is bounded as on the right.
    fn top_bound(&self, left: f64) -> f64 {
        let Bounds { area, variation, terms, .. } = &self.bounds;
        let narrowest = terms.iter().map(|t| t.2).fold(f64::INFINITY, f64::min);
        let fades = |top: f64| {
            let two_sided: f64 = terms
                .iter()
                .map(|(area, c, w)| {
                    let exponent = 0.5 * w * w * (left * left - top * top) + c * left.abs();
                    area * exponent.exp()
                })
                .sum();
            let e = (left * left + top * top) * two_sided;
            let linear = if self.drag > 0.0 { self.drag * top } else { 1.0 };
            linear > self.ratio * (e + area.min(variation / top))
        };
        let mut top = (1.05 * self.right_bound()).max(1.0 / self.length);
        if left < 0.0 && self.ratio > 0.0 {
            // Beyond √2/w, E's bound falls with Im Λ: once satisfied, for good.
            top = top.max(2.0_f64.sqrt() / narrowest);
            while !fades(top) {
                top *= 1.1;
            }
        }
        top
    }
}

impl Bounds {
    fn new(tip: &TipFunction) -> Self {
        let TipFunction::Gaussians(sum) = tip else {
            return Self { area: 0.0, variation: 0.0, peak: 0.0, terms: Vec::new() };
        };
        let reach = tip.reach().unwrap_or(1.0);
        let samples = f64::from(SAMPLES).max(reach * tip.band()).min(1e5);
        let step = reach / samples;
        let (mut area, mut x) = (0.0, 0.0);
        let peak = tip.slope_and_curvature(0.0).1;
        let mut last = peak;
        let mut variation = last.abs();
        while x < reach {
            x += step;
            let curvature = tip.slope_and_curvature(x).1;
            area += 0.5 * step * (curvature.abs() + last.abs());
            variation += (curvature - last).abs();
            last = curvature;
        }
        let term = |g: &stickslip_tip::Gaussian| {
            (g.amplitude.abs() * g.width * (2.0 * PI).sqrt(), g.center.abs(), g.width)
        };
        let terms = sum.terms().iter().map(term).collect();
        Self { area: MARGIN * area, variation: MARGIN * variation, peak, terms }
    }
}
