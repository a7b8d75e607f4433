//! The numbers of the law from ripples, lateral forces, onsets and wavelengths: several data at once.
//!
//! What is compared is the settled motion: the limit cycle at α and r, what it leaves and what it feels. Offsets,
//! slopes and unknown gains are projected out; numbers are searched by their logarithms, phases in turns.

mod data;
mod likelihood;
mod misfit;
mod parameters;
mod problem;
mod retreat;
mod start;
mod wave;

pub use data::{Data, DataError, Track};
pub use likelihood::Fitted as FittedNumber;
pub use parameters::{Name, Shape, Values};

use crate::least_squares::{Minimum, minimum};
use likelihood::{Around, least_felt, plain};
use problem::Problem;
use stickslip_tip::stop;
use thiserror::Error;
use wave::Cycles;

/// What is to be fitted.
#[derive(Debug, Clone, PartialEq)]
pub struct FitRequest {
    /// Of the footprint.
    pub shape: Shape,
    /// Numbers that are known.
    pub known: Values,
    /// Numbers to fit; where none are named, those that the data are about and that are not known.
    pub free: Vec<Name>,
    /// Whether rows far off count less (Huber 1964).
    pub robust: bool,
}

/// The best fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// Each number fitted.
    pub numbers: Vec<FittedNumber>,
    /// All numbers, the known ones too.
    pub values: Values,
    /// Correlations of the logarithms of those fitted.
    pub correlations: Vec<Vec<f64>>,
    /// What was fitted to each of the data.
    pub parts: Vec<Part>,
    /// Rows in all, and numbers fitted, offsets, slopes, gains and phases among them.
    pub rows: usize,
    /// The latter.
    pub parameters: usize,
    /// What should be known before it is believed.
    pub remarks: Vec<String>,
}

/// Of one of the data, in its units.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The model at every row; of a loop forwards, then backwards. Loads at onset, or wavelengths, of a series.
    pub model: Vec<f64>,
    /// Standard deviation of what is left; of a series relative.
    pub residual: f64,
    /// Offset at position 0, slope, and gain, as far as there are such.
    pub offset: Option<f64>,
    /// Per length.
    pub slope: Option<f64>,
    /// Of an unknown one, over σ² for heights and over σ for forces.
    pub gain: Option<f64>,
    /// By how many standard deviations what is left repeats itself with the wavelength.
    pub misfit: Option<f64>,
}

/// Why there is no fit.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FitError {
    /// Data that cannot be used.
    #[error(transparent)]
    Data(#[from] DataError),
    /// No number is free.
    #[error("nothing is to be fitted: leave one of the known numbers out")]
    Nothing,
    /// No motion like it anywhere that was tried.
    #[error(
        "no motion of this footprint is like the data anywhere that was tried (r from 0.15 to 3, α from 1.01 to 1.6 αc): is it a settled ripple, by the tip that made it?"
    )]
    NoStart,
    /// The work was asked to [`stop`].
    #[error("the fit was interrupted")]
    Stopped,
}

/// Rounds of Huber's weights, and the residual from which on a row counts less, in standard deviations.
const ROUNDS: usize = 4;
const HUBER: f64 = 1.345;

/// Fits the numbers that are not known.
///
/// # Errors
/// Unusable data, nothing to fit, no start, or [`FitError::Stopped`].
pub fn fit(data: &[Data], request: &FitRequest) -> Result<Fit, FitError> {
    let found = best(data, request);
    // Searches that are asked to stop end as if there were nothing to find.
    if stop::is_asked() { Err(FitError::Stopped) } else { found }
}

