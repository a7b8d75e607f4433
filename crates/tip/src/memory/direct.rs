//! The definition, a sum over all nodes within reach: the reference for the other algorithms.

use super::groove::Groove;
use super::record::Record;
use crate::TipFunction;
use crate::sorting::ends_of;
use multiversion::multiversion;

/// Number of points per vector: the stages of a step, and idle ones that fill the SIMD vectors.
const LANES: usize = 8;

/// The groove of all nodes of the history buffer within reach, at displacements from the tip.
///
/// The cost is proportional to the number of nodes within reach, plus one comparison per block.
pub(super) fn groove(record: &Record, tip: &TipFunction, at: &[f64], groove: &mut Groove<'_>) {
    let position = record.position();
    let (low, high) = ends_of(at);
    groove.clear();
    for visits in record.blocks_near(position + low, position + high) {
        add(visits, tip, (position, at), groove);
    }
}

/// Number of points at which [`slopes_of`] evaluates a groove.
pub const POINTS: usize = LANES;

/// Slopes of the groove of these visits at the points x, divided by α: Σ w f'(x - ξ) over positions ξ of the tip and times w
/// spent there.
pub fn slopes_of(visits: &[(f64, f64)], tip: &TipFunction, x: &[f64; POINTS]) -> [f64; POINTS] {
    let [mut slopes, mut curvatures] = [[0.0; POINTS]; 2];
    add_side_by_side(visits, tip, x, (&mut slopes, &mut curvatures));
    slopes
}

/// Adds the groove of these nodes at the points `origin + at`.
pub(super) fn add(
    visits: &[(f64, f64)],
    tip: &TipFunction,
    (origin, at): (f64, &[f64]),
    groove: &mut Groove<'_>,
) {
    let told = groove.slope.chunks_mut(LANES).zip(groove.curvature.chunks_mut(LANES));
    for (at, told) in at.chunks(LANES).zip(told) {
        let mut x = [origin; LANES];
        x.iter_mut().zip(at).for_each(|(x, at)| *x += at);
        add_side_by_side(visits, tip, &x, told);
    }
    if let Some(heights) = &mut groove.height {
        for (position, weight) in visits {
            for (at, height) in at.iter().zip(heights.iter_mut()) {
                *height += weight * tip.value(origin + at - position);
            }
        }
    }
}

/// Adds the slope and curvature of these nodes at the first points x, as many as `slope` holds.
///
/// Also compiled for wider vectors: lanes are independent of each other.
#[multiversion(targets("x86_64+avx2"))]
fn add_side_by_side(
    visits: &[(f64, f64)],
    tip: &TipFunction,
    x: &[f64; LANES],
    (slope, curvature): (&mut [f64], &mut [f64]),
) {
    let mut sums = [[0.0; LANES]; 2];
    sums[0][..slope.len()].copy_from_slice(slope);
    sums[1][..slope.len()].copy_from_slice(curvature);
    for (position, weight) in visits {
        let mut from = *x;
        for x in &mut from {
            *x -= position;
        }
        let told = tip.slopes_and_curvatures(&from);
        for i in 0..LANES {
            sums[0][i] += weight * told[0][i];
            sums[1][i] += weight * told[1][i];
        }
    }
    slope.copy_from_slice(&sums[0][..slope.len()]);
    curvature.copy_from_slice(&sums[1][..slope.len()]);
}
