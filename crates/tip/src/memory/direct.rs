//! The definition: a sum over visits. The oracle for the other sums.

use super::Groove;
use super::record::Record;
use crate::TipFunction;

/// The groove of all that the record holds within reach, at displacements from the tip.
///
/// It costs as much as there are visits within reach, and a look at every block of them.
pub(super) fn groove(record: &Record, tip: &TipFunction, at: &[f64], groove: &mut Groove<'_>) {
    let position = record.position();
    let (low, high) = super::range(at);
    groove.clear();
    for nodes in record.blocks_near(position + low, position + high) {
        add(nodes.iter().copied(), tip, (position, at), groove);
    }
}

/// Adds the groove of these visits at the points `origin + at`.
pub(super) fn add(
    visits: impl Iterator<Item = (f64, f64)>,
    tip: &TipFunction,
    (origin, at): (f64, &[f64]),
    groove: &mut Groove<'_>,
) {
    for (position, weight) in visits {
        let told = groove.slope.iter_mut().zip(groove.curvature.iter_mut());
        for (at, (slope, curvature)) in at.iter().zip(told) {
            let (f1, f2) = tip.slope_and_curvature(origin + at - position);
            *slope += weight * f1;
            *curvature += weight * f2;
        }
        if let Some(heights) = &mut groove.height {
            for (at, height) in at.iter().zip(heights.iter_mut()) {
                *height += weight * tip.value(origin + at - position);
            }
        }
    }
}
