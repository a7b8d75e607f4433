//! Starting points of a search, from the data: a wavelength, and a grid of motions.

use super::data::{Data, Scan, Track, ground};
use super::parameters::{Name, Values};
use super::pattern::ONE;
use super::problem::Problem;
use crate::least_squares::{Residuals, squares};
use crate::projection::project;
use std::f64::consts::TAU;
use stickslip_stability::trapping_alpha;
use stickslip_tip::Wider;
use stickslip_tip::sorting::{ends, sort_by_number};

/// Values of r, and of α over αc, that are tried if they are unknown.
const RS: [f64; 8] = [0.15, 0.3, 0.5, 0.75, 1.0, 1.4, 2.0, 3.0];
const OVER: [f64; 6] = [1.01, 1.04, 1.1, 1.2, 1.35, 1.6];
/// Phases that are tried, in turns relative to that of the first harmonic.
const PHASES: [f64; 3] = [0.0, -0.06, 0.06];
/// Number of best starting points that are refined, each with a different r; larger if a parameter of the extended
/// model is free, which creates further valleys.
const FOLLOWED: usize = 3;
const FOLLOWED_UNDER_A_LAW: usize = 6;

/// A starting point, with the directions of the scans.
pub(super) struct Start {
    pub(super) scans: Vec<Scan>,
    pub(super) searched: Vec<f64>,
}

/// Number of ratios from one r to the next, where they are close together.
const CLOSE: u32 = 80;
/// For other patterns than that of most ripples, α in parts of the way from αc to trapping, if there is one.
const ON_THE_WAY: [f64; 6] = [0.2, 0.35, 0.5, 0.65, 0.8, 0.87];

/// Starting points for every combination of possible directions of the tip.
pub(super) fn starts(problem: &Problem, asked: Option<Scan>, length: Option<f64>) -> Vec<Start> {
    let ways: Vec<Problem> = ways(problem.data, asked)
        .into_iter()
        .map(|scans| Problem { scans, ..problem.clone() })
        .collect();
    let mut judged: Vec<Vec<(f64, Vec<f64>)>> = ways.iter().map(|_| vec![]).collect();
    for values in lattice(problem, length) {
        for (way, judged) in ways.iter().zip(&mut judged) {
            let Some(start) = with_phases(way, &values) else { continue };
            let Some(left) = way.at(&start).map(|found| squares(&found)) else { continue };
            if left.is_finite() {
                judged.push((left, start));
            }
        }
    }
    let chosen = ways.iter().zip(judged).flat_map(|(way, judged)| {
        chosen(way, judged).into_iter().map(|searched| Start { scans: way.scans.clone(), searched })
    });
    chosen.collect()
}

/// The most promising starting points, each with a different r.
fn chosen(problem: &Problem, mut judged: Vec<(f64, Vec<f64>)>) -> Vec<Vec<f64>> {
    sort_by_number(&mut judged, |item| item.0);
    let is_of_extended_model = problem.free.iter().any(|name| name.is_of_extended_model());
    let most = if is_of_extended_model { FOLLOWED_UNDER_A_LAW } else { FOLLOWED };
    let mut chosen: Vec<Vec<f64>> = vec![];
    let r = problem.free.iter().position(|name| matches!(name, Name::R | Name::RPerVelocity));
    for (_, start) in judged {
        let is_other = |other: &Vec<f64>| r.is_none_or(|i| (other[i] - start[i]).abs() > 1e-9);
        if chosen.iter().all(is_other) || r.is_none() {
            chosen.push(start);
        }
        if chosen.len() == most {
            break;
        }
    }
    chosen
}

/// Largest number of tracks whose directions are varied separately; for more, all directions are the same.
const ONE_BY_ONE: usize = 3;

/// All combinations of directions.
fn ways(data: &[Data], asked: Option<Scan>) -> Vec<Vec<Scan>> {
    if let Some(scan) = asked {
        return vec![vec![scan; data.len()]];
    }
    let tracks = data.iter().filter(|data| !data.is_series()).count();
    if tracks > ONE_BY_ONE {
        return vec![vec![Scan::Right; data.len()], vec![Scan::Left; data.len()]];
    }
    let mut found: Vec<Vec<Scan>> = vec![vec![]];
    for data in data {
        let tried: &[Scan] =
            if data.is_series() { &[Scan::Right] } else { &[Scan::Right, Scan::Left] };
        let with = |before: &Vec<Scan>, scan: &Scan| [&**before, &[*scan]].concat();
        found = found.iter().flat_map(|b| tried.iter().map(move |scan| with(b, scan))).collect();
    }
    found
}

