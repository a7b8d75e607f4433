//! The pasts of several motions as states of the same exponentials, `z_j = ∫ e^{s_j (x_tip - x0(t'))}dt'`.

use super::super::series::MOST_ORDER;
use super::super::visits::{MOST_NODES, Rule};
use super::lanes::{LANES, Lanes};
use crate::elementary::{complex_exp, inverse_factorials};
use crate::memory::{Fit, HIGHEST_DEGREE, LOWEST_DEGREE, Term, expansion_lengths};
use num_complex::Complex;

/// Quantities that follow from the exponentials alone.
pub(super) struct Exponentials {
    terms: Vec<Term>,
    /// `Re w_j s_j^{n-1}` and `-Im w_j s_j^{n-1}`, n = 1, 2, …: the factors of `Re z_j` and `Im z_j` in the n-th
    /// derivative.
    derivatives: Vec<[[f64; ROOM]; 2]>,
    /// `s_j^m`
    powers: Vec<[[f64; 2]; HIGHEST_DEGREE + 1]>,
    /// Largest distance at which a polynomial of each degree represents all exponentials.
    lengths: Vec<f64>,
    /// Derivatives of f at 0 on the side of the past, from the first on.
    pub(super) of_tip: [f64; MOST_ORDER],
}

/// Number of derivatives that are summed together, small for the same reason as the block in `expansion`, and room for
/// whole blocks of derivatives.
const AT_ONCE: usize = 6;
const ROOM: usize = MOST_ORDER.next_multiple_of(AT_ONCE);

const INVERSE_FACTORIALS: [f64; HIGHEST_DEGREE + 1] = inverse_factorials();

impl Exponentials {
    pub(super) fn new(fit: &Fit) -> Self {
        let terms = fit.terms().to_vec();
        let counts = |term: &Term| {
            let powers: [[f64; 2]; ROOM] = powers_of(term.exponent, term.weight);
            [powers.map(|[re, _]| re), powers.map(|[_, im]| -im)]
        };
        let derivatives: Vec<[[f64; ROOM]; 2]> = terms.iter().map(counts).collect();
        let sum = |n: usize| derivatives.iter().map(|[re, _]| re[n]).sum();
        Self {
            powers: terms.iter().map(|term| powers_of(term.exponent, Complex::ONE)).collect(),
            lengths: expansion_lengths(&terms, fit.wanted()),
            of_tip: std::array::from_fn(sum),
            derivatives,
            terms,
        }
    }

    /// States after a steady motion of this velocity that ended at the distance `ahead` in front of the tip.
    pub(super) fn steady(&self, velocity: f64, ahead: f64) -> impl Iterator<Item = Complex<f64>> {
        self.terms.iter().map(move |Term { exponent, .. }| {
            -complex_exp(-exponent * ahead) / (velocity * exponent)
        })
    }

    /// Largest distance of the ends of a stretch from its middle.
    pub(super) fn longest(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// The degrees of polynomials that represent all exponentials within each `radius`, and the highest of them.
    #[inline(always)]
    fn degrees(&self, radius: Lanes) -> (Lanes, usize) {
        let mut degrees = Lanes::all(LOWEST_DEGREE as f64);
        for length in &self.lengths[..HIGHEST_DEGREE - LOWEST_DEGREE] {
            for lane in 0..LANES {
                degrees.0[lane] += if *length < radius.0[lane] { 1.0 } else { 0.0 };
            }
        }
        let highest = degrees.0.into_iter().fold(0.0, f64::max);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a degree")]
        (degrees, highest as usize)
    }
}

/// `factor s^m`, m = 0, 1, …
fn powers_of<const N: usize>(s: Complex<f64>, factor: Complex<f64>) -> [[f64; 2]; N] {
    let mut power = factor;
    std::array::from_fn(|_| {
        let here = [power.re, power.im];
        power *= s;
        here
    })
}

/// The states of all motions.
pub(super) struct Past {
    /// Real and imaginary part of each state.
    states: Vec<[Lanes; 2]>,
    /// Room for the results of [`moments_about`].
    moments: Box<[[Lanes; 2]; HIGHEST_DEGREE + 1]>,
    /// Room for the visits of a step: displacements of the tip, times spent, and distances from the middle of a stretch.
    positions: Box<Nodes>,
    weights: Box<Nodes>,
    off: Box<Nodes>,
}

/// Visits of a step of length 1, with a rule for each motion. Nodes beyond those of the rule have weight 0.
pub(super) struct Visits {
    rules: [Option<&'static Rule>; LANES],
    count: usize,
    parts: Nodes,
    weights: Nodes,
}

/// Number of nodes that are summed together.
const BLOCK: usize = 4;
type Nodes = [Lanes; MOST_NODES];

impl Visits {
    pub(super) fn none() -> Self {
        let nothing = [Lanes::ZERO; MOST_NODES];
        Self { rules: [None; LANES], count: 0, parts: nothing, weights: nothing }
    }

