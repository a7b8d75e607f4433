//! A run of a tip that is free to move across the scan.

use super::run_found::{RunEnd, RunFound, SampleLine, Samples};
use crate::{
    Context, RegimeName, SteadyState, SwingDocument, Times, TransientDocument, WorkDocument,
};
use stickslip_outcome::{Observer, Outcome, WatchedAcross, judge};
use stickslip_stability::Snaking;
use stickslip_tip::planar::{PlanarError, PlanarScenario, Step, Trajectory};
use stickslip_tip::{Support, Wider};

/// A deviation across the scan counts as decayed if it is at most this many tolerances at the end of a run.
const DIED_OUT: f64 = 10.0;
/// The last part of a run, as a fraction of it, in which this must hold.
const LATE: f64 = 0.25;

/// The answer of a run up to its end or its cancellation; `None` if it has no step.
pub(super) fn found(
    scenario: &PlanarScenario,
    times: &Times,
    context: &Context,
) -> Result<Option<(RunFound, Vec<String>)>, PlanarError> {
    let along = &scenario.along;
    let span = (along.start_time(), along.until);
    let mut running = WatchedAcross::new(scenario)?;
    let (began, mut steps) = (context.seconds(), vec![]);
    while !context.is_cancelled()
        && let Some(step) = running.step()?
    {
        steps.push(step);
        context.stepped(span, step.end(), steps.len());
    }
    if steps.is_empty() {
        return Ok(None);
    }
    let ended = became_across(scenario, &running, context.seconds() - began)?;
    let ended = RunEnd { interrupted: ended.end < span.1, ..ended };
    let trajectory = Trajectory::under(*along.model.wider(), along.support(), steps);
    let samples = samples(&trajectory, times, along);
    let (steady_state, remarks) = (SteadyState::of(&along.model), ended.remarks.clone());
    let history = Some((&trajectory).into());
    Ok(Some((RunFound::new(steady_state, samples, history, ended), remarks)))
}

/// The result of a run that took this many seconds and has at least one step.
///
/// # Errors
/// The initial surface cannot be computed.
pub fn became_across(
    scenario: &PlanarScenario,
    running: &WatchedAcross,
    seconds: f64,
) -> Result<RunEnd, PlanarError> {
    let along = &scenario.along;
    let made = running.running();
    let work = WorkDocument::of(&made.work(), made.memory(), seconds);
    let across = running.across();
    let has_died_out = across.largest_late(LATE) <= DIED_OUT * along.tolerance;
    let swing = across.snaking(along.tolerance).filter(|_| !has_died_out);
    let end = running.last().map_or(running.t(), Step::end);
    let mut ended = became(scenario, has_died_out, running.along(), (end, work))?;
    ended.remarks.extend(undisturbed(scenario).filter(|_| has_died_out));
    if let Some(swing) = swing {
        ended.regime = RegimeName::Snaking;
        ended.transient = None;
        ended.snaking = Some(SwingDocument::of(&swing, along.model.r()));
    }
    Ok(ended)
}

/// The regime of the motion along the scan if the motion across it has decayed; otherwise that it has not settled.
fn became(
    scenario: &PlanarScenario,
    has_died_out: bool,
    observer: &Observer,
    (end, work): (f64, WorkDocument),
) -> Result<RunEnd, PlanarError> {
    if has_died_out {
        let initial = scenario.along.initial_surface()?;
        let outcome: Outcome = judge(&scenario.along, &initial, observer);
        let oscillation = outcome.oscillation.as_ref();
        let oscillation = oscillation.map(|found| crate::OscillationDocument::of(found, None));
        return Ok(RunEnd::of(end, outcome, oscillation, work));
    }
    Ok(RunEnd {
        end,
        regime: RegimeName::Transient,
        oscillation: None,
        snaking: None,
        creep: None,
        drifting: None,
        transient: Some(TransientDocument { towards: None, time: None }),
        remarks: vec![],
        interrupted: false,
        work,
    })
}

/// A warning for a tip that stays on its line only because nothing displaces it, although deviations across the scan
/// would grow.
fn undisturbed(scenario: &PlanarScenario) -> Option<String> {
    let model = &scenario.along.model;
    let is_pushed = scenario.kick_across.abs() > 0.0
        || scenario.noise_spacing_across.is_some()
        || scenario.profile_across.is_some();
    let theory = || {
        let place = (model.r(), scenario.stiffness_across);
        Snaking::new(model.tip().footprint()?, *model.wider(), place).ok()
    };
    let grows = || theory()?.unstable_count(model.alpha()).ok().filter(|count| *count > 0);
    (!is_pushed && grows().is_some()).then(|| {
        "the tip starts on its line, and stays there by symmetry, but deviations across the scan grow: start it off \
         the line with a kick across"
            .into()
    })
}

/// The motion at these times, as far as it was computed.
fn samples(trajectory: &Trajectory, times: &Times, along: &stickslip_tip::Scenario) -> Samples {
    let (support, wider, end) = (along.support(), along.model.wider(), trajectory.end());
    let sample = |t: f64| sample_across(trajectory.step_at(t), (&support, wider), t);
    times.all().into_iter().filter(|t| *t <= end).map(sample).collect()
}

/// The motion at a time within one of its steps.
pub fn sample_across(step: &Step, of: (&Support, &Wider), t: f64) -> SampleLine {
    let [_, velocity_y] = step.velocity(t);
    let along = SampleLine::of(&step.along, of, t);
    SampleLine { y0: Some(step.y0(t)), velocity_y: Some(velocity_y), ..along }
}
