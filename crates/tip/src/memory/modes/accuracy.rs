//! How well f' must be fitted for a run to keep its tolerance.

use crate::Model;
use crate::elementary::{log10, pow};

/// The error of x0 that the fit may bring about, over the tolerance of the run.
/// Motions near onset amplify it a hundredfold, as they do the error of a step, of which they allow as much.
const SHARE: f64 = 0.025;
/// Of that for a tip that swings back: it turns where its groove does not hold it, and carves another.
const SWINGING: f64 = 0.1;
/// Errors of a fit change sign within about this distance, in widths of the apex: what a moving tip feels
/// of them is that much at a time.
const WIDTHS: f64 = 2.0;

/// Down to here an error is cheap, one exponential more for a fifth of it, and is this much smaller than it need be: errors
/// of a fit are there from the start of a run, and nothing but the motion says what becomes of them.
const CHEAP: f64 = 1e-10;
const SPARE: f64 = 0.1;

/// Heights are forgotten more slowly than slopes, by about this factor.
const HEIGHTS: f64 = 4.0;
/// Exponentials do not fit much better than this: heights alone do not ask for more, nor, where they are to hold
/// farther back, does a tip that swings.
const FINEST: f64 = 2.5e-14;
const FINEST_OF_SWINGING: f64 = 5e-14;

/// The largest error ε of f' that moves the tip by a small part of the tolerance.
///
/// ε shifts the force by α ε times the time spent within reach. A tip that moves on at about r spends
/// 1/r per length, and the errors that it meets alternate: α ε times two widths over r, against a spring of
/// stiffness 1. A tip that sticks for a time T feels α ε T, but the groove that it made meanwhile has the
/// stiffness α T |f''(0)|: it is shifted by ε/|f''(0)|, however long T is.
///
/// Under a depth limit b an error of the height, which is α times that of f for a time, changes the rate of
/// indentation by its part of b: where α is above b, that counts for more.
///
/// In quarter decades, so that runs alike share a fit.
#[must_use]
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

/// How far an error ε of f' displaces the tip, in σ: see [`accuracy_needed`].
#[must_use]
pub fn displacement(model: &Model, slope_error: f64) -> f64 {
    let curvature = model.tip().slope_and_curvature(0.0).1.abs();
    let width = model.tip().widths(1.0);
    // Without a support its own force moves the tip.
    let speed = if model.wider().spring { model.r() } else { 1.0 };
    let moving = WIDTHS * width * model.alpha().abs() / speed;
    let stuck = if curvature > 0.0 { 1.0 / curvature } else { 0.0 };
    slope_error * moving.max(stuck)
}
