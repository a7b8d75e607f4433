//! A run of a tip that is free to move across the scan.

use super::run_found::{RunEnd, RunFound, SampleLine};
use crate::{
    Context, History, RegimeName, SteadyState, SwingDocument, Times, TransientDocument,
    WorkDocument,
};
use stickslip_outcome::{Observer, Outcome, judge, largest_across, snaking};
use stickslip_stability::Snaking;
use stickslip_tip::Wider;
use stickslip_tip::planar::{PlanarError, PlanarRunning, PlanarScenario, Trajectory};

/// A deviation across the scan counts as decayed if it is at most this many tolerances at the end of a run.
const DIED_OUT: f64 = 10.0;
/// The last part of a run, as a fraction of it, in which this must hold.
const LATE: f64 = 0.25;

/// The document of a run up to its end or its cancellation; `None` if it has no step.
pub(super) fn found(
    scenario: &PlanarScenario,
    times: &Times,
    context: &Context,
) -> Result<Option<(RunFound, Vec<String>)>, PlanarError> {
    let along = &scenario.along;
    let span = (along.start_time(), along.until);
    let mut running = PlanarRunning::new(scenario)?;
    let (began, mut steps, mut observer) = (context.seconds(), vec![], Observer::new(along));
    while !context.is_cancelled()
        && let Some(step) = running.step()?
    {
        observer.observe(&step.along);
        steps.push(step);
        context.stepped(span, step.end(), steps.len());
    }
    let Some(last) = steps.last() else { return Ok(None) };
    let (end, seconds) = (last.end(), context.seconds() - began);
    let layers = running.layers();
    let reason = format!("the only one across the scan; up to {} layers", layers.most);
    let work = WorkDocument::of(&running.work(), ("modes", reason), seconds);
    let trajectory = Trajectory::new(*along.model.wider(), along.support(), steps);
    let late = end - LATE * (end - span.0);
    let has_died_out = largest_across(&trajectory, late) <= DIED_OUT * along.tolerance;
    let swing = snaking(&trajectory, along.tolerance).filter(|_| !has_died_out);
    let ended = RunEnd {
        interrupted: end < span.1,
        ..became(scenario, has_died_out, &observer, (end, work))?
    };
    let mut remarks = ended.remarks.clone();
    remarks.extend(undisturbed(scenario).filter(|_| has_died_out));
    let steady_state = SteadyState::of(&along.model);
    let samples = samples(&trajectory, times, along);
    let history = Some(history(&trajectory, along.model.wider()));
    let mut found = RunFound::new(steady_state, &samples, history, ended);
    if let Some(swing) = swing {
        found.regime = RegimeName::Snaking;
        found.transient = None;
        found.snaking = Some(SwingDocument::of(&swing, along.model.r()));
    }
    Ok(Some((found, remarks)))
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
    let is_pushed = scenario.kick_across.abs() > 0.0;
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
fn samples(
    trajectory: &Trajectory,
    times: &Times,
    along: &stickslip_tip::Scenario,
) -> Vec<SampleLine> {
    let (support, wider, end) = (along.support(), along.model.wider(), trajectory.end());
    let sample = |t: f64| {
        let step = trajectory.step_at(t);
        let [_, velocity_y] = step.velocity(t);
        SampleLine {
            y0: Some(step.y0(t)),
            velocity_y: Some(velocity_y),
            ..SampleLine::of(&step.along, (&support, wider), t)
        }
    };
    times.all().into_iter().filter(|t| *t <= end).map(sample).collect()
}

/// The history of the motion along the scan, together with y0.
fn history(trajectory: &Trajectory, wider: &Wider) -> History {
    let steps = trajectory.steps();
    let along = steps.iter().map(|step| step.along).collect();
    let support = trajectory.support().clone();
    let along = stickslip_tip::Trajectory::under(*wider, support, along);
    let y0 = steps.iter().map(|step| {
        [step.y].into_iter().chain(step.across.map(|across| step.y + across)).collect()
    });
    History { y0: Some(y0.collect()), ..(&along).into() }
}
