//! Exponents on a lattice, for footprints that few exponentials cannot fit: narrow lobes, tables.
//!
//! On [-δ, P - δ], where P exceeds the reach of f by δ, f'(ξ)e^{aξ} equals a Fourier series of period P, apart from
//! the images of f' one period on, which are damped by e^{-aP}. So
//!
//! ```text
//!     f'(ξ) ≈ Σ_k Re(w_k e^{s_k ξ}),    s_k = -a + 2πik/P,    w_k = (2/P) ∫ f'(ξ) e^{-s_k ξ} dξ
//! ```
//!
//! where w_0 is half of this. For a Gaussian of amplitude A, center c and width W the integral over all ξ is
//! s_k A √(2π) W e^{-s_k c + s_k² W²/2}.

use num_complex::Complex;
use std::f64::consts::TAU;
use std::sync::Arc;
use stickslip_tip::cache::Cache;
use stickslip_tip::elementary::complex_exp;
use stickslip_tip::memory::{Fit, FitError, Term};
use stickslip_tip::{Gaussian, TipFunction, stop};

/// P over the reach of f; δ is at most a quarter of the reach.
const PERIOD: f64 = 1.6;
/// Largest contribution of the images of f' and of the omitted waves, in units of the required accuracy.
const SHARE: f64 = 0.2;

/// Factor by which the required accuracy is relaxed until it is met, up to [`LOOSEST`].
const LOOSER: f64 = 30.0;
const LOOSEST: f64 = 1e-2;
/// If the residual of a lattice exceeds the required one by more than this factor, its waves cancel so strongly that a
/// lattice of lower accuracy fits better.
const MISSED: f64 = 3.0;

/// The best fit of f' with at most this number of waves, no more accurate than required.
///
/// # Errors
/// A footprint that never fades.
pub(super) fn fit(tip: &TipFunction, wanted: f64, most: usize) -> Result<Arc<Fit>, FitError> {
    let error = |fit: &Arc<Fit>| fit.certificate().slope;
    // Nothing is looser than 0 by a factor, and no damping is stronger than that of round-off squared.
    let least = f64::EPSILON * f64::EPSILON;
    let (mut aim, mut best): (f64, Option<Arc<Fit>>) = (wanted.max(least), None);
    // A looser lattice is less damped, and waves that are left out weigh less.
    while best.is_none() || aim <= LOOSEST {
        if stop::is_requested() {
            return Err(FitError::Stopped);
        }
        let fit = known(tip, aim, terms(tip, (aim, PERIOD), most)?)?;
        let is_best = best.as_ref().is_none_or(|best| error(&fit) < error(best));
        let met = error(&fit) <= MISSED * aim;
        if is_best {
            best = Some(fit);
        }
        if met {
            break;
        }
        aim *= LOOSER;
    }
    best.ok_or(FitError::Terms)
}

/// Retreat up to which a lattice is valid, in units of the reach.
const FAR: f64 = 0.25;
/// Period of this lattice, in units of the reach: the images of f' are negligible there.
const FAR_PERIOD: f64 = 2.4;

/// Largest factor by which both are increased: the farthest retreat is one reach.
const MOST_TIMES: f64 = 4.0;

/// A lattice that is valid far behind the farthest point that the tip has reached: at least up to this retreat, if any
/// lattice is.
///
/// # Errors
/// A footprint that never fades.
pub(super) fn reaching_back(
    tip: &TipFunction,
    (wanted, retreat): (f64, f64),
    most: usize,
) -> Result<Arc<Fit>, FitError> {
    let reach = tip.reach().ok_or(FitError::NeverFades)?;
    let mut times = 1.0;
    while times < MOST_TIMES && retreat > times * FAR * reach {
        times *= 2.0;
    }
    let terms = terms(tip, (wanted, times * FAR_PERIOD), most)?;
    Fit::from_terms(tip, terms, Some(times * FAR * reach)).map(Arc::new)
}

/// The sum of these terms with its certificate, or one from the cache.
fn known(tip: &TipFunction, wanted: f64, terms: Vec<Term>) -> Result<Arc<Fit>, FitError> {
    static KNOWN: Cache<(TipFunction, u64, usize), Arc<Fit>> = Cache::new(16);
    let (bits, count) = (wanted.to_bits(), terms.len());
    if let Some(fit) = KNOWN.get(|(t, w, n)| (*w, *n) == (bits, count) && t == tip) {
        return Ok(fit);
    }
    let fit = Arc::new(Fit::from_terms(tip, terms, None)?);
    KNOWN.keep((tip.clone(), bits, count), Arc::clone(&fit));
    Ok(fit)
}

/// A lattice with the necessary number of waves, or the first `most` of them.
fn terms(
    tip: &TipFunction,
    (wanted, periods): (f64, f64),
    most: usize,
) -> Result<Vec<Term>, FitError> {
    let (TipFunction::Gaussians(sum), Some(reach)) = (tip, tip.reach()) else {
        return Err(FitError::NeverFades);
    };
    let period = periods * reach;
    let damping = -(SHARE * wanted).clamp(f64::EPSILON * f64::EPSILON, 0.1).ln() / period;
    let spacing = TAU / period;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let all = ((1.2 * tip.band() / spacing).ceil() as usize).min(MOST_LOOKED_AT);
    let mut transform = vec![Complex::ZERO; all + 1];
    for gaussian in sum.terms() {
        add(&mut transform, gaussian, damping, spacing);
    }
    let term = |(k, value): (usize, &Complex<f64>)| {
        let exponent = Complex::new(-damping, spacing * k as f64);
        let share = if k == 0 { 1.0 } else { 2.0 } / period;
        Term { exponent, weight: *value * exponent * share }
    };
    let mut terms: Vec<Term> = transform.iter().enumerate().map(term).collect();
    let mut left_out = 0.0;
    while terms.len() > 1 {
        left_out += terms.last().map_or(0.0, |term| term.weight.norm());
        if left_out > SHARE * wanted && terms.len() <= most {
            break;
        }
        terms.pop();
    }
    Ok(terms)
}

/// Largest number of waves whose coefficients are evaluated.
const MOST_LOOKED_AT: usize = 20_000;

/// Adds ∫ g(ξ) e^{-s_k ξ} dξ of a Gaussian g for each k.
fn add(transform: &mut [Complex<f64>], g: &Gaussian, damping: f64, spacing: f64) {
    let size = g.amplitude * g.width * TAU.sqrt();
    let mut turn = Complex::<f64>::ONE;
    let once = complex_exp(Complex::new(0.0, -spacing * g.center));
    for (k, value) in transform.iter_mut().enumerate() {
        let (re, im) = (damping, -spacing * k as f64);
        let log = 0.5 * g.width.powi(2) * (re * re - im * im) + re * g.center;
        if log < -700.0 {
            return;
        }
        let phase = g.width.powi(2) * re * im;
        *value += turn * complex_exp(Complex::new(log, phase)) * size;
        turn *= once;
    }
}

/// The largest wave number in the spectrum of f', to this accuracy.
pub(super) fn band(tip: &TipFunction, wanted: f64) -> Result<f64, FitError> {
    let waves = terms(tip, (wanted, PERIOD), MOST_LOOKED_AT)?;
    Ok(waves.iter().map(|term| term.exponent.im).fold(0.0, f64::max))
}
