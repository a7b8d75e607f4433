//! The history of a periodic motion, as a sum of exponentials.

use super::carved::Carved;
use super::orbit::Orbit;
use num_complex::Complex;
use std::cell::Cell;
use stickslip_tip::collocation::{STAGES, Stages};
use stickslip_tip::elementary::complex_exp;
use stickslip_tip::exponential::with_inverses;
use stickslip_tip::memory::{Fit, Term};
use stickslip_tip::stop;

/// ζ at the ends of all steps of an orbit, and the exponentials at their stages.
pub(super) struct Past<'a> {
    terms: &'a [Term],
    /// By step and term.
    numbers: Numbers,
    /// Weights and decay by step.
    carved: &'a [Carved],
}

/// Exponentials for all steps and terms: some hundred kilobytes, written at every linearisation.
#[derive(Default)]
struct Numbers {
    /// `e^{s_j d_i}`
    exponentials: Vec<[Complex<f64>; STAGES]>,
    /// `e^{-s_j d_i}` of the last few steps.
    inverses: Vec<[Complex<f64>; STAGES]>,
    /// `ζ_j` at the starts of the steps and at the end of the last one; before it is known, `Δζ_j` of each step in place of
    /// its end.
    zeta: Vec<Complex<f64>>,
}

thread_local! {
    /// The memory of the last history, for the next one: a new allocation takes longer than writing to it.
    static EARLIER: Cell<Numbers> = Cell::default();
}

/// Number of steps whose exponentials are computed together.
const TOGETHER: usize = 16;

/// Room, in steps times terms, for nearly all cycles: memory that is never written costs nothing.
const USUAL_ROOM: usize = 1 << 15;

impl Numbers {
    /// Empty, with room for this number of steps and terms.
    fn with_room(count: usize) -> Self {
        let mut numbers = EARLIER.take();
        if numbers.exponentials.capacity() < count {
            // A vector that grew would copy what is not needed any more.
            let room = USUAL_ROOM.max(count.next_power_of_two());
            numbers = Self {
                exponentials: Vec::with_capacity(room),
                inverses: numbers.inverses,
                zeta: Vec::with_capacity(room),
            };
        }
        numbers.exponentials.clear();
        numbers.zeta.clear();
        numbers
    }
}

/// The groove of the history at the stages of all steps.
pub(super) struct Grooves {
    /// Its slope, divided by α.
    slopes: Vec<Stages>,
    /// Its height, divided by -α; empty without a depth limit.
    heights: Vec<Stages>,
    /// Its slope at the start of the period, divided by α.
    pub(super) at_start: f64,
}

/// The groove of the history at the stages of one step, as in [`Grooves`].
#[derive(Clone, Copy)]
pub(super) struct GrooveOfStep<'a> {
    pub(super) slope: &'a Stages,
    pub(super) height: Option<&'a Stages>,
}

/// The history in one step.
#[derive(Clone, Copy)]
pub(super) struct PastOfStep<'a> {
    pub(super) terms: &'a [Term],
    /// `e^{s_j d_i}`
    pub(super) exponentials: &'a [[Complex<f64>; STAGES]],
    /// ζ at the start of the step.
    pub(super) zeta: &'a [Complex<f64>],
    /// ζ at the end of the step.
    pub(super) after: &'a [Complex<f64>],
    /// Decay factors at the nodes for contributions from before the step.
    left: &'a Stages,
}

