//! The end of a step: at a representable time, exactly at a required end, and where the tip leaves the stretch.

use super::Integrator;
use crate::elementary::{larger, smaller};
use crate::relief::Piece;
use crate::roots::zero_between;
use crate::sorting::ends_of;

/// Largest extension of a step, in roundings of t, that lets it end at a required time.
const MOST_ROUNDINGS: usize = 64;

/// The length of a step from t, of about the length h, that ends at a representable time, and at `end` if that is
/// close; `None` for a step that is too short.
pub(crate) fn landing(t: f64, h: f64, end: f64) -> Option<f64> {
    // The difference of two representable times: t loses nothing as it grows.
    let mut h = (t + h) - t;
    let roundings = |t: f64| 4.0 * f64::EPSILON * larger(t.abs(), 1e-3);
    let least = roundings(t);
    // Near t = 0 no such difference may end just there: then a rounding beyond, as no step could
    // make up for a rounding short.
    let rounding = larger(roundings(end), least);
    let is_short = |h: f64| t + h < end && end - (t + h) <= rounding;
    for _ in 0..MOST_ROUNDINGS {
        if !is_short(h) {
            break;
        }
        h = h.next_up();
    }
    // Far from t = 0 the difference is exact, and the roundings of h are too small to be counted through.
    if is_short(h) {
        h = end - t;
    }
    (h > least).then_some(h)
}

impl Integrator<'_> {
    /// Latest end of the next step.
    pub(super) fn next_end(&self) -> f64 {
        let breaks = smaller(self.force.next_break(self.t), self.support.next_break(self.t));
        smaller(breaks, self.until)
    }

    /// As [`leaves`], for the tip and its stretch.
    pub(super) fn leaves(
        &self,
        nodes: &[f64],
        displacement: &[f64],
        at: impl Fn(f64) -> f64,
    ) -> Option<f64> {
        leaves(&self.stretch.ends, self.position(), (nodes, displacement), at)
    }
}

/// Time, in the unit of `nodes`, at which a coordinate that begins at x leaves a piece; `None` if it stays within the
/// slack of the piece. Its displacement is `at` as a function of time, and `displacement` at the nodes.
pub(crate) fn leaves(
    Piece { low, high, slack, .. }: &Piece,
    x: f64,
    (nodes, displacement): (&[f64], &[f64]),
    at: impl Fn(f64) -> f64,
) -> Option<f64> {
    // A tip that already stands beyond an end, within the slack, has its end where it stands.
    let (low, high) = (smaller(low - x, 0.0), larger(high - x, 0.0));
    let outside = |d: f64| d < low - slack || d > high + slack;
    let (least, most) = ends_of(displacement);
    if !outside(least) && !outside(most) {
        return None;
    }
    let after = (0..nodes.len()).find(|&i| outside(displacement[i]))?;
    // Nearer than where the tip is found outside, farther than where it starts: the sign changes
    // between the two, whatever the nodes between them do.
    let knot = match (displacement[after] > high, high > 0.0, low < 0.0) {
        (true, true, _) => high,
        (true, false, _) => 0.5 * slack,
        (false, _, true) => low,
        (false, _, false) => -0.5 * slack,
    };
    let beyond = |tau: f64| (at(tau) - knot) * (displacement[after] - knot).signum();
    Some(zero_between(beyond, 0.0, nodes[after]))
}
