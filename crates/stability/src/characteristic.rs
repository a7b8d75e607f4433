//! The characteristic function N(Λ) of [`Law`], λ = vΛ, which is real on the real axis, with regions without zeros and
//! error estimates of zeros.

use super::StabilityError;
use super::bounds::{Bounds, bare_zeros, quadratic};
use super::law::Law;
use super::newton::simultaneous;
use super::transform::Scaled;
use num_complex::Complex64;
use std::sync::Arc;
use stickslip_tip::{Model, TipFunction};

/// Largest distance left of the imaginary axis at which roots are sought, in inverse widths.
const WIDENINGS: f64 = 60.0;
/// Round-off of 1e-16 in f, or of 1e-11 in f'' of a dense table, is no longer small if amplified by e to this power.
const ROUNDOFF_EXPONENT: f64 = 24.0;
/// Distance right of the branch points of J0 from which leading roots are counted, in units of s = 1/(rT).
const BESIDE_BRANCH_POINTS: f64 = 0.02;

/// N for small deviations from steady motion, or for creep.
#[derive(Debug, Clone)]
pub(super) struct Characteristic {
    law: Law,
    bounds: Arc<Bounds>,
    /// A length of the order of the tip's width: N varies over its inverse.
    pub(super) length: f64,
}

impl Characteristic {
    /// N for small deviations from the steady motion behind the support.
    pub(super) fn new(model: &Model) -> Result<Self, StabilityError> {
        if !model.wider().spring {
            return Err(StabilityError::NoSupport);
        }
        let law = Law::of(model);
        if Law::has_corner(model.wider(), model.tip(), &law.steady) {
            return Err(StabilityError::Corner);
        }
        Ok(Self::of(law))
    }

    pub(super) fn of(law: Law) -> Self {
        let bounds = Bounds::of(&law.footprint);
        let length = law.footprint.tip().reach().unwrap_or(9.0) / 9.0;
        Self { law, bounds, length }
    }

    /// D(λ) and D'(λ): a force e^{λt} divided by D(λ) is the displacement.
    pub(super) fn response(&self, lambda: Complex64) -> (Complex64, Complex64) {
        self.law.response(lambda / self.law.speed)
    }

    /// N and N'.
    pub(super) fn at(&self, lambda: Complex64) -> Scaled {
        let (transforms, (value, derivative)) = self.law.at(lambda);
        Scaled { value, derivative, log_scale: transforms.log_scale }
    }

    /// λ/Λ
    pub(super) fn r(&self) -> f64 {
        self.law.speed
    }

    /// s = p - Λ
    pub(super) fn fading(&self) -> f64 {
        self.law.fading
    }

    /// The number of zeros for cos x, where N times the unit of the transforms is a polynomial; else `None`.
    pub(super) fn degree(&self) -> Option<usize> {
        let cosine = *self.law.footprint.tip() == TipFunction::Cosine;
        cosine.then_some(if self.law.inertia > 0.0 { 4 } else { 3 })
    }

