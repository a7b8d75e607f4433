//! Whether a tip moves steadily, and what linear theory says of that.

use super::*;

/// Errors of steps push l away from steady motion by this part of the tolerance in a period.
const PUSHED: f64 = 0.6;
/// Below this part of the tolerance l is steady motion itself, where that is stable: what steps by series leave of it hovers
/// at up to 0.24.
const UNDISTURBED: f64 = 0.5;

impl End<'_> {
    /// What linear theory says of steady motion: worth half of a judgement, and not asked of a tip that is trapped.
    pub(super) fn linear(&self) -> Linear {
        // Nobody waits for what it takes on a table.
        let of = || Linear::of(&self.scenario.model);
        *self.linear.get_or_init(|| if stop::is_asked() { Linear::Unknown } else { of() })
    }

    /// Whether the tip stays at l0.
    pub(super) fn is_steady(&self) -> bool {
        let (start, end) = (self.start(), self.last.end());
        let share = self.observer.steady_since() < end - STEADY_SHARE * (end - start);
        let deviation = self.deviation();
        let near = deviation <= self.observer.near_steady();
        let itself = deviation <= UNDISTURBED * self.scenario.tolerance;
        let stable = || matches!(self.linear(), Linear::Stable(_));
        let kept = || self.is_kept_steady() || (itself && stable());
        share && near && kept() && !self.grows()
    }

    /// Whether steady motion is stable, and attracts by more than the errors of steps push away.
    pub(super) fn is_kept_steady(&self) -> bool {
        let Linear::Stable(Slowest { rate, period }) = self.linear() else { return false };
        PUSHED * self.scenario.tolerance / (rate * period).min(1.0) < self.observer.near_steady()
    }
}
