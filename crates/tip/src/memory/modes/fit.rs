//! f' on one side as a sum of few complex exponentials.

use super::certificate::{FitCertificate, certify};
use super::pencil::Pencil;
use super::standard;
use super::term::Term;
use super::weights::weights;
use super::window::{Retreat, Window, samples};
use crate::cache::Cache;
use crate::elementary::{complex_exp, ln, norm};
use crate::{TipFunction, stop};
use num_complex::Complex;
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use thiserror::Error;

/// f'(ξ) ≈ `Σ_j Re(w_j e^{s_j ξ})` for ξ ≥ -(allowed retreat), with its certified error.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    terms: Vec<Term>,
    retreat: f64,
    between_steps: f64,
    wanted: f64,
    certificate: FitCertificate,
}

/// Reasons why f' has no fit.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum FitError {
    /// J0 decays like 1/√ξ, which no sum of few exponentials approximates.
    #[error(
        "the memory modes needs a footprint that decays; this one does not (J0 falls like 1/√x): use the memory fft"
    )]
    NeverFades,
    /// Terms that do not form a decaying sum.
    #[error("a fit needs at least one exponential, and each must fade")]
    Terms,
    /// The computation was cancelled: [`crate::stop`].
    #[error("stopped before f' was fitted")]
    Stopped,
    /// The best fit is not accurate enough.
    #[error(
        "f' cannot be fitted by exponentials to {wanted:.1e}, at best to {reached:.1e}: allow a larger tolerance, or use the memory fft"
    )]
    NotMet {
        /// Largest error allowed.
        wanted: f64,
        /// Error of the best fit.
        reached: f64,
    },
}

/// Number of samples of the pencil, and their extent relative to reach plus retreat. The second pair of numbers is for
/// accuracies below [`CHEAP`], where more samples reduce the effect of their round-off. The samples resolve three
/// smooth lobes. Those beyond the reach suppress the sum there, which could be a thousand times the error within. An
/// extent of 1.1 saves a pair or two of exponentials; 1.2 would double the weights.
const SAMPLES: [(usize, f64); 2] = [(127, 1.1), (159, 1.1)];
/// The same if no lattice is fine enough: the samples extend farther into the range where f' is 0, because they would
/// not determine the decay of the slowest term otherwise.
const MORE_SAMPLES: (usize, f64) = (191, 1.4);
/// Below this accuracy the terms of the pencil cancel so much that a lattice is better; it is also found sooner.
const FINEST_OF_PENCIL: f64 = 2e-12;
/// Below this accuracy, slips amplify the error of a fit to that of a run. Therefore one pair more is tried, which
/// reduces the error to about a fifth.
const CHEAP: f64 = 1e-10;
const SPARE: f64 = 0.3;
/// Periods of the lattices of exponents, relative to reach plus retreat. Lattices are used if the pencil does not
/// suffice.
const PERIODS: [f64; 4] = [1.3, 1.6, 2.0, 2.4];
/// Allowed error due to the images of f' and the omitted waves, relative to the required accuracy.
const SHARE_OF_LATTICE: f64 = 0.1;
/// Largest number of pairs: a lattice with more exponents would cost more than `fft`.
const MOST_PAIRS: usize = 64;
/// Allowed error due to cancellation between terms, relative to the required accuracy; otherwise expansions would be
/// short.
const SHARE_OF_ROUND_OFF: f64 = 0.1;
const LEAST_ROUND_OFF: f64 = 2e-15;
/// Number of samples for least squares, as a multiple of those of the pencil.
const FINER: usize = 2;
/// Largest number of terms of the pencil (pairs count twice).
const MOST_TERMS: usize = 40;

impl Fit {
    /// The fit with the fewest terms whose certified error of f' is at most `wanted`, and whose area is at most
    /// `wanted` times two widths of a Gaussian. It is valid for a tip that moves backward as far as `back` allows.
    ///
    /// # Errors
    /// A footprint that does not decay, or an accuracy that no fit reaches.
    pub fn new(tip: &TipFunction, wanted: f64, back: Retreat) -> Result<Self, FitError> {
        if *tip == TipFunction::Cosine {
            return Ok(Self::of_cosine(wanted));
        }
        let reach = tip.reach().ok_or(FitError::NeverFades)?;
        let window = Window::of(tip, reach, back);
        // f' itself is known no better.
        let largest = window.largest_slope(tip);
        let roundings = f64::EPSILON * largest;
        if wanted < roundings {
            return Err(FitError::NotMet { wanted, reached: roundings });
        }
        let pencil = |samples, reached: &mut f64| by_pencil(tip, &window, samples, wanted, reached);
        let mut reached = f64::INFINITY;
        if wanted >= FINEST_OF_PENCIL
            && let Some(fit) = pencil(SAMPLES[usize::from(wanted < CHEAP)], &mut reached)
        {
            return Ok(fit);
        }
        let mut lattices = false;
        for period in PERIODS.into_iter().take_while(|_| !stop::is_requested()) {
            let Some(fit) = damped_fourier(tip, (&window, largest), period, wanted) else {
                continue;
            };
            if fit.meets(&window) {
                return Ok(fit);
            }
            reached = reached.min(fit.certificate.slope);
            lattices = true;
        }
        // Where no lattice is fine enough, the exponentials of the pencil are the best available.
        if !lattices && let Some(fit) = pencil(MORE_SAMPLES, &mut reached) {
            return Ok(fit);
        }
        Err(if stop::is_requested() {
            FitError::Stopped
        } else {
            FitError::NotMet { wanted, reached }
        })
    }