impl<'a> Past<'a> {
    /// The history of a periodic orbit; `None` after a request to stop. `carved` contains the weights and the decay of each
    /// step.
    ///
    /// Over a step of length h ζ becomes `e^{s d_s} (ζ e^{-h/T} + w Σ_k b_k e^{-s d_k})`, with the healing time T; after a
    /// period it must be the same again.
    pub(super) fn of(fit: &'a Fit, (orbit, carved): (&Orbit, &'a [Carved])) -> Option<Self> {
        let terms = fit.terms();
        let count = orbit.stages.len() * terms.len();
        let mut numbers = Numbers::with_room(count);
        let Numbers { exponentials, inverses, zeta } = &mut numbers;
        zeta.resize(terms.len(), Complex::ZERO);
        for (steps, carved) in orbit.stages.chunks(TOGETHER).zip(carved.chunks(TOGETHER)) {
            if stop::is_requested() {
                return None;
            }
            let from = exponentials.len();
            for d in steps {
                exponentials.extend(terms.iter().map(|term| d.map(|d| term.exponent * d)));
            }
            let exponentials = &mut exponentials[from..];
            inverses.clear();
            inverses.extend_from_slice(exponentials);
            with_inverses(exponentials.as_flattened_mut(), inverses.as_flattened_mut());
            for (carved, inverses) in carved.iter().zip(inverses.chunks_exact(terms.len())) {
                let [stays, ..] = carved.at_end();
                let of_term = |(term, inverse): (&Term, &[Complex<f64>; STAGES])| {
                    term.weight * spent_in(inverse, &stays) * carved.times
                };
                zeta.extend(terms.iter().zip(inverses).map(of_term));
            }
        }
        let mut past = Self { terms, numbers, carved };
        let added = past.of_one_period();
        let moved: f64 = orbit.stages.iter().map(|d| d[STAGES - 1]).sum();
        let kept: f64 = carved.iter().map(|carved| carved.left()[STAGES - 1]).product();
        for ((start, added), term) in past.numbers.zeta.iter_mut().zip(added).zip(terms) {
            *start = added / (1.0 - complex_exp(term.exponent * moved) * kept);
        }
        past.follow();
        Some(past)
    }

    /// ζ at the end of a period without a history.
    fn of_one_period(&self) -> Vec<Complex<f64>> {
        let count = self.terms.len();
        let mut zeta = vec![Complex::ZERO; count];
        let Numbers { exponentials, zeta: spent, .. } = &self.numbers;
        let steps = exponentials.chunks_exact(count).zip(spent[count..].chunks_exact(count));
        for ((exponentials, spent), carved) in steps.zip(self.carved) {
            let left = carved.left()[STAGES - 1];
            for ((zeta, e), spent) in zeta.iter_mut().zip(exponentials).zip(spent) {
                *zeta = e[STAGES - 1] * (*zeta * left + spent);
            }
        }
        zeta
    }

    /// Replaces the contributions of the steps by ζ at their ends, from ζ at the start of the period.
    fn follow(&mut self) {
        let count = self.terms.len();
        let Numbers { exponentials, zeta, .. } = &mut self.numbers;
        let steps = exponentials.chunks_exact(count).zip(self.carved);
        for (n, (exponentials, carved)) in steps.enumerate() {
            let (before, after) = zeta[n * count..].split_at_mut(count);
            let left = carved.left()[STAGES - 1];
            for ((after, before), e) in after.iter_mut().zip(before).zip(exponentials) {
                *after = e[STAGES - 1] * (*before * left + *after);
            }
        }
    }

    /// The groove at all stages, with heights if wanted.
    pub(super) fn grooves(&self, with_heights: bool) -> Grooves {
        let steps = || (0..self.carved.len()).map(|n| self.of_step(n));
        Grooves {
            slopes: steps().map(|step| step.slope()).collect(),
            heights: steps().filter(|_| with_heights).map(|step| step.height()).collect(),
            at_start: self.numbers.zeta[..self.terms.len()].iter().map(|z| z.re).sum(),
        }
    }

    pub(super) fn of_step(&self, n: usize) -> PastOfStep<'_> {
        let of = |n: usize| n * self.terms.len()..(n + 1) * self.terms.len();
        PastOfStep {
            terms: self.terms,
            exponentials: &self.numbers.exponentials[of(n)],
            zeta: &self.numbers.zeta[of(n)],
            after: &self.numbers.zeta[of(n + 1)],
            left: self.carved[n].left(),
        }
    }
}

impl Grooves {
    pub(super) fn of_step(&self, n: usize) -> GrooveOfStep<'_> {
        GrooveOfStep { slope: &self.slopes[n], height: self.heights.get(n) }
    }
}

/// `Σ_k b_k e^{-s d_k}`
fn spent_in(inverse: &[Complex<f64>; STAGES], b: &Stages) -> Complex<f64> {
    let mut sum = [0.0; 2];
    for (e, b) in inverse.iter().zip(b) {
        sum[0] += e.re * b;
        sum[1] += e.im * b;
    }
    Complex::new(sum[0], sum[1])
}

impl Drop for Past<'_> {
    fn drop(&mut self) {
        EARLIER.set(std::mem::take(&mut self.numbers));
    }
}

impl PastOfStep<'_> {
    /// Change of the state at the start of the step for a shift of the tip by 1 there, with an unchanged history.
    pub(super) fn moved_on(&self) -> impl Iterator<Item = f64> + '_ {
        let moved = || self.zeta.iter().zip(self.terms).map(|(zeta, term)| zeta * term.exponent);
        [-1.0].into_iter().chain(moved().map(|z| z.re)).chain(moved().map(|z| z.im))
    }

    /// Slope of the groove of the history at the stages, divided by α.
    pub(super) fn slope(&self) -> Stages {
        self.sum(|zeta, _| zeta)
    }

    /// Curvature of the groove of the history at the stages, divided by α.
    pub(super) fn curvature(&self) -> Stages {
        self.sum(|zeta, term| zeta * term.exponent)
    }

    /// Height of the groove of the history at the stages, divided by -α.
    pub(super) fn height(&self) -> Stages {
        self.sum(|zeta, term| zeta / term.exponent)
    }

    /// `Σ_j Re(w_j e^{s_j d_i})` at the nodes, with a weight w of each ζ.
    fn sum(&self, weight: impl Fn(Complex<f64>, &Term) -> Complex<f64>) -> Stages {
        let mut sums = [0.0; STAGES];
        for ((e, zeta), term) in self.exponentials.iter().zip(self.zeta).zip(self.terms) {
            let weight = weight(*zeta, term);
            for (sum, e) in sums.iter_mut().zip(e) {
                *sum += weight.re * e.re - weight.im * e.im;
            }
        }
        std::array::from_fn(|i| sums[i] * self.left[i])
    }
}
