//! αc under the wider law: the smallest α at which a root reaches the imaginary axis.
//!
//! N of `law.rs` is a polynomial c0 + c1 A + c2 A² in A = αw0/r, of first degree unless the surface both heals
//! and has a depth limit. On the axis, Λ = iΩ, its real and its imaginary part have a common zero A where their
//! resultant vanishes, which is an equation for Ω alone. α = rA e^{A|φ(s)|/b} rises with A: the first crossing is
//! that of the smallest A.

use super::super::{Critical, StabilityError};
use super::corner;
use super::law::{Crossing, Law};
use num_complex::Complex64;
use std::f64::consts::TAU;
use stickslip_tip::roots::zero_between;
use stickslip_tip::{TipFunction, Wider};

/// Samples per period of the fastest ripple that the reach of the tip allows.
const SAMPLES_PER_PERIOD: f64 = 12.0;
/// What J0 and cos x, which have no reach, are sampled as if they had.
const WAVES: f64 = 30.0;
/// Samples a decade outside the band, and decades of them.
const PER_DECADE: u32 = 40;
const DECADES_BELOW: u32 = 6;
const DECADES_ABOVE: u32 = 3;
/// The largest |N| that makes a crossing, relative to its terms.
const LARGEST_RESIDUAL: f64 = 1e-9;
/// Round-off in G, of closed forms and of tables; a crossing at an A so large that it weighs more than this part of
/// Mv²Λ² + vΛ + κ is none.
const ROUNDOFF: (f64, f64) = (1e-15, 1e-11);
const LARGEST_NOISE: f64 = 1e-3;

/// What small deviations obey at the onset.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OnsetKind {
    /// A linear law: this is the Hopf bifurcation.
    Smooth,
    /// A law with the corner of |h| in it: the height under the steady tip is 0. See [`critical_under`].
    NonSmooth,
}

/// A point of the boundary under the wider law.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WiderCritical {
    /// αc, r and the oscillation.
    pub critical: Critical,
    /// Whether it is one of linear theory.
    pub kind: OnsetKind,
    /// αw0/r, what the steady tip indents per length there.
    pub density: f64,
    /// w0, its rate of indentation relative to α.
    pub weight: f64,
}

/// αc(r) under a wider law.
///
/// Where the steady tip has the surface at height 0 under it and the depth limit its corner (β = 1 without
/// healing), small deviations obey no linear law, but a homogeneous one: this is the α at which a small oscillation
/// keeps its amplitude, whatever it is, and marked [`OnsetKind::NonSmooth`]. There are no roots there.
///
/// # Errors
/// r not a positive finite number, a parameter of the wider law out of range, no spring,
/// [`StabilityError::NoCrossing`], also where αc is no finite number any more, or [`StabilityError::Unsettled`].
pub fn critical_under(
    wider: &Wider,
    tip: &TipFunction,
    r: f64,
) -> Result<WiderCritical, StabilityError> {
    if !(r.is_finite() && r > 0.0) {
        return Err(StabilityError::R(r));
    }
    if !wider.spring {
        return Err(StabilityError::NoSupport);
    }
    wider.validate()?;
    let mut law = Law::with_density(wider, tip, r, 1.0);
    let first = crossings(&law).into_iter().min_by(|a, b| a.density.total_cmp(&b.density));
    let mut first = first.ok_or(StabilityError::NoCrossing { r })?;
    let mut kind = OnsetKind::Smooth;
    if let Some(limit) = wider.depth_limit.filter(|_| Law::has_corner(wider, tip, &law.steady)) {
        first = corner::onset(&law, limit, first).ok_or(StabilityError::Unsettled { limit })?;
        kind = OnsetKind::NonSmooth;
    }
    let Crossing { density, wave_number } = first;
    law.set_density(density);
    let alpha = law.alpha();
    if !alpha.is_finite() {
        return Err(StabilityError::NoCrossing { r });
    }
    let critical = Critical::new(alpha, r, wave_number);
    Ok(WiderCritical { critical, kind, density, weight: r * density / alpha })
}

