//! Trapped motion: the logarithmic creep x0 ~ (1/p) ln t.

use super::thinned::Thinned;
use stickslip_stability::creep;
use stickslip_tip::{Model, Step};

/// The part of the time since the last turning point that the creep rate is measured over.
const MEASURED_SHARE: f64 = 0.5;
/// How close the measured rate must be to the one that the equation demands.
const WITHIN: f64 = 0.1;

/// Whether the tip creeps as a trapped tip must: l has only risen for the last half of the run, and
/// 1/x0' = p (t - const) grows at the rate p that attracts.
///
/// The run began at `start`, l had its last extremum at `since`, `risen` has steps since then.
pub(super) fn is_trapped(
    model: &Model,
    (start, since): (f64, f64),
    risen: &Thinned,
    last: &Step,
) -> bool {
    let (end, velocity) = (last.end(), last.velocity(last.end()));
    if since > 0.5 * (start + end) || velocity >= model.r() {
        return false;
    }
    let Some(p) = creep(model).ok().and_then(|creep| creep.attracting()) else { return false };
    let earlier = end - MEASURED_SHARE * (end - since);
    let Some(then) = risen.at(earlier) else { return false };
    let earlier = earlier.min(then.end());
    let rate = (1.0 / velocity - 1.0 / then.velocity(earlier)) / (end - earlier);
    (rate / p - 1.0).abs() < WITHIN
}
