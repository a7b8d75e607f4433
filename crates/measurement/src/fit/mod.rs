//! Fit of the parameters of the model to ripples, lateral forces, onsets and wavelengths, combining several data
//! sets.
//!
//! The data are compared with the settled motion: the surface and the force of the limit cycle at α and r. Offsets,
//! slopes and unknown gains are projected out; parameters are searched by their logarithms, phases in turns.

mod comb;
mod data;
mod law;
mod likelihood;
mod noise;
mod parameters;
mod pattern;
mod problem;
mod remarks;
mod retreat;
mod rivals;
mod start;
mod subspace;
mod verdict;
mod wave;

pub use data::{Data, DataError, Scan, Track};
pub use likelihood::Fitted as FittedNumber;
pub use parameters::{Name, Shape, Values};
pub use rivals::Alternative;
pub use verdict::Judged;

use crate::interval::median;
use crate::least_squares::{Minimum, minimum};
use crate::profile::MEDIAN_OF_NORMAL;
use comb::{MOST_WAVES, Rows, by_chance, repeated};
use likelihood::{Around, plain};
use pattern::{ONE, Pattern};
use problem::Problem;
use start::Start;
use stickslip_tip::sorting::{ends, sort_by_number};
use stickslip_tip::{TipFunction, stop};
use thiserror::Error;
use verdict::{CHANGE, Evidence};
use wave::Cycles;

/// Options of a fit.
#[derive(Debug, Clone, PartialEq)]
pub struct FitRequest {
    /// Shape of the footprint.
    pub shape: Shape,
    /// Known parameters.
    pub known: Values,
    /// Parameters to fit; by default those that the data determine and that are not known.
    pub free: Vec<Name>,
    /// Whether outliers have a reduced weight (Huber 1964).
    pub robust: bool,
    /// Direction of the tip along the positions; both are tried if it is unknown.
    pub scan: Option<Scan>,
    /// Footprints, each in its own σ, drawn within the error of the measured shape; empty if it is exact.
    pub footprints: Vec<TipFunction>,
}

/// The best fit.
#[derive(Debug, Clone, PartialEq)]
pub struct Fit {
    /// The fitted parameters.
    pub numbers: Vec<FittedNumber>,
    /// All parameters, including the known ones.
    pub values: Values,
    /// Correlations of the logarithms of the fitted parameters.
    pub correlations: Vec<Vec<f64>>,
    /// The fit of each data set.
    pub parts: Vec<Part>,
    /// Total number of rows.
    pub rows: usize,
    /// Number of fitted parameters, including offsets, slopes, gains and phases.
    pub parameters: usize,
    /// Number of slips in a wavelength of the fitted motion: 2 beyond a period doubling.
    pub slips: usize,
    /// Other minima that the data do not exclude at 99.7 %, the likeliest first.
    pub alternatives: Vec<Alternative>,
    /// The best fit with a depth limit, if the request has none and the data do not exclude one at 95 %.
    pub with_depth_limit: Option<Alternative>,
    /// Whether the model explains the data: intervals are given only if it does.
    pub explained: bool,
    /// Probability that the joint residual of several data sets is as large by chance; `None` for a single data set.
    pub joint: Option<f64>,
    /// Warnings about the result.
    pub remarks: Vec<String>,
}

/// The fit of one data set, in its units.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// The model at every row; for a loop, the trace and then the retrace; for a series, loads at onset or wavelengths.
    pub model: Vec<f64>,
    /// Standard deviation of the residuals; relative for a series.
    pub residual: f64,
    /// Offset at position 0, if fitted.
    pub offset: Option<f64>,
    /// Slope per length, if fitted.
    pub slope: Option<f64>,
    /// Fitted gain, defined as in [`Track::gain`](super::Track::gain).
    pub gain: Option<f64>,
    /// The direction of the scan; `None` for a series.
    pub scan: Option<Scan>,
    /// Tests of the model against these data.
    pub judged: Judged,
}

