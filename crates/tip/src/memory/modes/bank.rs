//! The state of the sum: one complex number per term, `z_j = ∫ e^{s_j (x_tip - x0(t'))}dt'`.

mod powers;
mod saved;

use super::fit::Fit;
use super::local::{HIGHEST_DEGREE, LocalGroove};
use super::term::Term;
use crate::elementary::{self, larger, ln, norm};
use crate::exponential::of_lanes as exp;
use crate::sorting::ends_of;
use powers::Powers;
use std::sync::Arc;

/// The terms in real arithmetic, in groups that fill the SIMD vectors.
#[derive(Debug, Clone)]
pub(super) struct Bank {
    groups: Vec<Group>,
    tables: Arc<Tables>,
}

/// The part of a bank that follows from the terms alone.
#[derive(Debug, Clone)]
pub(crate) struct Tables {
    /// The groups of a bank without a past.
    groups: Vec<Group>,
    powers: Vec<Powers>,
    /// `lengths[k]` is the distance up to which degree k + `LOWEST_DEGREE` expands every term.
    lengths: Vec<f64>,
}

pub(crate) const LANES: usize = 4;
type Lane = [f64; LANES];
/// Complex numbers of a group: real parts, imaginary parts.
pub(crate) type Terms = (Lane, Lane);

#[derive(Debug, Clone, Copy)]
struct Group {
    exponent: (Lane, Lane),
    weight: (Lane, Lane),
    state: (Lane, Lane),
}

pub(crate) const LOWEST_DEGREE: usize = 3;
/// Allowed error of an expansion, relative to that of the fit.
const SHARE_OF_EXPANSION: f64 = 0.01;

impl Tables {
    pub(super) fn new(fit: &Fit) -> Self {
        let terms = fit.terms();
        let group = |terms: &[Term]| {
            let lane = |part: fn(&Term) -> f64, idle: f64| {
                std::array::from_fn(|i| terms.get(i).map_or(idle, part))
            };
            Group {
                exponent: (lane(|t| t.exponent.re, -1.0), lane(|t| t.exponent.im, 0.0)),
                weight: (lane(|t| t.weight.re, 0.0), lane(|t| t.weight.im, 0.0)),
                state: ([0.0; LANES], [0.0; LANES]),
            }
        };
        let groups: Vec<Group> = terms.chunks(LANES).map(group).collect();
        let powers = groups.iter().map(|group| powers::powers(group.exponent)).collect();
        Self { groups, powers, lengths: expansion_lengths(terms, fit.wanted()) }
    }

    /// The exponents in groups of lanes, and their powers from the 0th on.
    pub(crate) fn terms(&self) -> impl Iterator<Item = (&Terms, &[Terms])> {
        self.groups.iter().zip(&self.powers).map(|(group, powers)| (&group.exponent, &powers[..]))
    }

    /// The degree that expands every `e^{s_j y}` for |y| ≤ radius; `None` if no degree suffices.
    pub(crate) fn degree(&self, radius: f64) -> Option<usize> {
        // Not by halving, where each comparison would wait for the one before.
        let k = self.lengths.iter().filter(|length| **length < radius).count();
        (k < self.lengths.len()).then_some(k + LOWEST_DEGREE)
    }

    /// Passes the visits of a tip that moves from `start` to the last visit to `each`: in one part if an expansion is
    /// valid for all of them, otherwise in several. Each visit has `count` weights.
    pub(crate) fn each_part<'a, W>(
        &self,
        start: f64,
        (position, weights, count): (&'a [f64], &'a [W], usize),
        each: &mut impl FnMut(ExpandedPart<'a, W>),
    ) {
        let Some(&end) = position.last() else { return };
        let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
        let (low, high) = ends_of(position);
        let radius = larger(larger(high - middle, middle - low), half.abs());
        let degree = self.degree(radius);
        if degree.is_some() || position.len() == 1 {
            return each(ExpandedPart { position, weights, middle, half, degree });
        }
        let (first, rest) = position.split_at(position.len() / 2);
        let (first_weights, rest_weights) = weights.split_at(first.len() * count);
        self.each_part(start, (first, first_weights, count), each);
        self.each_part(first[first.len() - 1], (rest, rest_weights, count), each);
    }
}

