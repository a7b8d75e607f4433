//! Trapping: the logarithmic creep of a tip that its own groove holds permanently.
//!
//! x0 ~ (1/p) ln t solves (10) to leading order in t if α/r = 1/Q(p),
//! Q(p) = p ∫_0^∞ e^{-ps}(-f'(s))ds = -G(p). `docs/explanation/trapping.md` derives it.

use super::StabilityError;
use super::one_sided::OneSided;
use num_complex::Complex64;
use stickslip_tip::TipFunction;
use stickslip_tip::roots::bisected;

/// Number of samples of ln p in the search for the largest Q.
const SAMPLES: u32 = 400;

/// Trapping threshold r/max_p Q(p), Q(p) = p ∫_0^∞ e^{-ps}(-f'(s))ds: the smallest α with a creep x0 ~ (1/p) ln t. For a
/// footprint with several peaks this creep need not be attracting: see [`super::Creep::attracting`].
///
/// # Errors
/// `r` is not a positive finite number, or Q is nowhere positive.
pub fn trapping_alpha(tip: &TipFunction, r: f64) -> Result<f64, StabilityError> {
    StabilityError::unless_positive(r)?;
    let (_, largest) = Push::new(tip).largest().ok_or(StabilityError::NoTrapping)?;
    Ok(r / largest)
}

struct Push {
    footprint: OneSided,
    slowest: f64,
    fastest: f64,
}

impl Push {
    fn new(tip: &TipFunction) -> Self {
        let reach = tip.reach().unwrap_or(10.0);
        Self { footprint: OneSided::new(tip), slowest: 1e-2 / reach, fastest: 10.0 * tip.band() }
    }

    /// Q and Q'.
    fn q(&self, p: f64) -> (f64, f64) {
        let (g, slope) = self.footprint.plain(Complex64::new(p, 0.0)).curvature;
        (-g.re, -slope.re)
    }

    /// p and Q at the highest maximum of Q, if that is positive.
    fn largest(&self) -> Option<(f64, f64)> {
        let ratio = (self.fastest / self.slowest).powf(1.0 / f64::from(SAMPLES));
        let sample = |i: u32| self.slowest * ratio.powi(i.cast_signed());
        let samples = (0..=SAMPLES).map(sample).map(|p| (p, self.q(p).0));
        let (highest, _) = samples.max_by(|a, b| a.1.total_cmp(&b.1))?;
        let rises = |p: f64| self.q(p).1 > 0.0;
        let is_narrow = |(low, high): (f64, f64)| high - low <= 4.0 * f64::EPSILON * high;
        let (p, _) = bisected((highest / ratio, highest * ratio), rises, is_narrow);
        let q = self.q(p).0;
        (q > 0.0).then_some((p, q))
    }
}
