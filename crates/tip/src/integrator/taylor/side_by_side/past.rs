//! The pasts of several motions as states of the same exponentials, `z_j = ∫ e^{s_j (x_tip - x0(t'))}dt'`.

use super::super::series::MOST_ORDER;
use super::lanes::{LANES, Lanes};
use super::series::{OwnGroove, own_groove};
use crate::elementary::{complex_exp, inverse_factorials};
use crate::memory::{
    Fit, HIGHEST_DEGREE, LOWEST_DEGREE, ROOM as DERIVATIVES, Term, expansion_lengths,
};
use num_complex::Complex;

/// Quantities that follow from the exponentials alone.
pub(super) struct Exponentials {
    terms: Vec<Term>,
    /// `Re w_j s_j^n/n!` and `-Im w_j s_j^n/n!`, n = 0, 1, …: the factors of `Re z_j` and `Im z_j` in the n-th coefficient
    /// of the slope.
    slopes: Vec<[[f64; ROOM]; 2]>,
    /// `s_j^m`
    powers: Vec<[[f64; 2]; HIGHEST_DEGREE + 1]>,
    /// Largest distance at which a polynomial of each degree represents all exponentials.
    lengths: Vec<f64>,
    /// Derivatives of f at 0 on the side of the past; f itself, at index 0, is not needed.
    pub(super) of_tip: [f64; DERIVATIVES],
    /// Factors for the groove that a step itself makes.
    pub(super) own: Box<OwnGroove>,
    /// For each stretch of a step.
    means: Vec<Means>,
}

/// For a stretch with the middle c, where q is the covered fraction of a step: `(k+1) ∫ (c - q)^m q^k dq` at row m, index
/// k.
type Means = [[f64; MOST_ORDER]; MOMENTS];

/// Number of derivatives or moments that are summed together, small for the same reason as the block in `series`, and
/// room for whole blocks of them.
const AT_ONCE: usize = 6;
const ROOM: usize = MOST_ORDER.next_multiple_of(AT_ONCE);
const BLOCK: usize = 4;
const MOMENTS: usize = (HIGHEST_DEGREE + 1).next_multiple_of(BLOCK);

const INVERSE_FACTORIALS: [f64; HIGHEST_DEGREE + 1] = inverse_factorials();

/// A step is divided into as many equal stretches as allow this displacement. Steps of slips and sticks are rarely longer,
/// and more stretches take more time in each.
const NEEDED: f64 = 1.4;
const MOST_STRETCHES: usize = 4;

impl Exponentials {
    pub(super) fn new(fit: &Fit) -> Self {
        let terms = fit.terms().to_vec();
        let factors = |term: &Term| -> [[f64; 2]; ROOM] { powers_of(term.exponent, term.weight) };
        let factors: Vec<_> = terms.iter().map(factors).collect();
        let mut of_tip = [0.0; DERIVATIVES];
        for (n, derivative) in of_tip.iter_mut().enumerate().skip(1).take(ROOM) {
            *derivative = factors.iter().map(|factors| factors[n - 1][0]).sum();
        }
        let slopes = factors.iter().map(|factors| {
            let mut over = 1.0;
            let mut slopes = [[0.0; ROOM]; 2];
            for (n, [re, im]) in factors.iter().enumerate() {
                over *= n.max(1) as f64;
                (slopes[0][n], slopes[1][n]) = (re / over, -im / over);
            }
            slopes
        });
        let mut new = Self {
            slopes: slopes.collect(),
            powers: terms.iter().map(|term| powers_of(term.exponent, Complex::ONE)).collect(),
            lengths: expansion_lengths(&terms, fit.wanted()),
            own: own_groove(&of_tip),
            of_tip,
            means: vec![],
            terms,
        };
        let enough = |count: &usize| 2.0 * *count as f64 * new.longest() >= NEEDED;
        let count = (1..MOST_STRETCHES).find(enough).unwrap_or(MOST_STRETCHES);
        new.means = (0..count).map(|stretch| means(stretch, count as f64)).collect();
        new
    }

    /// States after a steady motion of this velocity that ended at the distance `ahead` in front of the tip.
    pub(super) fn steady(&self, velocity: f64, ahead: f64) -> impl Iterator<Item = Complex<f64>> {
        self.terms.iter().map(move |Term { exponent, .. }| {
            -complex_exp(-exponent * ahead) / (velocity * exponent)
        })
    }

    /// States after visits at these distances behind the tip, which took these times.
    pub(super) fn visited(&self, visits: &[(f64, f64)]) -> impl Iterator<Item = Complex<f64>> {
        self.terms.iter().map(|Term { exponent, .. }| {
            visits.iter().map(|(behind, time)| complex_exp(exponent * behind) * time).sum()
        })
    }

