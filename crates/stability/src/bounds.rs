//! Regions without zeros of N (see [`Law`]): the transforms at p = Λ + s are bounded and decrease with |p|, while
//! Mv²Λ² + vΛ + κ grows with |Λ| (for creep it is κ).

use super::extent::Extent;
use super::kept::Kept;
use super::law::Law;
use super::one_sided::OneSided;
use num_complex::Complex64;
use std::f64::consts::PI;
use std::sync::Arc;
use stickslip_tip::{Gaussian, TipFunction};

/// Number of samples of f over its reach, from which its integrals are bounded.
const SAMPLES: u32 = 1000;
/// Safety factor between sums over the samples and the bounds.
const MARGIN: f64 = 1.1;
/// Factor between successive distances in the search for a bound.
const STEP: f64 = 1.1;
/// Largest distance in the search for a bound.
const FARTHEST: f64 = 1e12;
/// For |p| ≥ 2 the transforms of J0 (Re p ≥ 0) and cos x are below this number divided by |p|.
const WAVES: f64 = 4.0 / 3.0;

/// Bounds of the transforms φ, φ1, G, in this order, of both f(x) and f(-x): for Re p ≥ 0 the modulus of each is at most
/// `area` and at most `decay`/|p|.
#[derive(Debug, Clone)]
pub(super) struct Bounds {
    area: [f64; 3],
    decay: [f64; 3],
    /// Power of p in the exponential term of each transform for Re p < 0: 0, 1, 2.
    powers: [i32; 3],
    /// |p| above which these bounds hold.
    from: f64,
    /// (a w √(2π), |c|, w) of each Gaussian: for Re p < 0 the exponential term E(p) = φ(p) + φ(-p) decreases as
    /// e^{w²((Re p)²-(Im p)²)/2}.
    terms: Vec<(f64, f64, f64)>,
}

impl Bounds {
    /// The bounds for this footprint, from the cache if they are recent.
    pub(super) fn of(footprint: &OneSided) -> Arc<Self> {
        static ALONG: Kept<Bounds> = Kept::new();
        static ACROSS: Kept<Bounds> = Kept::new();
        let kept = if footprint.is_across { &ACROSS } else { &ALONG };
        kept.of(footprint.tip(), || Self::new(footprint))
    }

    fn new(footprint: &OneSided) -> Self {
        let tip = footprint.tip();
        let mut powers = [0, 1, 2];
        let TipFunction::Gaussians(sum) = tip else {
            let (area, decay) = ([f64::INFINITY; 3], [WAVES; 3]);
            return Self { area, decay, powers, from: 2.0, terms: vec![] };
        };
        let samples = f64::from(SAMPLES).max(tip.reach().unwrap_or(1.0) * tip.band()).min(1e5);
        let summed = |tip| Extent::summed(tip, samples, true, |_| 1.0);
        let Extent { mut area, mut decay, .. } = summed(tip);
        if !tip.is_even() {
            let other = summed(&tip.mirrored());
            area = [0, 1, 2].map(|i: usize| area[i].max(other.area[i]));
            decay = [0, 1, 2].map(|i: usize| decay[i].max(other.decay[i]));
        }
        let term = |g: &Gaussian| {
            (g.amplitude.abs() * g.width * (2.0 * PI).sqrt(), g.center.abs(), g.width)
        };
        let terms = sum.terms().iter().map(term).collect();
        if footprint.is_across {
            (area[2], decay[2], powers[2]) = (area[0], decay[0], powers[0]);
        }
        let [area, decay] = [area, decay].map(|all| all.map(|f| MARGIN * f));
        Self { area, decay, powers, from: 0.0, terms }
    }

    /// Bounds of φ, φ1, G for |p| ≥ `distance`, Re p ≥ 0.
    fn right(&self, distance: f64) -> [f64; 3] {
        [0, 1, 2].map(|i: usize| self.area[i].min(self.decay[i] / distance))
    }

    /// Bounds of φ, φ1, G for Re p ≥ `left`, |Im p| ≥ `top`: for Re p < 0 φ = E(p) - φ(-p), φ1 = pE + φ1(-p) and
    /// G = p²E - G(-p), where the transforms at -p are those of f(-x).
    fn left(&self, left: f64, top: f64) -> [f64; 3] {
        let mut bounds = self.right(top);
        if left >= 0.0 {
            return bounds;
        }
        let two_sided = |(area, c, w): &(f64, f64, f64)| {
            area * (0.5 * w * w * (left * left - top * top) + c * left.abs()).exp()
        };
        let e: f64 = self.terms.iter().map(two_sided).sum();
        let distance = left.hypot(top);
        for (bound, power) in bounds.iter_mut().zip(self.powers) {
            *bound += e * distance.powi(power);
        }
        bounds
    }

