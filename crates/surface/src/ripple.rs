//! The ripple of a periodic motion far behind the tip.

use crate::Surface;
use crate::carved::{MOST_CELLS, cells};
use stickslip_convolution::{Kernel, Sum, direct_sum};
use stickslip_tip::elementary::exp;

/// One wavelength of the surface far behind the tip. On a surface that heals with the time T, u = U(x) e^{-D/(rT)}
/// there, with a periodic U and the distance D behind the support; the heights are then those of U.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ripple {
    /// Half peak-to-peak of u∞(x), (35), or of U(x).
    pub amplitude: f64,
    /// Largest height of u∞ or U.
    pub crest: f64,
    /// Smallest height of u∞ or U.
    pub trough: f64,
}

/// Number of points over the wavelength at first, and around an extremum in each refinement.
const POINTS: usize = 256;
const POINTS_AROUND: usize = 33;
/// Number of refinements. Each divides the error of the position of an extremum by 16, and that of the height by 256.
const REFINEMENTS: usize = 4;

/// The ripple over the last whole wavelength out of reach of the tip, in the carved groove without the initial surface.
/// `None` for a footprint without reach, if the groove out of reach is shorter than a wavelength, or if a height is not
/// finite.
pub fn ripple_behind(surface: &Surface, wavelength: f64) -> Option<Ripple> {
    let Surface { model, trajectory, .. } = surface;
    let reach = model.tip().reach()?;
    let end = trajectory.end();
    let high = trajectory.x0(end) - reach;
    let low = high - wavelength;
    if low < trajectory.x0(trajectory.start()) + reach {
        return None;
    }
    // Several points per width of the footprint, so that no pit falls between them.
    let per_width = wavelength * model.tip().band();
    let points = POINTS.max(per_width.min(1e6) as usize);
    let (crest, trough) = extrema_of_lasting(surface, (low, high), points)?;
    let ripple = Ripple { amplitude: 0.5 * (crest - trough), crest, trough };
    ripple.amplitude.is_finite().then_some(ripple)
}

/// Largest and smallest height in a range: of u∞, or of U on a healing surface.
fn extrema_of_lasting(
    Surface { model, trajectory, .. }: &Surface,
    range: (f64, f64),
    points: usize,
) -> Option<(f64, f64)> {
    let tip = model.tip();
    // Positions, weights, and the exponent of a factor of the weights.
    let fading = trajectory.wider().fading(trajectory.r());
    let (positions, weights, exponent) = if fading > 0.0 {
        trajectory.residence_unfaded()
    } else {
        let (positions, weights) = trajectory.residence(trajectory.end());
        (positions, weights, 0.0)
    };
    let value = |y: f64| if fading > 0.0 { tip.value(y) * exp(-fading * y) } else { tip.value(y) };
    let kernel = Kernel { value: &value, band: tip.band(), reach: tip.reach() };
    let factor = -model.alpha() * exp(exponent);
    let extrema = |sum: &dyn Fn(f64) -> f64| {
        let height = |x: f64| factor * sum(x);
        Some((extremum(&height, range, points, 1.0)?, -extremum(&height, range, points, -1.0)?))
    };
    if cells(tip, &positions, range) > MOST_CELLS {
        return extrema(&|x| direct_sum(&kernel, &positions, &weights, &[x])[0]);
    }
    // The first refinement looks a point beyond either end.
    let ((low, high), beyond) = (range, (range.1 - range.0) / (points - 1) as f64);
    let sum = Sum::on((low - beyond, high + beyond), &kernel, &positions, &weights);
    extrema(&|x| sum.value(x))
}

/// Largest value of `sign` times the height in the range, by repeated refinement of a grid of points.
fn extremum(
    height: &impl Fn(f64) -> f64,
    (mut low, mut high): (f64, f64),
    mut points: usize,
    sign: f64,
) -> Option<f64> {
    let mut best = f64::NEG_INFINITY;
    for _ in 0..=REFINEMENTS {
        let spacing = (high - low) / (points - 1) as f64;
        let at = |i: usize| low + spacing * i as f64;
        let heights = (0..points).map(|i| (at(i), sign * height(at(i))));
        let (x, value) = heights.max_by(|a, b| a.1.total_cmp(&b.1))?;
        best = best.max(value);
        (low, high) = (x - spacing, x + spacing);
        points = POINTS_AROUND;
    }
    Some(best)
}
