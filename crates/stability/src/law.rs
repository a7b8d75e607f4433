//! The characteristic equation of small deviations from steady motion, term by term.
//!
//! With λ = vΛ, p = Λ + s, A = αw0/v and B = ±A/b (minus where the surface under the tip is raised, h0 > 0):
//!
//! ```text
//!     D(Λ) = Mv²Λ² + vΛ + κ + A(G(p) - G(s)) + AB φ1(p)(φ1(s) - φ1(p))/(1 + Bφ(p)) = 0
//! ```
//!
//! The groove that acts on the tip is shifted by the deviation ξ, and less deep where w was smaller: w - w0 =
//! ±w0 (h - h0)/b. The height h depends on the same shifted and less deep groove, which leads to the quotient.
//! Multiplied by 1 + Bφ(p), with φ1 = pφ - f(0) and G = pφ1, the equation is of first degree in the transforms,
//!
//! ```text
//!     N(Λ) = (Mv²Λ² + vΛ + κ - A G(s))(1 + Bφ(p)) + A φ1(p)(p + B s φ(s)) = 0
//! ```
//!
//! In the basic model this is (30), rΛ + 1 + (α/r) G(Λ) = 0.

use super::StabilityError;
use super::one_sided::{Jet, OneSided, Steady, Transforms};
use num_complex::Complex64;
use std::sync::Arc;
use stickslip_tip::{Model, TipFunction, Wider};

/// The coefficients of N.
#[derive(Debug, Clone)]
pub(super) struct Law {
    pub(super) footprint: Arc<OneSided>,
    /// v: r, or the walking speed of a tip without a spring.
    pub(super) speed: f64,
    /// The coefficient of Λ: v, or 0 for creep.
    pub(super) drag: f64,
    /// A
    pub(super) density: f64,
    /// s = 1/(vT)
    pub(super) fading: f64,
    /// 1/b, negative where h0 > 0; 0 without a depth limit, or where h0 = 0.
    pub(super) inverse_limit: f64,
    /// Mv²
    pub(super) inertia: f64,
    /// κ
    pub(super) spring: f64,
    /// φ(s), φ1(s), G(s)
    pub(super) steady: Steady,
}

/// Heights below this fraction of ∫_0^∞|f| e^{-sy}dy are round-off of 0.
const NO_HEIGHT: f64 = 1e-13;

impl Law {
    /// # Errors
    /// r or a parameter of the model is out of range, or there is no spring.
    pub(super) fn judge(wider: &Wider, r: f64) -> Result<(), StabilityError> {
        StabilityError::unless_positive(r)?;
        if !wider.spring {
            return Err(StabilityError::NoSupport);
        }
        Ok(wider.validate()?)
    }

    /// N for the steady motion of a tip on its spring.
    pub(super) fn of(model: &Model) -> Self {
        Self::with_density(model.wider(), model.tip(), model.r(), model.steady_density())
    }

    /// N for the logarithmic creep of a trapped tip, in which drag is negligible: 1 + (α/r) G(p) = 0. Here Λ is the
    /// rate p, not a rate in time, and the speed is 1.
    pub(super) fn of_creep(model: &Model) -> Self {
        let density = model.alpha() / model.r();
        Self { drag: 0.0, ..Self::with_density(&Wider::default(), model.tip(), 1.0, density) }
    }

    /// N for deviations across the scan on a spring κ_y, given `f_yy(x,0)`. At first order such a deviation changes
    /// neither the motion along the scan nor the height, so that a depth limit enters only through A.
    ///
    /// ```text
    ///     N(Λ) = rΛ + κ_y + A(S(p) - S(s)) = 0,     S(p) = ∫_0^∞ f_yy(x,0) e^{-px}dx
    /// ```
    pub(super) fn across(
        healing_time: Option<f64>,
        curvature: &Arc<OneSided>,
        (r, density): (f64, f64),
        stiffness: f64,
    ) -> Self {
        let wider = Wider { healing_time, ..Wider::default() };
        Self { spring: stiffness, ..Self::on(&wider, curvature, r, density) }
    }

    /// N at a speed v for a given A.
    pub(super) fn with_density(wider: &Wider, tip: &TipFunction, speed: f64, density: f64) -> Self {
        Self::on(wider, &Arc::new(OneSided::new(tip)), speed, density)
    }

    /// As [`Law::with_density`], with given transforms of the footprint.
    pub(super) fn on(wider: &Wider, footprint: &Arc<OneSided>, speed: f64, density: f64) -> Self {
        let fading = wider.fading(speed);
        let steady = footprint.steady(fading);
        let is_level = !has_height(footprint.tip(), &steady);
        let sign = if is_level { 0.0 } else { (density * steady.height).signum() };
        Self {
            footprint: Arc::clone(footprint),
            speed,
            drag: speed,
            density,
            fading,
            inverse_limit: wider.depth_limit.map_or(0.0, |limit| sign / limit),
            inertia: wider.inertia.map_or(0.0, |mass| mass * speed * speed),
            spring: if wider.spring { 1.0 } else { 0.0 },
            steady,
        }
    }

