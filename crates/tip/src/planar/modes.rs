//! The past in two coordinates: one complex number for each exponential along the scan and each layer across it.
//!
//! With g'(ξ) ≈ `Σ_j Re(c_j e^{s_j ξ})` on the side of the past and the [`layers`] φ about a center,
//!
//! ```text
//!     z_jm = ∫ w φ_m(η') e^{s_j (x0 - x')} dt'        ∫ w φ_m(η') g⁽ⁿ⁾(x0 + d - x') dt' = Σ_j Re(c_j s_j^{n-1} e^{s_j d} z_jm)
//! ```
//!
//! The case n = 0 evaluates g itself, whose error is at most the [area](crate::memory::FitCertificate::area) of the
//! fit.

use super::layered::{Integrals, Layered};
use super::layers::{self, LANES, Lanes, add_all, resized};
use crate::elementary::{complex_exp, inverse_factorials};
use crate::exponential::of_lanes;
use crate::memory::{ExpandedPart, Fit, HIGHEST_DEGREE, Prepared, SteadyPast, TERMS, Terms};
use crate::state::{Damaged, Reader, State};
use multiversion::multiversion;
use num_complex::Complex;
use std::sync::Arc;

/// A memory of the whole past.
#[derive(Debug, Clone)]
pub(super) struct Modes {
    fit: Arc<Fit>,
    prepared: Arc<Prepared>,
    /// Number of groups of lanes that contain the layers.
    groups: usize,
    /// For each term the layers of the real part of its state, then those of the imaginary part.
    states: Vec<Lanes>,
    /// The farthest-forward position, as a displacement from the tip.
    farthest: f64,
    /// Scratch space for moments of visits.
    moments: Vec<Lanes>,
}

impl Modes {
    pub(super) fn new(fit: Arc<Fit>) -> Self {
        let (prepared, farthest) = (Prepared::cached(&fit), f64::NEG_INFINITY);
        Self { fit, prepared, groups: 0, states: vec![], farthest, moments: vec![] }
    }

    /// Number of exponentials; a conjugate pair counts as one.
    pub(super) fn terms(&self) -> usize {
        self.fit.terms().len()
    }

    /// Largest distance behind the farthest point at which a step may begin.
    pub(super) fn retreat_between_steps(&self) -> f64 {
        self.fit.retreat_between_steps()
    }

    /// Derivatives of g at 0, from the sum of exponentials.
    pub(super) fn of_tip(&self) -> &[f64] {
        &self.prepared.powers.of_tip
    }

    fn terms_in_parts(&self) -> impl Iterator<Item = f64> {
        self.fit.terms().iter().flat_map(|term| [term.exponent.re, term.exponent.im])
    }

    /// Derivatives of the integrals of each layer at the tip, multiplied by a factor, in order from the 0th on, as many
    /// as `of_layers` holds.
    pub(super) fn derivatives(&self, factor: f64, of_layers: &mut [Lanes]) {
        derivatives(&self.prepared.powers.rows, &self.states, factor, of_layers);
    }
}

impl Layered for Modes {
    fn groups(&self) -> usize {
        self.groups
    }

    fn behind(&self) -> f64 {
        self.farthest
    }

    fn retreat(&self) -> f64 {
        self.fit.retreat()
    }

    fn size(&self) -> usize {
        self.states.len() * LANES
    }

    fn resize(&mut self, groups: usize) {
        self.states = resized(&self.states, self.groups, (2 * self.terms(), groups));
        self.groups = groups;
    }

    fn recenter(&mut self, distance: f64) {
        layers::recenter(distance, &mut self.states, self.groups);
    }

    fn fade(&mut self, factor: f64) {
        self.states.as_flattened_mut().iter_mut().for_each(|z| *z *= factor);
    }

    fn remember_steady(&mut self, past: &SteadyPast, phi: &[Lanes]) {
        for (term, states) in
            self.fit.terms().iter().zip(self.states.chunks_exact_mut(2 * phi.len()))
        {
            let fading: Complex<f64> = past.velocity * term.exponent - past.healing;
            let state = -past.weight / fading * complex_exp(term.exponent * past.distance);
            let (re, im) = states.split_at_mut(phi.len());
            add_all(re, phi, state.re);
            add_all(im, phi, state.im);
        }
        self.farthest = self.farthest.max(-past.distance);
    }

    fn remember(&mut self, position: &[f64], weighted: &[Lanes]) {
        let Some(moved) = position.last() else { return };
        self.farthest = position.iter().copied().fold(self.farthest, f64::max) - moved;
        let Self { prepared, groups, states, moments, .. } = self;
        prepared.bank.each_part(0.0, (position, weighted, *groups), &mut |part| {
            let ExpandedPart { position, weights, middle, half, degree } = part;
            let count = degree.map_or(0, |degree| degree + 1);
            moments.resize(count.next_multiple_of(BLOCK) * *groups, [0.0; LANES]);
            self::moments(position, weights, middle, moments);
            let moments = &moments[..count * *groups];
            let of_terms = states.chunks_mut(2 * TERMS * *groups);
            for (states, terms) in of_terms.zip(prepared.bank.terms()) {
                carry(states, terms, half, (moments, *groups));
            }
            if degree.is_none() {
                let states = states.chunks_exact_mut(2 * *groups);
                states.for_each(|state| add_all(&mut state[..*groups], weights, 1.0));
            }
        });
    }

