//! Where a step ends: at a time that is a number, and not short of one where it has to.

use super::Integrator;
use crate::memory::Memory;

/// By which a step may be longer to end where it is to.
const MOST_ROUNDINGS: usize = 64;

impl<M: Memory> Integrator<'_, M> {
    /// Where the next step is to end at the latest.
    pub(super) fn next_end(&self, until: f64) -> f64 {
        let breaks = self.force.next_break(self.t).min(self.support.next_break(self.t));
        breaks.min(until)
    }

    /// The length of a step of about the length h that ends at a representable time, and at `end` if it is near;
    /// `None` for one too short.
    pub(super) fn landing(&self, h: f64, end: f64) -> Option<f64> {
        // The difference of two representable times: t loses nothing as it grows.
        let mut h = (self.t + h) - self.t;
        let roundings = |t: f64| 4.0 * f64::EPSILON * t.abs().max(1e-3);
        let least = roundings(self.t);
        // Near t = 0 no such difference may end just there: then a rounding beyond, as no step could
        // make up for a rounding short.
        let rounding = least.max(roundings(end));
        let is_short = |h: f64| self.t + h < end && end - (self.t + h) <= rounding;
        for _ in 0..MOST_ROUNDINGS {
            if !is_short(h) {
                break;
            }
            h = h.next_up();
        }
        // Far from t = 0 the difference is exact, and the roundings of h are too small to be counted through.
        if is_short(h) {
            h = end - self.t;
        }
        (h > least).then_some(h)
    }
}
