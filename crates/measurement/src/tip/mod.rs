//! A footprint from a measured profile.

mod answers;
mod hidden;
mod resample;
mod search;
mod shape;

use crate::{Estimate, Profile};
use answers::{Answers, normalised};
use resample::Resampling;
pub use search::Candidate;
use search::{Found, MOST_TERMS};
use stickslip_tip::{Gaussian, stop};
use thiserror::Error;

/// What is asked of a profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Request {
    /// Where f is even about, in the unit of the positions; found where it is not given. A profile of one half is
    /// even about 0.
    pub centre: Option<f64>,
    /// σ, in the unit of the positions; found where it is not given.
    pub sigma: Option<f64>,
    /// Gaussians, a pair of twins counted once; chosen where it is not given.
    pub terms: Option<usize>,
    /// The r at which onset and trapping are told.
    pub r: f64,
    /// Profiles drawn to tell what the noise leaves open.
    pub resamples: usize,
    /// Of the draws.
    pub seed: u64,
}

impl Default for Request {
    fn default() -> Self {
        Self { centre: None, sigma: None, terms: None, r: 1.0, resamples: 400, seed: 0 }
    }
}

/// A footprint, and how far it can be trusted. Lengths and heights in the units of the profile, but for `gaussians`.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasuredTip {
    /// f, with f(0) = 1 and lengths in σ.
    pub gaussians: Vec<Gaussian>,
    /// The width of the Gaussian that is as wide at half of f(0): half of the full width over √(2 ln 2).
    pub sigma: Estimate,
    /// What f(0) = 1 is; negative for a pit.
    pub apex: f64,
    /// Where f is even about.
    pub centre: f64,
    /// Of 1, x and, where the ground is curved, x² and x³ in the ground.
    pub ground: Vec<f64>,
    /// Standard deviation of what is not smooth from row to row.
    pub noise: f64,
    /// Standard deviation of what the fit leaves.
    pub residual: f64,
    /// Correlation of what it leaves in neighbouring rows.
    pub correlation: f64,
    /// Every number of Gaussians tried.
    pub candidates: Vec<Candidate>,
    /// Place of the chosen one among them.
    pub chosen: usize,
    /// αc(r), dimensionless.
    pub critical_alpha: Estimate,
    /// Its ω, in k/Γ.
    pub critical_omega: Estimate,
    /// The least α of trapping at r; NaN where there is none.
    pub trapping_alpha: Estimate,
    /// The r that these are for.
    pub r: f64,
    /// Footprints like `gaussians` that may as well be what was measured, drawn: their spread is the error of the
    /// shape.
    pub draws: Vec<Vec<Gaussian>>,
    /// Draws that had no footprint or no onset, over all.
    pub lost: f64,
    /// Rows of the profile, the fit and what it leaves.
    pub fitted: Fitted,
}

/// Columns of equal length, by ascending position.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// Position.
    pub x: Vec<f64>,
    /// As measured.
    pub f: Vec<f64>,
    /// As fitted, ground and all.
    pub fit: Vec<f64>,
}

/// Why there is no footprint to give.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TipError {
    /// Too few rows for any sum.
    #[error(
        "{rows} rows are too few for {terms} Gaussian(s) on a sloping ground: give more rows, or fewer terms"
    )]
    Rows {
        /// Rows given.
        rows: usize,
        /// Gaussians asked for.
        terms: usize,
    },
    /// Nothing stands out of the noise.
    #[error(
        "no footprint stands out: the best fit leaves {residual:.2e} of heights that vary by {variation:.2e}"
    )]
    Nothing {
        /// Standard deviation of what is left.
        residual: f64,
        /// Standard deviation of the heights less a straight line.
        variation: f64,
    },
    /// The fitted sum has no apex at its centre, or none that falls to its half.
    #[error(
        "the fitted sum is no footprint with an apex at its centre, {centre}: give the centre, or look at the profile"
    )]
    NoApex {
        /// Where f was found to be even about.
        centre: f64,
    },
    /// Steady motion of such a tip is stable at any α.
    #[error("the fitted footprint has no onset of stick-slip at r = {r}")]
    NoOnset {
        /// As asked.
        r: f64,
    },
    /// The work was asked to [`stop`].
    #[error("the fit was interrupted")]
    Stopped,
}

/// So far behind the best by the criterion a sum may still be what was measured: it is e^-2 times as likely.
const PLAUSIBLE: f64 = 4.0;

/// Footprints that are drawn to carry the error of the shape.
const MOST_DRAWS: usize = 24;