fn best(data: &[Data], request: &FitRequest) -> Result<Fit, FitError> {
    data.iter().try_for_each(Data::judge)?;
    let cycles = Cycles::default();
    let free = free(data, request);
    if free.is_empty() {
        return Err(FitError::Nothing);
    }
    let weights: Vec<Vec<f64>> = data.iter().map(|data| vec![1.0; data.rows()]).collect();
    let mut problem = Problem {
        shape: &request.shape,
        data,
        held: request.known,
        free,
        noise: data.iter().map(first_noise).collect(),
        weights,
        cycles: &cycles,
        by_excess: true,
    };
    let (rows, parameters) = (problem.rows(), problem.parameters());
    if rows <= parameters {
        return Err(DataError::Rows { rows, parameters }.into());
    }
    let ends = start::starts(&problem).into_iter().filter_map(|start| minimum(&problem, &start));
    let mut best = ends.min_by(|a, b| a.sum.total_cmp(&b.sum)).ok_or(FitError::NoStart)?;
    let rounds = if request.robust { ROUNDS } else { usize::from(data.len() > 1) };
    for _ in 0..rounds {
        reweigh(&mut problem, &best, request.robust);
        best = minimum(&problem, &best.parameters).ok_or(FitError::NoStart)?;
    }
    let (problem, best) = by_logarithms(problem, &best).ok_or(FitError::NoStart)?;
    let best = retreat::retreated(&problem, best);
    let around = Around::of(&problem, &best).ok_or(FitError::NoStart)?;
    let numbers: Vec<FittedNumber> = (0..problem.free.len()).map(|i| around.fitted(i)).collect();
    let parts = parts(&problem, &best);
    let remarks = remarks(&problem, &around, &numbers, &parts);
    Ok(Fit {
        correlations: around.correlations(),
        values: problem.values(&best.parameters).unwrap_or(request.known),
        numbers,
        parts,
        rows,
        parameters,
        remarks,
    })
}

/// The best fit with all numbers by their logarithms, as intervals are told.
fn by_logarithms<'a>(problem: Problem<'a>, best: &Minimum) -> Option<(Problem<'a>, Minimum)> {
    let values = problem.values(&best.parameters)?;
    let numbers = problem.free.len();
    let problem = Problem { by_excess: false, ..problem };
    let mut at = problem.searched_for(&values)?;
    at.extend(&best.parameters[numbers..]);
    // A last step, by the same derivatives as the intervals.
    let best = minimum(&problem, &at)?;
    Some((problem, best))
}

/// Those asked for, or those that the data are about.
fn free(data: &[Data], request: &FitRequest) -> Vec<Name> {
    let tracks = data.iter().any(|data| !data.is_series());
    let lengths = data.iter().any(|data| !matches!(data, Data::Onsets { .. }));
    let series = data.iter().any(Data::is_series);
    let about = |name: Name| match name {
        Name::Alpha | Name::R => tracks,
        Name::Width => lengths,
        Name::AlphaPerLoad | Name::RPerVelocity => series,
        _ => false,
    };
    let wanted = |name: &Name| request.free.contains(name) || about(*name);
    Name::ALL.into_iter().filter(wanted).filter(|name| request.known.get(*name).is_none()).collect()
}

/// A scale of the residuals before anything is known of them.
fn first_noise(data: &Data) -> f64 {
    match data {
        Data::Ripple(track) | Data::Friction(track) | Data::Loop(track, _) => {
            let mean = track.y.iter().sum::<f64>() / track.y.len() as f64;
            let square = track.y.iter().map(|y| (y - mean).powi(2)).sum::<f64>();
            (square / track.y.len() as f64).sqrt().max(f64::MIN_POSITIVE)
        }
        Data::Onsets { .. } | Data::Wavelengths { .. } => 1.0,
    }
}

/// What each of the data leaves sets its noise; and, if rows far off are to count less, their weights.
fn reweigh(problem: &mut Problem, best: &Minimum, robust: bool) {
    let mut from = 0;
    for (i, data) in problem.data.iter().enumerate() {
        let here = &best.residuals[from..from + data.rows()];
        from += data.rows();
        let plain_of = here.iter().zip(&problem.weights[i]).map(|(r, w)| r / w.max(1e-6));
        let plain_of: Vec<f64> = plain_of.collect();
        let spread = if robust {
            median(plain_of.iter().map(|r| r.abs()).collect()) / MEDIAN_OF_NORMAL
        } else {
            (plain(here, &problem.weights[i]) / here.len() as f64).sqrt()
        };
        if !(spread.is_finite() && spread > 0.0) {
            continue;
        }
        if robust {
            problem.weights[i] = plain_of
                .iter()
                .map(|r| (HUBER * spread / r.abs().max(f64::MIN_POSITIVE)).min(1.0).sqrt())
                .collect();
        }
        problem.noise[i] *= spread;
    }
}

/// Half of a normal distribution is within so many standard deviations.
const MEDIAN_OF_NORMAL: f64 = 0.674_489_75;

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}

