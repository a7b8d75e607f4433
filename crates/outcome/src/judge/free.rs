//! Tips without a spring.

use super::*;

/// A tip without a spring drifts where its velocity has changed by less than this part in the last of its run.
const DRIFTS: f64 = 1e-4;

impl End<'_> {
    /// A tip that nothing drags: it drifts at one velocity, or not.
    pub(super) fn without_spring(&self) -> Outcome {
        let (from, to) = (self.tail.start(), self.last.end());
        let enough = to - from >= STEADY_SHARE * (to - self.start());
        let at = |i: u32| self.tail.velocity(from + (to - from) * f64::from(i) / 1000.0);
        let now = self.last.velocity(to);
        let change = (0..1000).map(at).map(|v| (v - now).abs()).fold(0.0, f64::max);
        if !enough || change > DRIFTS * now.abs().max(self.scenario.tolerance) {
            return Outcome::transient(None, None);
        }
        Outcome::settled(Regime::Drifting)
    }
}