    /// -sin ξ = Re(i e^{iξ}), exactly, for all ξ.
    fn of_cosine(wanted: f64) -> Self {
        let terms = vec![Term { exponent: Complex::i(), weight: Complex::i() }];
        let certificate = FitCertificate { slope: 0.0, curvature: 0.0, area: 0.0 };
        let everywhere = f64::INFINITY;
        Self { terms, retreat: everywhere, between_steps: everywhere, wanted, certificate }
    }

    /// As [`new`](Self::new), or an equal fit made earlier. The latest fits are kept for all
    /// threads, and those of the default footprints are part of the program. The result is the same bit for bit.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn cached(tip: &TipFunction, wanted: f64, back: Retreat) -> Result<Arc<Self>, FitError> {
        type Known = Cache<(TipFunction, u64, Retreat), Result<Arc<Fit>, FitError>>;
        static CACHE: Known = Cache::new(64);
        let bits = wanted.to_bits();
        if let Some(fit) = CACHE.get(|(t, w, b)| *w == bits && *b == back && t == tip) {
            return fit;
        }
        let fit = Self::standard(tip, wanted, back)
            .map_or_else(|| Self::new(tip, wanted, back), Ok)
            .map(Arc::new);
        if fit != Err(FitError::Stopped) {
            CACHE.keep((tip.clone(), bits, back), fit.clone());
        }
        fit
    }

    /// A fit that is part of the program.
    fn standard(tip: &TipFunction, wanted: f64, back: Retreat) -> Option<Self> {
        if back != Retreat::Small {
            return None;
        }
        let (terms, certificate) = standard::known(tip, wanted)?;
        let Window { retreat, between_steps, .. } = Window::of(tip, tip.reach()?, back);
        Some(Self { terms, retreat, between_steps, wanted, certificate })
    }

    /// The sum of given terms with its certified error, for exponentials from other sources. It is certified for a
    /// retreat of the given length, in σ, or for a small one.
    ///
    /// # Errors
    /// A footprint that does not decay, no terms, or terms that do not decay.
    pub fn from_terms(
        tip: &TipFunction,
        terms: Vec<Term>,
        retreat: Option<f64>,
    ) -> Result<Self, FitError> {
        let reach = tip.reach().ok_or(FitError::NeverFades)?;
        let small = Window::of(tip, reach, Retreat::Small);
        let window = retreat.map_or(small, |retreat| small.reaching_back(retreat));
        let fades = |term: &Term| {
            term.exponent.re < 0.0 && term.exponent.is_finite() && term.weight.is_finite()
        };
        if terms.is_empty() || !terms.iter().all(fades) {
            return Err(FitError::Terms);
        }
        let fit = Self::certified(tip, &window, terms);
        if stop::is_requested() {
            return Err(FitError::Stopped);
        }
        Ok(Self { wanted: fit.certificate.slope, ..fit })
    }

    /// The terms.
    pub fn terms(&self) -> &[Term] {
        &self.terms
    }

    /// The required accuracy; the error of the sum if the terms were given.
    pub fn wanted(&self) -> f64 {
        self.wanted
    }

    /// Distance behind the farthest point within which the sum is valid, in σ.
    pub fn retreat(&self) -> f64 {
        self.retreat
    }

    /// Largest distance behind the farthest point at which a step may begin, so that all its evaluations are valid; in
    /// σ.
    pub fn retreat_between_steps(&self) -> f64 {
        self.between_steps
    }

    /// Largest errors of the sum.
    pub fn certificate(&self) -> FitCertificate {
        self.certificate
    }

    /// The sum at ξ, and its derivative.
    pub fn slope_and_curvature(&self, xi: f64) -> (f64, f64) {
        self.terms.iter().fold((0.0, 0.0), |(slope, curvature), term| {
            let value = term.weight * complex_exp(term.exponent * xi);
            (slope + value.re, curvature + (value * term.exponent).re)
        })
    }

    /// Whether the error of f' and its integral are small enough, and the terms do not cancel too much.
    fn meets(&self, window: &Window) -> bool {
        let wanted = self.wanted;
        let largest = self.terms.iter().fold(0.0, |m: f64, t| m.max(norm(t.weight)));
        self.certificate.slope <= wanted
            && self.certificate.area <= window.area(wanted)
            && f64::EPSILON * largest <= (SHARE_OF_ROUND_OFF * wanted).max(LEAST_ROUND_OFF)
    }

    /// The sum of these exponents with weights from least squares.
    fn with_exponents(
        tip: &TipFunction,
        window: &Window,
        exponents: &[Complex<f64>],
        samples: &[(f64, f64)],
        wanted: f64,
    ) -> Option<Self> {
        let weights = weights(exponents, samples)?;
        let term = |(s, w): (&Complex<f64>, Complex<f64>)| Term { exponent: *s, weight: w };
        let terms: Vec<Term> = exponents.iter().zip(weights).map(term).collect();
        Some(Self { wanted, ..Self::certified(tip, window, terms) })
    }

    fn certified(tip: &TipFunction, window: &Window, terms: Vec<Term>) -> Self {
        let Window { reach, retreat, between_steps, .. } = *window;
        let certificate = certify(tip, reach, retreat, &terms);
        Self { terms, retreat, between_steps, wanted: certificate.slope, certificate }
    }
}