/// What was fitted to each of the data.
fn parts(problem: &Problem, best: &Minimum) -> Vec<Part> {
    let found = problem.parts(&best.parameters).zip(problem.values(&best.parameters));
    let Some((found, values)) = found else { return vec![] };
    let share = problem.data.len() as f64;
    let each = problem.data.iter().zip(found).zip(problem.noise.iter().zip(&problem.weights));
    let part = |((data, found), (noise, weights)): ((&Data, crate::projection::Projected), _)| {
        let weights: &Vec<f64> = weights;
        let left: Vec<f64> =
            found.residuals.iter().zip(weights).map(|(r, w)| r / w.max(1e-6) * noise).collect();
        let numbers = data.linear() as f64 + problem.searched() as f64 / share;
        let freedom = (left.len() as f64 - numbers).max(1.0);
        let residual = (left.iter().map(|r| r * r).sum::<f64>() / freedom).sqrt();
        let less = |y: &[f64]| -> Vec<f64> { y.iter().zip(&left).map(|(y, r)| y - r).collect() };
        let model = match data {
            Data::Ripple(track) | Data::Friction(track) => less(&track.y),
            Data::Loop(track, back) => less(&[&*track.y, back].concat()),
            Data::Onsets { load, .. } => {
                load.iter().zip(&left).map(|(load, r)| load / r.exp()).collect()
            }
            Data::Wavelengths { wavelength, .. } => {
                wavelength.iter().zip(&left).map(|(w, r)| w / r.exp()).collect()
            }
        };
        let length = || {
            let (alpha, r) = (values.get(Name::Alpha)?, values.get(Name::R)?);
            let waves = problem.cycles.waves(&values.model(problem.shape, alpha, r)?)?;
            Some(waves.ripple.wavelength * values.get(Name::Width)?)
        };
        let (mut offset, mut slope, mut gain, mut misfit) = (None, None, None, None);
        if let Data::Ripple(track) | Data::Friction(track) | Data::Loop(track, _) = data {
            let (first, last) = problem::ends(&track.x);
            let per_length = 2.0 * found.coefficients[1] / (last - first);
            slope = Some(per_length);
            offset = Some(found.coefficients[0] - 0.5 * (first + last) * per_length);
            gain = found.coefficients.get(2).copied();
            misfit = length().map(|length| misfit::of_track(track, &left, length));
        }
        Part { model, residual, offset, slope, gain, misfit }
    };
    each.map(part).collect()
}

/// What is left that repeats itself by so many standard deviations is not noise.
const MISFIT: f64 = 4.0;
/// An interval whose ends are this many times apart says little.
const WIDE: f64 = 3.0;
/// Powers below this are left out of a combination.
const NO_POWER: f64 = 0.15;

fn remarks(
    problem: &Problem,
    around: &Around,
    numbers: &[FittedNumber],
    parts: &[Part],
) -> Vec<String> {
    let mut remarks = vec![];
    for (i, part) in parts.iter().enumerate() {
        if part.misfit.is_some_and(|misfit| misfit > MISFIT) {
            remarks.push(format!(
                "what the fit leaves of data {} repeats itself with the wavelength, {:.0} standard deviations above noise: the \
                 footprint is another, or the law a wider one (a depth limit, healing, inertia)",
                i + 1,
                part.misfit.unwrap_or(0.0)
            ));
        }
        if part.gain.is_some_and(|gain| gain < 0.0) {
            remarks.push(format!(
                "data {} are upside down beside the model: heights go up, forces hold the tip back",
                i + 1
            ));
        }
    }
    let open = |n: &&FittedNumber| n.estimate.high / n.estimate.low > WIDE;
    let wide: Vec<&str> = numbers.iter().filter(open).map(|n| n.name.word()).collect();
    if wide.is_empty() {
        return remarks;
    }
    let combination = least_felt(around)
        .filter(|(powers, _)| powers.iter().filter(|p| p.abs() > NO_POWER).count() > 1);
    remarks.push(match combination {
        Some((powers, _)) => {
            let each = problem.free.iter().zip(powers).filter(|(_, p)| p.abs() > NO_POWER);
            let words = each.map(|(name, p)| format!("{}^{p:.2}", name.word()));
            format!(
                "{} cannot be told well by these data: they hardly feel a change along {}; hold one of them, or give data of \
                 another kind",
                wide.join(" and "),
                words.collect::<Vec<String>>().join(" · ")
            )
        }
        None => format!("{} cannot be told well by these data", wide.join(" and ")),
    });
    remarks
}
