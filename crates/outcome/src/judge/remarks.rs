//! Warnings: cases in which round-off, the initial condition or the tolerance decides.

use super::*;
use crate::rest::Rest;

/// Number of times at which the force is evaluated.
const LOOKS: u32 = 20_000;
/// ln of the factor by which the errors of the history, a fortieth of the tolerance, grow to the tolerance.
const MOST_GROWTH: f64 = 3.7;

impl End<'_> {
    pub(super) fn remarks(&self, regime: Regime) -> Vec<Remark> {
        let Scenario { model, force, .. } = self.scenario;
        let mut remarks = vec![];
        remarks.extend(self.rest_remark());
        let is_basic = model.wider().is_basic();
        // The growth exponent takes longer than the rest.
        if self.begins_steady()
            && let Linear::Unstable(Slowest { rate, .. }) = self.linear()
            && self.is_undisturbed(rate)
        {
            remarks.push(Remark::RoundOffGrows { rate });
        }
        match regime {
            Regime::StickSlip if self.steady_is_stable() => {
                remarks.push(Remark::SteadyToo);
            }
            Regime::StickSlip
                if is_basic && creep(model).is_ok_and(|creep| creep.attracting().is_some()) =>
            {
                remarks.push(Remark::TrappedToo);
            }
            Regime::Steady if is_basic => {
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

    /// A warning for a tip without a spring that was at rest, although rest is unstable, for longer than its errors allow.
    fn rest_remark(&self) -> Option<Remark> {
        let Scenario { model, force, tolerance, .. } = self.scenario;
        let coasts =
            model.wider().inertia.is_some() && self.scenario.velocity_at_start().abs() > 0.0;
        if model.wider().spring || coasts || !self.surface.is_flat() {
            return None;
        }
        let (start, end) = (self.start(), self.last.end());
        let (rest, begins) = (Rest::of(model), force.begins().max(start));
        if begins >= end {
            let rate = rest.rate(end - start);
            return (rate > 0.0).then_some(Remark::RestsBySymmetry { rate });
        }
        // From then on errors of the sum over the past grow, until the force is more than they are.
        let step = (end - begins) / f64::from(LOOKS);
        let felt = |t: &f64| force.value(*t).abs() > *tolerance;
        let felt = (0..=LOOKS).map(|i| begins + step * f64::from(i)).find(felt).unwrap_or(end);
        let growth = rest.growth(begins - start, felt - start);
        (growth > MOST_GROWTH).then_some(Remark::ErrorsGrowAtRest { growth: growth.exp() })
    }

    /// Whether the run began in steady motion on an even surface.
    fn begins_steady(&self) -> bool {
        let Scenario { start, kick, noise, profile, .. } = self.scenario;
        let smooth = noise.is_none_or(|noise| noise.amplitude.abs() <= 0.0) && profile.is_none();
        let off = self.scenario.velocity_at_start() - self.scenario.model.r();
        *start == Start::Steady && kick.abs() <= 0.0 && off.abs() <= 0.0 && smooth
    }

    /// Whether no force disturbed a run that began in steady motion before errors had become as large as a width. They
    /// begin at the order of the tolerance and grow at this rate.
    fn is_undisturbed(&self, rate: f64) -> bool {
        let Scenario { force, tolerance, .. } = self.scenario;
        let (start_time, begins) = (self.start(), force.begins());
        let late = begins >= self.last.end() || rate * (begins - start_time) > -tolerance.ln();
        late || force.ends() < start_time
    }
}
