//! Trapped motion: the logarithmic creep x0 ~ (1/p) ln t.

use super::extrema::Extrema;
use crate::stability::creep_rates;
use crate::{Model, Trajectory};

/// The part of the time since the last turning point that the creep rate is measured over.
const MEASURED_SHARE: f64 = 0.5;
/// How close the measured rate must be to the one that the equation demands.
const WITHIN: f64 = 0.1;

/// Whether the tip creeps as a trapped tip must: α/r is above the threshold, l has only risen for the
/// last half of the run, and 1/x0' = p (t - const) grows at one of the rates p that solve (10).
pub(super) fn is_trapped(trajectory: &Trajectory, model: &Model, extrema: &Extrema) -> bool {
    let (start, end) = (trajectory.start(), trajectory.end());
    let since = extrema.latest_first.first().map_or(start, |e| e.t.max(start));
    if since > 0.5 * (start + end) || trajectory.velocity(end) >= model.r() {
        return false;
    }
    let Some((shallow, steep)) = creep_rates(model) else { return false };
    let earlier = end - MEASURED_SHARE * (end - since);
    let (now, then) = (1.0 / trajectory.velocity(end), 1.0 / trajectory.velocity(earlier));
    let rate = (now - then) / (end - earlier);
    [shallow, steep].iter().any(|p| (rate / p - 1.0).abs() < WITHIN)
}
