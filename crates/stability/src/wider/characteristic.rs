//! N of the wider law as a function whose zeros are found and counted.

use super::super::StabilityError;
use super::super::analytic::Analytic;
use super::super::newton::simultaneous;
use super::super::transform::Scaled;
use super::bounds::{Bounds, bare_zeros, quadratic};
use super::law::Law;
use num_complex::Complex64;
use stickslip_tip::TipFunction;

/// How many widths^{-1} to the left anyone may want to look.
const WIDENINGS: f64 = 60.0;
/// Round-off of 1e-16 in f, 1e-11 in f'' of a dense table, is no longer small times e to this.
const ROUNDOFF_EXPONENT: f64 = 24.0;

/// Leading roots are counted so far to the right of the branch points of J0, in parts of s.
const BESIDE_BRANCH_POINTS: f64 = 0.02;

/// N, with where it cannot vanish.
#[derive(Debug, Clone)]
pub(in super::super) struct WiderCharacteristic {
    law: Law,
    bounds: Bounds,
    length: f64,
}

impl WiderCharacteristic {
    pub(super) fn new(law: Law) -> Self {
        let bounds = Bounds::new(law.footprint.tip());
        let length = law.footprint.tip().reach().unwrap_or(9.0) / 9.0;
        Self { law, bounds, length }
    }

    /// How many zeros there are at all, where they are few: those of a polynomial.
    pub(in super::super) fn degree(&self) -> Option<usize> {
        let cosine = *self.law.footprint.tip() == TipFunction::Cosine;
        cosine.then_some(if self.law.inertia > 0.0 { 4 } else { 3 })
    }

    /// Whether lines left of [`Analytic::leftmost`] cross the cuts of J0.
    pub(in super::super) fn is_cut(&self) -> bool {
        *self.law.footprint.tip() == TipFunction::Bessel
    }

    /// D(λ) and D'(λ) for a force e^{λt}.
    pub(in super::super) fn response(&self, lambda: Complex64) -> (Complex64, Complex64) {
        self.law.response(lambda / self.law.speed)
    }
}

impl Analytic for WiderCharacteristic {
    fn at(&self, lambda: Complex64) -> Scaled {
        let (transforms, (value, derivative)) = self.law.at(lambda);
        Scaled { value, derivative, log_scale: transforms.log_scale }
    }

    fn size_of_terms(&self, lambda: Complex64, _: f64) -> f64 {
        self.law.size(lambda).max(f64::MIN_POSITIVE)
    }

    fn r(&self) -> f64 {
        self.law.speed
    }

    fn length(&self) -> f64 {
        self.length
    }

    fn leftmost(&self) -> f64 {
        let within = match self.law.footprint.tip() {
            // Roots come as close to its branch points as A is small.
            TipFunction::Bessel => BESIDE_BRANCH_POINTS * self.law.fading,
            TipFunction::Gaussians(_) if !self.law.footprint.is_closed_form() => {
                -ROUNDOFF_EXPONENT / (9.0 * self.length)
            }
            TipFunction::Gaussians(_) | TipFunction::Cosine => -WIDENINGS / self.length,
        };
        within - self.law.fading
    }

    fn analytic_from(&self) -> f64 {
        if self.is_cut() && self.law.density.abs() > 0.0 {
            -self.law.fading
        } else {
            f64::NEG_INFINITY
        }
    }

    fn left_of_all(&self) -> Option<f64> {
        let Law { speed, spring, inertia, .. } = self.law;
        let zeros =
            if inertia > 0.0 { bare_zeros(&self.law) } else { vec![(-spring / speed).into()] };
        let leftmost = zeros.iter().map(|z| z.re).fold(0.0, f64::min);
        (self.law.density.abs() <= 0.0).then_some(2.0 * leftmost)
    }

    fn right_bound(&self) -> f64 {
        self.bounds.right_bound(&self.law)
    }

    fn top_bound(&self, left: f64) -> f64 {
        let least = (1.05 * self.right_bound()).max(1.0 / self.length);
        1.05 * self.bounds.top_bound(&self.law, left, least)
    }

    /// Those of Mv²Λ² + vΛ + κ - A G(s), and of that times p plus A f''(0): G(p) = f''(0)/p + O(p^{-3}).
    fn likely_roots(&self) -> Vec<Complex64> {
        let Law { density, speed, inertia, fading, .. } = self.law;
        let constant = self.law.spring - density * self.law.steady.curvature;
        let peak = density * self.law.footprint.tip().slope_and_curvature(0.0).1;
        let mut zeros = if inertia > 0.0 {
            let free = speed / inertia;
            let cubic = [
                fading + free,
                (free * fading) + constant / inertia,
                (constant * fading + peak) / inertia,
            ];
            let mut zeros = quadratic(inertia, speed, constant);
            zeros.extend(simultaneous(cubic));
            zeros
        } else {
            let mut zeros = quadratic(speed, speed * fading + constant, constant * fading + peak);
            zeros.push((-constant / speed).into());
            zeros
        };
        zeros.retain(|z| z.is_finite() && z.im >= -1e-9 * z.norm());
        zeros.into_iter().map(|z| Complex64::new(z.re, z.im.abs())).collect()
    }

    fn too_far_apart(&self) -> StabilityError {
        StabilityError::TooFarApart { alpha: self.law.alpha(), r: self.law.speed }
    }
}
