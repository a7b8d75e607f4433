//! Heights h(jd) of earlier lines at the y of the present line.

use crate::StabilityError;
use stickslip_tip::{Across, Footprint};

/// Values of h_l(jd) below this fraction of the largest are left out.
const NEGLIGIBLE: f64 = 1e-17;
/// Largest number of lines in a sum: if more are needed the pitch is an error.
const MOST_LINES: usize = 1_000_000;
/// c^j h_l(jd) of each layer for j = 1, 2, …, as far as it is not negligible, with h_l or its derivative of this order.
pub(super) fn heights(
    footprint: &Footprint,
    (pitch, left): (f64, f64),
    order: usize,
) -> Result<Vec<Vec<f64>>, StabilityError> {
    let widest = footprint.layers().iter().map(|layer| layer.across);
    let reach = widest.map(|h| h.center + 9.0 * h.width).fold(0.0, f64::max);
    let lines = (reach / pitch).ceil();
    if !(pitch.is_finite() && pitch > 0.0 && lines < MOST_LINES as f64) {
        return Err(StabilityError::Pitch(pitch));
    }
    let layers = footprint.layers().iter();
    let heights = layers.map(|layer| {
        let mut kept = 1.0;
        let height = |j: usize| {
            kept *= left;
            kept * derivative(&layer.across, pitch * j as f64, order)
        };
        let Across { center, width } = layer.across;
        let largest = layer.across.value(center) / width.powi(order as i32);
        let mut heights: Vec<f64> = (1..=lines as usize).map(height).collect();
        let last = heights.iter().rposition(|h| h.abs() >= NEGLIGIBLE * largest);
        heights.truncate(last.map_or(0, |last| last + 1));
        heights
    });
    Ok(heights.collect())
}

/// h, h' or h''.
fn derivative(across: &Across, y: f64, order: usize) -> f64 {
    let Across { center, width } = *across;
    let term = |center: f64| {
        let z = (y - center) / width;
        let bell = (-0.5 * z * z).exp();
        if order == 1 { -z * bell / width } else { (z * z - 1.0) * bell / (width * width) }
    };
    match order {
        0 => across.value(y),
        _ if center > 0.0 => term(center) + term(-center),
        _ => term(0.0),
    }
}
