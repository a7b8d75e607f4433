//! The largest T, by Newton's method.

use super::determinant::{Lines, Phase, Wave};
use super::growth::cramer;
use super::on_cell::Determinant;
use crate::newton::real_steps;
use num_complex::Complex64;
use std::f64::consts::PI;

const MOST_STEPS: usize = 40;
/// Step of finite differences, as a fraction of a cell.
const PART: f64 = 1e-2;
/// Largest step of Newton's method, in cells.
const FARTHEST: f64 = 1e3;
/// Q counts as 0 if |Q| is below this fraction of T |∂Q/∂T|.
const SOLVED: f64 = 1e-12;

/// A zero of Q.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Place {
    /// T
    pub(super) t: f64,
    pub(super) q: f64,
    /// arg w; on a zigzag arg W = arg w²
    pub(super) theta: f64,
    pub(super) is_stationary: bool,
}

/// Q and its derivatives with respect to T, q and θ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    pub(super) value: Complex64,
    pub(super) t: Complex64,
    pub(super) q: Complex64,
    pub(super) theta: Complex64,
}

impl Place {
    /// Whether T is stationary here, and this place is in the cell or next to it.
    pub(super) fn settles(&self, [q, theta]: [(f64, f64); 2]) -> bool {
        let is_in = |x: f64, (centre, half): (f64, f64)| (x - centre).abs() <= 3.0 * half;
        self.is_stationary && is_in(self.q, q) && is_in(self.theta, theta)
    }

    pub(super) fn slopes(&self, lines: &Lines) -> Slopes {
        slopes(lines, (&lines.wave(self.q, 1.0), &lines.phase(self.theta, 1.0)), self.t)
    }
}

fn slopes(lines: &Lines, (wave, phase): (&Wave, &Phase), t: f64) -> Slopes {
    let Determinant { value, slope, .. } = lines.determinant(wave, phase, t);
    let [q, theta] = value.along;
    Slopes { value: value.value, t: slope.value, q, theta }
}

/// A zero of Q, sought from the middle of a cell and T = `known`: if possible one at which T is stationary. If the tip is
/// flexible across the lines, T may be largest at q = 0, which Newton's method does not reach from q > 0.
pub(super) fn candidate(lines: &Lines, cell: [(f64, f64); 2], known: f64) -> Option<Place> {
    let [(q, half_q), phases] = cell;
    let moving = moving(lines, cell, known);
    if !lines.is_plane() || q > half_q {
        return moving;
    }
    let still = still(lines, phases, known);
    moving.into_iter().chain(still).max_by(|a, b| a.t.total_cmp(&b.t))
}

/// A zero of Q at q = 0. T is stationary there if w is real, because then Q is real too, and on a zigzag with an even
/// footprint, because then Q is even in q.
pub(super) fn still(lines: &Lines, (theta, half): (f64, f64), known: f64) -> Option<Place> {
    let real = if theta.abs() < 0.5 * PI { 0.0 } else { PI.copysign(theta) };
    let is_real = lines.is_alone() || (theta - real).abs() <= half;
    let start = started(lines, 0.0, if is_real { real } else { theta }, known)?;
    let is_stationary = is_real || lines.is_mirrored();
    solved(lines, start).map(|place| Place { is_stationary, ..place })
}

fn moving(lines: &Lines, cell: [(f64, f64); 2], known: f64) -> Option<Place> {
    let [(q, _), (theta, half_theta)] = cell;
    let start = started(lines, q, lines.symmetric(theta, half_theta), known)?;
    if lines.is_alone() {
        return solved(lines, start);
    }
    let stationary = stationary(lines, start, cell).and_then(|place| solved(lines, place));
    let stationary = stationary.map(|place| Place { is_stationary: true, ..place });
    stationary.or_else(|| solved(lines, start))
}

/// Newton's method for Q = 0 and [`balance`] = 0, where T is stationary.
pub(super) fn stationary(lines: &Lines, mut place: Place, cell: [(f64, f64); 2]) -> Option<Place> {
    let [(_, half_q), (_, half_theta)] = cell;
    let (step_q, step_theta) = (PART * half_q, PART * half_theta);
    let mut before = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let Place { t, q, theta, .. } = place;
        let waves = [q, q - step_q, q + step_q].map(|q| lines.wave(q, 1.0));
        let phases = [theta, theta - step_theta, theta + step_theta].map(|x| lines.phase(x, 1.0));
        let here = slopes(lines, (&waves[0], &phases[0]), t);
        let at = |t: f64, i: usize, j: usize| balance(&slopes(lines, (&waves[i], &phases[j]), t));
        let difference = |up: f64, down: f64, step: f64| (up - down) / (2.0 * step);
        let step_t = PART * here.t.norm();
        let row = [
            difference(at(t + step_t, 0, 0), at(t - step_t, 0, 0), step_t),
            difference(at(t, 2, 0), at(t, 1, 0), step_q),
            difference(at(t, 0, 2), at(t, 0, 1), step_theta),
        ];
        let rows =
            [[here.t.re, here.q.re, here.theta.re], [here.t.im, here.q.im, here.theta.im], row];
        let [t, q, theta] = solution(rows, [here.value.re, here.value.im, balance(&here)])?;
        let size = (t / place.t).abs() + (q / half_q).abs() + (theta / half_theta).abs();
        place = Place { t: place.t - t, q: place.q - q, theta: place.theta - theta, ..place };
        if !(place.q > 0.0 && place.t > 0.0 && size < FARTHEST) {
            return None;
        }
        if size < 1e-13 || size < 1e-6 && size >= before {
            return Some(place);
        }
        before = size;
    }
    None
}

/// The start of Newton's method: the largest T at which Q would vanish at this q and θ if it were real.
fn started(lines: &Lines, q: f64, theta: f64, known: f64) -> Option<Place> {
    let here = lines.determinant(&lines.wave(q, 1.0), &lines.phase(theta, 1.0), known);
    let t = known + here.beyond();
    let is_stationary = lines.is_alone();
    (t.is_finite() && t > 0.0).then_some(Place { t, q, theta, is_stationary })
}

/// Newton's method for Q = 0 in T and θ, at the same q; for a single line in T and q.
pub(super) fn solved(lines: &Lines, mut place: Place) -> Option<Place> {
    for _ in 0..MOST_STEPS {
        let here = place.slopes(lines);
        let other = if lines.is_alone() { here.q } else { here.theta };
        let [step_t, step] = real_steps(here.value, [here.t, other]);
        if !(step_t.is_finite() && step.is_finite()) {
            return None;
        }
        place.t -= step_t;
        if lines.is_alone() {
            place.q -= step;
        } else {
            place.theta -= step;
        }
        if !(place.t > 0.0 && place.q >= 0.0) {
            return None;
        }
        if step_t.abs() <= 2.0 * f64::EPSILON * place.t && step.abs() < SOLVED {
            return Some(place);
        }
    }
    let here = place.slopes(lines);
    (here.value.norm() <= SOLVED * place.t * here.t.norm()).then_some(place)
}

/// 0 where T is stationary: there Q remains 0 if q and θ change and T does not, so that the slopes of Q along q and θ are
/// parallel in the complex plane.
fn balance(slopes: &Slopes) -> f64 {
    (slopes.q * slopes.theta.conj()).im / slopes.theta.norm()
}

/// The solution of three linear equations, if it is finite.
fn solution(rows: [[f64; 3]; 3], right: [f64; 3]) -> Option<[f64; 3]> {
    let x = cramer(rows, right);
    x.iter().all(|x| x.is_finite()).then_some(x)
}
