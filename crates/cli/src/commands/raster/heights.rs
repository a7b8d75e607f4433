//! Height maps of rasters, for Gwyddion.

use crate::files::gsf::{Frame, gsf};
use stickslip::{HeightMap, Raster};

/// An evenly spaced map, in σ and kσ²/a times these factors.
pub(in crate::commands) fn field(
    parameters: &Raster,
    map: &HeightMap,
    (length, height, unit): (f64, f64, &str),
) -> Vec<u8> {
    let spacing = |v: &[f64]| match v {
        [first, .., last] => length * (last - first) / (v.len() - 1) as f64,
        _ => length,
    };
    let first = |v: &[f64]| length * v.first().copied().unwrap_or(0.0);
    let model = parameters.model_parameters();
    let frame = Frame {
        title: &format!("u(x,y) of a raster, alpha {}, r {}", model.alpha, model.r),
        counts: [map.x.len(), map.y.len()],
        first: [first(&map.x), first(&map.y)],
        spacing: [spacing(&map.x), spacing(&map.y)],
        unit,
    };
    gsf(&frame, &map.u, height)
}
