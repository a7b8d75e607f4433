//! The range of heights that colours cover.

use crate::axis::extremes;
use stickslip::HeightMap;

/// The colour scale covers the heights between these fractions of the length, because pits at the ends are deeper.
const COLOURED: (f64, f64) = (0.2, 0.85);

/// The lowest and the highest height away from the ends of the lines.
pub(super) fn heights_within(map: &HeightMap) -> Option<[f64; 2]> {
    let (low, high) = (map.x.first()?, map.x.last()?);
    let (from, to) = (low + COLOURED.0 * (high - low), low + COLOURED.1 * (high - low));
    let inside = |x: &f64| (from..=to).contains(x);
    let of = |row: &Vec<f64>| -> Vec<f64> {
        map.x.iter().zip(row).filter(|(x, _)| inside(x)).map(|(_, u)| *u).collect()
    };
    let (low, high) = extremes(map.u.iter().flat_map(of))?;
    (low < high).then_some([low, high])
}
