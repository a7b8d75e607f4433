//! The response during weak pulses, by the inverse Laplace transform.
//!
//! During a pulse the sum over modes converges slowly. But the transform of a Gaussian pulse falls like e^{-ω²W²/2},
//! so that the integral
//!
//! ```text
//!     l(t) - l0 = -1/(2π) ∫ F̃ext(σ + iω) e^{(σ + iω)t} / D(σ + iω) dω
//! ```
//!
//! on a line right of all roots has a short range, and the trapezoidal rule converges exponentially. In the basic model
//! D(λ) = h(λ/r) of (30). With a step of 2π/P the error of the rule is the response at t + nP times e^{-σnP}, summed
//! over n ≥ 1; the truncation of the range is negligible.

use num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use stickslip_tip::Pulse;

/// The response during weak pulses, as an integral over a line of λ: nodes, and the integrand without its factor e^{λt}.
#[derive(Debug, Clone)]
pub struct Inversion {
    nodes: Vec<(Complex64, Complex64)>,
}

/// e^{-8.5²/2} = 2e-16: number of inverse widths beyond which the transform of a pulse is negligible.
const INVERSE_WIDTHS: f64 = 8.5;
/// σP: the response a period P later is added with the factor e^{-26} = 5e-12.
const DECAYED: f64 = 26.0;
/// P in units of the window of times, at whose end rounding errors are amplified by e^{σP/2} = e^{13}.
const PERIODS: f64 = 2.0;
/// Number of widths before its center at which a pulse begins.
const WIDTHS_OF_PULSE: f64 = 8.5;
const MOST_NODES: f64 = 100_000.0;

impl Inversion {
    /// The inversion for times up to `until`, for this D and these pulses, if D has no zero right of `rightmost`.
    /// `None` if there are no pulses, or if they are too short compared with `until`.
    pub(super) fn new(
        characteristic: impl Fn(Complex64) -> Complex64,
        pulses: &[Pulse],
        rightmost: f64,
        until: f64,
    ) -> Option<Self> {
        let begins = pulses.iter().map(|p| p.time - WIDTHS_OF_PULSE * p.width);
        let begins = begins.reduce(f64::min)?;
        let shortest = pulses.iter().map(|p| p.width).reduce(f64::min)?;
        let longest = pulses.iter().map(|p| p.width).fold(0.0, f64::max);
        let window = (until - begins).max(longest);
        let period = PERIODS * window;
        let sigma = rightmost.max(0.0) + DECAYED / period;
        let step = TAU / period;
        let count = (INVERSE_WIDTHS / shortest / step).ceil();
        if !(count.is_finite() && count <= MOST_NODES) || sigma * longest > 3.0 {
            return None;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let nodes = (0..=count as u32).map(|i| {
            let lambda = Complex64::new(sigma, step * f64::from(i));
            let force: Complex64 = pulses.iter().map(|p| transform(p, lambda)).sum();
            // ω and -ω together, and ω = 0 once.
            let weight = if i == 0 { 0.5 } else { 1.0 } * step / PI;
            (lambda, -force * weight / characteristic(lambda))
        });
        Some(Self { nodes: nodes.collect() })
    }

    /// l(t) - l0.
    pub fn at(&self, t: f64) -> f64 {
        self.nodes.iter().map(|(lambda, value)| ((lambda * t).exp() * value).re).sum()
    }
}

/// F̃ext(λ) = ∫ Fext e^{-λt}dt = A W √(2π) exp(λ²W²/2 - λT).
pub(super) fn transform(pulse: &Pulse, lambda: Complex64) -> Complex64 {
    let exponent = lambda * (lambda * (0.5 * pulse.width * pulse.width) - pulse.time);
    exponent.exp() * (pulse.amplitude * pulse.width * (2.0 * PI).sqrt())
}
