//! Trenches along the scan, and pairs of lines: the pattern of a tip that is free to move across.
//!
//! Trenches are uniform along the lines. Therefore they are sought on the surface minus a plane, and not minus the mean of
//! each line. Lines in pairs lie equally far from the trench that they share: their pattern appears between the lines.
//! Therefore the surface is evaluated on the lines and halfway between them.

use super::doubt::Doubt;
use super::estimate::Estimate;
use super::local::Local;
use super::regime::{FLAT, Regime};
use super::sheet::Sheet;
use super::vector::{MOST_ANGLE, Vector};
use super::wave::Wave;
use super::window::Window;
use super::{FEWEST_WAVES, POINTS, Pattern, SETTLED, Written, changing, felt, growth};
use crate::line::Line;
use crate::path::Path;
use crate::plan::Plan;
use crate::surface::Scanned;
use ndarray::Array2;
use std::f64::consts::PI;

/// Number of rows per line: one on the line, and one halfway to the next.
const ROWS: usize = 2;
/// Largest wave number across the lines, in units of π/d: pairs have 1, the rows of equal lines have 2.
const WIDEST: f64 = 1.25;
/// Smallest straightness of trenches.
const STRAIGHT: f64 = 0.6;

/// The pattern, if crests along the lines are the strongest wave of the surface; `None` otherwise.
pub(super) fn bunched(plan: &Plan, lines: &[Line], window: &Window) -> Option<Written> {
    let (sheet, amplitude) = sheet(plan, lines, window);
    let (carved, healed) = window.depth_and_healing(plan, lines);
    if sheet.amplitude() < FLAT * carved {
        return None;
    }
    let waves = trenches(&sheet, window.pitch)?;
    let changes = waves[0].changes(&sheet).map(|factor| factor * healed);
    let mut doubts: Vec<Doubt> = changing(changes).into_iter().collect();
    let is_settled = changes[1].ln().abs() <= SETTLED;
    let measured = Measured::of(&sheet, &waves, is_settled, (lines.len(), plan.area.longest()));
    let Measured { angle, wavelength, local, doubts: others } = measured;
    doubts.extend(others);
    let coherence = local.coherence_along(ROWS);
    let same_way = (plan.path == Path::Zigzag).then(|| local.coherence_along(2 * ROWS));
    let coherences = (coherence, same_way);
    let pattern =
        Pattern::of(&waves[0], (wavelength, angle), coherences, amplitude, local.defects());
    Some(Written { regime: Regime::Bunched, pattern: Some(pattern), doubts })
}

/// Growth of the relief across the lines, on a surface that is steady so far.
pub(super) fn growing(plan: &Plan, lines: &[Line]) -> Option<Doubt> {
    let window = Window::of(plan, lines.len()).ok()?;
    let (sheet, _) = sheet(plan, lines, &window);
    let rows = window.end - window.first;
    growth(plan, &sheet.u, window.depth_and_healing(plan, lines), (rows, lines.len()))
}

/// The wave of straight crests along lines one pitch apart, with its rivals; `None` if another wave is stronger.
fn trenches(sheet: &Sheet, pitch: f64) -> Option<Vec<Wave>> {
    let waves = Wave::strongest_of_all(sheet, FEWEST_WAVES, WIDEST * PI / pitch);
    let is_straight = || sheet.straightness() >= STRAIGHT;
    let first = waves.first()?;
    (first.is_along_the_lines() && is_straight()).then_some(waves)
}

struct Measured {
    angle: Option<Estimate>,
    wavelength: Option<Estimate>,
    /// Local amplitude and phase, with x and y exchanged.
    local: Local,
    doubts: Vec<Doubt>,
}

impl Measured {
    /// Measures the first of these waves, from this number of lines of this length. Its amplitude and phase are averaged across
    /// the trenches: x and y are exchanged.
    fn of(sheet: &Sheet, waves: &[Wave], is_settled: bool, (lines, length): (usize, f64)) -> Self {
        let exchanged = sheet.exchanged();
        let waves: Vec<Wave> = waves.iter().map(Wave::exchanged).collect();
        let local = Local::of(&exchanged, &waves[0]);
        let vector = Vector::of(&exchanged, &local, &waves, lines);
        let mut doubts = vec![];
        let angle = vector.crest_angle(&mut doubts);
        let angle = angle.map(|of| Estimate { value: 90.0 - of.value, ..of });
        let wavelength = vector.wavelength(is_settled, &mut doubts);
        for doubt in &mut doubts {
            match doubt {
                Doubt::Rivals(rivals) => {
                    rivals.iter_mut().for_each(|(_, angle)| *angle = 90.0 - *angle);
                }
                Doubt::Unresolved { error, .. } => {
                    let length = length * error.min(90.0) / MOST_ANGLE;
                    *doubt = Doubt::ShortTrenches { error: *error, length };
                }
                _ => {}
            }
        }
        Self { angle, wavelength, local, doubts }
    }
}