    /// The |Im p| beyond which the bounds of [`Self::left`] decrease with Im p.
    fn fading_from(&self) -> f64 {
        let narrowest = self.terms.iter().map(|t| t.2).fold(f64::INFINITY, f64::min);
        (2.0_f64.sqrt() / narrowest).max(self.from)
    }

    /// ∫|f''|; 1 for J0 and cos x, for which it is infinite.
    pub(super) fn curvature(&self) -> f64 {
        if self.area[2].is_finite() { self.area[2] } else { 1.0 }
    }

    /// |Λ| beyond which N has no zero with Re Λ ≥ 0.
    pub(super) fn right_bound(&self, law: &Law) -> f64 {
        let far =
            |distance: f64| outweighs(law, bare_on_the_right(law, distance), self.right(distance));
        first(far, self.from.max(1e-9 / self.unit_length(law)))
    }

    /// |Im Λ| above which N has no zero with Re Λ ≥ `left`; at least `least`.
    pub(super) fn top_bound(&self, law: &Law, left: f64, least: f64) -> f64 {
        let past = left + law.fading;
        let zeros = bare_zeros(law);
        let far =
            |top: f64| outweighs(law, bare_above(law, &zeros, left, top), self.left(past, top));
        first(far, least.max(if past < 0.0 { self.fading_from() } else { self.from }))
    }

    fn unit_length(&self, law: &Law) -> f64 {
        law.footprint.tip().reach().unwrap_or(1.0)
    }
}

/// Lower bound of |Mv²Λ² + vΛ + κ| for |Λ| ≥ `distance`, Re Λ ≥ 0: the real part of Mv²Λ + v + κ/Λ is at least v.
/// Without drag only κ remains.
fn bare_on_the_right(law: &Law, distance: f64) -> f64 {
    if law.drag <= 0.0 {
        return law.spring;
    }
    let inertial = law.inertia * distance * distance - law.drag * distance - law.spring;
    inertial.max(law.drag * distance)
}

/// Lower bound of |Mv²Λ² + vΛ + κ| for Re Λ ≥ `left`, |Im Λ| ≥ `top`: the larger of two bounds. One is that of the
/// imaginary part, v|Im Λ| |1 + 2Mv Re Λ|; the other, with inertia, is Mv² times the distances from the two zeros.
fn bare_above(law: &Law, zeros: &[Complex64], left: f64, top: f64) -> f64 {
    if law.drag <= 0.0 {
        return law.spring;
    }
    let imaginary = 1.0 - 2.0 * law.inertia / law.drag * (-left).max(0.0);
    let apart = zeros.iter().map(|zero| (top - zero.im.abs()).max(0.0)).product::<f64>();
    (law.drag * top * imaginary).max(law.inertia * apart)
}

/// The zeros of Mv²Λ² + vΛ + κ, if there are two.
pub(super) fn bare_zeros(law: &Law) -> Vec<Complex64> {
    if law.inertia <= 0.0 {
        return vec![];
    }
    quadratic(law.inertia, law.drag, law.spring)
}

/// Zeros of az² + bz + c, b > 0, without cancellation.
pub(super) fn quadratic(a: f64, b: f64, c: f64) -> Vec<Complex64> {
    let root = Complex64::new(b * b - 4.0 * a * c, 0.0).sqrt();
    let far = (root + b) / (-2.0 * a);
    let near = (root + b).inv() * (-2.0 * c);
    vec![far, near]
}

/// Whether |(Mv²Λ² + vΛ + κ)(1 + Bφ)|, with the first factor at least `bare`, exceeds the remaining terms of N.
fn outweighs(law: &Law, bare: f64, [height, slope, curvature]: [f64; 3]) -> bool {
    let (a, b) = (law.density.abs(), law.limit().abs());
    let still = law.steady.curvature.abs();
    let raised = b * (still * height + law.fading * law.steady.height.abs() * slope);
    bare * (1.0 - b * height) > a * (curvature + still + raised)
}

/// The first product of `least` and a power of [`STEP`] for which `holds` is true.
fn first(holds: impl Fn(f64) -> bool, least: f64) -> f64 {
    let mut at = least;
    while !holds(at) && at < FARTHEST {
        at *= STEP;
    }
    at
}
