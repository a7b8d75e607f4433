//! ∫_0^∞ f(x+y) e^{-sy}dy for s > 0: the groove of steady motion over a surface that heals.

use super::Gaussian;
use crate::elementary::{cos, exp, sin};
use crate::error_function::erfcx;
use gauss_quad::legendre::GaussLegendre;
use std::f64::consts::{FRAC_1_SQRT_2, PI};
use std::num::NonZeroUsize;
use std::sync::LazyLock;

/// The integral for one Gaussian: a w √(π/2) e^{-z²/2} erfcx((z+p)/√2) with z = (x-c)/w and p = sw.
pub(super) fn gaussian(g: &Gaussian, x: f64, s: f64) -> f64 {
    let (z, p) = ((x - g.center) / g.width, s * g.width);
    let scale = g.amplitude * g.width * (PI / 2.0).sqrt();
    let argument = (z + p) * FRAC_1_SQRT_2;
    if argument >= 0.0 {
        scale * exp(-0.5 * z * z) * erfcx(argument.into()).re
    } else {
        scale * exp(p * (z + 0.5 * p)) * libm::erfc(argument)
    }
}

/// For s above this a few hundred points resolve the integrand of the mean over wave numbers.
const FAST: f64 = 0.1;
/// Largest exponent s x of the factor e^{sx}, which amplifies the error of the difference that it multiplies.
const MOST_GROWTH: f64 = 2.0;

/// The integral for J0. J0 is the mean of cos(x sin θ) over θ, so that the integral is the mean of Re e^{ikx}/(s - ik),
/// k = sin θ. The trapezoidal rule converges geometrically, but slowly if the poles at sin θ = ±is are close. For small
/// s the integral follows by quadrature from its value 1/√(1+s²) at x = 0, the Laplace transform of J0.
pub(super) fn bessel(x: f64, s: f64) -> f64 {
    if s < FAST && s * x < MOST_GROWTH {
        let from_zero = integral(x, WAVE, |y| libm::j0(y) * exp(-s * y));
        return exp(s * x) * ((1.0 + s * s).sqrt().recip() - from_zero);
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let points = (40.0 / libm::asinh(s) + 2.0 * x.abs() + 60.0).min(1e8) as usize;
    let wave = |i: usize| {
        let k = sin(2.0 * PI * (i as f64 + 0.5) / points as f64);
        (s * cos(k * x) - k * sin(k * x)) / (s * s + k * k)
    };
    (0..points).map(wave).sum::<f64>() / points as f64
}

/// Half a wave of J0.
const WAVE: f64 = 3.0;

/// ∫_0^x g, for a g that is smooth over `length`.
fn integral(x: f64, length: f64, g: impl Fn(f64) -> f64) -> f64 {
    static GAUSS: LazyLock<GaussLegendre> =
        LazyLock::new(|| GaussLegendre::new(const { NonZeroUsize::new(16).unwrap() }));
    let panels = (x.abs() / length).ceil().max(1.0);
    let half = 0.5 * x / panels;
    let panel = |n: f64| {
        let nodes = GAUSS.as_node_weight_pairs().iter();
        nodes.map(|(node, weight)| weight * g((2.0 * n + 1.0 + node) * half)).sum::<f64>() * half
    };
    let numbers = std::iter::successors(Some(0.0), |n| Some(n + 1.0));
    numbers.take_while(|n| *n < panels).map(panel).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TipFunction;

    /// Against quadrature of the definition, out to where e^{-sy} is 1e-16; the fading profile obeys
    /// φ' = sφ - f besides.
    #[test]
    fn fading_tails_are_the_integral_that_they_stand_for() {
        let tips = [
            TipFunction::triple_gaussian(1.0, 1.0).unwrap(),
            TipFunction::gaussian(0.3).unwrap(),
            TipFunction::Bessel,
            TipFunction::Cosine,
        ];
        for tip in tips {
            for s in [0.05, 0.3, 1.0, 7.0] {
                for x in [-30.0, -3.0, -0.4, 0.0, 1.1, 6.0, 25.0] {
                    let sum = integral(37.0 / s, 0.5, |y| tip.value(x + y) * (-s * y).exp());
                    let told = tip.fading_tail(x, s);
                    assert!((told - sum).abs() < 2e-12, "{tip:?} {s} {x}: {told} {sum}");
                }
            }
        }
    }

    #[test]
    fn without_fading_it_is_the_tail() {
        for tip in [TipFunction::triple_gaussian(0.4, 1.0).unwrap(), TipFunction::Bessel] {
            for x in [-5.0, 0.0, 2.0] {
                let (fading, tail) = (tip.fading_tail(x, 1e-9), tip.tail(x));
                assert!((fading - tail).abs() < 1e-7, "{tip:?} {x}: {fading} {tail}");
            }
        }
    }
}
