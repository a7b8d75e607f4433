//! Verification of a run in two coordinates: it is repeated with another memory, by collocation.
//!
//! A run by `modes` is repeated by `fft`. The two share neither exponentials nor Taylor steps, only the layers across the
//! scan, and a tighter tolerance requires more layers. A run by `fft` is repeated by `direct`, which has no layers.

use super::compare::{AgainstSamples, compare};
use super::growth::Probes;
use super::repeat::{follow, keep};
use super::{
    Repeated, Sample, TOLERANCES_ALLOWED, Verification, VerificationError, shift, tightest,
};
use std::ops::ControlFlow;
use stickslip_tip::planar::{PlanarRunning, PlanarScenario, Step, Trajectory};
use stickslip_tip::{MemoryChoice, RunError, Scenario};

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
    let mut steps = vec![];
    let see = |step: &Step, _| keep(&mut steps, step);
    let repeated = repeated(scenario, trajectory.end(), see, observe)?;
    let (wider, support) = (*scenario.along.model.wider(), scenario.along.support());
    let reference = Trajectory::under(wider, support, steps);
    let allowed = TOLERANCES_ALLOWED * scenario.along.tolerance;
    let l = compare(trajectory, &reference, Trajectory::followed, allowed);
    let y = compare(trajectory, &reference, Trajectory::y0, allowed);
    Ok(repeated.verification(&[l, y], None, None))
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
    let mut compared = AgainstSamples::new(along.support(), samples(), along.start_time(), allowed);
    let see = |step: &Step, before| {
        compared.see(&step.along, |t| Some(step.y0(t)), before);
        Ok(())
    };
    let repeated = repeated(scenario, until, see, observe)?;
    Ok(repeated.verification(&compared.judgements, None, Some(compared.found)))
}

/// Repeats a run up to a time with another memory and a tighter tolerance, and measures the growth of errors by a
/// perturbed run. `see` is called with each step and the time before which it is valid.
fn repeated(
    run: &PlanarScenario,
    until: f64,
    mut see: impl FnMut(&Step, f64) -> Result<(), RunError>,
    mut observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Repeated, VerificationError> {
    let (choice, memory) = match PlanarRunning::new(run)?.memory() {
        ("fft", _) => (MemoryChoice::Direct, "direct"),
        _ => (MemoryChoice::Fft, "fft"),
    };
    // The end remains that of the run, because the noise depends on it.
    let with = |tolerance: f64| {
        let along = Scenario { tolerance, memory: choice, ..run.along.clone() };
        PlanarScenario { along, ..run.clone() }
    };
    let tolerance = tightest(run.along.tolerance, |tolerance| with(tolerance).validate().is_ok());
    let scenario = with(tolerance);
    let (span, support) = ((run.along.start_time(), until), run.along.support());
    let probe = |probes: &mut Probes, step: &Step, before: f64| {
        probes.probe(before, |t| [step.along.followed(&support, t), step.y0(t)]);
    };
    let mut here = Probes::over(span);
    let see_and_probe = |step: &Step, before| {
        probe(&mut here, step, before);
        see(step, before)
    };
    let mut running = PlanarRunning::new(&scenario)?;
    follow(|| running.step(), span, (0.0, SHARE), see_and_probe, &mut observe)?;
    let shift = shift(tolerance);
    let twin = twin(&scenario, shift);
    let mut there = Probes::over(span);
    let only_probe = |step: &Step, before| {
        probe(&mut there, step, before);
        Ok(())
    };
    let mut running = PlanarRunning::new(&twin)?;
    follow(|| running.step(), span, (SHARE, 1.0), only_probe, &mut observe)?;
    Ok(Repeated { memory, tolerance, growth: here.growth(&there, shift, tolerance) })
}

/// The run of a tip that starts at a slightly different point, shifted in both coordinates.
fn twin(scenario: &PlanarScenario, shift: f64) -> PlanarScenario {
    let (kick, memory) = (scenario.along.kick + shift, MemoryChoice::Auto);
    let along = Scenario { kick, memory, ..scenario.along.clone() };
    let kick_across = scenario.kick_across + shift;
    PlanarScenario { along, kick_across, ..scenario.clone() }
}
