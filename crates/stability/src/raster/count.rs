//! Number of waves that grow at a given T and q, from the change of arg Q along the unit circle.

use super::determinant::Lines;
use super::optimum::Place;
use crate::transform::Scaled;
use crate::winding::{argument_along, whole};
use num_complex::Complex64;
use std::f64::consts::{PI, TAU};

/// Waves are counted at the α at which the zero of the threshold lies this far inside the unit circle, and outside it.
const OFF_CIRCLE: f64 = 1e-3;
/// Largest relative distance from the threshold of the α at which waves are counted.
const FARTHEST: f64 = 1e-3;

/// Numbers of growing waves at α below and above a threshold by the fraction `margin`.
#[derive(Debug, Clone, Copy)]
pub(super) struct Counted {
    pub(super) margin: f64,
    pub(super) below: Option<usize>,
    pub(super) above: Option<usize>,
}

/// Counts growing waves with the q of a threshold, slightly below and above this threshold.
pub(super) fn beside(lines: &Lines, place: Place) -> Counted {
    let slopes = place.slopes(lines);
    // How far T moves while w moves by OFF_CIRCLE.
    let moved = OFF_CIRCLE * (slopes.theta / slopes.t).norm();
    let margin = (moved / place.t).min(FARTHEST);
    let at = |part: f64| growing(lines, place.t * part, place.q);
    Counted { margin, below: at(1.0 + margin), above: at(1.0 - margin) }
}

/// Number of zeros of Q within the unit circle; `None` if one lies on it.
pub(super) fn growing(lines: &Lines, t: f64, q: f64) -> Option<usize> {
    let wave = lines.wave(q, 1.0);
    let along = |theta: Complex64| {
        let here = lines.determinant(&wave, &lines.phase(theta.re, 1.0), t).value;
        Scaled { value: here.value, derivative: here.along[1], log_scale: 0.0 }
    };
    let turned = argument_along(along, &corners(lines.felt())).ok()?;
    whole(turned, TAU)
}

/// Phases from -π to π, spaced more closely than the variation of sums of this number of lines.
fn corners(lines: usize) -> Vec<Complex64> {
    let finest = 0.3 / (lines as f64).max(1.0);
    let mut half = vec![0.0_f64];
    let mut theta = 0.0_f64;
    while theta < PI {
        theta = (theta + finest.max(0.1 * theta)).min(PI);
        half.push(theta);
    }
    let negative = half.iter().skip(1).rev().map(|theta| -theta);
    negative.chain(half.iter().copied()).map(Complex64::from).collect()
}
