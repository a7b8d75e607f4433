//! The response to weak pulses while they last, by the inverse Laplace transform.
//!
//! The sum over modes converges slowly there. But the transform of a Gaussian pulse falls like e^{-ω²W²/2}, so that
//!
//! ```text
//!     l(t) - l0 = -1/(2π) ∫ F̃ext(σ + iω) e^{(σ + iω)t} / D(σ + iω) dω,    D(λ) = λ + 1 - K̃(λ),
//! ```
//!
//! on a line right of all roots, has a short range, and the trapezoidal rule converges exponentially: with a step of
//! 2π/P it adds the response at t + nP times e^{-σnP}, n ≥ 1, and to both sides of the range nothing.

use super::pulse::transform;
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};
use stickslip_tip::Pulse;

/// Nodes on the line, with what the integrand is there but for e^{λt}.
#[derive(Debug, Clone)]
pub struct Inversion {
    nodes: Vec<(Complex64, Complex64)>,
}

/// e^{-8.5²/2} = 2e-16: beyond so many inverse widths the transform of a pulse is nothing.
const INVERSE_WIDTHS: f64 = 8.5;
/// What is added from a period P later is e^{-26} = 5e-12 of itself,
const DECAYED: f64 = 26.0;
/// and what rounding errors are magnified by e^{13} at the end of a window of P/2.
const PERIODS: f64 = 2.0;
/// So many widths after its center a pulse is over.
const WIDTHS_OF_PULSE: f64 = 8.5;
/// More nodes than this are not made.
const MOST_NODES: f64 = 100_000.0;

impl Inversion {
    /// For times up to `until`, D and the pulses given, D having no zero right of `rightmost`; `None` where the pulses
    /// are too short for so long a time, or there are none.
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
    #[must_use]
    pub fn at(&self, t: f64) -> f64 {
        self.nodes.iter().map(|(lambda, value)| ((lambda * t).exp() * value).re).sum()
    }
}
