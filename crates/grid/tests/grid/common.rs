//! The main case, and short names.

use stickslip_grid::{
    Footprint, Gaussian, GridError, Method, Problem, Request, Run, Start, Stepping, solve,
};

/// (48) at β = 1, in its own words rather than through a list of Gaussians.
pub(crate) fn triple_gaussian(x: f64) -> f64 {
    let bell = |x: f64| (-0.5 * x * x).exp();
    bell(x) - 0.5 * (bell(x + 2.0) + bell(x - 2.0))
}

/// 8.8 widths beyond the lobes.
pub(crate) const REACH: f64 = 10.8;

/// αc at β = 1, r = 1, and the frequency there (30-digit arithmetic, rounded).
pub(crate) const CRITICAL_ALPHA: f64 = 1.069_036_174_947;
pub(crate) const CRITICAL_OMEGA: f64 = 0.942_779_021_257;

/// The spacing at which the lattice of Gaussians is exact to round-off.
pub(crate) const FINE: f64 = std::f64::consts::PI / 8.7;

pub(crate) fn terms(terms: &[(f64, f64, f64)]) -> Vec<Gaussian> {
    let gaussian = |&(amplitude, center, width)| Gaussian { amplitude, center, width };
    terms.iter().map(gaussian).collect()
}

/// The triple Gaussian's lattice.
pub(crate) fn spectral(spacing: f64) -> Method {
    let gaussians = terms(&[(1.0, 0.0, 1.0), (-0.5, 2.0, 1.0), (-0.5, -2.0, 1.0)]);
    Method::Spectral { gaussians, spacing }
}

/// Triple Gaussian β = 1, r = 1, steady start at 14 less a kick of 0.05.
pub(crate) struct Kicked {
    pub(crate) alpha: f64,
    pub(crate) kick: f64,
    /// Time units after the start.
    pub(crate) span: f64,
    pub(crate) samples: usize,
}

/// α = 1.2: stick-slip that grows out of the kick.
pub(crate) fn main_case(span: f64) -> Kicked {
    Kicked { alpha: 1.2, kick: 0.05, span, samples: 20 }
}

impl Kicked {
    pub(crate) fn run(&self, method: &Method, stepping: &Stepping) -> Result<Run, GridError> {
        let footprint = Footprint::new(&triple_gaussian, REACH)?;
        let start = Start::steady(self.alpha, 1.0, footprint, 14.0, self.kick);
        let (times, points) = self.request(start.time);
        let problem = Problem::new(self.alpha, 1.0, footprint, start)?;
        solve(&problem, method, stepping, &Request { times: &times, points: &points })
    }

    /// Times and points of a run that starts at this time.
    pub(crate) fn request(&self, start: f64) -> (Vec<f64>, Vec<f64>) {
        let sample = |k: usize| start + self.span * k as f64 / self.samples as f64;
        let times = (1..=self.samples).map(sample).collect();
        (times, (0..60).map(|k| 10.0 + 0.7 * f64::from(k)).collect())
    }
}

/// max |a - b|
pub(crate) fn distance(a: &[f64], b: &[f64]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// log2 of the ratios of successive errors.
pub(crate) fn observed_orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}
