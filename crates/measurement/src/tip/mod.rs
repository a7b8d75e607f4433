//! Fit of a footprint to a measured profile.

mod answers;
mod hidden;
mod lopsided;
mod resample;
mod search;
mod shape;
mod sides;

use crate::{Estimate, Profile};
use answers::{Answers, normalised};
use resample::Resampling;
pub use search::Candidate;
use search::{Found, MOST_TERMS};
pub(crate) use shape::bell;
pub use sides::{Sides, sides};
use stickslip_tip::{Gaussian, stop};
use thiserror::Error;

/// Options of the fit of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Centre of symmetry of f, in the unit of the positions; fitted by default. The centre of half a profile is 0.
    pub centre: Option<f64>,
    /// σ, in the unit of the positions; computed by default.
    pub sigma: Option<f64>,
    /// Number of Gaussians, where a symmetric pair counts as one; selected by default.
    pub terms: Option<usize>,
    /// The r at which onset and trapping threshold are computed.
    pub r: f64,
    /// Number of resampled profiles for the intervals.
    pub resamples: usize,
    /// Seed of the random numbers.
    pub seed: u64,
}

impl Default for Request {
    fn default() -> Self {
        Self { centre: None, sigma: None, terms: None, r: 1.0, resamples: 400, seed: 0 }
    }
}

/// A footprint with its errors. Lengths and heights are in the units of the profile, except in `gaussians`.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredTip {
    /// f as a sum of Gaussians, with f(0) = 1 and lengths in σ.
    pub gaussians: Vec<Gaussian>,
    /// The width of the Gaussian with the same full width at half of f(0): half of that width over √(2 ln 2).
    pub sigma: Estimate,
    /// Height that corresponds to f(0) = 1; negative for a pit.
    pub apex: f64,
    /// Centre of symmetry of f.
    pub centre: f64,
    /// Coefficients of the background: of 1, x and, if it is curved, x² and x³.
    pub ground: Vec<f64>,
    /// Standard deviation of the noise from row to row.
    pub noise: f64,
    /// Standard deviation of the residuals.
    pub residual: f64,
    /// Correlation of the residuals of neighbouring rows.
    pub correlation: f64,
    /// The best fits with one, two … Gaussians.
    pub candidates: Vec<Candidate>,
    /// Index of the selected fit in `candidates`.
    pub chosen: usize,
    /// αc(r), dimensionless.
    pub critical_alpha: Estimate,
    /// ω at αc, in k/Γ.
    pub critical_omega: Estimate,
    /// Trapping threshold at r; NaN if there is none.
    pub trapping_alpha: Estimate,
    /// The r of these results.
    pub r: f64,
    /// Footprints compatible with the noise, drawn at random: their spread is the error of the shape.
    pub draws: Vec<Vec<Gaussian>>,
    /// Fraction of draws without a footprint or without an onset.
    pub lost: f64,
    /// Rows of the profile and of the fit.
    pub fitted: Fitted,
}

/// Columns of equal length, by ascending position, in the units of the data.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "FittedDocument"))]
pub struct Fitted {
    /// Positions.
    pub x: Vec<f64>,
    /// Measured heights.
    pub f: Vec<f64>,
    /// Fitted heights, including the background.
    pub fit: Vec<f64>,
}

impl Fitted {
    /// The residuals of the fit.
    pub fn residuals(&self) -> Vec<f64> {
        self.f.iter().zip(&self.fit).map(|(f, fit)| f - fit).collect()
    }
}

/// The reason why there is no footprint.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TipError {
    /// Too few rows for any fit.
    #[error(
        "{rows} rows are too few for {terms} Gaussian(s) on a sloping background: give more rows, or fewer terms"
    )]
    Rows {
        /// Number of rows.
        rows: usize,
        /// Number of Gaussians requested.
        terms: usize,
    },
    /// No footprint is stronger than the noise.
    #[error(
        "no footprint is distinguishable from noise: the residual of the best fit is {residual:.2e}, where heights vary by {variation:.2e}"
    )]
    Nothing {
        /// Standard deviation of the residuals.
        residual: f64,
        /// Standard deviation of the heights minus a straight line.
        variation: f64,
    },
    /// The fitted sum has no apex at its centre, or does not fall to half of it.
    #[error(
        "the fitted sum has no apex at its centre, {centre}: give the centre, or check the profile"
    )]
    NoApex {
        /// Fitted centre of symmetry.
        centre: f64,
    },
    /// With the fitted footprint steady motion is stable at any α.
    #[error("the fitted footprint has no onset of stick-slip at r = {r}")]
    NoOnset {
        /// The r requested.
        r: f64,
    },
    /// The work was [cancelled](stop).
    #[error("the fit was interrupted")]
    Stopped,
}