/// The surface in the window, on the lines and between them, and half its peak-to-peak value. Each row is then averaged with
/// its neighbours, so that the grooves of equal lines have the same height on all rows.
fn sheet(plan: &Plan, lines: &[Line], window: &Window) -> (Sheet, f64) {
    let Window { first, end, from, to, pitch } = *window;
    let (spacing, x) = window.points((POINTS * (to - from) * plan.band() / 8.7) as usize);
    let step = pitch / ROWS as f64;
    let low = lines[first].track().y - step;
    let count = ROWS * (end - first) + 2;
    let y: Vec<f64> = (0..count).map(|n| low + step * n as f64).collect();
    let heights = Scanned::new(plan, felt(plan, lines, (y[0], y[count - 1]))).heights(&x, &y);
    let sheet = |u| Sheet::about_a_plane(u, (from, spacing), step, plan.band());
    (sheet(averaged(&heights)), sheet(heights).amplitude())
}

/// Each row but the first and the last, averaged with its neighbours: a wave that alternates from row to row vanishes.
fn averaged(heights: &Array2<f64>) -> Array2<f64> {
    let (rows, columns) = heights.dim();
    let of = |n: usize, i: usize| heights[(n, i)];
    Array2::from_shape_fn((rows - 2, columns), |(n, i)| {
        0.25 * (of(n, i) + of(n + 2, i)) + 0.5 * of(n + 1, i)
    })
}

#[cfg(test)]
mod tests {
    use super::super::tests::Random;
    use super::*;
    use std::f64::consts::TAU;

    const PITCH: f64 = 1.0;
    const STEP: f64 = PITCH / ROWS as f64;
    const BAND: f64 = 8.7;

    /// Trenches with steep walls, at this angle to the lines, with noise.
    fn made(length: f64, angle: f64, noise: f64, random: &mut Random) -> Sheet {
        let (q, kappa) = (angle.to_radians().sin(), angle.to_radians().cos());
        let phase = random.between(0.0, TAU);
        let u = Array2::from_shape_fn((160, 240), |(n, i)| {
            let (x, y) = (0.25 * i as f64, STEP * n as f64);
            let turn = TAU / length * (q * x + kappa * y) + phase;
            turn.cos() + 0.4 * (2.0 * turn + 0.3).cos() + noise * random.between(-1.7, 1.7) - 5.0
        });
        Sheet::about_a_plane(u, (3.0, 0.25), STEP, BAND)
    }

    /// Angles and wavelengths are within their errors, which are a few degrees and a tenth of the wavelength.
    #[test]
    fn trenches_are_reported_within_small_errors() {
        let mut random = Random::new(3);
        let (mut reported, mut errors) = ([0; 2], [0.0; 2]);
        for n in 0..20 {
            let (length, angle) = (random.between(3.0, 8.0), random.between(-17.0, 17.0));
            // Every fourth is exactly along the lines, every fifth of pairs.
            let length = if n % 5 == 0 { 2.0 * PITCH } else { length };
            let angle = if n % 4 == 0 { 0.0 } else { angle };
            let sheet = made(length, angle, 0.05 * f64::from(n % 3), &mut random);
            let waves = trenches(&sheet, PITCH).unwrap();
            let found = Measured::of(&sheet, &waves, true, (160, 90.0));
            let known = [angle.abs(), length];
            for (k, estimate) in [found.angle, found.wavelength].into_iter().enumerate() {
                let Some(estimate) = estimate else {
                    assert!(!found.doubts.is_empty());
                    continue;
                };
                let miss = (estimate.value - known[k]).abs();
                assert!(miss < estimate.error, "{k}: {estimate:?} for {}", known[k]);
                reported[k] += 1;
                errors[k] += estimate.error / if k == 0 { 1.0 } else { length };
            }
        }
        println!("{reported:?} {errors:?}");
        assert!(reported[0] > 17 && reported[1] > 17, "{reported:?}");
        assert!(
            errors[0] / f64::from(reported[0]) < 7.0 && errors[1] / f64::from(reported[1]) < 0.1
        );
    }

    /// Ripples, pits and disorder are no trenches.
    #[test]
    fn other_patterns_are_no_trenches() {
        let mut random = Random::new(5);
        assert!(trenches(&made(4.0, 35.0, 0.2, &mut random), PITCH).is_none());
        assert!(trenches(&made(4.0, 80.0, 0.2, &mut random), PITCH).is_none());
        let of = |u: &dyn Fn(f64, f64) -> f64| {
            let u = Array2::from_shape_fn((160, 240), |(n, i)| u(0.25 * i as f64, STEP * n as f64));
            trenches(&Sheet::about_a_plane(u, (0.0, 0.25), STEP, BAND), PITCH)
        };
        assert!(of(&|x, y| (0.9 * x).cos() * (1.2 * y).cos()).is_none());
        // What even lines leave, one trench on each, is no pattern between them.
        let even = Array2::from_shape_fn((40, 9), |(n, _)| (TAU / PITCH * STEP * n as f64).cos());
        assert!(averaged(&even).iter().all(|u| u.abs() < 1e-13));
    }
}
