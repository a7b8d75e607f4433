//! The past of a motion that has gone on for ever, as a sum of exponentials tells it.

use super::carved::Carved;
use super::orbit::Orbit;
use num_complex::Complex;
use stickslip_tip::collocation::{STAGES, Stages};
use stickslip_tip::elementary::complex_exp;
use stickslip_tip::exponential::exponentials as fill;
use stickslip_tip::memory::{Fit, Term};
use stickslip_tip::stop;

/// ζ at the ends of all steps of an orbit, and the exponentials at their stages.
pub(super) struct Past<'a> {
    terms: &'a [Term],
    /// `e^{s_j d_i}` by step and term.
    exponentials: Vec<[Complex<f64>; STAGES]>,
    /// `e^{-s_j d_i}`
    inverses: Vec<[Complex<f64>; STAGES]>,
    /// `ζ_j` by step, the end of the last included, and term.
    zeta: Vec<Complex<f64>>,
    /// What is left of it at the nodes of each step.
    left: Vec<Stages>,
}

/// That of one step.
#[derive(Clone, Copy)]
pub(super) struct PastOfStep<'a> {
    pub(super) terms: &'a [Term],
    /// `e^{s_j d_i}`
    pub(super) exponentials: &'a [[Complex<f64>; STAGES]],
    /// `e^{-s_j d_i}`
    pub(super) inverses: &'a [[Complex<f64>; STAGES]],
    /// ζ where the step starts.
    pub(super) zeta: &'a [Complex<f64>],
    /// ζ where it ends.
    pub(super) after: &'a [Complex<f64>],
    /// What is left at the nodes of what there was where it starts.
    left: &'a Stages,
}

impl<'a> Past<'a> {
    /// `None` where nobody waits for it any more. `carved` is what each step leaves.
    ///
    /// Over a step ζ becomes `e^{s d_s} (ζ e^{-h/T} + w Σ_k b_k e^{-s d_k})`; after a period it must be what it was.
    pub(super) fn of(fit: &'a Fit, orbit: &Orbit, carved: &[Carved]) -> Option<Self> {
        let terms = fit.terms();
        let count = orbit.stages.len() * terms.len();
        let (mut exponentials, mut inverses) =
            (Vec::with_capacity(count), Vec::with_capacity(count));
        let mut spent = Vec::with_capacity(count);
        for (d, carved) in orbit.stages.iter().zip(carved) {
            if stop::is_asked() {
                return None;
            }
            let stays = carved.weighted()[STAGES - 1];
            let from = inverses.len();
            let exponents = terms.iter().map(|term| term.exponent);
            fill(exponents, d, &mut exponentials, &mut inverses);
            for (term, inverse) in terms.iter().zip(&inverses[from..]) {
                spent.push(term.weight * spent_in(inverse, &stays) * carved.times);
            }
        }
        let left: Vec<Stages> = carved.iter().map(|carved| carved.left).collect();
        let zeta = vec![Complex::ZERO; count + terms.len()];
        let mut past = Self { terms, exponentials, inverses, zeta, left };
        past.follow(&spent);
        let moved: f64 = orbit.stages.iter().map(|d| d[STAGES - 1]).sum();
        let kept: f64 = past.left.iter().map(|left| left[STAGES - 1]).product();
        let added = &past.zeta[past.zeta.len() - terms.len()..];
        let settled = |(added, term): (&Complex<f64>, &Term)| {
            added / (1.0 - complex_exp(term.exponent * moved) * kept)
        };
        let start: Vec<_> = added.iter().zip(terms).map(settled).collect();
        past.zeta[..terms.len()].copy_from_slice(&start);
        past.follow(&spent);
        Some(past)
    }

    /// ζ at the ends of all steps, from what it is at the start.
    fn follow(&mut self, spent: &[Complex<f64>]) {
        let count = self.terms.len();
        let steps = self.exponentials.chunks_exact(count).zip(spent.chunks_exact(count));
        for (n, ((exponentials, spent), left)) in steps.zip(&self.left).enumerate() {
            let (before, after) = self.zeta[n * count..].split_at_mut(count);
            let left = left[STAGES - 1];
            for (j, after) in after[..count].iter_mut().enumerate() {
                *after = exponentials[j][STAGES - 1] * (before[j] * left + spent[j]);
            }
        }
    }

    pub(super) fn of_step(&self, n: usize) -> PastOfStep<'_> {
        let of = |n: usize| n * self.terms.len()..(n + 1) * self.terms.len();
        PastOfStep {
            terms: self.terms,
            exponentials: &self.exponentials[of(n)],
            inverses: &self.inverses[of(n)],
            zeta: &self.zeta[of(n)],
            after: &self.zeta[of(n + 1)],
            left: &self.left[n],
        }
    }
}

/// `Σ_k b_k e^{-s d_k}`
fn spent_in(inverse: &[Complex<f64>; STAGES], b: &Stages) -> Complex<f64> {
    inverse.iter().zip(b).map(|(e, b)| e * *b).sum()
}

impl PastOfStep<'_> {
    /// By how much the state where the step starts changes if the tip is moved on there by 1, the past staying.
    pub(super) fn moved_on(&self) -> impl Iterator<Item = f64> + '_ {
        let moved = || self.zeta.iter().zip(self.terms).map(|(zeta, term)| zeta * term.exponent);
        [-1.0].into_iter().chain(moved().map(|z| z.re)).chain(moved().map(|z| z.im))
    }

    /// Slope of the past groove at the stages, over α.
    pub(super) fn slope(&self) -> Stages {
        self.sum(|value, _| value.re)
    }

    /// Its curvature.
    pub(super) fn curvature(&self) -> Stages {
        self.sum(|value, term| (value * term.exponent).re)
    }

    /// Its height: u is -α times that.
    pub(super) fn height(&self) -> Stages {
        self.sum(|value, term| (value / term.exponent).re)
    }

    fn sum(&self, part: impl Fn(Complex<f64>, &Term) -> f64) -> Stages {
        let mut sums = [0.0; STAGES];
        for ((e, zeta), term) in self.exponentials.iter().zip(self.zeta).zip(self.terms) {
            for (sum, e) in sums.iter_mut().zip(e) {
                *sum += part(zeta * e, term);
            }
        }
        std::array::from_fn(|i| sums[i] * self.left[i])
    }
}
