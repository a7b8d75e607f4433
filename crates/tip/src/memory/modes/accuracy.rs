//! Accuracy of the fit of f' that a run requires.

use crate::Model;
use crate::elementary::{log10, pow};

/// Allowed error of x0 due to the fit, in units of the tolerance of the run. Motions near onset amplify it a
/// hundredfold, as they amplify the error of a step.
const SHARE: f64 = 0.025;
/// Factor of this share for a tip with M > 1/2, which turns where no groove holds it and carves another one.
const SWINGING: f64 = 0.1;
/// Distance, in widths of the apex, within which errors of a fit change sign: they act on a moving tip over about
/// this distance.
const WIDTHS: f64 = 2.0;

/// Accuracy up to which a smaller error is cheap: one exponential more reduces it to a fifth. Down to this accuracy
/// the error is made smaller than necessary, because errors of a fit act from the start of a run and their later
/// effect depends on the motion.
const CHEAP: f64 = 1e-10;
const SPARE: f64 = 0.1;

/// Approximate ratio of the times for which heights and slopes act on the tip.
const HEIGHTS: f64 = 4.0;
/// Finest accuracy of a fit. Heights do not require more, nor does a tip that swings back, whose fit must be valid
/// farther behind.
const FINEST: f64 = 2.5e-14;
/// The same for a tip that may swing back, and for every tip in two coordinates.
pub(crate) const FINEST_OF_SWINGING: f64 = 5e-14;

/// The error ε of f' that may be allowed: the displacement of the tip that it causes is a small part of the tolerance.
///
/// ε changes the force by α ε times the time spent within reach. A tip that moves on at about r spends 1/r per
/// length, and the errors alternate along its path. The change is α ε times two widths over r, and the spring has
/// stiffness 1. For a tip that sticks for a time T the change is α ε T, but the groove made meanwhile has the
/// stiffness α T |f''(0)|: the displacement is ε/|f''(0)| for any T.
///
/// With a depth limit b, an error of f changes the height by α times this error and the time spent within reach. The
/// ratio of this change to b is the relative error of the indentation rate. If α is above b, this effect is the larger
/// one.
///
/// The result is rounded down to quarter decades, so that similar runs share a fit.
pub fn accuracy_needed(model: &Model, tolerance: f64) -> f64 {
    let limit = model.wider().depth_limit.unwrap_or(f64::INFINITY);
    let of_height = (limit / (HEIGHTS * model.alpha().abs())).min(1.0);
    let mut of_slope = SHARE * tolerance / displacement(model, 1.0);
    if model.wider().swings_back() {
        of_slope = of_slope.min(FINEST_OF_SWINGING.max(SWINGING * of_slope));
    }
    let largest = of_slope.min(FINEST.max(of_height * of_slope)).min(CHEAP.max(SPARE * of_slope));
    pow(10.0, (4.0 * log10(largest)).floor() / 4.0)
}

/// Displacement of the tip by an error ε of f', in σ: see [`accuracy_needed`].
pub fn displacement(model: &Model, slope_error: f64) -> f64 {
    let curvature = model.tip().slope_and_curvature(0.0).1.abs();
    let width = model.tip().widths(1.0);
    // Without a support its own force moves the tip.
    let speed = if model.wider().spring { model.r() } else { 1.0 };
    let moving = WIDTHS * width * model.alpha().abs() / speed;
    let stuck = if curvature > 0.0 { 1.0 / curvature } else { 0.0 };
    slope_error * moving.max(stuck)
}