/// Grid of values of the free parameters.
fn lattice(problem: &Problem, measured: Option<f64>) -> Vec<Values> {
    let is_free = |name: Name| problem.free.contains(&name);
    let mut found = vec![problem.held];
    for name in [Name::Beta, Name::DepthLimit, Name::HealingTime, Name::Inertia] {
        let tried: &[f64] = match name {
            Name::Beta => &[0.3, 1.0],
            Name::DepthLimit => &[3.0, 30.0],
            Name::HealingTime => &[10.0, 100.0],
            _ => &[0.1, 1.0],
        };
        if is_free(name) {
            found = found.iter().flat_map(|v| tried.iter().map(|t| v.with(name, *t))).collect();
        }
    }
    if problem.data.iter().any(Data::is_series) {
        found = found.into_iter().flat_map(|values| of_series(problem, values)).collect();
    }
    if problem.data.iter().all(Data::is_series) {
        return found;
    }
    let mut motions = vec![];
    for values in found {
        for r in values.get(Name::R).map_or_else(|| rs(problem, &values), |r| vec![r]) {
            let over: Vec<f64> = match values.get(Name::Alpha) {
                Some(alpha) => vec![alpha],
                None => {
                    let onset = problem.onset(&values, r);
                    onset.map_or(vec![], |(at, _)| tried(problem, &values, (r, at)))
                }
            };
            for alpha in over {
                let values = values.with(Name::R, r).with(Name::Alpha, alpha);
                let model = values.model(problem.shape, alpha, r);
                let Some(waves) = model.and_then(|model| problem.cycles.waves(&model)) else {
                    continue;
                };
                let width = measured.map(|found| found / waves.ripple.wavelength);
                match (values.get(Name::Width), width) {
                    (Some(_), _) => motions.push(values),
                    (None, Some(width)) => motions.push(values.with(Name::Width, width)),
                    (None, None) => {}
                }
            }
        }
    }
    motions
}

/// The r that are tried. At a known α, motions of other patterns than that of most ripples have r in a narrow range.
fn rs(problem: &Problem, values: &Values) -> Vec<f64> {
    if problem.pattern == ONE || values.get(Name::Alpha).is_none() {
        return RS.to_vec();
    }
    let [first, .., last] = RS;
    (0..=CLOSE).map(|i| first * (last / first).powf(f64::from(i) / f64::from(CLOSE))).collect()
}

/// The α that are tried at this r and αc.
fn tried(problem: &Problem, values: &Values, (r, onset): (f64, f64)) -> Vec<f64> {
    let over = OVER.iter().map(|over| over * onset);
    let model = values.model(problem.shape, onset, r);
    let trapped =
        model.filter(|model| problem.pattern != ONE && *model.wider() == Wider::default());
    let far = trapped.and_then(|model| trapping_alpha(model.tip(), r).ok()).map(|end| end - onset);
    let far = far.filter(|far| *far > 0.0);
    over.chain(far.into_iter().flat_map(|far| ON_THE_WAY.map(|part| onset + part * far))).collect()
}

/// r and α of a series at its velocities and loads, in the middle of the range of ripples.
fn of_series(problem: &Problem, values: Values) -> Vec<Values> {
    let rows = problem.data.iter().find_map(|data| match data {
        Data::Onsets { velocity, load } => Some((velocity, load, None)),
        Data::Wavelengths { velocity, load, wavelength } => {
            Some((velocity, load, Some(wavelength)))
        }
        _ => None,
    });
    let Some((velocity, load, wavelength)) = rows else { return vec![values] };
    let middle =
        |values: &[f64]| (values.iter().map(|v| v.ln()).sum::<f64>() / values.len() as f64).exp();
    let found = RS.iter().flat_map(|r| {
        let onset = problem.onset(&values, *r);
        let over: &[f64] = if wavelength.is_some() { &OVER } else { &[1.0] };
        over.iter().filter_map(move |over| {
            let (alpha, born) = onset?;
            let per_load = over * alpha / middle(load);
            let mut found = values;
            for (name, value) in [
                (Name::RPerVelocity, Some(r / middle(velocity))),
                (Name::AlphaPerLoad, Some(per_load)),
                (Name::Width, wavelength.map(|w| middle(w) / born)),
            ] {
                if let (None, Some(value)) = (found.get(name), value) {
                    found.set(name, value);
                }
            }
            Some(found)
        })
    });
    found.collect()
}