/// Visits of a tip that moves by twice `half`, expanded about the middle of this displacement.
pub(crate) struct ExpandedPart<'a, W> {
    pub(crate) position: &'a [f64],
    pub(crate) weights: &'a [W],
    pub(crate) middle: f64,
    pub(crate) half: f64,
    /// The degree that expands every exponential about the middle; `None` for a single visit too far from the middle
    /// for any degree.
    pub(crate) degree: Option<usize>,
}

impl Bank {
    pub(super) fn new(tables: &Arc<Tables>) -> Self {
        Self { groups: tables.groups.clone(), tables: Arc::clone(tables) }
    }

    /// Sets `states` to z of each term times a factor, real and imaginary parts in turn. Zeros fill up the last group.
    pub(super) fn all_states(&self, factor: f64, states: &mut Vec<f64>) {
        states.resize(2 * LANES * self.groups.len(), 0.0);
        let (rooms, _) = states.as_chunks_mut::<{ 2 * LANES }>();
        for (group, room) in self.groups.iter().zip(rooms) {
            let (re, im) = group.state;
            for i in 0..LANES {
                (room[2 * i], room[2 * i + 1]) = (factor * re[i], factor * im[i]);
            }
        }
    }

    pub(super) fn clear(&mut self) {
        for group in &mut self.groups {
            group.state = ([0.0; LANES], [0.0; LANES]);
        }
    }

    pub(super) fn scale(&mut self, factor: f64) {
        for group in &mut self.groups {
            for i in 0..LANES {
                group.state.0[i] *= factor;
                group.state.1[i] *= factor;
            }
        }
    }

    /// Adds a time spent at a displacement from the tip.
    pub(super) fn add(&mut self, position: f64, weight: f64) {
        add(&mut self.groups, position, weight);
    }

    /// Remembers visits that end at the last of their positions: `z_j ← e^{s_j Δ} z_j + Σ_k weight_k
    /// e^{s_j (Δ - position_k)}`, the sum expanded about Δ/2 in powers of `s_j`.
    pub(super) fn advance(&mut self, position: &[f64], weight: &[f64]) {
        let Self { groups, tables } = self;
        tables.each_part(0.0, (position, weight, 1), &mut |part| {
            let ExpandedPart { position, weights, middle, half, degree } = part;
            if let Some(degree) = degree {
                let visits = (position, weights);
                powers::carry(groups, &tables.powers, visits, (middle, half), degree);
            } else {
                displace(groups, 2.0 * half);
                weights.iter().for_each(|weight| add(groups, 0.0, *weight));
            }
        });
    }

    /// Slope and curvature of the groove at one displacement from the tip.
    pub(super) fn at(&self, at: f64) -> (f64, f64) {
        let (mut slope, mut curvature) = ([0.0; LANES], [0.0; LANES]);
        for group in &self.groups {
            let value = product(group.weight, product(exp(group.exponent, at), group.state));
            let derivative = product(value, group.exponent);
            for i in 0..LANES {
                slope[i] += value.0[i];
                curvature[i] += derivative.0[i];
            }
        }
        (slope.iter().sum(), curvature.iter().sum())
    }

    /// Height of the groove at one displacement from the tip: on the side of the past f is
    /// `Σ_j Re(w_j/s_j e^{s_j ξ})`.
    pub(super) fn height(&self, at: f64) -> f64 {
        let mut height = [0.0; LANES];
        for group in &self.groups {
            let slope = product(group.weight, product(exp(group.exponent, at), group.state));
            let value = quotient(slope, group.exponent);
            (0..LANES).for_each(|i| height[i] += value.0[i]);
        }
        height.iter().sum()
    }

