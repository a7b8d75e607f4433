//! Effect of an undetected Gaussian, too weak to be selected by the criterion.

use super::Request;
use super::answers::Answers;
use super::search::Candidate;
use super::shape::{Shape, pair};
use crate::Profile;
use crate::least_squares::{Residuals, squares};
use crate::projection::project;
use chacha20::ChaCha8Rng;
use rand::RngExt;

/// Positions of such a Gaussian that are tried, in widths of the first, and its widths.
const PLACES: [f64; 8] = [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0, 4.0];
const WIDTHS: [f64; 3] = [0.5, 0.8, 1.3];
/// Its amplitude, in standard errors of its fit.
const DEVIATIONS: f64 = 2.0;
/// Fraction of the norm of such a Gaussian, outside of the span of the fit, below which the existing terms represent it.
const TOLD: f64 = 0.15;
/// Largest change of the fitted parameters; larger changes are scaled down in proportion, because the resamples cover
/// transitions to another sum.
const FAR: f64 = 0.05;
const TOO_FAR: f64 = 0.6;
/// Largest change of the logarithm of a result that is computed along the tangent.
const ALONG: f64 = 0.05;

/// Largest factor by which each result changes if such a Gaussian exists and the fit adapts to it: [σ, αc, ω,
/// trapping threshold].
pub(super) fn factors(
    profile: &Profile,
    request: &Request,
    found: &Candidate,
    effective: f64,
) -> [f64; 4] {
    let Request { centre, sigma, r, .. } = *request;
    let mut factors = [1.0; 4];
    let shape = Shape::of(profile, centre, (found.terms, found.finest), found.order());
    let searched = shape.searched(&found.places);
    let Some(derivatives) = shape.derivatives(&found.residuals, &searched) else { return factors };
    let Some(before) = Answers::of(found, sigma, r) else { return factors };
    // Rows that hang together tell less.
    let rows = profile.x().len() as f64;
    let deviation = found.residual * (rows / effective).sqrt();
    let width = found.places.terms[0].1;
    let places = PLACES.iter().flat_map(|d| WIDTHS.iter().map(move |w| (d * width, w * width)));
    for (d, w) in places {
        let Some(hidden) = Hidden::at(&shape, (found, &searched, &derivatives), (d, w)) else {
            continue;
        };
        let amplitude = (DEVIATIONS * deviation).min(TOO_FAR / hidden.farthest);
        let share = (FAR / (amplitude * hidden.farthest)).min(1.0);
        for sign in [-1.0, 1.0] {
            let more = hidden.with(&shape, (found, &searched), sign * share * amplitude);
            let Some(after) = Answers::of(&more, sigma, r) else { continue };
            let changes = after.changes(&before).map(|change| change / share);
            // A large change along the tangent counts as far as a fit to such a profile confirms it.
            let whole = hidden.beside(found, sign * amplitude);
            let fitted = if share < 1.0 {
                refitted(profile, request, found, &whole, effective)
            } else {
                None
            };
            let fitted = fitted.unwrap_or([f64::INFINITY; 4]);
            for (factor, change) in factors.iter_mut().zip(changes.into_iter().zip(fitted)) {
                let (along, fitted) = change;
                let change = along.min(fitted.max(ALONG)).exp();
                if change.is_finite() {
                    *factor = factor.max(change);
                }
            }
        }
    }
    factors
}

/// Differences of the logarithms of the results between a sum and a fit to it without its last Gaussian.
fn refitted(
    profile: &Profile,
    &Request { centre, sigma, r, .. }: &Request,
    found: &Candidate,
    whole: &Candidate,
    effective: f64,
) -> Option<[f64; 4]> {
    let heights = profile.x().iter().map(|x| whole.height(*x)).collect();
    let fitted = found.again(&profile.with(heights), centre, effective)?;
    Some(Answers::of(whole, sigma, r)?.changes(&Answers::of(&fitted, sigma, r)?))
}

