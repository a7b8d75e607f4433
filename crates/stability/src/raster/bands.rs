//! Bands of waves: every local maximum of T, at which another kind of wave may begin to grow.
//!
//! The zeros of Q with real T, q and θ are curves; along them T rises to several maxima, of ripples and of lines that bunch or
//! snake. The largest of all follows from the certified search (`search.rs`). The others are what Newton's method finds
//! from a lattice of wave numbers and phases: a narrow band may be missed.

use super::determinant::Lines;
use super::optimum::{Place, solved, stationary, still};
use super::search::largest;
use crate::StabilityError;
use std::f64::consts::PI;
use stickslip_tip::sorting::sort_by_number;
use stickslip_tip::stop;

/// Number of wave numbers of the lattice.
const WAVE_NUMBERS: u32 = 48;
/// Number of phases of the lattice, from 0 to 2π.
const PHASES: f64 = 32.0;
/// Half the width of a cell about the wave number of a single line.
const NARROW: f64 = 1e-3;
/// Places closer than this count as one.
const APART: f64 = 1e-6;
/// Steps along the curve of zeros after which T is compared with a maximum; the first that can be made is used.
const BESIDE: [f64; 6] = [1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8];

/// All maxima found with T of at least `least` and q up to `band`, the largest T first.
pub(super) fn bands(lines: &Lines, least: f64, band: f64) -> Result<Vec<Place>, StabilityError> {
    let mut found: Vec<Place> = vec![];
    let (centre, half_range) = lines.phases();
    let mut keep = |place: Place| {
        let is_known = found.iter().any(|known| is_same(lines, *known, place));
        if place.t >= least && place.q < 2.0 * band && !is_known && is_largest(lines, place) {
            found.push(place);
        }
    };
    let half_q = 0.5 * band / f64::from(WAVE_NUMBERS);
    let mut wave_numbers: Vec<(f64, f64)> =
        (0..WAVE_NUMBERS).map(|i| (half_q * f64::from(2 * i + 1), half_q)).collect();
    // Lines that hardly feel each other have bands as narrow as that beside those of a single line.
    for single in lines.alone_each() {
        wave_numbers.extend(largest(&single, least)?.place.map(|place| (place.q, NARROW)));
    }
    let half_theta = PI / PHASES;
    let phases = (0..).map(|j: u32| centre - half_range + half_theta * f64::from(2 * j + 1));
    let phases = phases.take_while(|theta| *theta < centre + half_range);
    for theta in phases.take_while(|_| !stop::is_requested()) {
        let phase = lines.phase(theta, half_theta);
        still(lines, (theta, half_theta), least).into_iter().for_each(&mut keep);
        for &(q, half_q) in &wave_numbers {
            let cell = [(q, half_q), (theta, half_theta)];
            let theta = lines.symmetric(theta, half_theta);
            let here = lines.determinant(&lines.wave(q, half_q), &phase, 0.0);
            for t in here.near_axis().into_iter().filter(|t| *t > 0.5 * least) {
                let start = Place { t, q, theta, is_stationary: false };
                let place = stationary(lines, start, cell).and_then(|place| solved(lines, place));
                place.into_iter().for_each(&mut keep);
            }
        }
    }
    sort_by_number(&mut found, |item| -item.t);
    Ok(found)
}

fn is_same(lines: &Lines, a: Place, b: Place) -> bool {
    let turned = |a: f64, b: f64| (0.5 * (a - b)).sin().abs() < APART;
    // Q(W*) = Q(W)* on a zigzag with equal sides, and at q = 0.
    let is_mirrored = lines.is_mirrored() || a.q.abs() < APART;
    let is_turned = turned(a.theta, b.theta) || is_mirrored && turned(a.theta, -b.theta);
    is_turned && (a.q - b.q).abs() < APART * (1.0 + a.q)
}

/// Whether T is smaller a small step farther along the curve of zeros, on both sides.
fn is_largest(lines: &Lines, place: Place) -> bool {
    let slopes = place.slopes(lines);
    let turn = -(slopes.q / slopes.theta).re;
    let along = |place: Place, step: f64| {
        let near = Place { q: place.q + step, theta: place.theta + turn * step, ..place };
        let there = solved(lines, near)?;
        ((there.theta - near.theta).abs() < 0.1 * PI).then_some(there.t)
    };
    // Q(-q, w*) = Q(q, w)*, and Newton's method does not go below q = 0.
    let mirrored = Place { q: -place.q, theta: -place.theta, ..place };
    let both = |step: f64| {
        let before = if place.q > step { along(place, -step) } else { along(mirrored, step) };
        along(place, step).zip(before)
    };
    let steps = BESIDE.into_iter().map(|step| step / (1.0 + turn.abs()));
    let beside = steps.filter_map(both).next();
    beside.is_some_and(|(after, before)| after.max(before) < place.t)
}
