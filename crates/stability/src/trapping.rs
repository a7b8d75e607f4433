//! Trapping: the logarithmic creep of a tip that the groove it digs holds for ever.
//!
//! x0 ~ (1/p) ln t solves (10) to leading order in t if α/r = 1/Q(p),
//! Q(p) = p ∫_0^∞ e^{-ps}(-f'(s))ds = -G(p). `docs/stability.md` derives it.

use super::StabilityError;
use super::transform::CurvatureTransform;
use num_complex::Complex64;
use stickslip_tip::{Model, TipFunction};

/// Samples of ln p in the search for the largest Q.
const SAMPLES: u32 = 400;

/// The smallest α at which the tip can be trapped: r / max_p Q(p).
///
/// # Errors
/// `r` not a positive finite number, or Q nowhere positive.
pub fn trapping_alpha(tip: &TipFunction, r: f64) -> Result<f64, StabilityError> {
    if !(r.is_finite() && r > 0.0) {
        return Err(StabilityError::R(r));
    }
    let (_, largest) = Creep::new(tip).largest().ok_or(StabilityError::NoTrapping)?;
    Ok(r / largest)
}

/// The two p, ascending, with which x0 ~ (1/p) ln t solves (10) for large t; `None` below the threshold
/// [`trapping_alpha`].
///
/// Of the two, the larger p (the slower creep) is the one that attracts. Where Q has several maxima
/// these are the two around the highest.
#[must_use]
pub fn creep_rates(model: &Model) -> Option<(f64, f64)> {
    let creep = Creep::new(model.tip());
    let (p, largest) = creep.largest()?;
    if model.alpha() * largest < model.r() {
        return None;
    }
    let wanted = model.r() / model.alpha();
    // Q ≤ p f(0)-like for small p and falls like 1/p for large p: doubling finds the far sides.
    let below = creep.first_below(wanted, p, 0.5)?;
    let above = creep.first_below(wanted, p, 2.0)?;
    Some((creep.level(wanted, below, p), creep.level(wanted, above, p)))
}

struct Creep {
    transform: CurvatureTransform,
    slowest: f64,
    fastest: f64,
}

impl Creep {
    fn new(tip: &TipFunction) -> Self {
        let reach = tip.reach().unwrap_or(10.0);
        let transform = CurvatureTransform::new(tip);
        Self { transform, slowest: 1e-2 / reach, fastest: 10.0 * tip.band() }
    }

    /// Q and Q'.
    fn q(&self, p: f64) -> (f64, f64) {
        let g = self.transform.at(Complex64::new(p, 0.0));
        (-g.value.re, -g.derivative.re)
    }

    /// p and Q at the highest maximum, if that is positive.
    fn largest(&self) -> Option<(f64, f64)> {
        let ratio = (self.fastest / self.slowest).powf(1.0 / f64::from(SAMPLES));
        let sample = |i: u32| self.slowest * ratio.powi(i.cast_signed());
        let highest =
            (0..=SAMPLES).map(sample).max_by(|a, b| self.q(*a).0.total_cmp(&self.q(*b).0))?;
        let (mut lo, mut hi) = (highest / ratio, highest * ratio);
        while hi - lo > 4.0 * f64::EPSILON * hi {
            let middle = 0.5 * (lo + hi);
            if middle <= lo || middle >= hi {
                break;
            }
            if self.q(middle).1 > 0.0 { lo = middle } else { hi = middle }
        }
        let q = self.q(lo).0;
        (q > 0.0).then_some((lo, q))
    }

    /// The first p·factorⁿ at which Q is below `wanted`.
    fn first_below(&self, wanted: f64, p: f64, factor: f64) -> Option<f64> {
        (1..2000).map(|n| p * factor.powi(n)).find(|p| self.q(*p).0 < wanted)
    }

    /// The p between `below` and `above` at which Q = `wanted`, by bisection to round-off.
    fn level(&self, wanted: f64, below: f64, above: f64) -> f64 {
        let (mut below, mut above) = (below, above);
        for _ in 0..200 {
            let middle = 0.5 * (below + above);
            if (middle - below).abs() <= f64::EPSILON * middle {
                break;
            }
            if self.q(middle).0 < wanted { below = middle } else { above = middle }
        }
        0.5 * (below + above)
    }
}
