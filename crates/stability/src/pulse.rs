//! Laplace transform of a pulse.

use num_complex::Complex64;
use std::f64::consts::PI;
use stickslip_tip::Pulse;

/// F̃ext(λ) = ∫ Fext e^{-λt}dt = A W √(2π) exp(λ²W²/2 - λT).
pub(super) fn transform(pulse: &Pulse, lambda: Complex64) -> Complex64 {
    let exponent = lambda * (lambda * (0.5 * pulse.width * pulse.width) - pulse.time);
    exponent.exp() * (pulse.amplitude * pulse.width * (2.0 * PI).sqrt())
}