    /// The groove within `radius` of a displacement from the tip, if a polynomial is accurate there; with its height at
    /// the center on request.
    pub(super) fn expand(
        &self,
        center: f64,
        radius: f64,
        groove: &mut LocalGroove,
        with_height: bool,
    ) -> bool {
        let Some(degree) = self.tables.degree(radius) else { return false };
        let coefficients = groove.about(center, radius, degree);
        let mut height = [0.0; LANES];
        for group in &self.groups {
            let mut term = product(group.weight, product(exp(group.exponent, center), group.state));
            if with_height {
                let value = quotient(term, group.exponent);
                (0..LANES).for_each(|i| height[i] += value.0[i]);
            }
            for (k, coefficient) in coefficients.iter_mut().enumerate() {
                *coefficient += (term.0[0] + term.0[1]) + (term.0[2] + term.0[3]);
                let next = 1.0 / (k + 1) as f64;
                term = product(term, group.exponent);
                for i in 0..LANES {
                    term.0[i] *= next;
                    term.1[i] *= next;
                }
            }
        }
        if with_height {
            groove.height = Some(height.iter().sum());
        }
        true
    }
}

/// Adds a time spent at a displacement from the tip.
fn add(groups: &mut [Group], position: f64, weight: f64) {
    for group in groups {
        let e = exp(group.exponent, -position);
        for i in 0..LANES {
            group.state.0[i] += weight * e.0[i];
            group.state.1[i] += weight * e.1[i];
        }
    }
}

/// Moves the tip: `z_j ← e^{s_j Δ} z_j`.
fn displace(groups: &mut [Group], moved: f64) {
    for group in groups {
        group.state = product(exp(group.exponent, moved), group.state);
    }
}

/// Largest distances ρ up to which each degree K expands all terms. There `|w| (|s|ρ)^{K+1}/(K+1)!` stays below a share
/// of the accuracy of the fit. The round-off of cancelling terms of size `|w| e^{|s|ρ}` stays below its allowed value.
pub(crate) fn expansion_lengths(terms: &[Term], error: f64) -> Vec<f64> {
    let share = SHARE_OF_EXPANSION * error / terms.len() as f64;
    let sizes = terms.iter().map(|t| (norm(t.exponent), norm(t.weight).max(f64::MIN_POSITIVE)));
    let allowed = (0.1 * error).max(2e-14);
    let cancelling = |(s, w): (f64, f64)| ln(allowed / (f64::EPSILON * w)).max(0.5) / s;
    let longest = sizes.clone().map(cancelling).fold(f64::INFINITY, f64::min);
    let shares: Vec<_> = sizes.map(|(s, w)| (s, ln(share / w))).collect();
    let mut log_factorial: f64 = (1..=LOWEST_DEGREE).map(|k| ln(k as f64)).sum();
    let length = |degree: usize| {
        let n = (degree + 1) as f64;
        log_factorial += ln(n);
        let one = |(s, share): &(f64, f64)| elementary::exp((share + log_factorial) / n) / s;
        shares.iter().map(one).fold(longest, f64::min)
    };
    (LOWEST_DEGREE..=HIGHEST_DEGREE).map(length).collect()
}

#[inline(always)]
fn product(a: (Lane, Lane), b: (Lane, Lane)) -> (Lane, Lane) {
    let mut c = ([0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        c.0[i] = a.0[i] * b.0[i] - a.1[i] * b.1[i];
        c.1[i] = a.0[i] * b.1[i] + a.1[i] * b.0[i];
    }
    c
}

/// a/b
fn quotient(a: (Lane, Lane), b: (Lane, Lane)) -> (Lane, Lane) {
    let (mut c, conjugate) = (([0.0; LANES], [0.0; LANES]), (b.0, b.1.map(|im| -im)));
    let scaled = product(a, conjugate);
    for i in 0..LANES {
        let size = b.0[i] * b.0[i] + b.1[i] * b.1[i];
        (c.0[i], c.1[i]) = (scaled.0[i] / size, scaled.1[i] / size);
    }
    c
}

#[inline(always)]
fn sum(a: (Lane, Lane), b: (Lane, Lane)) -> (Lane, Lane) {
    let mut c = a;
    for i in 0..LANES {
        c.0[i] += b.0[i];
        c.1[i] += b.1[i];
    }
    c
}
