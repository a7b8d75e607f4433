//! Crossings of the imaginary axis by roots, in any model.
//!
//! N of `law.rs` is a polynomial c0 + c1 A + c2 A² in A = αw0/r. It is of first degree unless the surface both heals
//! and has a depth limit. On the axis, Λ = iΩ, its real and imaginary parts have a common zero A if their resultant
//! vanishes: this is an equation for Ω alone. As α = rA e^{A|φ(s)|/b} increases with A, the first crossing is that of
//! the smallest A.

use super::law::Law;
use super::newton::real_steps;
use super::one_sided::{OneSided, Transforms};
use num_complex::Complex64;
use std::f64::consts::TAU;
use std::sync::Arc;
use stickslip_tip::roots::zero_between;
use stickslip_tip::sorting::{sort_by_number, sort_numbers};
use stickslip_tip::{TipFunction, Wider, stop};

/// Number of samples per period of the fastest oscillation that the reach of the tip allows.
const SAMPLES_PER_PERIOD: f64 = 12.0;
/// Reach assumed for J0 and cos x, which have none.
const WAVES: f64 = 30.0;
/// Number of samples per decade outside the band.
const PER_DECADE: u32 = 40;
/// Number of decades sampled below the band, and above it.
const DECADES_BELOW: u32 = 6;
const DECADES_ABOVE: u32 = 3;
/// The largest |N| of a crossing, relative to its terms.
const LARGEST_RESIDUAL: f64 = 1e-9;
/// Relative round-off in G, of closed forms and of tables.
const ROUNDOFF: (f64, f64) = (1e-15, 1e-11);
/// A crossing is rejected if its A is so large that the round-off in AG exceeds this fraction of Mv²Λ² + vΛ + κ.
const LARGEST_NOISE: f64 = 1e-3;

/// Relative distance from the Ω of a resonance to the nearest samples, in units of 1/√M, its relative width.
const PART_OF_RESONANCE: f64 = 0.1;

/// A and Ω of a root on the imaginary axis.
#[derive(Debug, Clone, Copy)]
pub(super) struct Crossing {
    pub(super) density: f64,
    pub(super) wave_number: f64,
}

/// The imaginary axis of one footprint, sampled for the crossings at every r.
#[derive(Debug, Clone)]
pub(super) struct Scan {
    wider: Wider,
    footprint: Arc<OneSided>,
    samples: Vec<Sample>,
}

#[derive(Debug, Clone)]
struct Sample {
    wave_number: f64,
    /// Transforms at p = iΩ if the surface does not heal; otherwise p = iΩ + 1/(rT) depends on r.
    kept: Option<Transforms>,
}

impl Scan {
    pub(super) fn new(wider: &Wider, tip: &TipFunction) -> Self {
        let footprint = Arc::new(OneSided::new(tip));
        let keeps = wider.healing_time.is_none();
        let sample = |wave_number: f64| {
            let kept = keeps.then(|| footprint.at(Complex64::new(0.0, wave_number)));
            Sample { wave_number, kept }
        };
        let wave_numbers = wave_numbers(tip).into_iter().take_while(|_| !stop::is_requested());
        let samples = wave_numbers.map(sample).collect();
        Self { wider: *wider, footprint, samples }
    }

    pub(super) fn tip(&self) -> &TipFunction {
        self.footprint.tip()
    }

    /// The model at this r, with A = 1.
    pub(super) fn law_at(&self, r: f64) -> Law {
        self.law_under(&self.wider, r)
    }

    /// Another model at this r, with A = 1; it uses the stored transforms if its healing is the same.
    pub(super) fn law_under(&self, wider: &Wider, r: f64) -> Law {
        Law::on(wider, &self.footprint, r, 1.0)
    }

    /// Each sampled Ω, with the transforms there if they do not depend on r.
    pub(super) fn samples(&self) -> impl Iterator<Item = (f64, Option<&Transforms>)> {
        self.samples.iter().map(|sample| (sample.wave_number, sample.kept.as_ref()))
    }

    /// Whether the steady tip is on the kink of |h| of a depth limit.
    pub(super) fn has_corner(&self, law: &Law) -> bool {
        Law::has_corner(&self.wider, self.footprint.tip(), &law.steady)
    }

    /// All crossings with A > 0.
    pub(super) fn crossings(&self, law: &Law) -> Vec<Crossing> {
        let on_axis = |q: f64| law.by_density(Complex64::new(0.0, q));
        let value = |Sample { wave_number, kept }: &Sample| {
            let kept = kept.as_ref().map(|t| law.expanded(Complex64::new(0.0, *wave_number), t));
            (*wave_number, resultant(kept.unwrap_or_else(|| on_axis(*wave_number))))
        };
        let samples = self.samples.iter().take_while(|_| !stop::is_requested());
        let mut values: Vec<(f64, f64)> = samples.map(value).collect();
        let beside = beside_resonance(law);
        if !beside.is_empty() {
            values.extend(beside.into_iter().map(|q| (q, resultant(on_axis(q)))));
            sort_by_number(&mut values, |item| item.0);
        }
        let zeros = zeros(|q| resultant(on_axis(q)), &values).into_iter();
        let crossings = zeros.flat_map(|wave_number| {
            let densities = common(on_axis(wave_number)).into_iter();
            let densities = densities.filter(|a| a.is_finite() && *a > 0.0);
            densities.filter_map(move |density| polished(law, Crossing { density, wave_number }))
        });
        crossings.collect()
    }
}

