//! Where a search begins, found from the data: a wavelength, and a lattice of motions.

use super::data::{Data, Track};
use super::parameters::{Name, Values};
use super::problem::{Problem, ends};
use crate::least_squares::{Residuals, squares};
use crate::projection::project;
use std::f64::consts::TAU;
use stickslip_stability::critical;

/// r, and α over αc, of the motions that are tried where they are not known.
const RS: [f64; 8] = [0.15, 0.3, 0.5, 0.75, 1.0, 1.4, 2.0, 3.0];
const OVER: [f64; 6] = [1.01, 1.04, 1.1, 1.2, 1.35, 1.6];
/// Places of the wave that are tried about the one that its first harmonic says.
const PHASES: [f64; 3] = [0.0, -0.06, 0.06];
/// The best of them that are followed, each of another r; more where a number of a wider law is free, which makes valleys
/// of its own.
const FOLLOWED: usize = 3;
const FOLLOWED_UNDER_A_LAW: usize = 6;

/// Points from which to search, the most promising first.
pub(super) fn starts(problem: &Problem) -> Vec<Vec<f64>> {
    let tracks = problem.data.iter().find(|data| !data.is_series());
    let measured = tracks.and_then(|data| match data {
        Data::Ripple(track) | Data::Friction(track) | Data::Loop(track, _) => wavelength(track),
        _ => None,
    });
    let mut judged: Vec<(f64, Vec<f64>)> = lattice(problem, measured)
        .into_iter()
        .filter_map(|values| {
            let start = with_phases(problem, &values)?;
            let left = squares(&problem.at(&start)?);
            left.is_finite().then_some((left, start))
        })
        .collect();
    judged.sort_by(|a, b| a.0.total_cmp(&b.0));
    let is_of_a_law = problem.free.iter().any(|name| name.is_of_a_law());
    let most = if is_of_a_law { FOLLOWED_UNDER_A_LAW } else { FOLLOWED };
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

/// Values of the free numbers.
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
        for r in values.get(Name::R).map_or(RS.to_vec(), |r| vec![r]) {
            let over: Vec<f64> = match values.get(Name::Alpha) {
                Some(alpha) => vec![alpha],
                None => {
                    let onset = values.model(problem.shape, 1.0, r);
                    let onset = onset.and_then(|model| critical(model.tip(), r).ok());
                    onset.map_or(vec![], |at| OVER.iter().map(|o| o * at.alpha).collect())
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

/// r and α of a series over its velocities and loads, in the middle of what ripples have.
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
        let onset = values.model(problem.shape, 1.0, *r);
        let onset = onset.and_then(|model| critical(model.tip(), *r).ok());
        let over: &[f64] = if wavelength.is_some() { &OVER } else { &[1.0] };
        over.iter().filter_map(move |over| {
            let at = onset?;
            let per_load = over * at.alpha / middle(load);
            let mut found = values;
            for (name, value) in [
                (Name::RPerVelocity, Some(r / middle(velocity))),
                (Name::AlphaPerLoad, Some(per_load)),
                (Name::Width, wavelength.map(|w| middle(w) / at.wavelength)),
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

/// The values as they are searched, each track where its first harmonic has its crest.
fn with_phases(problem: &Problem, values: &Values) -> Option<Vec<f64>> {
    let mut start = problem.searched_for(values)?;
    if problem.data.iter().all(Data::is_series) {
        return Some(start);
    }
    let (alpha, r) = (values.get(Name::Alpha)?, values.get(Name::R)?);
    let waves = problem.cycles.waves(&values.model(problem.shape, alpha, r)?)?;
    let width = values.get(Name::Width)?;
    let numbers = start.len();
    for data in problem.data {
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
        start.push(phase(1.0, &track.y)?);
        if let Some(back) = back {
            let upside_down: Vec<f64> = back.iter().map(|y| -y).collect();
            start.push(phase(-1.0, &upside_down)?);
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

/// What a wave of one harmonic with this many turns per length leaves, and where it has its crest, in turns from the
/// middle.
fn harmonic(x: &[f64], y: &[f64], turns: f64) -> Option<(f64, f64)> {
    let (first, last) = ends(x);
    let slope = x.iter().map(|x| (2.0 * x - first - last) / (last - first)).collect();
    let middle = 0.5 * (first + last);
    let turn = |x: &f64| (TAU * turns * (x - middle)).sin_cos();
    let (sin, cos): (Vec<f64>, Vec<f64>) = x.iter().map(turn).unzip();
    let found = project(&[vec![1.0; x.len()], slope, cos, sin], y)?;
    let crest = found.coefficients[3].atan2(found.coefficients[2]) / TAU;
    Some((squares(&found.residuals), crest))
}

/// Turns over the extent that are tried, and steps of them.
const FEWEST_TURNS: f64 = 1.0;
const STEPS_A_TURN: f64 = 6.0;
const MOST_TURNS: f64 = 300.0;
/// Rows that are enough for a wavelength.
const ENOUGH: usize = 1500;

/// The wavelength whose first harmonic leaves least of a track.
fn wavelength(track: &Track) -> Option<f64> {
    let every = track.x.len().div_ceil(ENOUGH).max(1);
    let thin = |v: &[f64]| v.iter().step_by(every).copied().collect::<Vec<f64>>();
    let (x, y) = (thin(&track.x), thin(&track.y));
    let (first, last) = ends(&x);
    let extent = last - first;
    let most = (0.25 * x.len() as f64).min(MOST_TURNS);
    let left = |turns: f64| harmonic(&x, &y, turns / extent).map_or(f64::INFINITY, |h| h.0);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
    let steps = ((most - FEWEST_TURNS) * STEPS_A_TURN).max(0.0) as usize;
    let at = |i: usize| FEWEST_TURNS + i as f64 / STEPS_A_TURN;
    let best = (0..=steps).map(at).min_by(|a, b| left(*a).total_cmp(&left(*b)))?;
    // Golden section between its neighbours.
    let (mut low, mut high) = (best - 1.0 / STEPS_A_TURN, best + 1.0 / STEPS_A_TURN);
    for _ in 0..30 {
        let (a, b) = (low + 0.382 * (high - low), low + 0.618 * (high - low));
        if left(a) < left(b) { high = b } else { low = a }
    }
    Some(extent / (0.5 * (low + high)))
}