    /// Sets the visits of a lane to those of a rule; in most steps they are set already.
    pub(super) fn set(&mut self, lane: usize, rule: &'static Rule) {
        let before = self.rules[lane].replace(rule);
        if before.is_some_and(|before| std::ptr::eq(before, rule)) {
            return;
        }
        self.count = self.rules.iter().flatten().map(|rule| rule.nodes.len()).max().unwrap_or(0);
        let nothing = std::iter::repeat((&0.0, &0.0));
        let of_rule = rule.nodes.iter().zip(&rule.weights).chain(nothing);
        let most = before.map_or(MOST_NODES, |before| before.nodes.len().max(rule.nodes.len()));
        let places = self.parts[..most].iter_mut().zip(&mut self.weights);
        for ((part, weight), (node, of_node)) in places.zip(of_rule) {
            (part.0[lane], weight.0[lane]) = (*node, *of_node);
        }
    }
}

impl Past {
    pub(super) fn nothing(exponentials: &Exponentials) -> Self {
        let room = || Box::new([Lanes::ZERO; MOST_NODES]);
        Self {
            states: vec![[Lanes::ZERO; 2]; exponentials.terms.len()],
            moments: Box::new([[Lanes::ZERO; 2]; HIGHEST_DEGREE + 1]),
            positions: room(),
            weights: room(),
            off: room(),
        }
    }

    pub(super) fn set(&mut self, lane: usize, states: impl Iterator<Item = Complex<f64>>) {
        for ([re, im], state) in self.states.iter_mut().zip(states) {
            (re.0[lane], im.0[lane]) = (state.re, state.im);
        }
    }

    /// Derivatives of the grooves under the tips, from the first on, times these factors.
    #[inline(always)]
    pub(super) fn derivatives(&self, of: &Exponentials, factor: Lanes, into: &mut [Lanes]) {
        for (block, into) in into.chunks_mut(AT_ONCE).enumerate() {
            let mut sums = [Lanes::ZERO; AT_ONCE];
            for (parts, counts) in self.states.iter().zip(&of.derivatives) {
                for (part, counts) in parts.iter().zip(counts) {
                    let counts = &counts.as_chunks::<AT_ONCE>().0[block];
                    for (sum, count) in sums.iter_mut().zip(counts) {
                        *sum += *part * *count;
                    }
                }
            }
            for (entry, sum) in into.iter_mut().zip(sums) {
                *entry = sum * factor;
            }
        }
    }

    /// Advances the states by steps of these lengths. The displacements are series in the elapsed fraction of the step.
    /// Each step is divided into stretches on which the exponentials can be expanded.
    #[inline(always)]
    pub(super) fn remember(
        &mut self,
        of: &Exponentials,
        displacement: &[Lanes],
        (visits, length): (&Visits, Lanes),
    ) {
        positions_at(displacement, &visits.parts, &mut self.positions, visits.count);
        let mut end = Lanes::ZERO;
        displacement.iter().for_each(|coefficient| end += *coefficient);
        if end.0.iter().all(|end| !Stretch::is_beyond(*end, 0.0, of.longest())) {
            self.set_weights(visits, length);
            self.carry(of, visits.count, (Lanes::ZERO, end));
            return;
        }
        let mut stretches = [Stretch { start: 0.0, end: 0.0, nodes: (0, 0) }; LANES];
        for _ in 0..MOST_STRETCHES {
            let (mut from, mut to, mut more) = (Lanes::ZERO, Lanes::ZERO, false);
            self.set_weights(visits, length);
            for (lane, stretch) in stretches.iter_mut().enumerate() {
                let positions = (&*self.positions, visits.count);
                *stretch = stretch.next(of.longest(), lane, positions, end.0[lane]);
                more |= stretch.end.to_bits() != end.0[lane].to_bits();
                (from.0[lane], to.0[lane]) = (stretch.start, stretch.end);
                let others = (0..stretch.nodes.0).chain(stretch.nodes.1..visits.count);
                others.for_each(|node| self.weights[node].0[lane] = 0.0);
            }
            self.carry(of, visits.count, (from, to));
            if !more {
                break;
            }
        }
    }

