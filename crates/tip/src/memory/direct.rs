//! The definition: a sum over visits. The oracle for the other sums.

use super::groove::{Groove, range};
use super::record::Record;
use crate::TipFunction;
use crate::collocation::{STAGES, Stages};

/// The groove of all that the record holds within reach, at displacements from the tip.
///
/// It costs as much as there are visits within reach, and a look at every block of them.
pub(super) fn groove(record: &Record, tip: &TipFunction, at: &[f64], groove: &mut Groove<'_>) {
    let position = record.position();
    let (low, high) = range(at);
    let near = record.blocks_near(position + low, position + high);
    groove.clear();
    add(near.flatten().copied(), tip, (position, at), groove);
}

/// Adds the groove of these visits at the points `origin + at`.
pub(super) fn add(
    visits: impl Iterator<Item = (f64, f64)> + Clone,
    tip: &TipFunction,
    (origin, at): (f64, &[f64]),
    groove: &mut Groove<'_>,
) {
    let told = groove.slope.chunks_mut(STAGES).zip(groove.curvature.chunks_mut(STAGES));
    for (at, (slope, curvature)) in at.chunks(STAGES).zip(told) {
        let mut x = [origin; STAGES];
        x.iter_mut().zip(at).for_each(|(x, at)| *x += at);
        let mut sums = ([0.0; STAGES], [0.0; STAGES]);
        sums.0[..slope.len()].copy_from_slice(slope);
        sums.1[..slope.len()].copy_from_slice(curvature);
        add_stages(visits.clone(), tip, (&x, at.len()), &mut sums);
        slope.copy_from_slice(&sums.0[..slope.len()]);
        curvature.copy_from_slice(&sums.1[..slope.len()]);
    }
    if let Some(heights) = &mut groove.height {
        visits.for_each(|(position, weight)| {
            for (at, height) in at.iter().zip(heights.iter_mut()) {
                *height += weight * tip.value(origin + at - position);
            }
        });
    }
}

/// Adds the slope and curvature of these visits at the first `count` of x.
#[inline]
fn add_stages(
    visits: impl Iterator<Item = (f64, f64)>,
    tip: &TipFunction,
    (x, count): (&Stages, usize),
    (slope, curvature): &mut (Stages, Stages),
) {
    visits.for_each(|(position, weight)| {
        for i in 0..count {
            let (f1, f2) = tip.slope_and_curvature(x[i] - position);
            slope[i] += weight * f1;
            curvature[i] += weight * f2;
        }
    });
}
