//! Verification of a run in two coordinates: it is repeated with another memory, by collocation.
//!
//! A run by `modes` is repeated by `fft`. The two share neither exponentials nor Taylor steps, only the layers across the
//! scan, and a tighter tolerance requires more layers. A run by `fft` is repeated by `direct`, which has no layers.

use super::compare::{AgainstSamples, Judgement, compare_all};
use super::growth::{Probes, growth_within};
use super::repeat::Witness;
use super::{
    ComparedSamples, Growth, LARGEST_SHIFT, SHIFT, Sample, TIGHTER, TOLERANCES_ALLOWED,
    Verification, VerificationError, tightest,
};
use std::ops::ControlFlow;
use stickslip_tip::planar::{PlanarRunning, PlanarScenario, Step, Trajectory};
use stickslip_tip::{MOST_STEPS, MemoryChoice, RunError, Scenario};

/// Fraction of the work that the second run takes; the perturbed run, by Taylor steps, takes the rest.
const SHARE: f64 = 0.9;

/// Verifies l and y0 of a run in two coordinates over its whole dense history.
///
/// `observe` is called with the fraction of the work done, and may stop it.
///
/// # Errors
/// The run cannot be repeated, or the observer stopped the work.
pub fn verify_across(
    scenario: &PlanarScenario,
    trajectory: &Trajectory,
    observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Verification, VerificationError> {
    let mut second = Second::of(scenario, trajectory.end(), observe)?;
    let mut steps = vec![];
    let growth = second.run(|step, _| {
        if steps.len() == MOST_STEPS {
            return Err(RunError::HistoryTooLong { t: step.along.t });
        }
        steps.push(*step);
        Ok(())
    })?;
    let (wider, support) = (*scenario.along.model.wider(), scenario.along.support());
    let reference = Trajectory::under(wider, support, steps);
    let allowed = TOLERANCES_ALLOWED * scenario.along.tolerance;
    let compare = |value: fn(&Trajectory, f64) -> f64| {
        let steps = trajectory.steps().iter().chain(reference.steps()).map(|step| &step.along);
        let span = (reference.start(), trajectory.end().min(reference.end()));
        compare_all(steps, span, |t| [value(trajectory, t), value(&reference, t)], allowed)
    };
    let l = |of: &Trajectory, t: f64| of.step_at(t).along.followed(of.support(), t);
    Ok(second.verification([compare(l), compare(Trajectory::y0)], None, growth))
}

/// Verifies a run as [`verify_across`] does, from samples in the order of time. Samples after `until` are ignored.
/// Neither the samples nor the second run are stored.
///
/// # Errors
/// As [`verify_across`].
pub fn verify_samples_across<I: Iterator<Item = Sample>>(
    scenario: &PlanarScenario,
    samples: impl Fn() -> I,
    until: f64,
    observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Verification, VerificationError> {
    let along = &scenario.along;
    let allowed = TOLERANCES_ALLOWED * along.tolerance;
    let span = (along.start_time(), until);
    let mut compared = AgainstSamples::new(along.support(), samples, span, allowed);
    compared.begin();
    let mut second = Second::of(scenario, until, observe)?;
    let growth = second.run(|step, before| {
        compared.see_across(step, before);
        Ok(())
    })?;
    let (judgements, found) = compared.finish_across();
    Ok(second.verification(judgements, Some(found), growth))
}

/// The second run and its perturbed copy.
struct Second<O> {
    /// The scenario with another memory and a tighter tolerance, but the same end, on which the noise depends.
    scenario: PlanarScenario,
    /// Name of the memory.
    memory: &'static str,
    /// End of the comparison, in Γ/k.
    until: f64,
    observe: O,
}

impl<O: FnMut(f64) -> ControlFlow<()>> Second<O> {
    fn of(run: &PlanarScenario, until: f64, observe: O) -> Result<Self, VerificationError> {
        let (memory, name) = match PlanarRunning::new(run)?.memory() {
            ("fft", _) => (MemoryChoice::Direct, "direct"),
            _ => (MemoryChoice::Fft, "fft"),
        };
        let with = |tolerance: f64| {
            let along = Scenario { tolerance, memory, ..run.along.clone() };
            PlanarScenario { along, ..run.clone() }
        };
        let can_be_met = |tolerance: f64| with(tolerance).validate().is_ok();
        let tolerance = tightest(run.along.tolerance, can_be_met);
        Ok(Self { scenario: with(tolerance), memory: name, until, observe })
    }

    /// Repeats the run, and measures the growth of errors by the perturbed run. `see` is called with each step and the
    /// time up to which it is valid.
    fn run(
        &mut self,
        mut see: impl FnMut(&Step, f64) -> Result<(), RunError>,
    ) -> Result<Growth, VerificationError> {
        let scenario = self.scenario.clone();
        let mut here = ProbesAcross::of(&scenario, self.until);
        self.repeat(PlanarRunning::new(&scenario)?, (0.0, SHARE), |step, before| {
            here.see(step, before);
            see(step, before)
        })?;
        let tolerance = scenario.along.tolerance;
        let shift = (SHIFT * tolerance).min(LARGEST_SHIFT).max(TIGHTER * tolerance);
        let twin = twin(&scenario, shift);
        let mut there = ProbesAcross::of(&twin, self.until);
        self.repeat(PlanarRunning::new(&twin)?, (SHARE, 1.0), |step, before| {
            there.see(step, before);
            Ok(())
        })?;
        Ok(here.growth(&there, shift, tolerance))
    }

    fn repeat(
        &mut self,
        mut running: PlanarRunning<'_>,
        (from, to): (f64, f64),
        mut see: impl FnMut(&Step, f64) -> Result<(), RunError>,
    ) -> Result<(), VerificationError> {
        let (start, until) = (running.t(), self.until);
        while let Some(step) = running.step()? {
            let is_last = step.end() >= until;
            see(&step, if is_last { until.next_up() } else { step.end() })?;
            let part = from + (to - from) * (step.end() - start) / (until - start);
            if (self.observe)(part.min(to)).is_break() {
                return Err(VerificationError::Interrupted);
            }
            if is_last {
                break;
            }
        }
        Ok(())
    }

    fn verification(
        self,
        judgements: [Judgement; 2],
        samples: Option<ComparedSamples>,
        growth: Growth,
    ) -> Verification {
        let [l, y] = judgements.map(|judgement| judgement.worst);
        let wrong = judgements.iter().filter_map(|judgement| judgement.trusted_until);
        Verification {
            memory: self.memory,
            tolerance: self.scenario.along.tolerance,
            l,
            y: Some(y),
            u: None,
            trusted_until: wrong.reduce(f64::min),
            samples,
            growth,
        }
    }
}

/// The run of a tip that starts at a slightly different point, shifted in both coordinates.
fn twin(scenario: &PlanarScenario, shift: f64) -> PlanarScenario {
    let (kick, memory) = (scenario.along.kick + shift, MemoryChoice::Auto);
    let along = Scenario { kick, memory, ..scenario.along.clone() };
    let kick_across = scenario.kick_across + shift;
    PlanarScenario { along, kick_across, ..scenario.clone() }
}

/// l and y0 of a run.
struct ProbesAcross {
    l: Probes,
    y0: Probes,
    support: stickslip_tip::Support,
}

impl ProbesAcross {
    fn of(scenario: &PlanarScenario, until: f64) -> Self {
        let along = Scenario { until, ..scenario.along.clone() };
        let [l, y0] = [Probes::of(&along), Probes::of(&along)];
        Self { l, y0, support: along.support() }
    }

    fn see(&mut self, step: &Step, before: f64) {
        self.l.probe_before(before, |t| step.along.followed(&self.support, t));
        self.y0.probe_before(before, |t| step.y0(t));
    }

    /// The growth in the coordinate in which errors grow most.
    fn growth(&self, twin: &Self, shift: f64, tolerance: f64) -> Growth {
        let size = self.l.range().max(self.y0.range());
        let [along, across] = [(&self.l, &twin.l), (&self.y0, &twin.y0)]
            .map(|(one, twin)| growth_within(one, twin, shift, (tolerance, size)));
        if across.amplification > along.amplification { across } else { along }
    }
}