    fn save(&self, state: &mut State) {
        let exponents: Vec<f64> = self.terms_in_parts().collect();
        state.numbers(exponents.into_iter());
        state.numbers(self.states.as_flattened().iter().copied());
        state.count(self.groups as u64);
        state.number(self.farthest);
    }

    fn restore(&mut self, state: &mut Reader, _: Option<usize>) -> Result<(), Damaged> {
        // A fit made on another machine may differ by a rounding: not to the last bit the same run.
        let saved = state.numbers()?.into_iter().map(f64::to_bits);
        if !saved.eq(self.terms_in_parts().map(f64::to_bits)) {
            return Err(Damaged::Other("fit of f' by exponentials"));
        }
        let states = state.numbers()?;
        let groups = usize::try_from(state.count()?).map_err(|_| Damaged::OutOfRange)?;
        if groups == 0 || groups.checked_mul(2 * self.terms() * LANES) != Some(states.len()) {
            return Err(Damaged::OutOfRange);
        }
        self.groups = groups;
        self.states = states.as_chunks::<LANES>().0.to_vec();
        self.farthest = state.number()?;
        Ok(())
    }

    fn at(&self, displacement: f64, jet: &mut Integrals<'_>) {
        jet.iter_mut().for_each(|integral| integral.fill([0.0; LANES]));
        let exponentials = self.prepared.bank.terms().flat_map(|(exponents, _)| {
            let (re, im) = of_lanes(*exponents, displacement);
            (0..TERMS).map(move |i| Complex::new(re[i], im[i]))
        });
        let states = self.states.chunks_exact(2 * self.groups);
        for ((term, e), state) in self.fit.terms().iter().zip(exponentials).zip(states) {
            let (re, im) = state.split_at(self.groups);
            let mut factor = term.weight * e / term.exponent;
            for integral in jet.iter_mut() {
                add_all(integral, re, factor.re);
                add_all(integral, im, -factor.im);
                factor *= term.exponent;
            }
        }
    }
}

/// `Σ_k weighted_km (from - position_k)^n/n!`: `groups` of lanes for each n. With these, `Σ_k weighted_km e^{s (from -
/// position_k)}` is a polynomial of s.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn moments(position: &[f64], weighted: &[Lanes], from: f64, moments: &mut [Lanes]) {
    let groups = weighted.len() / position.len();
    for (block, moments) in moments.chunks_exact_mut(BLOCK * groups).enumerate() {
        for g in 0..groups {
            let mut sums = [[0.0; LANES]; BLOCK];
            for (position, weighted) in position.iter().zip(weighted.chunks_exact(groups)) {
                let y = from - position;
                let square = y * y;
                let factors = [1.0, y, square, square * y];
                let mut first = 1.0;
                for _ in 0..block {
                    first *= square * square;
                }
                for (sum, factor) in sums.iter_mut().zip(&factors) {
                    let factor = first * factor;
                    for i in 0..LANES {
                        sum[i] += factor * weighted[g][i];
                    }
                }
            }
            let inverse = &INVERSE_FACTORIALS[BLOCK * block..];
            for ((moments, sum), inverse) in
                moments.chunks_exact_mut(groups).zip(&sums).zip(inverse)
            {
                for i in 0..LANES {
                    moments[g][i] = inverse * sum[i];
                }
            }
        }
    }
}

/// 1/n! up to the highest degree, and further ones that fill the last block.
const INVERSE_FACTORIALS: [f64; (HIGHEST_DEGREE + 1).next_multiple_of(BLOCK)] =
    inverse_factorials();

/// `z_jm ← E (E z_jm + Σ_n s_j^n moments_nm)` with `E = e^{s_j half}`, for a group of terms.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn carry(
    states: &mut [Lanes],
    (exponents, powers): (&Terms, &[Terms]),
    half: f64,
    (moments, groups): (&[Lanes], usize),
) {
    let (re, im) = of_lanes(*exponents, half);
    for (i, state) in states.chunks_exact_mut(2 * groups).enumerate() {
        let (real, imaginary) = state.split_at_mut(groups);
        for (g, (a, b)) in real.iter_mut().zip(imaginary).enumerate() {
            let (mut x, mut y) = ([0.0; LANES], [0.0; LANES]);
            for ((re, im), moments) in powers.iter().zip(moments.chunks_exact(groups)) {
                for m in 0..LANES {
                    x[m] += re[i] * moments[g][m];
                    y[m] += im[i] * moments[g][m];
                }
            }
            for m in 0..LANES {
                (x[m], y[m]) =
                    (x[m] + (re[i] * a[m] - im[i] * b[m]), y[m] + (re[i] * b[m] + im[i] * a[m]));
                (a[m], b[m]) = (re[i] * x[m] - im[i] * y[m], re[i] * y[m] + im[i] * x[m]);
            }
        }
    }
}

