//! Whether a tip moves steadily, and the linear stability of this motion.

use super::*;
use stickslip_stability::critical;
use stickslip_tip::{Model, TipFunction};

/// Errors of steps push l away from steady motion by this fraction of the tolerance in a period.
const PUSHED: f64 = 0.6;
/// A deviation from stable steady motion below this fraction of the tolerance counts as none: Taylor steps maintain
/// deviations of up to 0.24.
const UNDISTURBED: f64 = 0.5;

/// Relative distance from αc below which the roots decide.
const BESIDE_ONSET: f64 = 1e-6;

/// Whether steady motion is stable because α is below αc, in the basic model; `None` if this does not decide.
fn by_alpha(model: &Model) -> Option<bool> {
    let is_sum = matches!(model.tip(), TipFunction::Gaussians(_));
    if !(is_sum && model.wider().is_basic()) || stop::is_requested() {
        return None;
    }
    let above = model.alpha() / critical(model.wider(), model.tip(), model.r()).ok()?.alpha - 1.0;
    (above.abs() > BESIDE_ONSET).then_some(above < 0.0)
}

impl End<'_> {
    /// Linear stability of steady motion, computed at the first request: this takes half the time of a classification, and
    /// is not needed for a trapped tip.
    pub(super) fn linear(&self) -> Linear {
        // Nobody waits for what it takes on a table.
        let of = || Linear::of(&self.scenario.model);
        *self.linear.get_or_init(|| if stop::is_requested() { Linear::Unknown } else { of() })
    }

    /// Whether steady motion is stable: from α alone where that decides, at a quarter of the work.
    pub(super) fn steady_is_stable(&self) -> bool {
        let known = if self.linear.get().is_some() { None } else { by_alpha(&self.scenario.model) };
        known.unwrap_or_else(|| matches!(self.linear(), Linear::Stable(_)))
    }

    /// Whether l stays at l0.
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

    /// Whether steady motion is stable, and attracts l more strongly than the errors of steps push it away.
    pub(super) fn is_kept_steady(&self) -> bool {
        let Linear::Stable(Slowest { rate, period }) = self.linear() else { return false };
        PUSHED * self.scenario.tolerance / (rate * period).min(1.0) < self.observer.near_steady()
    }
}