/// The reason why there is no fit.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum FitError {
    /// Data that cannot be used.
    #[error(transparent)]
    Data(#[from] DataError),
    /// No parameter is free.
    #[error("there is no free parameter: leave one of the known parameters out")]
    Nothing,
    /// No wave is stronger than expected from noise.
    #[error(
        "no significant ripple: pure noise contains a wave as strong as the strongest one in {:.3} % of such data, where at \
         most 0.01 % is accepted; give a longer track of settled ripples, one with less noise, or one without the curvature of \
         a scanner",
        100.0 * probability
    )]
    Noise {
        /// Probability of an equally strong wave in noise alone.
        probability: f64,
    },
    /// No motion that was tried resembles the data.
    #[error(
        "no motion of this footprint resembles the data for any r from 0.15 to 3 and α from 1.01 to 1.6 αc: are the ripples settled, and is the footprint that of the tip that made them?"
    )]
    NoStart,
    /// The work was [cancelled](stop).
    #[error("the fit was interrupted")]
    Stopped,
}

/// Rounds of Huber's weights, and the residual in standard deviations above which a row has a reduced weight.
const ROUNDS: usize = 4;
const HUBER: f64 = 1.345;

/// Fits the parameters that are not known.
///
/// # Errors
/// Unusable data, nothing to fit, ripples no stronger than noise, no start, or [`FitError::Stopped`].
pub fn fit(data: &[Data], request: &FitRequest) -> Result<Fit, FitError> {
    let found = best(data, request);
    // Searches that are asked to stop end as if there were nothing to find.
    if stop::is_requested() { Err(FitError::Stopped) } else { found }
}

/// Largest probability of an equally strong wave in noise alone at which a track is accepted.
const NOISE: f64 = 1e-4;

fn best(data: &[Data], request: &FitRequest) -> Result<Fit, FitError> {
    let data: Vec<Data> = data.iter().cloned().map(Data::reduced).collect::<Result<_, _>>()?;
    let waves: Vec<Option<f64>> =
        data.iter().map(|data| data.track().and_then(start::wavelength)).collect();
    let of = |pattern| of_pattern((&data, &waves), request, pattern);
    let first = of(ONE);
    match &first {
        Ok(fit) if !fit.explained => {}
        Err(FitError::NoStart) => {}
        _ => return first,
    }
    let others = patterns(&data, &waves).into_iter().flat_map(of);
    let explained = others.filter(|fit| fit.explained);
    explained.min_by(|a, b| a.scatter().total_cmp(&b.scatter())).map_or(first, Ok)
}

/// The other patterns that the data suggest, in the order in which they are tried; none if the ripples change along the
/// track.
fn patterns(data: &[Data], waves: &[Option<f64>]) -> Vec<Pattern> {
    let of = |(data, length): (&Data, &Option<f64>)| {
        let rows = Rows::of(data)?;
        let (waves, comb) = repeated(&rows, (*length)?)?;
        comb.drift(&rows).is_none_or(|drift| drift >= CHANGE).then_some(waves)
    };
    let waves = data.iter().zip(waves).find_map(of);
    let found = waves.into_iter().flat_map(|waves| [2, 1].map(|slips| Pattern { slips, waves }));
    found.filter(|pattern| *pattern != ONE).collect()
}

/// The best fit of motions whose ripples repeat in this way; `waves` are the lengths of the strongest waves of the data.
fn of_pattern(
    (data, waves): (&[Data], &[Option<f64>]),
    request: &FitRequest,
    pattern: Pattern,
) -> Result<Fit, FitError> {
    let cycles = Cycles::of(pattern);
    let free = free(data, request);
    if free.is_empty() {
        return Err(FitError::Nothing);
    }
    let problem = Problem {
        shape: &request.shape,
        data,
        held: request.known,
        free,
        noise: data.iter().map(first_noise).collect(),
        weights: data.iter().map(|data| vec![1.0; data.rows()]).collect(),
        cycles: &cycles,
        by_excess: true,
        scans: vec![request.scan.unwrap_or(Scan::Right); data.len()],
        pattern,
    };
    judge_counts(&problem)?;
    if pattern == ONE {
        judge_noise(data, waves)?;
    }
    let length = waves.iter().flatten().next().map(|length| length * pattern.waves as f64);
    let starts = start::starts(&problem, request.scan, length);
    let end = |Start { scans, searched }| {
        let end = minimum(&Problem { scans: Vec::clone(&scans), ..problem.clone() }, &searched)?;
        Some((scans, end))
    };
    let mut ends: Vec<(Vec<Scan>, Minimum)> = starts.into_iter().filter_map(end).collect();
    sort_by_number(&mut ends, |item| item.1.sum);
    let (scans, mut best) = ends.first().cloned().ok_or(FitError::NoStart)?;
    let mut problem = Problem { scans, ..problem.clone() };
    let rounds = if request.robust { ROUNDS } else { usize::from(data.len() > 1) };
    for _ in 0..rounds {
        reweigh(&mut problem, &best, request.robust);
        best = minimum(&problem, &best.parameters).ok_or(FitError::NoStart)?;
    }
    let others: Vec<Start> =
        ends.into_iter().map(|(scans, end)| Start { scans, searched: end.parameters }).collect();
    settled(&problem, best, others, request)
}