/// Ω from far below to far above the band of the footprint, dense enough for its reach.
pub(super) fn wave_numbers(tip: &TipFunction) -> Vec<f64> {
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
        all.extend(beside(1.0, 0.5 / decade(10 * PER_DECADE)));
        sort_numbers(&mut all);
    }
    all
}

/// Samples of Ω around the resonance of inertia and spring, on both sides.
pub(super) fn beside_resonance(law: &Law) -> Vec<f64> {
    if law.inertia <= 0.0 {
        return vec![];
    }
    let width = law.speed / law.inertia.sqrt();
    beside((law.spring / law.inertia).sqrt(), PART_OF_RESONANCE * width)
}

/// Samples on both sides of Ω, at relative distances from 1/2 down to `nearest`.
fn beside(wave_number: f64, nearest: f64) -> Vec<f64> {
    let part = |n: u32| 0.5 / 10_f64.powf(f64::from(n) / f64::from(PER_DECADE));
    let parts = (0..).map(part).take_while(|part| *part > nearest);
    parts.flat_map(|part| [wave_number * (1.0 - part), wave_number * (1.0 + part)]).collect()
}

/// Resultant of the real and the imaginary part of c0 + c1 A + c2 A², or of c0 + c1 A if c2 is 0.
fn resultant([c0, c1, c2]: [Complex64; 3]) -> f64 {
    let cross = |a: Complex64, b: Complex64| a.re * b.im - a.im * b.re;
    if c2.norm() <= 0.0 {
        return cross(c0, c1);
    }
    cross(c0, c2).powi(2) - cross(c1, c2) * cross(c0, c1)
}

/// Candidates for the A at which the real and the imaginary part of c0 + c1 A + c2 A² both vanish.
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

/// Newton's method for N = 0 in A and Ω; `None` if it does not converge to a zero close by.
fn polished(law: &Law, start: Crossing) -> Option<Crossing> {
    let mut law = law.clone();
    let (mut density, mut q) = (start.density, start.wave_number);
    for _ in 0..6 {
        law.density = density;
        let lambda = Complex64::new(0.0, q);
        let [_, c1, c2] = law.by_density(lambda);
        let (_, (value, slope)) = law.at(lambda);
        let along_a = c1 + c2 * (2.0 * density);
        let along_q = slope * Complex64::I;
        let [step_a, step_q] = real_steps(value, [along_a, along_q]);
        let (to_a, to_q) = (density - step_a, q - step_q);
        if !(to_a > 0.0 && to_q > 0.0 && to_a.is_finite()) {
            break;
        }
        (density, q) = (to_a, to_q);
    }
    law.density = density;
    let lambda = Complex64::new(0.0, q);
    let residual = law.at(lambda).1.0.norm() / law.size(lambda);
    let near =
        (q / start.wave_number - 1.0).abs() < 1e-3 && (density / start.density - 1.0).abs() < 1e-2;
    (near && residual < LARGEST_RESIDUAL && is_told(&law, lambda))
        .then_some(Crossing { density, wave_number: q })
}

/// Whether the terms of N that balance at this Λ exceed round-off.
fn is_told(law: &Law, lambda: Complex64) -> bool {
    let t = law.footprint.at(lambda + law.fading);
    let curvature = (t.curvature.0 / t.unit.0).norm() + law.steady.curvature.abs();
    let roundoff = if law.footprint.is_closed_form() { ROUNDOFF.0 } else { ROUNDOFF.1 };
    law.density * curvature * roundoff < LARGEST_NOISE * law.bare(lambda).0.norm()
}

/// Zeros of g between samples: by sign changes, and at local minima of |g|, in case g crosses 0 twice between samples. The
/// slopes of g fall towards such a minimum: |g| does not reach 0 if the steepest of both would not lead there.
pub(super) fn zeros(g: impl Fn(f64) -> f64, samples: &[(f64, f64)]) -> Vec<f64> {
    let mut zeros = vec![];
    for i in 1..samples.len() {
        let ((last, before), (here, value)) = (samples[i - 1], samples[i]);
        if before * value < 0.0 {
            zeros.push(zero_between(&g, last, here));
        }
        let Some((next, after)) = samples.get(i + 1).copied() else { continue };
        let dips = value.abs() < before.abs().min(after.abs());
        let slopes = [(before - value) / (here - last), (after - value) / (next - here)];
        let reach = (next - last) * slopes[0].abs().max(slopes[1].abs());
        if dips && value.abs() < reach && before * value > 0.0 && value * after > 0.0 {
            let sign = value.signum();
            let bottom = least(|q| sign * g(q), last, next);
            if sign * g(bottom) < 0.0 {
                zeros.push(zero_between(&g, last, bottom));
                zeros.push(zero_between(&g, bottom, next));
            }
        }
    }
    zeros
}

/// The minimum of g between a and b, by golden-section search.
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
