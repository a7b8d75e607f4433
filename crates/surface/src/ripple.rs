//! The ripple of a periodic motion far behind the tip.

use crate::{Method, Surface, carved};
use ndarray::Array1;
use stickslip_convolution::{Kernel, direct_sum, sum};
use stickslip_tip::Trajectory;
use stickslip_tip::elementary::exp;

/// One wavelength of the surface far behind the tip. On a healing surface u at the distance D behind the support is
/// U(x) e^{-D/(rT)} with U a periodic function, out of the reach of the tip: then the heights are those of U.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ripple {
    /// Half peak-to-peak of u∞(x), (35), or of U(x).
    pub amplitude: f64,
    /// Its highest height.
    pub crest: f64,
    /// Its lowest height.
    pub trough: f64,
}

/// Number of points over the wavelength at first, and around an extremum in each refinement.
const POINTS: usize = 256;
const POINTS_AROUND: usize = 33;
/// Number of refinements. Each narrows the position of an extremum by 16; the error of the height is proportional to
/// its square.
const REFINEMENTS: usize = 4;

/// The ripple over the last whole wavelength out of reach of the tip, in the carved groove without the initial
/// surface. `None` for a footprint without reach, or if the run has not left one wavelength behind.
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
    let carved = Lasting::of(surface, trajectory);
    let carved = |x: &[f64]| carved.heights(x);
    // Several points per width of the footprint, so that no pit falls between them.
    let per_width = wavelength * surface.model.tip().band();
    let points = POINTS.max(per_width.min(1e6) as usize);
    let crest = extremum(&carved, (low, high), points, 1.0)?;
    let trough = -extremum(&carved, (low, high), points, -1.0)?;
    let ripple = Ripple { amplitude: 0.5 * (crest - trough), crest, trough };
    ripple.amplitude.is_finite().then_some(ripple)
}

/// The undecayed part of the surface: u∞, or U on a healing surface.
struct Lasting<'a> {
    surface: &'a Surface<'a>,
    /// Positions, weights, and the exponent of a factor of the weights.
    visits: (Vec<f64>, Vec<f64>, f64),
    /// Rate of decay along x, 1/(rT).
    fading: f64,
}

impl<'a> Lasting<'a> {
    fn of(surface: &'a Surface, trajectory: &Trajectory) -> Self {
        let Some(time) = trajectory.wider().healing_time else {
            let (positions, weights) = trajectory.residence(trajectory.end());
            return Self { surface, visits: (positions, weights, 0.0), fading: 0.0 };
        };
        let fading = 1.0 / (trajectory.r() * time);
        Self { surface, visits: trajectory.residence_unfaded(), fading }
    }

    fn heights(&self, x: &[f64]) -> Array1<f64> {
        let (model, (positions, weights, exponent)) = (self.surface.model, &self.visits);
        if self.fading <= 0.0 {
            let sums = carved(model.tip(), positions, weights, x);
            return sums.mapv_into(|sum| -model.alpha() * sum);
        }
        let value = |y: f64| model.tip().value(y) * exp(-self.fading * y);
        let kernel = Kernel { value: &value, band: model.tip().band(), reach: model.tip().reach() };
        let sums = match Method::cheaper(model.tip(), positions, x) {
            Method::Direct => direct_sum(&kernel, positions, weights, x),
            Method::Fft => sum(&kernel, positions, weights, x),
        };
        let factor = -model.alpha() * exp(*exponent);
        sums.into_iter().map(|sum| factor * sum).collect()
    }
}

/// Largest value of `sign` · u∞ in the range, by repeated refinement of a grid of points.
fn extremum(
    carved: &impl Fn(&[f64]) -> Array1<f64>,
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