    /// The times spent at the visits; 0 at nodes that only complete the last block.
    #[inline(always)]
    fn set_weights(&mut self, visits: &Visits, length: Lanes) {
        // By blocks, or else compilers make vectors of visits instead of lanes.
        let weights = self.weights.as_chunks_mut::<BLOCK>().0.iter_mut();
        let blocks = weights.zip(visits.weights.as_chunks::<BLOCK>().0);
        for (weights, of_nodes) in blocks.take(visits.count.div_ceil(BLOCK)) {
            for (weight, of_node) in weights.iter_mut().zip(of_nodes) {
                *weight = *of_node * length;
            }
        }
    }

    /// Advances the states of each motion by a stretch between these displacements. Visits elsewhere have weight 0.
    #[inline(always)]
    fn carry(&mut self, of: &Exponentials, count: usize, (start, end): (Lanes, Lanes)) {
        let (middle, half) = ((start + end) * 0.5, (end - start) * 0.5);
        let (weights, blocks) = (&self.weights, count.div_ceil(BLOCK));
        let mut radius = half.map(f64::abs);
        let visits = self.positions.iter().zip(weights.iter());
        for (off, (position, weight)) in self.off[..blocks * BLOCK].iter_mut().zip(visits) {
            // What counts for nothing may be anywhere.
            *off = (middle - *position).where_positive(*weight);
            radius = radius.larger(off.map(f64::abs));
        }
        let (degrees, degree) = of.degrees(radius);
        let moments = &mut self.moments[..=degree];
        moments_about(half, (&self.off, weights), blocks, (degrees, moments));
        for (state, powers) in self.states.iter_mut().zip(&of.powers) {
            carry(state, &powers[..=degree], moments);
        }
    }
}

/// A part of a step: displacements of the tip at its start and end, and the range of the visits in it.
#[derive(Debug, Clone, Copy)]
struct Stretch {
    start: f64,
    end: f64,
    nodes: (usize, usize),
}

/// Largest number of stretches of a step.
pub(super) const MOST_STRETCHES: usize = 8;

impl Stretch {
    /// Whether the displacement `end` is beyond the stretch that begins at `start`.
    fn is_beyond(end: f64, start: f64, longest: f64) -> bool {
        end > start + 2.0 * longest
    }