/// Number of derivatives that are summed together.
const BLOCK: usize = 4;

/// Products of rows and states, in the order of the terms: the same bits on every machine. The results are `groups`
/// of lanes for each derivative, and some more that fill the last block.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq", "x86_64+avx2"))]
fn derivatives<const ROOM: usize>(
    rows: &[[f64; ROOM]],
    states: &[Lanes],
    factor: f64,
    of_layers: &mut [Lanes],
) {
    let groups = states.len() / rows.len();
    for (block, of_layers) in of_layers.chunks_mut(BLOCK * groups).enumerate() {
        for g in 0..groups {
            let mut sums = [[0.0; LANES]; BLOCK];
            for (row, state) in rows.iter().zip(states.chunks_exact(groups)) {
                let Some(powers) = row[BLOCK * block..].first_chunk::<BLOCK>() else { break };
                for (sum, power) in sums.iter_mut().zip(powers) {
                    for i in 0..LANES {
                        sum[i] += power * state[g][i];
                    }
                }
            }
            for (of_layers, sum) in of_layers.chunks_exact_mut(groups).zip(&sums) {
                for i in 0..LANES {
                    of_layers[g][i] = factor * sum[i];
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TipFunction;
    use crate::memory::Retreat;

    fn modes() -> (TipFunction, Modes) {
        let tip = TipFunction::default();
        let mut modes = Modes::new(Fit::cached(&tip, 1e-11, Retreat::Small).unwrap());
        modes.resize(4);
        (tip, modes)
    }

    /// Visits by themselves are the oracle: f and its derivatives at distances along, layers at distances across.
    #[test]
    fn states_are_sums_over_visits() {
        let (tip, mut modes) = modes();
        let mut visits: Vec<(f64, f64, f64)> = vec![];
        for n in 0..40 {
            let part = |k: usize| (k + 1) as f64 / 5.0;
            let positions: [f64; 5] = std::array::from_fn(|k| 0.7 * part(k) * (0.3 + part(k)));
            let moved = positions[4];
            visits.iter_mut().for_each(|visit| visit.0 -= moved);
            let mut weighted = vec![[0.0; LANES]; 20];
            for (k, weighted) in weighted.chunks_exact_mut(4).enumerate() {
                let (eta, weight) = (0.6 * (0.9 * (n as f64 + part(k))).sin(), 0.2 + 0.1 * part(k));
                visits.push((positions[k] - moved, eta, weight));
                layers::values(eta, weight, weighted);
            }
            modes.remember(&positions, &weighted);
        }
        let mut integrals = vec![[0.0; LANES]; 3 * 4];
        for (d, eta) in [(0.0, 0.0), (0.4, -0.5), (-0.3, 0.6)] {
            let [value, slope, curvature] =
                integrals.get_disjoint_mut([0..4, 4..8, 8..12]).unwrap();
            modes.at(d, &mut [value, slope, curvature]);
            let mut phi = vec![[0.0; LANES]; 4];
            layers::values(eta, 1.0, &mut phi);
            for (n, integral) in integrals.chunks_exact(4).enumerate() {
                let of = |xi: f64| match n {
                    0 => tip.value(xi),
                    1 => tip.slope(xi),
                    _ => tip.slope_and_curvature(xi).1,
                };
                let exact: f64 = visits
                    .iter()
                    .map(|(x, y, w)| w * of(d - x) * (-0.5 * (eta - y) * (eta - y)).exp())
                    .sum();
                let sum: f64 = phi
                    .as_flattened()
                    .iter()
                    .zip(integral.as_flattened())
                    .map(|(a, b)| a * b)
                    .sum();
                assert!((sum - exact).abs() < 1e-8, "{d} {n}: {sum} {exact}");
            }
        }
        let mut derivatives = vec![[0.0; LANES]; 12];
        modes.at(0.0, &mut integrals.get_disjoint_mut([0..4, 4..8, 8..12]).unwrap());
        modes.derivatives(1.0, &mut derivatives);
        for (a, b) in derivatives.as_flattened().iter().zip(integrals.as_flattened()) {
            assert!((a - b).abs() < 1e-12 * (1.0 + a.abs()), "{a} {b}");
        }
    }

    /// The fit is one of g'; what it misses of g is the integral of what it misses of g', and at most its area.
    #[test]
    fn heights_are_as_near_as_the_area_of_the_error_of_slopes() {
        for wanted in [1e-5, 1e-8, 1e-11] {
            let tip = TipFunction::default();
            let fit = Fit::new(&tip, wanted, Retreat::Small).unwrap();
            for i in 0..3000 {
                let xi = 0.005 * f64::from(i) - fit.retreat();
                let term = |term: &crate::memory::Term| {
                    (term.weight / term.exponent * (term.exponent * xi).exp()).re
                };
                let error = (fit.terms().iter().map(term).sum::<f64>() - tip.value(xi)).abs();
                let area = fit.certificate().area;
                assert!(error <= area + 1e-14, "{xi}: {error:e} {area:e}");
            }
        }
    }
}