/// Checks that there are enough rows, and enough different velocities and loads.
fn judge_counts(problem: &Problem) -> Result<(), DataError> {
    let (rows, parameters) = (problem.rows(), problem.parameters());
    if rows <= parameters {
        return Err(DataError::Rows { rows, parameters });
    }
    let places: Option<Vec<usize>> = problem.data.iter().map(Data::places).collect();
    match places.map(|places| places.iter().sum::<usize>()) {
        Some(places) if places < parameters => Err(DataError::Places { rows, places, parameters }),
        _ => Ok(()),
    }
}

/// Rejects tracks if none has a ripple that is stronger than expected from noise.
fn judge_noise(data: &[Data], waves: &[Option<f64>]) -> Result<(), FitError> {
    let mut least: Option<f64> = None;
    let mut tracks = 0.0;
    for (data, length) in data.iter().zip(waves) {
        let Some((rows, track)) = Rows::of(data).zip(data.track()) else { return Ok(()) };
        let Some(length) = *length else { return Ok(()) };
        let trials = start::trials(track);
        let Some(mut chance) = by_chance(&rows, length, 1, trials) else { return Ok(()) };
        if chance > NOISE {
            // Slips that are short beside the time between them have many waves, none of which is strong.
            let waves = repeated(&rows, length);
            let trials = trials * MOST_WAVES as f64;
            let again = waves.and_then(|(waves, _)| by_chance(&rows, length, waves, trials));
            chance = again.map_or(chance, |again| again.min(chance));
        }
        least = Some(least.map_or(chance, |least| least.min(chance)));
        tracks += 1.0;
    }
    match least.map(|least| (least * tracks).min(1.0)) {
        Some(probability) if probability > NOISE => Err(FitError::Noise { probability }),
        _ => Ok(()),
    }
}

/// The best fit, refined and tested.
fn settled(
    problem: &Problem,
    best: Minimum,
    others: Vec<Start>,
    request: &FitRequest,
) -> Result<Fit, FitError> {
    let (mut problem, mut best) = problem.by_logarithms(&best).ok_or(FitError::NoStart)?;
    let mut rivals = rivals::found(&problem, &best, others);
    // Weights and the last step may have turned two minima round.
    let least = rivals.iter_mut().min_by(|a, b| a.1.sum.total_cmp(&b.1.sum));
    if let Some((scans, least)) = least.filter(|least| least.1.sum < best.sum) {
        std::mem::swap(least, &mut best);
        std::mem::swap(scans, &mut problem.scans);
    }
    let best = retreat::retreated(&problem, best);
    let around = Around::of(&problem, &best).ok_or(FitError::NoStart)?;
    let footprints = rivals::with_footprints(&problem, &best, &request.footprints);
    let shifts: Vec<Vec<f64>> = footprints
        .iter()
        .map(|found| found.residuals.iter().zip(&best.residuals).map(|(a, b)| a - b).collect())
        .collect();
    let values = problem.values(&best.parameters).ok_or(FitError::NoStart)?;
    let evidence = Evidence {
        problem: &problem,
        best: &best,
        slopes: &around.slopes,
        length: length(&problem, &values),
        shifts: &shifts,
    };
    let verdict = evidence.verdict().ok_or(FitError::NoStart)?;
    let around = around.judged(&verdict).with_footprints(&footprints);
    let (rivals, alternatives) = rivals::judged(&problem, &around, rivals);
    let around = around.with_rivals(rivals);
    let scattered = verdict.each.iter().all(|judged| judged.noise.is_some())
        || best.sum / problem.rows() as f64 > EXACT * EXACT;
    let explained = verdict.is_explained() && scattered;
    let number = |i| if explained { around.fitted(i) } else { around.without_interval(i) };
    let numbers: Vec<FittedNumber> = (0..problem.free.len()).map(number).collect();
    let parts = parts(&problem, &best, &verdict.each);
    let mut fit = Fit {
        correlations: around.correlations(),
        values,
        numbers,
        parts,
        rows: problem.rows(),
        parameters: problem.parameters(),
        slips: problem.pattern.slips,
        alternatives,
        with_depth_limit: explained.then(|| law::with_depth_limit(&problem, &around)).flatten(),
        explained,
        joint: verdict.joint,
        remarks: vec![],
    };
    fit.remarks = remarks::remarks(&problem, &around, &fit, scattered);
    Ok(fit)
}

