//! Results for a footprint: width, onset, trapping threshold.

use super::search::Candidate;
use super::shape::value;
use stickslip_stability::{critical, trapping_alpha};
use stickslip_tip::roots::halved_between;
use stickslip_tip::{Gaussian, TipFunction, Wider};

/// Results for a footprint with f(0) = 1, in units of σ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Answers {
    /// σ, in the unit of the positions.
    pub(super) sigma: f64,
    /// αc(r), its ω, and the trapping threshold.
    pub(super) alpha: f64,
    pub(super) omega: f64,
    pub(super) trapping: f64,
}

/// Smallest f(0), relative to the largest |f|, that can normalise f.
const LEAST_APEX: f64 = 0.05;

/// The Gaussians in units of σ and f(0); σ; f(0).
pub(super) fn normalised(
    candidate: &Candidate,
    sigma: Option<f64>,
) -> Option<(Vec<Gaussian>, f64, f64)> {
    let terms = candidate.gaussians();
    let value = |x: f64| value(&terms, x);
    let reach = terms.iter().map(|g| g.center.abs() + 5.0 * g.width).fold(0.0, f64::max);
    let samples = (0..=SAMPLES).map(|i| reach * f64::from(i) / f64::from(SAMPLES));
    let largest = samples.clone().map(|x| value(x).abs()).fold(0.0, f64::max);
    let apex = value(0.0);
    if apex.abs() < LEAST_APEX * largest || !apex.is_finite() {
        return None;
    }
    let sigma = match sigma {
        Some(sigma) => sigma,
        None => half_width(&value, apex, samples)? / (2.0 * std::f64::consts::LN_2).sqrt(),
    };
    let scaled = terms.iter().map(|g| Gaussian {
        amplitude: g.amplitude / apex,
        center: g.center / sigma,
        width: g.width / sigma,
    });
    Some((scaled.collect(), sigma, apex))
}

/// Number of samples from the apex outwards.
const SAMPLES: u32 = 2000;

/// The distance at which f first falls to half of f(0).
fn half_width(
    value: &impl Fn(f64) -> f64,
    apex: f64,
    mut samples: impl Iterator<Item = f64>,
) -> Option<f64> {
    let above = |x: f64| value(x) / apex - 0.5;
    let mut last = 0.0;
    let (low, high) = samples.find_map(|x| {
        let found = (above(x) <= 0.0).then_some((last, x));
        last = x;
        found
    })?;
    Some(halved_between(above, low, high))
}

impl Answers {
    /// σ, αc, ω and trapping threshold.
    pub(super) fn each(&self) -> [f64; 4] {
        [self.sigma, self.alpha, self.omega, self.trapping]
    }

    /// Absolute differences of the logarithms.
    pub(super) fn changes(&self, other: &Self) -> [f64; 4] {
        let (mine, others) = (self.each(), other.each());
        std::array::from_fn(|i| (mine[i] / others[i]).ln().abs())
    }

    /// The results; `None` if the sum has no apex, or no onset.
    pub(super) fn of(candidate: &Candidate, sigma: Option<f64>, r: f64) -> Option<Self> {
        let (terms, sigma, _) = normalised(candidate, sigma)?;
        let tip = TipFunction::gaussian_sum(terms).ok()?;
        let at = critical(&Wider::default(), &tip, r).ok()?;
        let trapping = trapping_alpha(&tip, r).unwrap_or(f64::NAN);
        Some(Self { sigma, alpha: at.alpha, omega: at.omega, trapping })
    }
}