/// Largest excess of the criterion at which a sum is still plausible: its probability is e^-2 times that of the best.
const PLAUSIBLE: f64 = 4.0;

/// Largest number of footprints drawn to represent the error of the shape.
const MOST_DRAWS: usize = 24;

/// Fits a footprint: the sum of Gaussians on a sloping or curved background that Schwarz' criterion selects.
///
/// # Errors
/// Too few rows, no signal above the noise, a sum without an apex, or [`TipError::Stopped`].
pub fn tip(profile: &Profile, request: &Request) -> Result<MeasuredTip, TipError> {
    let found = measured(profile, request);
    // Searches that are asked to stop end as if there were nothing to find.
    if stop::is_requested() { Err(TipError::Stopped) } else { found }
}

fn measured(profile: &Profile, request: &Request) -> Result<MeasuredTip, TipError> {
    let rows = profile.x().len();
    let Found { best: candidates, others } =
        search::candidates(profile, request.centre, request.terms);
    if candidates.is_empty() || request.terms.is_some_and(|terms| terms > candidates.len()) {
        return Err(TipError::Rows { rows, terms: request.terms.unwrap_or(1) });
    }
    let last = request.terms.map_or_else(|| best(&candidates), |terms| terms - 1);
    let correlation = correlation(&candidates[last].residuals);
    let effective = effective(rows, correlation);
    let judged = |c: Candidate| {
        let alpha = Answers::of(&c, request.sigma, request.r).map_or(f64::NAN, |a| a.alpha);
        Candidate { critical_alpha: alpha, ..c.judged(effective) }
    };
    let candidates: Vec<Candidate> = candidates.into_iter().map(judged).collect();
    let others: Vec<Candidate> = others.into_iter().map(judged).collect();
    let chosen = request.terms.map_or_else(|| best(&candidates), |terms| terms - 1);
    let found = &candidates[chosen];
    judge_size(profile, found)?;
    let centre = found.places.centre;
    let (gaussians, _, apex) =
        normalised(found, request.sigma).ok_or(TipError::NoApex { centre })?;
    let answers =
        Answers::of(found, request.sigma, request.r).ok_or(TipError::NoOnset { r: request.r })?;
    let is_plausible = |c: &&Candidate| {
        c.criterion - found.criterion < PLAUSIBLE
            && request.terms.is_none_or(|terms| c.terms == terms)
    };
    let resampling = Resampling {
        profile,
        request,
        makers: candidates.iter().chain(&others).filter(is_plausible).collect(),
        effective,
    };
    let draws = resampling.draw(request.resamples);
    let factors = hidden::factors(profile, request, found, effective);
    let estimates: [Estimate; 4] = std::array::from_fn(|i| {
        let of = |a: &Answers| a.each()[i];
        let ways = draws.iter().map(|drawn| drawn.iter().flatten().map(of).collect());
        let ways: Vec<Vec<f64>> = ways.collect();
        Estimate::of_resamples(of(&answers), &ways).wider_by(factors[i])
    });
    let [sigma, critical_alpha, critical_omega, trapping_alpha] = estimates;
    Ok(MeasuredTip {
        gaussians,
        sigma,
        apex,
        centre,
        ground: found.ground.clone(),
        noise: profile.noise(),
        residual: found.residual,
        correlation,
        critical_alpha,
        critical_omega,
        trapping_alpha,
        r: request.r,
        draws: resampling.footprints(request.resamples.min(MOST_DRAWS)),
        lost: lost(&draws),
        fitted: Fitted {
            x: profile.x().to_vec(),
            f: profile.f().to_vec(),
            fit: profile.x().iter().map(|x| found.height(*x)).collect(),
        },
        candidates,
        chosen,
    })
}

/// The fraction of draws without a result.
fn lost(draws: &[Vec<Option<Answers>>]) -> f64 {
    let all: Vec<&Option<Answers>> = draws.iter().flatten().collect();
    all.iter().filter(|drawn| drawn.is_none()).count() as f64 / all.len().max(1) as f64
}

/// Residual relative to the variation of the data below which a footprint counts as found.
const LEAST_PART: f64 = 0.7;

