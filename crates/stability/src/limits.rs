//! The depth limit, and the memory length, below which steady motion is always stable.

use super::StabilityError;
use super::crossings::{Scan, beside_resonance, least, wave_numbers};
use super::law::Law;
use super::one_sided::Transforms;
use num_complex::Complex64;
use stickslip_tip::roots::halved_between;
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::{TipFunction, Wider};

/// First value of s = 1/(rT) in the search for the memory length, in units of the bandwidth of f.
const BANDS: f64 = 10.0;
/// Factor between successive values of s in this search.
const FACTOR: f64 = 1.05;
/// Last value of s in this search, as a fraction of the first.
const LEAST: f64 = 1e-6;

/// b_c(r): the depth limit b below which no α makes steady motion unstable, with the healing and the inertia of
/// `wider`.
///
/// On the axis Λ = iΩ the characteristic equation is linear in 1/b. Each Ω therefore determines the A = αw0/r at which
/// 1/b is real, and this 1/b. b_c is the inverse of the largest 1/b > 0 with A > 0, reached as A → ∞ or at a finite A.
/// As A → 0 and b → 0 with B = ±A/b fixed, the equation becomes 1 + Bφ = 0, φ = ∫_0^∞ f e^{-(iΩ+s)y}dy, s = 1/(rT): if it
/// has a solution for some B, 1/b is not bounded.
///
/// # Errors
/// As [`super::critical`]; [`StabilityError::Corner`]; [`StabilityError::NoCrossing`] if steady motion is stable at
/// every b; [`StabilityError::NoLimit`] if it is unstable at some α for every b, and for cos x.
pub fn least_depth_limit(wider: &Wider, tip: &TipFunction, r: f64) -> Result<f64, StabilityError> {
    least_on(&Scan::new(wider, tip), wider, r)
}

/// b_c(r) from a given scan of the imaginary axis.
pub(super) fn least_on(scan: &Scan, wider: &Wider, r: f64) -> Result<f64, StabilityError> {
    let tip = scan.tip();
    StabilityError::unless_positive(r)?;
    if !wider.spring {
        return Err(StabilityError::NoSupport);
    }
    if *tip == TipFunction::Cosine {
        return Err(StabilityError::NoLimit("the tip cosine cannot be under a depth limit"));
    }
    let limited = Wider { depth_limit: Some(1.0), ..*wider };
    limited.validate()?;
    let law = scan.law_under(&limited, r);
    if Law::has_corner(&limited, tip, &law.steady) {
        return Err(StabilityError::Corner);
    }
    if unstable_at_any_limit(scan, &law) {
        return Err(StabilityError::NoLimit(
            "steady motion is unstable at some alpha under every depth limit",
        ));
    }
    let at = |(q, kept): (f64, Option<&Transforms>)| {
        (q, kept.map_or_else(|| inverse_limit(&law, q), |t| inverse_limit_with(&law, q, t)))
    };
    let mut known: Vec<(f64, f64)> = scan.samples().map(at).collect();
    known.extend(beside_resonance(&law).into_iter().map(|q| (q, inverse_limit(&law, q))));
    sort_by_number(&mut known, |item| item.0);
    let (samples, values): (Vec<f64>, Vec<f64>) = known.into_iter().unzip();
    let mut largest = f64::NEG_INFINITY;
    for (q, value) in samples.windows(3).zip(values.windows(3)) {
        largest = largest.max(value[1]);
        if value[1].is_finite() && value[1] >= value[0].max(value[2]) {
            let at = least(|q| -inverse_limit(&law, q), q[0], q[2]);
            largest = largest.max(inverse_limit(&law, at));
        }
        // Where it ends, A → ∞.
        if value[1].is_finite() != value[2].is_finite() {
            let is_real = |q: f64| if inverse_limit(&law, q).is_finite() { 1.0 } else { -1.0 };
            let end = halved_between(is_real, q[1], q[2]);
            let beside =
                [1.0 - 1e-14, 1.0, 1.0 + 1e-14].map(|part| inverse_limit(&law, end * part));
            largest = beside.into_iter().fold(largest, f64::max);
        }
    }
    if largest > 0.0 { Ok(largest.recip()) } else { Err(StabilityError::NoCrossing { r }) }
}