/// The search variables for these values, with the phase of each track from its first harmonic.
fn with_phases(problem: &Problem, values: &Values) -> Option<Vec<f64>> {
    let mut start = problem.searched_for(values)?;
    if problem.data.iter().all(Data::is_series) {
        return Some(start);
    }
    let (alpha, r) = (values.get(Name::Alpha)?, values.get(Name::R)?);
    let waves = problem.cycles.waves(&values.model(problem.shape, alpha, r)?)?;
    let width = values.get(Name::Width)?;
    let numbers = start.len();
    for (data, scan) in problem.data.iter().zip(&problem.scans) {
        let sign = scan.sign();
        let (track, wave, back) = match data {
            Data::Ripple(track) => (track, &waves.ripple, None),
            Data::Friction(track) => (track, &waves.lag, None),
            Data::Loop(track, back) => (track, &waves.lag, Some(back)),
            _ => continue,
        };
        let length = wave.wavelength * width;
        let phase = |direction: f64, y: &[f64]| {
            harmonic(&track.x, y, direction / length).map(|(_, crest)| crest)
        };
        start.push(phase(sign, &track.y)?);
        if let Some(back) = back {
            let upside_down: Vec<f64> = back.iter().map(|y| -y).collect();
            start.push(phase(-sign, &upside_down)?);
        }
    }
    // The first harmonic is moved by the higher ones that are cut off at the ends.
    let moved = PHASES.iter().map(|by| {
        let mut moved = start.clone();
        moved[numbers..].iter_mut().for_each(|phase| *phase += by);
        moved
    });
    let left = |at: &Vec<f64>| problem.at(at).map_or(f64::INFINITY, |found| squares(&found));
    moved.min_by(|a, b| left(a).total_cmp(&left(b)))
}

/// The residual of the fit of one harmonic with this number of turns per length, and the position of its crest in turns
/// from the middle.
fn harmonic(x: &[f64], y: &[f64], turns: f64) -> Option<(f64, f64)> {
    let (first, last) = ends(x.iter().copied());
    let middle = 0.5 * (first + last);
    let turn = |x: &f64| (TAU * turns * (x - middle)).sin_cos();
    let (sin, cos): (Vec<f64>, Vec<f64>) = x.iter().map(turn).unzip();
    let mut columns = ground(x);
    columns.extend([cos, sin]);
    let found = project(&columns, y)?;
    let crest = found.coefficients[3].atan2(found.coefficients[2]) / TAU;
    Some((squares(&found.residuals), crest))
}

/// Smallest number of turns over the extent that is tried, number of trials per turn, and largest number of turns.
const FEWEST_TURNS: f64 = 1.25;
const STEPS_A_TURN: f64 = 6.0;
const MOST_TURNS: f64 = 300.0;
/// Number of rows that is sufficient for a wavelength.
const ENOUGH: usize = 1500;

/// Number of different wavelengths tried for a track.
pub(super) fn trials(track: &Track) -> f64 {
    (0.25 * track.x.len() as f64).min(MOST_TURNS) * 2.0
}

/// The wavelength whose first harmonic gives the smallest residual of a track.
pub(super) fn wavelength(track: &Track) -> Option<f64> {
    let every = track.x.len().div_ceil(ENOUGH).max(1);
    let thin = |v: &[f64]| v.iter().step_by(every).copied().collect::<Vec<f64>>();
    let (x, y) = (thin(&track.x), thin(&track.y));
    let (first, last) = ends(x.iter().copied());
    let extent = last - first;
    let most = (0.25 * x.len() as f64).min(MOST_TURNS);
    let left = |turns: f64| harmonic(&x, &y, turns / extent).map_or(f64::INFINITY, |h| h.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let steps = ((most - FEWEST_TURNS) * STEPS_A_TURN).max(0.0) as usize;
    let at = |i: usize| FEWEST_TURNS + i as f64 / STEPS_A_TURN;
    let best = (0..=steps).map(at).min_by(|a, b| left(*a).total_cmp(&left(*b)))?;
    // Golden section between its neighbours.
    let ends = (best - 1.0 / STEPS_A_TURN, best + 1.0 / STEPS_A_TURN);
    Some(extent / least_between(left, ends, 30))
}

/// The minimum of a function between two points, by this number of rounds of the golden section.
pub(super) fn least_between(
    of: impl Fn(f64) -> f64,
    (mut low, mut high): (f64, f64),
    rounds: usize,
) -> f64 {
    for _ in 0..rounds {
        let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
        if of(a) < of(b) { high = b } else { low = a }
    }
    0.5 * (low + high)
}