/// The matrix pencil with an increasing number of terms, until it meets the accuracy or no longer improves.
fn by_pencil(
    tip: &TipFunction,
    window: &Window,
    (count, length): (usize, f64),
    wanted: f64,
    reached: &mut f64,
) -> Option<Fit> {
    let span = length * (window.reach + window.retreat);
    let spacing = span / (count - 1) as f64;
    let sample = |i: usize| tip.slope(i as f64 * spacing - window.retreat);
    let even: Vec<f64> = (0..count).map(sample).collect();
    let fine = samples(tip, (window.retreat, span - window.retreat), FINER * count);
    let pencil = Pencil::cached(&even, spacing)?;
    let most = pencil.most_terms().min(MOST_TERMS);
    let aim = if wanted < CHEAP { (SPARE * wanted).max(FINEST_OF_PENCIL) } else { wanted };
    let (mut best, mut misses, mut met, mut first) = (f64::INFINITY, 0, None, None);
    for p in pencil.fewest_terms(wanted)..=most {
        if stop::is_requested() {
            return None;
        }
        let exponents = pencil.exponents(p);
        let fit = exponents.and_then(|s| Fit::with_exponents(tip, window, &s, &fine, wanted));
        let Some(fit) = fit else { continue };
        let error = fit.certificate.slope;
        *reached = reached.min(error);
        let (is_met, terms) = (fit.meets(window), fit.terms.len());
        if is_met && error < best {
            met = Some(fit);
            first.get_or_insert(terms);
        }
        if first.is_some_and(|first| error <= aim || terms > first) {
            break;
        }
        misses = if error < 0.7 * best { 0 } else { misses + 1 };
        best = best.min(error);
        if misses > 3 {
            break;
        }
    }
    met
}

/// A fit with exponents s = -a ± iκk on a lattice: more exponents than from a pencil, but without a search. `f' e^{aξ}`
/// is a Fourier series whose period P exceeds the reach; its images, P further on, are damped by `e^{-aP}`. `largest`
/// is max |f'|.
fn damped_fourier(
    tip: &TipFunction,
    (window, largest): (&Window, f64),
    period: f64,
    wanted: f64,
) -> Option<Fit> {
    let Window { reach, retreat, .. } = *window;
    let period = period * (reach + retreat);
    let share = SHARE_OF_LATTICE * wanted / largest.max(1.0);
    let digits = -ln(share.clamp(f64::EPSILON * f64::EPSILON, SHARE_OF_LATTICE));
    let (rate, lattice) = (-digits / period, TAU / period);
    let pairs = waves(tip, lattice, SHARE_OF_LATTICE * wanted);
    if pairs > MOST_PAIRS {
        return None;
    }
    let exponents: Vec<_> = (0..=pairs).map(|k| Complex::new(rate, k as f64 * lattice)).collect();
    let samples = samples(tip, (retreat, period - retreat), 8 * exponents.len());
    Fit::with_exponents(tip, window, &exponents, &samples, wanted)
}

/// Number of waves of a lattice that f' requires: all the others together amount to less than `error`.
fn waves(tip: &TipFunction, lattice: f64, error: f64) -> usize {
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let all = (tip.band() / lattice).ceil() as usize;
    let mut beyond = 0.0;
    for k in (1..=all).rev() {
        let q = k as f64 * lattice;
        beyond += lattice / PI * q * norm(tip.transform(q));
        if beyond > error {
            return k;
        }
    }
    0
}