impl Fit {
    /// Twice the negative logarithm of the likelihood, with the noise of each data set as fitted, but for a constant.
    fn scatter(&self) -> f64 {
        let of = |part: &Part| 2.0 * part.model.len() as f64 * part.residual.ln();
        self.parts.iter().map(of).sum()
    }
}

/// Smallest relative scatter of a series; less is round-off and gives no error estimate.
const EXACT: f64 = 1e-7;

/// The wavelength of the ripples, in the unit of the data.
fn length(problem: &Problem, values: &Values) -> Option<f64> {
    let (alpha, r) = (values.get(Name::Alpha)?, values.get(Name::R)?);
    let waves = problem.cycles.waves(&values.model(problem.shape, alpha, r)?)?;
    Some(waves.ripple.wavelength * values.get(Name::Width)?)
}

/// The requested parameters, or those that the data determine.
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

/// An initial scale of the residuals.
fn first_noise(data: &Data) -> f64 {
    let Some(track) = data.track() else { return 1.0 };
    let mean = track.y.iter().sum::<f64>() / track.y.len() as f64;
    let square = track.y.iter().map(|y| (y - mean).powi(2)).sum::<f64>();
    (square / track.y.len() as f64).sqrt().max(f64::MIN_POSITIVE)
}

/// Sets the noise of each data set from its residuals, and the weights of outliers if requested.
fn reweigh(problem: &mut Problem, best: &Minimum, robust: bool) {
    let mut from = 0;
    for (i, data) in problem.data.iter().enumerate() {
        let here = &best.residuals[from..from + data.rows()];
        from += data.rows();
        let plain_of = here.iter().zip(&problem.weights[i]).map(|(r, w)| r / w.max(1e-6));
        let plain_of: Vec<f64> = plain_of.collect();
        let spread = if robust {
            median(plain_of.iter().map(|r| r.abs())).unwrap_or(0.0) / MEDIAN_OF_NORMAL
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

/// The fit of each data set.
fn parts(problem: &Problem, best: &Minimum, judged: &[Judged]) -> Vec<Part> {
    let Some(found) = problem.parts(&best.parameters) else { return vec![] };
    let share = problem.data.len() as f64;
    let part = |(i, found): (usize, crate::projection::Projected)| {
        let (data, noise, weights) = (&problem.data[i], problem.noise[i], &problem.weights[i]);
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
        let (mut offset, mut slope, mut gain) = (None, None, None);
        if let Some(track) = data.track() {
            let (first, last) = ends(track.x.iter().copied());
            let per_length = 2.0 * found.coefficients[1] / (last - first);
            slope = Some(per_length);
            offset = Some(found.coefficients[0] - 0.5 * (first + last) * per_length);
            gain = found.coefficients.get(2).copied();
        }
        let scan = (!data.is_series()).then_some(problem.scans[i]);
        Part { model, residual, offset, slope, gain, scan, judged: judged[i] }
    };
    found.into_iter().enumerate().map(part).collect()
}
