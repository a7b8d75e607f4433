//! Snaking: instability of a single line with a tip that is flexible across the scan.
//!
//! A spring κ_y holds the tip on its line y = 0. A small deviation y ∝ e^{λt} from the steady motion x0 = rt is driven
//! by the groove that the tip made at other y. With the indentation rate a = αw0 in steady motion, the healing time T
//! and s = 1/(rT),
//!
//! ```text
//!     y'(t) = a ∫_0^∞ f_yy(rτ,0) e^{-τ/T} [y(t) - y(t-τ)] dτ - κ_y y(t)
//!     N(λ) = λ + κ_y + (a/r) [S(λ/r + s) - S(s)] = 0,       S(p) = ∫_0^∞ f_yy(x,0) e^{-px}dx
//! ```
//!
//! f is even in y, so that neither the force along the scan nor the height under the tip changes at first order. A
//! depth limit therefore enters only through w0, and neither its kink nor inertia along the scan matters. For f = f(x)
//! exp(-y²/(2v²)), S = -φ/v². At λ = 0 N = κ_y > 0, so that roots cross the axis in pairs λ = ±iω, Ω = ω/r, where
//!
//! ```text
//!     r/a = Im[S(s) - S(s + iΩ)]/(rΩ),       κ_y = rΩ Re[S(s) - S(s + iΩ)]/Im[S(s) - S(s + iΩ)]
//! ```
//!
//! Without healing, α/r² in the basic model is therefore a function of κ_y/r alone. A footprint whose f_yy(x,0)
//! increases from x = 0 on never snakes, because ∫ f_yy sin Ωx dx < 0 for all Ω; the Gaussian is an example.

use super::StabilityError;
use super::certificate::Spectrum;
use super::characteristic::Characteristic;
use super::half_plane::{HalfPlane, leading};
use super::law::Law;
use super::one_sided::OneSided;
use super::raster::{judge_stiffness, single_across};
use std::f64::consts::TAU;
use std::sync::Arc;
use stickslip_tip::{Footprint, Model, ModelError, TipFunction, Wider};

/// Relative accuracy to which the search certifies a threshold as the lowest.
const TOLERANCE: f64 = 1e-10;
/// Relative distance from a threshold of the two α at which roots are counted.
const MARGIN: f64 = 1e-6;

/// A single line of a footprint f(x,y) at a velocity r, with a spring κ_y across the scan.
#[derive(Debug, Clone)]
pub struct Snaking {
    footprint: Footprint,
    /// `f_yy(x,0)`; `None` if it is 0 for all x.
    curvature: Option<Arc<OneSided>>,
    law: Wider,
    r: f64,
    stiffness: f64,
}

/// Threshold of the snaking of a single line. Lengths in σ, times in Γ/k.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SnakingCritical {
    /// α_y, the smallest α with an undamped deviation across the scan.
    pub alpha: f64,
    /// The support velocity r.
    pub r: f64,
    /// κ_y, in units of the spring along the scan.
    pub stiffness: f64,
    /// Frequency ω = rΩ in time.
    pub omega: f64,
    /// Wavelength 2πr/ω along the scan.
    pub wavelength: f64,
    /// Evidence that this is the threshold.
    pub certificate: SnakingCertificate,
}

/// Evidence that no deviation across the scan grows below the threshold, and that one grows above it.
///
/// A search over all Ω excludes roots on the imaginary axis for all α below the threshold by more than `tolerance`.
/// Roots right of the axis are counted by the argument principle at two α. The certificate rests on floating-point
/// arithmetic with bounds, not on interval arithmetic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SnakingCertificate {
    /// No other threshold is lower than this one by more than this fraction.
    pub tolerance: f64,
    /// Number of intervals of Ω examined.
    pub cells: usize,
    /// Relative distance of the two α from the threshold.
    pub margin: f64,
    /// Number of roots with Re λ > 0 at the lower α.
    pub growing_below: usize,
    /// Number of roots with Re λ > 0 at the higher α.
    pub growing_above: usize,
}

impl Snaking {
    /// # Errors
    /// r or κ_y is not a positive finite number, κ_y is below 1e-9 r, or a parameter of the model is out of range. There
    /// is no spring along the scan, or the footprint is not even.
    pub fn new(
        footprint: &Footprint,
        law: Wider,
        (r, stiffness): (f64, f64),
    ) -> Result<Self, StabilityError> {
        StabilityError::unless_positive(r)?;
        judge_stiffness(stiffness, r)?;
        Law::judge(&law, r)?;
        if !footprint.is_even() {
            return Err(StabilityError::EvenOnly("the motion across the scan"));
        }
        let curvature = footprint.curvature_across_path();
        let curvature = curvature.map(|curvature| Arc::new(OneSided::across(&curvature)));
        Ok(Self { footprint: footprint.clone(), curvature, law, r, stiffness })
    }

