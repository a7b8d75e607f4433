//! Periodic motions for which no cycle is available.

use super::*;

impl End<'_> {
    /// Classifies an oscillation without a cycle, whose changes from period to period decay.
    pub(super) fn extrapolated(
        &self,
        sequence: &Sequence,
        slips: usize,
        unstable: Option<&Reference>,
    ) -> Option<Outcome> {
        let (_, growth) = sequence.swing()?;
        let tolerance = self.scenario.tolerance;
        let found = motion::Oscillation::with_slips(&self.tail, &self.extrema, slips)?;
        let change = (0..3)
            .map(|back| sequence.change(slips, back))
            .try_fold(0.0_f64, |a, b| Some(a.max(b?)))?;
        // Near onset a cycle attracts at twice the rate at which steady motion repels or attracts, and beyond a
        // period doubling at twice that at which the old one repels.
        let (Linear::Stable(Slowest { rate, .. }) | Linear::Unstable(Slowest { rate, .. })) =
            self.linear()
        else {
            return None;
        };
        let onset = -(-2.0 * rate * found.period).exp_m1();
        let doubling = unstable.map_or(1.0, |old| 2.0 * (old.multiplier.powi(2) - 1.0).abs());
        let slowest = onset.min(doubling).max(f64::EPSILON);
        let noise = NOISE * tolerance;
        let rest = if change <= noise {
            noise / slowest
        } else {
            // Of several motions that die out the fastest are seen first.
            let factor = sequence.slowest_factor(slips)?;
            2.0 * change * factor / (1.0 - factor).min(doubling) + noise / slowest
        };
        let amplitude = found.amplitude_x0;
        // Swings about stable steady motion decay, however slowly.
        let decays = matches!(self.linear(), Linear::Stable(_)) && growth < 0.0 && change > noise;
        if rest > SETTLED * amplitude || decays || !self.may_be_a_cycle(amplitude) {
            return None;
        }
        let oscillation = Some(Oscillation::within(&found, rest));
        Some(Outcome { oscillation, ..Outcome::settled(Regime::StickSlip) })
    }

    /// Whether a cycle may have this amplitude: the amplitude of a small cycle is that of the leading order at onset.
    fn may_be_a_cycle(&self, amplitude: f64) -> bool {
        let model = &self.scenario.model;
        if amplitude > self.small() || !model.wider().is_basic() {
            return true;
        }
        let onset = onset(model.tip(), model.r());
        let square = onset.map(|o| o.amplitude_squared_slope * (model.alpha() - o.critical.alpha));
        square.is_ok_and(|square| (amplitude / square.max(0.0).sqrt() - 1.0).abs() < BESIDE)
    }
}