fn judge_size(profile: &Profile, found: &Candidate) -> Result<(), TipError> {
    let line = vec![profile.x().to_vec(), vec![1.0; profile.x().len()]];
    let left = crate::projection::project(&line, profile.f()).map(|p| p.residuals);
    let left = left.unwrap_or_default();
    let variation = (crate::least_squares::squares(&left) / left.len().max(1) as f64).sqrt();
    if found.residual < LEAST_PART * variation {
        return Ok(());
    }
    Err(TipError::Nothing { residual: found.residual, variation })
}

/// Index of the lowest criterion.
fn best(candidates: &[Candidate]) -> usize {
    let least =
        |a: &usize, b: &usize| candidates[*a].criterion.total_cmp(&candidates[*b].criterion);
    (0..candidates.len()).min_by(least).unwrap_or(0)
}

/// Correlation of neighbouring residuals.
fn correlation(residuals: &[f64]) -> f64 {
    let sum = crate::least_squares::squares(residuals);
    let along: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
    if sum > 0.0 { along / sum } else { 0.0 }
}

/// Number of effectively independent rows, if the correlation of neighbours is significant.
fn effective(rows: usize, correlation: f64) -> f64 {
    let rows = rows as f64;
    let by_chance = 2.0 / rows.sqrt();
    if correlation <= by_chance {
        return rows;
    }
    let rho = correlation.min(0.95);
    (rows * (1.0 - rho) / (1.0 + rho)).max(8.0)
}

/// Relative half width of an interval above which a warning is given.
const WIDE: f64 = 0.05;
const ABOVE_NOISE: f64 = 1.3;

/// Distance of the apex from the measured positions, in σ, above which a warning is given.
const OUTSIDE: f64 = 0.5;

/// Noise relative to the apex above which half a profile does not separate a tilt from a lobe.
const DOUBTFUL: f64 = 0.015;

impl MeasuredTip {
    /// Whether nearly all rows are on one side of the centre.
    fn is_one_sided(&self) -> bool {
        let x = &self.fitted.x;
        let before = x.partition_point(|x| *x < self.centre);
        let few = x.len() / 10;
        before <= few || x.len() - before <= few
    }

    /// Relative difference of the widths of the two sides of the profile, that at larger positions minus the other; `None`
    /// if it is within the noise, or if the profile has one side only.
    pub fn asymmetry(&self) -> Option<f64> {
        if self.is_one_sided() { None } else { lopsided::asymmetry(self) }
    }

    /// Distance of the apex from the measured positions; 0 within them.
    fn outside(&self) -> f64 {
        let x = &self.fitted.x;
        let nearest = self.centre.clamp(x[0], x[x.len() - 1]);
        (self.centre - nearest).abs()
    }

    /// Warnings about the result.
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = vec![];
        if self.outside() > OUTSIDE * self.sigma.value {
            remarks.push(format!(
                "the apex, at {:.3e}, lies outside of the profile: only a flank was measured, so that width and alpha follow \
                 from an assumed shape and may be wrong by more than their intervals; measure the apex too",
                self.centre
            ));
        }
        let relative = self.critical_alpha.relative();
        // Without resampled profiles there is no interval.
        if relative > WIDE && relative.is_finite() {
            remarks.push(format!(
                "the profile determines the critical alpha only to ±{:.0} %: more rows, or less noise, would help",
                100.0 * relative
            ));
        }
        if self.is_one_sided() && self.residual > DOUBTFUL * self.apex.abs() {
            remarks.push(format!(
                "one half of a footprint with {:.1} % of noise hardly distinguishes a tilt of the background from a \
                 wide lobe: alpha may be wrong by more than its interval (by over 10 % in one of 200 cases); measure \
                 both halves",
                100.0 * self.residual / self.apex.abs()
            ));
        }
        if self.ground.len() > 2 {
            remarks.push(format!(
                "the background is curved: a polynomial of order {} is fitted to it; a wide lobe may look the same",
                self.ground.len() - 1
            ));
        }
        if self.residual > ABOVE_NOISE * self.noise {
            remarks.push(format!(
                "the residual, {:.2e}, is larger than the noise from row to row, {:.2e}: the background is rough, f \
                 is not even, or not a sum of Gaussians",
                self.residual, self.noise
            ));
        }
        if self.chosen + 1 == MOST_TERMS {
            remarks.push(format!(
                "the largest number of Gaussians tried, {MOST_TERMS}, was chosen: more may fit better"
            ));
        }
        if self.lost > 0.01 {
            remarks.push(format!(
                "{:.0} % of the resampled profiles had no footprint with an onset and are not part of the intervals",
                100.0 * self.lost
            ));
        }
        remarks
    }
}