/// A footprint: the sum of Gaussians, on a sloping or curved ground, that Schwarz' criterion chooses.
///
/// # Errors
/// Too few rows, nothing above the noise, a sum that is no footprint, or [`TipError::Stopped`].
pub fn tip(profile: &Profile, request: &Request) -> Result<MeasuredTip, TipError> {
    let found = measured(profile, request);
    // Searches that are asked to stop end as if there were nothing to find.
    if stop::is_asked() { Err(TipError::Stopped) } else { found }
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
        centre: request.centre,
        sigma: request.sigma,
        r: request.r,
        makers: candidates.iter().chain(&others).filter(is_plausible).collect(),
        effective,
        seed: request.seed,
    };
    let draws = resampling.draw(request.resamples);
    let asked = (request.centre, request.sigma, request.r);
    let factors = hidden::factors(profile, asked, found, effective);
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

/// The share of draws that have no answer.
fn lost(draws: &[Vec<Option<Answers>>]) -> f64 {
    let all: Vec<&Option<Answers>> = draws.iter().flatten().collect();
    all.iter().filter(|drawn| drawn.is_none()).count() as f64 / all.len().max(1) as f64
}

/// What is left must be less than this part of what varies.
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

/// The lowest criterion.
fn best(candidates: &[Candidate]) -> usize {
    let least =
        |a: &usize, b: &usize| candidates[*a].criterion.total_cmp(&candidates[*b].criterion);
    (0..candidates.len()).min_by(least).unwrap_or(0)
}

/// Correlation of neighbours.
fn correlation(residuals: &[f64]) -> f64 {
    let sum = crate::least_squares::squares(residuals);
    let along: f64 = residuals.windows(2).map(|pair| pair[0] * pair[1]).sum();
    if sum > 0.0 { along / sum } else { 0.0 }
}

/// Rows that are as good as independent, where neighbours hang together by more than chance has it.
fn effective(rows: usize, correlation: f64) -> f64 {
    let rows = rows as f64;
    let by_chance = 2.0 / rows.sqrt();
    if correlation <= by_chance {
        return rows;
    }
    let rho = correlation.min(0.95);
    (rows * (1.0 - rho) / (1.0 + rho)).max(8.0)
}

/// An interval that is wider than this to either side, and a residual so many times the noise, are remarked on.
const WIDE: f64 = 0.05;
const ABOVE_NOISE: f64 = 1.3;

/// Of the apex: with more noise, one half alone does not tell a tilt from a lobe.
const DOUBTFUL: f64 = 0.015;

impl MeasuredTip {
    /// Whether all rows but a few are on one side of the centre.
    fn is_one_sided(&self) -> bool {
        let x = &self.fitted.x;
        let before = x.partition_point(|x| *x < self.centre);
        let few = x.len() / 10;
        before <= few || x.len() - before <= few
    }

    /// What a reader should know before believing it.
    #[must_use]
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = vec![];
        let relative = self.critical_alpha.relative();
        if relative > WIDE {
            remarks.push(format!(
                "the profile leaves the critical alpha open by {:.0} % to either side: more rows, or less noise, tell more",
                100.0 * relative
            ));
        }
        if self.is_one_sided() && self.residual > DOUBTFUL * self.apex.abs() {
            remarks.push(format!(
                "one half of a footprint with {:.1} % of noise hardly tells a tilt of the ground from a wide lobe: alpha may be off by \
                 more than its interval has it (by over 10 % in one of 200); measure both halves",
                100.0 * self.residual / self.apex.abs()
            ));
        }
        if self.ground.len() > 2 {
            remarks.push(format!(
                "the ground is curved: a polynomial of order {} is fitted to it; a wide lobe may look like that",
                self.ground.len() - 1
            ));
        }
        if self.residual > ABOVE_NOISE * self.noise {
            remarks.push(format!(
                "what the fit leaves, {:.2e}, is more than the noise from row to row, {:.2e}: the ground is rough, f not even, or \
                 a sum of Gaussians does not follow it",
                self.residual, self.noise
            ));
        }
        if self.chosen + 1 == MOST_TERMS {
            remarks.push(format!(
                "as many Gaussians as are tried, {MOST_TERMS}, and more might be asked for"
            ));
        }
        if self.lost > 0.01 {
            remarks.push(format!(
                "{:.0} % of the profiles drawn anew had no footprint with an onset and do not count in the intervals",
                100.0 * self.lost
            ));
        }
        remarks
    }
}
