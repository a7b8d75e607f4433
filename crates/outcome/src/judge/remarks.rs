//! Where round-off, the start or the tolerance decides.

use super::*;

impl End<'_> {
    pub(super) fn remarks(&self, regime: Regime) -> Vec<Remark> {
        let Scenario { model, force, .. } = self.scenario;
        let mut remarks = vec![];
        let is_papers = model.wider().is_papers();
        if self.is_undisturbed()
            && let Linear::Unstable(Slowest { rate, .. }) = self.linear()
        {
            remarks.push(Remark::RoundOffGrows { rate });
        }
        match regime {
            Regime::StickSlip if matches!(self.linear(), Linear::Stable(_)) => {
                remarks.push(Remark::SteadyToo);
            }
            Regime::StickSlip
                if is_papers && creep(model).is_ok_and(|creep| creep.attracting().is_some()) =>
            {
                remarks.push(Remark::TrappedToo);
            }
            Regime::Steady if is_papers => {
                let onset = onset(model.tip(), model.r());
                let below = |onset: &stickslip_stability::Onset| {
                    onset.criticality == Criticality::Subcritical
                };
                remarks.extend(onset.is_ok_and(|o| below(&o)).then_some(Remark::OscillationToo));
            }
            _ => {}
        }
        if force.ends().is_finite() && force.ends() > self.last.end() {
            remarks.push(Remark::ForceToCome { until: force.ends() });
        }
        let at = self.tail.x0(self.last.end());
        let until = self.surface.texture_ends().filter(|until| *until > at);
        remarks.extend(until.map(|until| Remark::UnevenAhead { until }));
        remarks
    }

    /// Whether the run began in steady motion, and nothing was to disturb it.
    fn is_undisturbed(&self) -> bool {
        let Scenario { start, kick, noise, profile, force, .. } = self.scenario;
        let still = noise.is_none_or(|noise| noise.amplitude.abs() <= 0.0) && profile.is_none();
        *start == Start::Steady && kick.abs() <= 0.0 && still && force.ends() < self.start()
    }
}