    /// The smallest α at which the line snakes; `None` if it never does.
    ///
    /// J0 never snakes. If its width across is v, and s = 1/(rT) for the healing time T, deviations obey
    /// λ + κ_y = (αw0/(rv²)) (φ(λ/r + s) - φ(s)). This has no solution with Re λ ≥ 0: φ(p) = 1/√(p²+1) decreases along
    /// the real axis, and Im φ < 0 if Re p and Im p are positive.
    ///
    /// # Errors
    /// [`StabilityError::AcrossGaussiansOnly`] for cos x; [`StabilityError::Uncertified`],
    /// [`StabilityError::Stopped`], and the errors of the count of roots.
    pub fn critical(&self) -> Result<Option<SnakingCritical>, StabilityError> {
        if *self.footprint.path() == TipFunction::Bessel {
            return Ok(None);
        }
        self.judge()?;
        if self.curvature.is_none() {
            return Ok(None);
        }
        let (r, stiffness) = (self.r, self.stiffness);
        let (place, cells) = single_across(&self.footprint, self.fading(), (r, stiffness))?;
        let Some((t, q)) = place else { return Ok(None) };
        let alpha = self.alpha(1.0 / t);
        if !alpha.is_finite() {
            return Ok(None);
        }
        let growing = |part: f64| self.unstable_count(alpha * part);
        let certificate = SnakingCertificate {
            tolerance: TOLERANCE,
            cells,
            margin: MARGIN,
            growing_below: growing(1.0 - MARGIN)?,
            growing_above: growing(1.0 + MARGIN)?,
        };
        let (omega, wavelength) = (r * q, TAU / q);
        Ok(Some(SnakingCritical { alpha, r, stiffness, omega, wavelength, certificate }))
    }

    /// All growth exponents λ of deviations across the scan with Re λ ≥ `bound` at this α, with a certificate that none
    /// is missing.
    ///
    /// # Errors
    /// As [`roots`](super::roots); [`StabilityError::AcrossGaussiansOnly`].
    pub fn roots(&self, alpha: f64, bound: f64) -> Result<Spectrum, StabilityError> {
        if !bound.is_finite() {
            return Err(StabilityError::Bound(bound));
        }
        let h = self.characteristic(alpha)?;
        let counted = HalfPlane::counted(&h, bound / self.r);
        counted.and_then(|counted| counted.spectrum(&h)).map_err(|error| h.explain(error))
    }

    /// At least `count` leading roots at this α, as [`leading_roots`](super::leading_roots).
    ///
    /// # Errors
    /// As [`Snaking::roots`].
    pub fn leading_roots(&self, alpha: f64, count: usize) -> Result<Spectrum, StabilityError> {
        let h = self.characteristic(alpha)?;
        leading(&h, count).map_err(|error| h.explain(error))
    }

    /// Number of roots right of the imaginary axis at this α: 0 if the line stays straight.
    ///
    /// # Errors
    /// As [`Snaking::roots`].
    pub fn unstable_count(&self, alpha: f64) -> Result<usize, StabilityError> {
        let h = self.characteristic(alpha)?;
        let counted = HalfPlane::counted(&h, 0.0).map_err(|error| h.explain(error))?;
        Ok(counted.count)
    }

    fn characteristic(&self, alpha: f64) -> Result<Characteristic, StabilityError> {
        self.judge()?;
        let model = Model::under(self.law, self.footprint.path().clone(), alpha, self.r);
        let model = model.map_err(|error| match error {
            ModelError::Wider(error) => error.into(),
            _ => StabilityError::Alpha(alpha),
        })?;
        // Nothing pushes where f_yy = 0: any function does then, with A = 0.
        let flat = || Arc::new(OneSided::across(self.footprint.path()));
        let density = if self.curvature.is_some() { model.steady_density() } else { 0.0 };
        let curvature = self.curvature.clone().unwrap_or_else(flat);
        let at = (self.r, density);
        Ok(Characteristic::of(Law::across(self.law.healing_time, &curvature, at, self.stiffness)))
    }

    /// An error for a footprint that is not a sum of Gaussians.
    fn judge(&self) -> Result<(), StabilityError> {
        let is_gaussian = matches!(self.footprint.path(), TipFunction::Gaussians(_));
        if is_gaussian { Ok(()) } else { Err(StabilityError::AcrossGaussiansOnly) }
    }

    /// s = 1/(rT)
    fn fading(&self) -> f64 {
        self.law.fading(self.r)
    }

    /// α for a given A = αw0/r, where w0 = e^{-A|φ(s)|/b}.
    fn alpha(&self, density: f64) -> f64 {
        let depth = density * self.footprint.path().fading_tail(0.0, self.fading()).abs();
        self.r * density * self.law.depth_limit.map_or(1.0, |limit| (depth / limit).exp())
    }
}