    /// The next stretch: up to the end of the step, or of length 2 `longest`.
    #[inline(always)]
    fn next(
        self,
        longest: f64,
        lane: usize,
        (positions, count): (&Nodes, usize),
        end: f64,
    ) -> Self {
        let (start, first) = (self.end, self.nodes.1);
        if !Self::is_beyond(end, start, longest) {
            return Self { start, end, nodes: (first, count) };
        }
        let farthest = start + 2.0 * longest;
        let is_within = |at: &Lanes| at.0[lane] <= farthest;
        let within = positions[first..count].iter().take_while(|at| is_within(at)).count();
        Self { start, end: farthest, nodes: (first, first + within) }
    }
}

/// The positions of the first `count` visits, by Horner's rule for three at a time: with four, compilers make vectors
/// of visits instead of lanes.
#[inline(always)]
fn positions_at(series: &[Lanes], parts: &Nodes, into: &mut Nodes, count: usize) {
    const CHAINS: usize = 3;
    let (parts, _) = parts[..count.next_multiple_of(CHAINS)].as_chunks::<CHAINS>();
    for (parts, into) in parts.iter().zip(into.as_chunks_mut::<CHAINS>().0) {
        let mut values = [Lanes::ZERO; CHAINS];
        for coefficient in series.iter().rev() {
            for (value, part) in values.iter_mut().zip(parts) {
                *value = *value * *part + *coefficient;
            }
        }
        *into = values;
    }
}

/// `half^m/m!` and `Σ_k weight_k off_k^m/m!`: coefficients of the powers of s in e^{s half} and in the contribution of
/// the visits; 0 beyond the degree of a lane.
#[inline(always)]
fn moments_about(
    half: Lanes,
    (off, weights): (&Nodes, &Nodes),
    blocks: usize,
    (degrees, into): (Lanes, &mut [[Lanes; 2]]),
) {
    into.fill([Lanes::ZERO; 2]);
    let (off, weights) = (off.as_chunks::<BLOCK>().0, weights.as_chunks::<BLOCK>().0);
    for (off, terms) in off[..blocks].iter().zip(weights) {
        let mut terms = *terms;
        for [_, moment] in into.iter_mut() {
            *moment += (terms[0] + terms[1]) + (terms[2] + terms[3]);
            for (term, off) in terms.iter_mut().zip(off) {
                *term *= *off;
            }
        }
    }
    let (mut power, mut left) = (Lanes::all(1.0), degrees);
    for ([carried, moment], inverse) in into.iter_mut().zip(INVERSE_FACTORIALS) {
        let inverse = left.map(|left| if left < 0.0 { 0.0 } else { inverse });
        (*carried, *moment) = (power * inverse, *moment * inverse);
        power *= half;
        left = left - Lanes::all(1.0);
    }
}

/// With E = e^{s half} and the contribution N of the visits, z becomes E (E z + N).
#[inline(always)]
fn carry(state: &mut [Lanes; 2], powers: &[[f64; 2]], moments: &[[Lanes; 2]]) {
    let zero = [Lanes::ZERO; 2];
    let (mut e, mut new) = (zero, zero);
    for (power, [carried, moment]) in powers.iter().zip(moments) {
        for part in 0..2 {
            e[part] += *carried * power[part];
            new[part] += *moment * power[part];
        }
    }
    let turned = product(e, *state);
    *state = product(e, [turned[0] + new[0], turned[1] + new[1]]);
}

#[inline(always)]
fn product(a: [Lanes; 2], b: [Lanes; 2]) -> [Lanes; 2] {
    [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TipFunction;
    use crate::memory::Retreat;

    /// Judged by the definition: ∫ f⁽ⁿ⁾ over all that was visited, each e^{s x} by itself. Steps of several lengths, of which
    /// some lead farther than any expansion, side by side.
    #[test]
    fn a_state_is_the_sum_over_all_visits() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let fit = Fit::new(&tip, 1e-11, Retreat::Small).unwrap();
        let of = Exponentials::new(&fit);
        let rules = crate::integrator::taylor::visits::Visits::new(tip.band(), 1e-12);
        let mut past = Past::nothing(&of);
        past.set(3, of.steady(1.3, 0.2));
        let mut visited: [Vec<(f64, f64)>; LANES] = std::array::from_fn(|_| vec![]);
        let mut tips = [0.0; LANES];
        for step in 0..12 {
            // x = a τ + b τ²
            let ahead = |lane: usize| 0.02 + 0.2 * ((lane + step) % LANES) as f64;
            let bend = |lane: usize| 0.01 * lane as f64;
            let displacement =
                [Lanes::ZERO, Lanes(std::array::from_fn(ahead)), Lanes(std::array::from_fn(bend))];
            let mut visits = Visits::none();
            for lane in 0..LANES {
                let rule = rules.rule(ahead(lane) + bend(lane), 0.0).unwrap();
                visits.set(lane, rule);
                for (node, weight) in rule.nodes.iter().zip(&rule.weights) {
                    let at = ahead(lane) * node + bend(lane) * node * node;
                    visited[lane].push((tips[lane] + at, 0.7 * weight));
                }
                tips[lane] += ahead(lane) + bend(lane);
            }
            past.remember(&of, &displacement, (&visits, Lanes::all(0.7)));
        }
        let mut told = [Lanes::ZERO; 6];
        past.derivatives(&of, Lanes::all(2.0), &mut told);
        for lane in 0..LANES {
            let mut sums = [0.0; 6];
            for term in fit.terms() {
                let one = |(x, weight): &(f64, f64)| {
                    complex_exp(term.exponent * (tips[lane] - x)) * weight
                };
                let mut state: Complex<f64> = visited[lane].iter().map(one).sum();
                if lane == 3 {
                    // ∫_0^∞ e^{s (x - 0.2 + 1.3 τ)}dτ
                    state -=
                        complex_exp(term.exponent * (tips[lane] - 0.2)) / (1.3 * term.exponent);
                }
                for (n, sum) in sums.iter_mut().enumerate() {
                    *sum += 2.0 * (term.weight * term.exponent.powu(n as u32) * state).re;
                }
            }
            for (n, sum) in sums.into_iter().enumerate() {
                let off = (told[n].0[lane] - sum).abs();
                assert!(off < 3e-12 * 8.0_f64.powi(n as i32), "{lane} {n}: {off:e}");
            }
        }
    }
}
