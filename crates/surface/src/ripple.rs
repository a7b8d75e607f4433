//! The ripple that a periodic motion leaves far behind the tip.

use crate::Surface;
use ndarray::Array1;
use stickslip_tip::Trajectory;

/// One wavelength of the surface left behind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ripple {
    /// Half peak-to-peak of u∞(x), (35).
    pub amplitude: f64,
    /// Its highest and lowest height.
    pub crest: f64,
    /// Its lowest height.
    pub trough: f64,
}

/// Points over the wavelength at first, and around an extremum in each refinement.
const POINTS: usize = 256;
const POINTS_AROUND: usize = 33;
/// Each narrows the place of an extremum by 16; the height errs by the square of that.
const REFINEMENTS: usize = 4;

/// The last whole wavelength that the tip has left out of its reach, measured on what it carved (noise
/// and other initial surfaces are not counted). `None` for a footprint without reach, or where the run
/// has not left one wavelength behind.
#[must_use]
pub fn ripple_behind(
    surface: &Surface,
    trajectory: &Trajectory,
    wavelength: f64,
) -> Option<Ripple> {
    let reach = surface.model.tip().reach()?;
    let end = trajectory.end();
    let high = trajectory.x0(end) - reach;
    let low = high - wavelength;
    if low < trajectory.x0(trajectory.start()) + reach {
        return None;
    }
    let residence = trajectory.residence(end);
    let carved = |x: &[f64]| surface.carved_along(&residence, x);
    // Several points per width of the footprint, so that no pit falls between them.
    let per_width = wavelength * surface.model.tip().band();
    let points = POINTS.max(per_width.min(1e6) as usize);
    let crest = extremum(carved, (low, high), points, 1.0)?;
    let trough = -extremum(carved, (low, high), points, -1.0)?;
    Some(Ripple { amplitude: 0.5 * (crest - trough), crest, trough })
}

/// Largest value of `sign` · u∞ in the range, looked for on so many points and then closer by.
fn extremum(
    carved: impl Fn(&[f64]) -> Array1<f64>,
    (mut low, mut high): (f64, f64),
    mut points: usize,
    sign: f64,
) -> Option<f64> {
    let mut best = f64::NEG_INFINITY;
    for _ in 0..=REFINEMENTS {
        let spacing = (high - low) / (points - 1) as f64;
        let x: Vec<f64> = (0..points).map(|i| low + spacing * i as f64).collect();
        let u = carved(&x);
        let (i, value) =
            u.iter().map(|u| sign * u).enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
        best = best.max(value);
        (low, high) = (x[i] - spacing, x[i] + spacing);
        points = POINTS_AROUND;
    }
    Some(best)
}
