//! Linear response to a weak pulse: the residue sum (A.9).

use super::characteristic::Characteristic;
use super::inversion::transform;
use super::scaled_erfc::scaled_erfc;
use super::{Inversion, Spectrum, StabilityError, leading_roots};
use num_complex::Complex64;
use std::f64::consts::{PI, SQRT_2};
use stickslip_tip::{Model, Pulse};

/// One term of (A.9) for one pulse: `residue` e^{λt} once the pulse is over.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ResponseMode {
    /// The growth exponent λ, in k/Γ.
    pub lambda: Complex64,
    /// The residue -F̃ext(λ)/D'(λ), where F̃ext(λ) = ∫ Fext e^{-λt}dt and, in the basic model, D(λ) = h(λ/r) of (30).
    pub residue: Complex64,
}

/// l(t) - l0 of a tip in steady motion after weak pulses, to first order in the pulses.
#[derive(Debug, Clone, PartialEq)]
pub struct Response {
    /// The modes, by falling Re λ.
    pub modes: Vec<ResponseMode>,
    /// The exponents of the modes, with the certificate that no root right of the last one is missing.
    pub spectrum: Spectrum,
    pulses: Vec<Pulse>,
    /// -1/D'(λ) of each mode.
    weights: Vec<Complex64>,
}

/// The response of steady motion to `pulses`, from at least `count` leading roots.
///
/// Faster modes are left out: the error decays like e^{Re λ t} of the first of them, so that the sum is soon accurate
/// after a pulse. The residues assume simple roots; double roots occur on curves in the (r, α) plane only. For J0 the
/// branch points ±ir add a term that decays like t^{-3/2}; it is not a mode and is left out.
///
/// # Errors
/// A pulse has a value that is not finite or a width ≤ 0; otherwise as [`super::roots`].
pub fn response(model: &Model, pulses: &[Pulse], count: usize) -> Result<Response, StabilityError> {
    for (i, p) in pulses.iter().enumerate() {
        if ![p.amplitude, p.time, p.width].iter().all(|v| v.is_finite()) || p.width <= 0.0 {
            return Err(StabilityError::Pulse { index: i + 1, width: p.width });
        }
    }
    let spectrum = leading_roots(model, count)?;
    let h = Characteristic::new(model)?;
    let weights: Vec<Complex64> = spectrum.roots.iter().map(|z| -h.response(*z).1.inv()).collect();
    let residue = |(lambda, weight): (&Complex64, &Complex64)| {
        let force: Complex64 = pulses.iter().map(|p| transform(p, *lambda)).sum();
        ResponseMode { lambda: *lambda, residue: force * weight }
    };
    let modes = spectrum.roots.iter().zip(&weights).map(residue).collect();
    Ok(Response { modes, spectrum, pulses: pulses.to_vec(), weights })
}

impl Response {
    /// l(t) - l0 at all times up to `until`, also during the pulses, with an error of 1e-9 relative to its largest value.
    /// `None` if the pulses are too short compared with `until`. `model` is that of the response.
    pub fn while_pulses_last(&self, model: &Model, until: f64) -> Option<Inversion> {
        let rightmost = self.modes.first().map_or(0.0, |mode| mode.lambda.re);
        let h = Characteristic::new(model).ok()?;
        Inversion::new(|z| h.response(z).0, &self.pulses, rightmost, until)
    }

    /// l(t) - l0 as a sum over modes, each convolved with the force up to t.
    ///
    /// Before a pulse it is 0, as it must be. During a pulse the missing modes cause errors of up to a quarter of the
    /// response; use [`while_pulses_last`](Self::while_pulses_last). At 3 time units after a pulse of width 0.5, ten
    /// modes have an error of 1e-8.
    pub fn at(&self, t: f64) -> f64 {
        let mode = |(mode, weight): (&ResponseMode, &Complex64)| {
            let driven: Complex64 = self.pulses.iter().map(|p| driven(p, mode.lambda, t)).sum();
            (driven * weight).re
        };
        self.modes.iter().zip(&self.weights).map(mode).sum()
    }
}

/// ∫_{-∞}^t Fext(t') e^{λ(t-t')}dt' = A W √(π/2) e^{-(t-T)²/2W²} erfcx(z), z = -(λW² + t - T)/(W√2).
fn driven(pulse: &Pulse, lambda: Complex64, t: f64) -> Complex64 {
    let since = t - pulse.time;
    let z = -(lambda * pulse.width + since / pulse.width) / SQRT_2;
    let size = pulse.amplitude * pulse.width * (PI / 2.0).sqrt();
    let force = (-0.5 * (since / pulse.width).powi(2)).exp();
    if z.re >= 0.0 {
        return scaled_erfc(z).0 * (size * force);
    }
    let exponent = lambda * (lambda * (0.5 * pulse.width * pulse.width) + since);
    (exponent.exp() * 2.0 - scaled_erfc(-z).0 * force) * size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mode_driven_by_a_pulse_is_the_integral_over_the_force_so_far() {
        let pulse = Pulse { amplitude: 0.3, time: 2.0, width: 0.5 };
        // Growing, decaying and fast modes; before, within and after the pulse.
        for lambda in [(0.05, 0.9), (-0.6, 0.0), (-3.2, 5.2), (-9.0, 11.0)] {
            let lambda = Complex64::new(lambda.0, lambda.1);
            for t in [0.5, 1.2, 1.7, 2.0, 2.4, 3.5, 6.0] {
                let found = driven(&pulse, lambda, t);
                let exact = by_simpson(&pulse, lambda, t);
                let scale = pulse.amplitude * pulse.width;
                assert!((found - exact).norm() < 1e-12 * scale, "{lambda} {t} {found} {exact}");
            }
        }
    }

    /// ∫ Fext(t') e^{λ(t-t')}dt' from nine widths before the pulse to t.
    fn by_simpson(pulse: &Pulse, lambda: Complex64, t: f64) -> Complex64 {
        let (start, panels) = (pulse.time - 9.0 * pulse.width, 20_000);
        let h = (t - start) / f64::from(panels);
        let term = |i: i32| {
            let at = start + h * f64::from(i);
            let force = pulse.amplitude * (-0.5 * ((at - pulse.time) / pulse.width).powi(2)).exp();
            let weight = match i {
                0 => 1.0,
                i if i == panels => 1.0,
                i if i % 2 == 1 => 4.0,
                _ => 2.0,
            };
            (lambda * (t - at)).exp() * (weight * force)
        };
        (0..=panels).map(term).sum::<Complex64>() * (h / 3.0)
    }
}