/// αc of each r in turn, `None` where nothing is unstable.
///
/// # Errors
/// As [`critical_under`], but for no crossing.
pub fn boundary_under(
    wider: &Wider,
    tip: &TipFunction,
    velocities: &[f64],
) -> Result<Vec<Option<WiderCritical>>, StabilityError> {
    let at = |r: &f64| match critical_under(wider, tip, *r) {
        Ok(critical) => Ok(Some(critical)),
        Err(StabilityError::NoCrossing { .. }) => Ok(None),
        Err(error) => Err(error),
    };
    velocities.iter().map(at).collect()
}

/// All of them with A > 0.
pub(super) fn crossings(law: &Law) -> Vec<Crossing> {
    let on_axis = |q: f64| law.by_density(Complex64::new(0.0, q));
    let zeros = zeros(|q| resultant(on_axis(q)), &wave_numbers(law));
    let densities = zeros.into_iter().flat_map(|q| {
        let candidates = common(on_axis(q)).into_iter().filter(|a| a.is_finite() && *a > 0.0);
        candidates.filter_map(move |density| polished(law, Crossing { density, wave_number: q }))
    });
    densities.collect()
}

/// Ω from far below to far above the band of the footprint, close enough together for what its reach allows.
pub(super) fn wave_numbers(law: &Law) -> Vec<f64> {
    let tip = law.footprint.tip();
    let reach = tip.reach().unwrap_or(WAVES);
    let step = TAU / (SAMPLES_PER_PERIOD * reach);
    let band = tip.band().min(2e5 * step);
    let decade = |n: u32| 10_f64.powf(f64::from(n) / f64::from(PER_DECADE));
    let below = (1..=PER_DECADE * DECADES_BELOW).rev().map(|n| step / decade(n));
    let within = (1..).map(|i: u32| f64::from(i) * step).take_while(|q| *q < band);
    let above = (0..=PER_DECADE * DECADES_ABOVE).map(|n| band * decade(n));
    let mut all: Vec<f64> = below.chain(within).chain(above).collect();
    if tip.reach().is_none() {
        // On either side of the wave of J0 and cos x, where the transforms change within s.
        let beside = (0..10 * PER_DECADE).flat_map(|n| {
            let off = 0.5 / decade(n);
            [1.0 - off, 1.0 + off]
        });
        all.extend(beside);
    }
    // What inertia and the spring resonate at.
    if law.inertia > 0.0 {
        let resonance = (law.spring / law.inertia).sqrt();
        let beside = (0..4 * PER_DECADE).flat_map(|n| {
            let part = 0.5 / decade(n);
            [resonance * (1.0 - part), resonance * (1.0 + part)]
        });
        all.extend(beside);
    }
    all.sort_by(f64::total_cmp);
    all
}

/// Of the real and the imaginary part of c0 + c1 A + c2 A²; over c2 where that vanishes.
fn resultant([c0, c1, c2]: [Complex64; 3]) -> f64 {
    let cross = |a: Complex64, b: Complex64| a.re * b.im - a.im * b.re;
    if c2.norm() <= 0.0 {
        return cross(c0, c1);
    }
    cross(c0, c2).powi(2) - cross(c1, c2) * cross(c0, c1)
}

/// The A at which both parts vanish, where they do so together.
fn common([c0, c1, c2]: [Complex64; 3]) -> Vec<f64> {
    if c2.norm() <= 0.0 {
        return vec![-(c0 * c1.conj()).re / c1.norm_sqr()];
    }
    // Both roots of the larger part: that which is common is sorted out by the polish.
    let real = c2.re.abs() > c2.im.abs();
    let part = |c: Complex64| if real { c.re } else { c.im };
    let (a, b, c) = (part(c2), part(c1), part(c0));
    let root = (b * b - 4.0 * a * c).max(0.0).sqrt();
    let q = -0.5 * (b + b.signum() * root);
    vec![q / a, c / q]
}