    /// Re Λ left of which roots are not sought: they would result from round-off.
    pub(super) fn leftmost(&self) -> f64 {
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

    /// Re Λ left of which N is not analytic: the branch points of J0.
    pub(super) fn analytic_from(&self) -> f64 {
        let is_cut = *self.law.footprint.tip() == TipFunction::Bessel;
        let indents = self.law.density.abs() > 0.0;
        if is_cut && indents { -self.law.fading } else { f64::NEG_INFINITY }
    }

    /// Whether N grows to the left as e^{Λ²w²/2}, so that its zeros form chains.
    pub(super) fn has_chain(&self) -> bool {
        matches!(self.law.footprint.tip(), TipFunction::Gaussians(_))
    }

    /// Re Λ of a line left of all zeros, if there is no indentation; else `None`.
    pub(super) fn left_of_all(&self) -> Option<f64> {
        let Law { drag, spring, inertia, .. } = self.law;
        let zeros =
            if inertia > 0.0 { bare_zeros(&self.law) } else { vec![(-spring / drag).into()] };
        let leftmost = zeros.iter().map(|z| z.re).fold(0.0, f64::min);
        (self.law.density.abs() <= 0.0).then_some(2.0 * leftmost)
    }

    /// R such that N has no zero with Re Λ ≥ 0 and |Λ| ≥ R.
    pub(super) fn right_bound(&self) -> f64 {
        self.bounds.right_bound(&self.law)
    }

    /// T such that N has no zero with `left` ≤ Re Λ and |Im Λ| ≥ T.
    pub(super) fn top_bound(&self, left: f64) -> f64 {
        let least = (1.05 * self.right_bound()).max(1.0 / self.length);
        1.05 * self.bounds.top_bound(&self.law, left, least)
    }

    /// Points close to zeros, on or above the real axis: the zeros of q = Mv²Λ² + vΛ + κ - A G(s) and of pq + A f''(0),
    /// because G(p) = f''(0)/p + O(p^{-3}).
    pub(super) fn likely_roots(&self) -> Vec<Complex64> {
        let Law { density, drag, inertia, fading, .. } = self.law;
        let constant = self.law.spring - density * self.law.steady.curvature;
        let peak = density * self.law.footprint.peak();
        let mut zeros = if drag <= 0.0 {
            vec![(-peak / constant).into()]
        } else if inertia > 0.0 {
            let free = drag / inertia;
            let cubic = [
                fading + free,
                (free * fading) + constant / inertia,
                (constant * fading + peak) / inertia,
            ];
            let mut zeros = quadratic(inertia, drag, constant);
            zeros.extend(simultaneous(cubic));
            zeros
        } else {
            let mut zeros = quadratic(drag, drag * fading + constant, constant * fading + peak);
            zeros.push((-constant / drag).into());
            zeros
        };
        zeros.retain(|z| z.is_finite() && z.im >= -1e-9 * z.norm());
        zeros.into_iter().map(|z| Complex64::new(z.re, z.im.abs())).collect()
    }

    /// |N| divided by the sum of the sizes of its terms.
    pub(super) fn relative_residual(&self, lambda: Complex64) -> f64 {
        self.at(lambda).value.norm() / self.size_of_terms(lambda)
    }

    /// Displacement of a root at Λ by round-off in N: the Newton step, and `roundoff` of its terms / |N'|. Close to a
    /// double root, where N' is small too, N'' limits it.
    pub(super) fn root_error(&self, lambda: Complex64, roundoff: f64) -> f64 {
        let h = self.at(lambda);
        let unknown = h.value.norm() + roundoff * self.size_of_terms(lambda);
        let error = unknown / h.derivative.norm();
        if error < 1e-9 * lambda.norm() {
            return error;
        }
        let step = 1e-3 / self.length;
        let far = self.at(lambda + step);
        let change = far.derivative * (far.log_scale - h.log_scale).exp() - h.derivative;
        error.min((2.0 * unknown * step / change.norm()).sqrt())
    }

    /// Σ|terms| of N, the scale of its round-off.
    fn size_of_terms(&self, lambda: Complex64) -> f64 {
        self.law.size(lambda).max(f64::MIN_POSITIVE)
    }

    pub(super) fn too_far_apart(&self) -> StabilityError {
        StabilityError::TooFarApart { alpha: self.law.alpha(), r: self.law.speed }
    }

    /// A more specific error if the parameters differ too much in size.
    pub(super) fn explain(&self, error: StabilityError) -> StabilityError {
        if self.is_out_of_proportion() { self.too_far_apart() } else { error }
    }

    /// Whether the terms of N, of sizes v/width, 1 and A ∫|f''|, differ too much. The first two cancel at the root -1/v,
    /// and the last two near 0; the remainder is then round-off.
    fn is_out_of_proportion(&self) -> bool {
        let drag = self.law.drag / self.length;
        let density = self.law.density.abs();
        let pull = density * self.bounds.curvature() / drag.max(1.0);
        !(1e-12..=1e12).contains(&drag) || (density > 0.0 && !(1e-50..=1e14).contains(&pull))
    }
}