    /// Largest displacement in a step.
    pub(super) fn farthest(&self) -> f64 {
        2.0 * self.means.len() as f64 * self.longest()
    }

    /// Largest distance of the ends of a stretch from its middle.
    fn longest(&self) -> f64 {
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

/// The means over one of `count` equal stretches, by `m_{m,k+1} = c m_{m,k} - m_{m+1,k}`, where no digits are lost.
fn means(stretch: usize, count: f64) -> Means {
    let (middle, half) = ((stretch as f64 + 0.5) / count, 0.5 / count);
    let of_even = |m: usize| 2.0 * half.powi(m as i32 + 1) / (m + 1) as f64;
    let first = |m: usize| if m.is_multiple_of(2) { of_even(m) } else { 0.0 };
    let mut column: Vec<f64> = (0..MOMENTS + MOST_ORDER).map(first).collect();
    let mut means = [[0.0; MOST_ORDER]; MOMENTS];
    for k in 0..MOST_ORDER {
        for (row, mean) in means.iter_mut().zip(&column) {
            row[k] = (k + 1) as f64 * mean;
        }
        column = column.windows(2).map(|pair| middle * pair[0] - pair[1]).collect();
    }
    means
}

/// The states of all motions.
pub(super) struct Past {
    /// Real and imaginary part of each state.
    states: Vec<[Lanes; 2]>,
    /// Room for the coefficients of the powers of s in `e^{s half}`, where `half` is half the length of a stretch, and in
    /// the contribution of each stretch.
    carried: Box<[Lanes; MOMENTS]>,
    moments: Vec<[Lanes; MOMENTS]>,
}

impl Past {
    pub(super) fn nothing(exponentials: &Exponentials) -> Self {
        Self {
            states: vec![[Lanes::ZERO; 2]; exponentials.terms.len()],
            carried: Box::new([Lanes::ZERO; MOMENTS]),
            moments: vec![[Lanes::ZERO; MOMENTS]; exponentials.means.len()],
        }
    }

    pub(super) fn set(&mut self, lane: usize, states: impl Iterator<Item = Complex<f64>>) {
        for ([re, im], state) in self.states.iter_mut().zip(states) {
            (re.0[lane], im.0[lane]) = (state.re, state.im);
        }
    }

    /// Coefficients of the slopes of the grooves about the tips, times these factors.
    #[inline(always)]
    pub(super) fn slopes(&self, of: &Exponentials, factor: Lanes, into: &mut [Lanes]) {
        for (block, into) in into.chunks_mut(AT_ONCE).enumerate() {
            let mut sums = [Lanes::ZERO; AT_ONCE];
            for (parts, counts) in self.states.iter().zip(&of.slopes) {
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

    /// Advances the states by displacements of these lengths. The times are series in the covered fraction of the step.
    /// With E = e^{s half} and the contribution N of a stretch, z becomes E (E z + N).
    #[inline(always)]
    pub(super) fn remember(&mut self, of: &Exponentials, time: &[Lanes], length: Lanes) {
        let half = length * (0.5 / of.means.len() as f64);
        let (degrees, degree) = of.degrees(half);
        let mut of_length = [Lanes::ZERO; MOMENTS];
        self.set_powers(&mut of_length[..=degree], (half, length), degrees);
        for (moments, means) in self.moments.iter_mut().zip(&of.means) {
            set_moments(moments, time, means, &of_length[..=degree]);
        }
        for (state, powers) in self.states.iter_mut().zip(&of.powers) {
            let powers = &powers[..=degree];
            let e = polynomial(powers, &self.carried);
            for moments in &self.moments {
                let new = polynomial(powers, moments);
                let turned = product(e, *state);
                *state = product(e, [turned[0] + new[0], turned[1] + new[1]]);
            }
        }
    }

    /// Sets `half^m/m!`, and in `of_length` `length^m/m!`; 0 beyond the degree of a lane.
    #[inline(always)]
    fn set_powers(
        &mut self,
        of_length: &mut [Lanes],
        (half, length): (Lanes, Lanes),
        degrees: Lanes,
    ) {
        let (mut of_half, mut power, mut left) = (Lanes::all(1.0), Lanes::all(1.0), degrees);
        let both = self.carried.iter_mut().zip(of_length);
        for ((carried, of_length), inverse) in both.zip(INVERSE_FACTORIALS) {
            let inverse = left.map(|left| if left < 0.0 { 0.0 } else { inverse });
            (*carried, *of_length) = (of_half * inverse, power * inverse);
            of_half *= half;
            power *= length;
            left = left - Lanes::all(1.0);
        }
    }
}

/// Sets `∫(c - x)^m/m! t'(x)dx` over a stretch with the middle c: the coefficients of the powers of s in its contribution.
#[inline(always)]
fn set_moments(moments: &mut [Lanes; MOMENTS], time: &[Lanes], means: &Means, of_length: &[Lanes]) {
    let blocks = moments.as_chunks_mut::<BLOCK>().0.iter_mut().zip(means.as_chunks::<BLOCK>().0);
    for ((moments, means), of_length) in blocks.zip(of_length.chunks(BLOCK)) {
        let mut sums = [Lanes::ZERO; BLOCK];
        for (k, time) in time[1..].iter().enumerate() {
            for (sum, means) in sums.iter_mut().zip(means) {
                *sum += *time * means[k];
            }
        }
        for ((moment, sum), of_length) in moments.iter_mut().zip(sums).zip(of_length) {
            *moment = sum * *of_length;
        }
    }
}

#[inline(always)]
fn polynomial(powers: &[[f64; 2]], coefficients: &[Lanes; MOMENTS]) -> [Lanes; 2] {
    let mut sums = [Lanes::ZERO; 2];
    for (power, coefficient) in powers.iter().zip(coefficients) {
        for part in 0..2 {
            sums[part] += *coefficient * power[part];
        }
    }
    sums
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

    /// Judged by the definition: ∫ f⁽ⁿ⁾ over all that was visited, each e^{s x} by itself. Steps of several lengths side by
    /// side, up to the longest in one stretch and in several.
    #[test]
    fn a_state_is_the_integral_over_all_visits() {
        let tip = TipFunction::triple_gaussian(1.0, 1.0).unwrap();
        let mut stretches = vec![];
        for accuracy in [1e-7, 1e-11, 1e-13] {
            let fit = Fit::new(&tip, accuracy, Retreat::Small).unwrap();
            let of = Exponentials::new(&fit);
            stretches.push(of.means.len());
            let rule = crate::integrator::taylor::visits::last();
            let mut past = Past::nothing(&of);
            past.set(3, of.steady(1.3, 0.2));
            let mut visited: [Vec<(f64, f64)>; LANES] = std::array::from_fn(|_| vec![]);
            let mut tips = [0.0; LANES];
            for step in 0..12 {
                let length = |lane: usize| {
                    (of.farthest() / LANES as f64) * (1 + (lane + step) % LANES) as f64
                };
                // t = a q + b q²
                let slow = |lane: usize| 0.02 + 0.2 * ((lane + step) % LANES) as f64;
                let bend = |lane: usize| 0.01 * lane as f64;
                for lane in 0..LANES {
                    for (q, weight) in rule.nodes.iter().zip(&rule.weights) {
                        let time = (slow(lane) + 2.0 * bend(lane) * q) * weight;
                        visited[lane].push((tips[lane] + q * length(lane), time));
                    }
                    tips[lane] += length(lane);
                }
                let lanes = |of: &dyn Fn(usize) -> f64| Lanes(std::array::from_fn(of));
                let time = [Lanes::ZERO, lanes(&slow), lanes(&bend)];
                past.remember(&of, &time, lanes(&length));
            }
            let mut found = [Lanes::ZERO; 6];
            past.slopes(&of, Lanes::all(2.0), &mut found);
            for lane in 0..LANES {
                for (n, found) in found.iter().enumerate() {
                    let mut sum = 0.0;
                    for (j, term) in fit.terms().iter().enumerate() {
                        let behind: Vec<_> =
                            visited[lane].iter().map(|(x, time)| (tips[lane] - x, *time)).collect();
                        let mut state = of.visited(&behind).nth(j).unwrap();
                        if lane == 3 {
                            // ∫_0^∞ e^{s (x - 0.2 + 1.3 τ)}dτ
                            state -= complex_exp(term.exponent * (tips[lane] - 0.2))
                                / (1.3 * term.exponent);
                        }
                        sum += 2.0 * (term.weight * term.exponent.powu(n as u32) * state).re;
                    }
                    let off = (found.0[lane] * (1..=n).product::<usize>() as f64 - sum).abs();
                    let allowed = (0.3 * accuracy).max(1e-13) * 8.0_f64.powi(n as i32);
                    assert!(off < allowed, "{accuracy:e}, {lane} {n}: {off:e}");
                }
            }
        }
        assert!(stretches[0] == 1 && stretches[2] > 1, "{stretches:?}");
    }
}