/// Newton's method for N = 0 in A and Ω; `None` where it leads away, or to no zero.
fn polished(law: &Law, start: Crossing) -> Option<Crossing> {
    let mut law = law.clone();
    let (mut density, mut q) = (start.density, start.wave_number);
    for _ in 0..6 {
        law.set_density(density);
        let lambda = Complex64::new(0.0, q);
        let [_, c1, c2] = law.by_density(lambda);
        let (_, (value, slope)) = law.at(lambda);
        let along_a = c1 + c2 * (2.0 * density);
        let along_q = slope * Complex64::I;
        let determinant = along_a.re * along_q.im - along_a.im * along_q.re;
        let step_a = (value.re * along_q.im - value.im * along_q.re) / determinant;
        let step_q = (along_a.re * value.im - along_a.im * value.re) / determinant;
        let (to_a, to_q) = (density - step_a, q - step_q);
        if !(to_a > 0.0 && to_q > 0.0 && to_a.is_finite()) {
            break;
        }
        (density, q) = (to_a, to_q);
    }
    law.set_density(density);
    let lambda = Complex64::new(0.0, q);
    let residual = law.at(lambda).1.0.norm() / law.size(lambda);
    let near =
        (q / start.wave_number - 1.0).abs() < 1e-3 && (density / start.density - 1.0).abs() < 1e-2;
    (near && residual < LARGEST_RESIDUAL && is_told(&law, lambda))
        .then_some(Crossing { density, wave_number: q })
}

/// Whether what balances there is more than round-off.
fn is_told(law: &Law, lambda: Complex64) -> bool {
    let t = law.footprint.at(lambda + law.fading);
    let curvature = (t.curvature.0 / t.unit.0).norm() + law.steady.curvature.abs();
    let roundoff = if law.footprint.is_closed_form() { ROUNDOFF.0 } else { ROUNDOFF.1 };
    law.density * curvature * roundoff < LARGEST_NOISE * law.bare(lambda).0.norm()
}

/// Zeros of g between samples: by its sign, and where |g| is least among neighbours, in case it dips across 0.
pub(super) fn zeros(g: impl Fn(f64) -> f64, samples: &[f64]) -> Vec<f64> {
    let values: Vec<f64> = samples.iter().map(|q| g(*q)).collect();
    let mut zeros = vec![];
    for i in 1..samples.len() {
        if values[i - 1] * values[i] < 0.0 {
            zeros.push(zero_between(&g, samples[i - 1], samples[i]));
        }
        let dips = i + 1 < samples.len()
            && values[i].abs() < values[i - 1].abs()
            && values[i].abs() < values[i + 1].abs()
            && values[i - 1] * values[i] > 0.0
            && values[i] * values[i + 1] > 0.0;
        if dips {
            let sign = values[i].signum();
            let bottom = least(|q| sign * g(q), samples[i - 1], samples[i + 1]);
            if sign * g(bottom) < 0.0 {
                zeros.push(zero_between(&g, samples[i - 1], bottom));
                zeros.push(zero_between(&g, bottom, samples[i + 1]));
            }
        }
    }
    zeros
}

/// Where g is least between a and b, by golden sections.
pub(super) fn least(g: impl Fn(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut x, mut y) = (b - golden * (b - a), a + golden * (b - a));
    let (mut at_x, mut at_y) = (g(x), g(y));
    for _ in 0..80 {
        if at_x < at_y {
            (b, y, at_y) = (y, x, at_x);
            x = b - golden * (b - a);
            at_x = g(x);
        } else {
            (a, x, at_x) = (x, y, at_y);
            y = a + golden * (b - a);
            at_y = g(y);
        }
    }
    0.5 * (a + b)
}