    /// Whether steady motion lies on the kink of a depth limit, h = 0.
    pub(super) fn has_corner(wider: &Wider, tip: &TipFunction, steady: &Steady) -> bool {
        wider.depth_limit.is_some() && !has_height(tip, steady)
    }

    /// B
    pub(super) fn limit(&self) -> f64 {
        self.density * self.inverse_limit
    }

    /// Mv²Λ² + vΛ + κ and its derivative.
    pub(super) fn bare(&self, lambda: Complex64) -> Jet {
        let inner = lambda * self.inertia + self.drag;
        (lambda * inner + self.spring, inner + lambda * self.inertia)
    }

    /// The transforms at p; without indentation, A = 0, they count as 0, even where they would overflow.
    fn transforms(&self, lambda: Complex64) -> Transforms {
        let nothing = self.density.abs() <= 0.0;
        if nothing { Transforms::NONE } else { self.footprint.at(lambda + self.fading) }
    }

    /// The transforms at p, and N times their unit with its derivative.
    pub(super) fn at(&self, lambda: Complex64) -> (Transforms, Jet) {
        let t = self.transforms(lambda);
        let (a, b) = (self.density, self.limit());
        let (bare, bare_slope) = self.bare(lambda);
        let base = bare - a * self.steady.curvature;
        let shifted = b * self.fading * self.steady.height * a;
        let opened = |f: Jet| (base * f.0, bare_slope * f.0 + base * f.1);
        let (plain, raised) = (opened(t.unit), opened(t.height));
        let value = plain.0 + t.curvature.0 * a + raised.0 * b + t.slope.0 * shifted;
        let derivative = plain.1 + t.curvature.1 * a + raised.1 * b + t.slope.1 * shifted;
        (t, (value, derivative))
    }

    /// Σ|terms| of N times the unit.
    pub(super) fn size(&self, lambda: Complex64) -> f64 {
        let p = lambda + self.fading;
        let t = self.transforms(lambda);
        let nothing = self.density.abs() <= 0.0;
        let sizes = if nothing { [0.0; 3] } else { self.footprint.sizes(p, &t) };
        let [height, slope, curvature] = sizes;
        let (a, b, distance) = (self.density.abs(), self.limit().abs(), lambda.norm());
        let bare = distance * (distance * self.inertia + self.drag) + self.spring;
        let base = bare + a * self.steady.curvature.abs();
        let shifted = b * self.fading * self.steady.height.abs() * a;
        base * (t.unit.0.norm() + b * height) + a * curvature + shifted * slope
    }

    /// D and dD/dλ: a force e^{λt} divided by D is the displacement.
    pub(super) fn response(&self, lambda: Complex64) -> Jet {
        let (t, (value, derivative)) = self.at(lambda);
        let below = t.unit.0 + t.height.0 * self.limit();
        let below_slope = t.unit.1 + t.height.1 * self.limit();
        let d = value / below;
        (d, (derivative - d * below_slope) / below / self.speed)
    }

    /// The coefficients of 1, A and A² in N times the unit.
    pub(super) fn by_density(&self, lambda: Complex64) -> [Complex64; 3] {
        self.expanded(lambda, &self.footprint.at(lambda + self.fading))
    }

    /// As [`Law::by_density`], with given transforms.
    pub(super) fn expanded(&self, lambda: Complex64, t: &Transforms) -> [Complex64; 3] {
        let bare = self.bare(lambda).0;
        let Steady { height, curvature, .. } = self.steady;
        let first = t.curvature.0 - t.unit.0 * curvature + bare * t.height.0 * self.inverse_limit;
        let second = t.slope.0 * (self.fading * height) - t.height.0 * curvature;
        [bare * t.unit.0, first, second * self.inverse_limit]
    }

    /// α = vA/w0 with w0 = e^{-A|φ(s)|/b}.
    pub(super) fn alpha(&self) -> f64 {
        let depth = self.density * self.steady.height * self.inverse_limit;
        self.speed * self.density * depth.abs().exp()
    }
}

/// Whether φ(s) is a height above round-off.
fn has_height(tip: &TipFunction, steady: &Steady) -> bool {
    let size = match tip {
        TipFunction::Gaussians(sum) => {
            sum.terms().iter().map(|g| g.amplitude.abs() * g.width).sum()
        }
        TipFunction::Bessel | TipFunction::Cosine => 1.0,
    };
    steady.height.abs() > NO_HEIGHT * size
}
