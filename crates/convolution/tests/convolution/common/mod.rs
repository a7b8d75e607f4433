//! Kernels with their derivatives, random sources, and the one acceptance rule.
#![allow(dead_code, reason = "each test binary uses a part")]

use chacha20::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use stickslip_convolution::Kernel;

/// Accepted error of a sum over `Σ|w| max|K|`, and of its derivative over `Σ|w| max|K'|`.
pub(crate) const TOLERANCE: f64 = 2e-14;

/// A kernel and its derivative, scaled to a width.
#[derive(Clone, Copy)]
pub(crate) struct Case {
    pub(crate) name: &'static str,
    pub(crate) kernel: fn(f64) -> f64,
    pub(crate) derivative: fn(f64) -> f64,
    /// Of width one.
    pub(crate) band: f64,
    pub(crate) reach: Option<f64>,
    pub(crate) width: f64,
}

impl Case {
    pub(crate) fn value(self) -> impl Fn(f64) -> f64 + Sync {
        move |x| (self.kernel)(x / self.width)
    }

    pub(crate) fn slope(self) -> impl Fn(f64) -> f64 + Sync {
        move |x| (self.derivative)(x / self.width) / self.width
    }

    /// `value` with the band and reach of this case.
    pub(crate) fn with<'a>(&self, value: &'a (dyn Fn(f64) -> f64 + Sync)) -> Kernel<'a> {
        let reach = self.reach.map(|r| r * self.width);
        Kernel { value, band: self.band / self.width, reach }
    }

    pub(crate) fn of_width(self, width: f64) -> Self {
        Self { width, ..self }
    }
}

const fn case(name: &'static str, kernel: fn(f64) -> f64, derivative: fn(f64) -> f64) -> Case {
    Case { name, kernel, derivative, band: 8.7, reach: Some(10.6), width: 1.0 }
}

fn gauss(x: f64) -> f64 {
    (-x * x / 2.0).exp()
}

fn gauss1(x: f64) -> f64 {
    -x * gauss(x)
}

fn gauss2(x: f64) -> f64 {
    (x * x - 1.0) * gauss(x)
}

/// `g(x) − ½ (g(x + 2) + g(x − 2))`.
fn triple(g: fn(f64) -> f64, x: f64) -> f64 {
    g(x) - 0.5 * (g(x + 2.0) + g(x - 2.0))
}

pub(crate) const GAUSS_SLOPE: Case = case("Gaussian slope", gauss1, gauss2);
pub(crate) const TRIPLE: Case = case("triple", |x| triple(gauss, x), |x| triple(gauss1, x));
pub(crate) const TRIPLE_SLOPE: Case =
    case("triple slope", |x| triple(gauss1, x), |x| triple(gauss2, x));
pub(crate) const J0: Case =
    Case { band: 1.0, reach: None, ..case("J0", libm::j0, |x| -libm::j1(x)) };
pub(crate) const J1: Case = Case {
    band: 1.0,
    reach: None,
    ..case("J1", libm::j1, |x| 0.5 * (libm::j0(x) - libm::jn(2, x)))
};

/// `count` numbers, uniform in [low, high), the same for the same seed.
pub(crate) fn uniform(seed: u64, count: usize, low: f64, high: f64) -> Vec<f64> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    (0..count).map(|_| rng.random_range(low..high)).collect()
}

/// The largest magnitude of a kernel, on a grid fine enough for two digits.
pub(crate) fn peak(kernel: impl Fn(f64) -> f64, width: f64) -> f64 {
    (-2000..=2000).map(|i| kernel(0.005 * f64::from(i) * width).abs()).fold(0.0, f64::max)
}

pub(crate) fn magnitude(weights: &[f64]) -> f64 {
    weights.iter().map(|w| w.abs()).sum()
}

/// The largest difference over `scale`.
pub(crate) fn worst(found: &[f64], expected: &[f64], scale: f64) -> f64 {
    assert_eq!(found.len(), expected.len());
    found.iter().zip(expected).map(|(f, e)| (f - e).abs()).fold(0.0, f64::max) / scale
}

/// Asserts `error ≤ tolerance` and prints how many times better it was.
pub(crate) fn accept(what: &str, error: f64, tolerance: f64) {
    println!("{what}: {error:.1e}, {:.0} times below {tolerance:.0e}", tolerance / error);
    assert!(error <= tolerance, "{what}: {error:e} above {tolerance:e}");
}