/// The sum with one such Gaussian at a random position, with a random amplitude below detection.
pub(super) fn drawn(
    profile: &Profile,
    centre: Option<f64>,
    found: &Candidate,
    effective: f64,
    random: &mut ChaCha8Rng,
) -> Option<Candidate> {
    let shape = Shape::of(profile, centre, (found.terms, found.finest), found.order());
    let searched = shape.searched(&found.places);
    let derivatives = shape.derivatives(&found.residuals, &searched)?;
    let width = found.places.terms[0].1;
    let place = PLACES[random.random_range(0..PLACES.len())] * width;
    let wide = WIDTHS[random.random_range(0..WIDTHS.len())] * width;
    let size = normal(random);
    let hidden = Hidden::at(&shape, (found, &searched, &derivatives), (place, wide))?;
    let rows = profile.x().len() as f64;
    let most = TOO_FAR / hidden.farthest;
    let amount = (size * found.residual * (rows / effective).sqrt()).clamp(-most, most);
    Some(hidden.with(&shape, (found, &searched), amount))
}

/// A standard normal random number, by the Box-Muller method.
fn normal(random: &mut ChaCha8Rng) -> f64 {
    let (u, v): (f64, f64) = (random.random_range(1e-12..1.0), random.random());
    (-2.0 * u.ln()).sqrt() * (std::f64::consts::TAU * v).cos()
}

/// A Gaussian of unit norm orthogonal to the columns of the fit, and the change of the fit.
struct Hidden {
    place: (f64, f64),
    /// Amplitude of the Gaussian.
    amplitude: f64,
    /// Change of the linear part of the fit, and of the search variables.
    linear: Vec<f64>,
    searched: Vec<f64>,
    /// Largest change of a search variable.
    farthest: f64,
}

impl Hidden {
    fn at(
        shape: &Shape,
        (found, searched, derivatives): (&Candidate, &[f64], &[Vec<f64>]),
        (d, w): (f64, f64),
    ) -> Option<Self> {
        let x = shape.profile.x();
        let centre = found.places.centre;
        let column =
            |d: f64, w: f64| x.iter().map(|x| pair(x - centre, d, w)).collect::<Vec<f64>>();
        let new = column(d, w);
        let mut columns = shape.ground();
        columns.extend(found.places.terms.iter().map(|(d, w)| column(*d, *w)));
        let linear = columns.len();
        // The residuals fall where the fit rises.
        columns.extend(derivatives.iter().map(|column| column.iter().map(|v| -v).collect()));
        let left = project(&columns, &new)?;
        let size = squares(&left.residuals).sqrt();
        if size < TOLD * squares(&new).sqrt() {
            return None;
        }
        let over = |c: &f64| c / size;
        let moves: Vec<f64> = left.coefficients[linear..].iter().map(over).collect();
        debug_assert_eq!(moves.len(), searched.len());
        Some(Self {
            place: (d, w),
            amplitude: 1.0 / size,
            linear: left.coefficients[shape.order + 1..linear].iter().map(over).collect(),
            farthest: moves.iter().fold(f64::MIN_POSITIVE, |m, v| m.max(v.abs())),
            searched: moves,
        })
    }

    /// The sum with this amount of the Gaussian added.
    fn beside(&self, found: &Candidate, amount: f64) -> Candidate {
        let mut whole = found.clone();
        whole.terms += 1;
        whole.places.terms.push(self.place);
        whole.amplitudes.push(amount * self.amplitude);
        whole
    }

    /// The sum with this amount of the Gaussian, and the fit adapted to it.
    fn with(
        &self,
        shape: &Shape,
        (found, searched): (&Candidate, &[f64]),
        amount: f64,
    ) -> Candidate {
        let moved: Vec<f64> =
            searched.iter().zip(&self.searched).map(|(p, c)| p - amount * c).collect();
        let mut places = shape.places(&moved);
        places.terms.push(self.place);
        let kept = found.amplitudes.iter().zip(&self.linear).map(|(b, c)| b - amount * c);
        let amplitudes = kept.chain([amount * self.amplitude]).collect();
        Candidate { terms: found.terms + 1, places, amplitudes, ..found.clone() }
    }
}