/// Whether φ(s + iΩ) is real at some Ω > 0, of the sign opposite to φ(s), so that 1 + Bφ = 0 for some B.
fn unstable_at_any_limit(scan: &Scan, law: &Law) -> bool {
    let height = |t: &Transforms| t.height.0 / t.unit.0 * law.inverse_limit;
    let at = |q: f64| height(&law.footprint.at(Complex64::new(law.fading, q)));
    let heights: Vec<(f64, Complex64)> =
        scan.samples().map(|(q, kept)| (q, kept.map_or_else(|| at(q), height))).collect();
    heights.windows(2).any(|pair| {
        let [(below, first), (above, second)] = [pair[0], pair[1]];
        let is_crossed = first.im * second.im < 0.0 && first.re.min(second.re) < 0.0;
        is_crossed && at(halved_between(|q| at(q).im, below, above)).re < 0.0
    })
}

/// The largest 1/b with A > 0 at which iΩ is a root; -∞ where there is none. `law` has 1/b = ±1.
///
/// With q = Mv²Λ² + vΛ + κ, X = q + A(G(p) - G(s)) and Y = qφ(p) + A(sφ(s)φ1(p) - G(s)φ(p)), N = X ± (A/b)Y: A is
/// such that X/Y is real.
fn inverse_limit(law: &Law, wave_number: f64) -> f64 {
    let p = Complex64::new(law.fading, wave_number);
    inverse_limit_with(law, wave_number, &law.footprint.at(p))
}

/// As [`inverse_limit`], with the transforms `t` at s + iΩ.
fn inverse_limit_with(law: &Law, wave_number: f64, t: &Transforms) -> f64 {
    let lambda = Complex64::new(0.0, wave_number);
    let unlimited = Law { inverse_limit: 0.0, ..law.clone() };
    let [bare, groove, _] = unlimited.expanded(lambda, t);
    let [_, with, second] = law.expanded(lambda, t);
    let first = with - groove;
    let cross = |a: Complex64, b: Complex64| (a * b.conj()).im;
    let coefficients =
        [cross(groove, second), cross(bare, second) + cross(groove, first), cross(bare, first)];
    let of = |density: f64| {
        let x = bare + groove * density;
        let y = (first + second * density) * density;
        -(x * y.conj()).re / y.norm_sqr()
    };
    let positive = real_zeros(coefficients).into_iter().filter(|a| a.is_finite() && *a > 0.0);
    positive.map(of).filter(|inverse| inverse.is_finite()).fold(f64::NEG_INFINITY, f64::max)
}

/// The real zeros of az² + bz + c, or the zero of bz + c if a is 0, computed without cancellation.
fn real_zeros([a, b, c]: [f64; 3]) -> Vec<f64> {
    if a.abs() <= 0.0 {
        return vec![-c / b];
    }
    let squared = b * b - 4.0 * a * c;
    if squared < 0.0 {
        return vec![];
    }
    let q = -0.5 * (b + b.signum() * squared.sqrt());
    vec![q / a, c / q]
}

/// The memory length rT below which steady motion is stable at every α, r and M, on a surface that heals without
/// a depth limit.
///
/// On the axis the imaginary part of the characteristic equation is rΩ + (α/r) Im G(s + iΩ) = 0, s = 1/(rT), with
/// G(p) = ∫_0^∞ f''(y) e^{-py}dy. There is no root if Im G(s + iΩ) ≥ 0 for all Ω. Beyond the memory length this condition
/// no longer holds. If it first fails at Ω → 0, where G'(s) and with it d l0/dr change their sign, the length is exact
/// for each r. If it first fails at some Ω > 0, the length is exact for some r only.
///
/// # Errors
/// [`StabilityError::NoLimit`] if the condition holds for all lengths.
pub fn memory_length(tip: &TipFunction) -> Result<f64, StabilityError> {
    let law = Law::with_density(&Wider::default(), tip, 1.0, 1.0);
    let samples = wave_numbers(tip);
    let lowest = |s: f64| {
        let at = |q: f64| {
            let t = law.footprint.at(Complex64::new(s, q));
            (t.curvature.0 / t.unit.0).im / q
        };
        let t = law.footprint.at(Complex64::new(s, 0.0));
        // (G u)' = G'u + Gu'
        let slope = (t.curvature.1 - t.curvature.0 / t.unit.0 * t.unit.1) / t.unit.0;
        samples.iter().map(|q| at(*q)).fold(slope.re, f64::min)
    };
    let most = BANDS * tip.band();
    let ladder = std::iter::successors(Some(most), |s| Some(s / FACTOR));
    let mut ladder = ladder.take_while(|s| *s > LEAST * most);
    let none = StabilityError::NoLimit(
        "steady motion over this footprint is stable at every memory length",
    );
    let below = ladder.find(|s| lowest(*s) < 0.0).ok_or(none)?;
    Ok(halved_between(lowest, below, below * FACTOR).recip())
}
