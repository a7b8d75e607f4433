//! Verification of a run in two coordinates.

use super::claims::{self, Summary};
use super::{begins_as, finish, is_of, job, repeated, samples, samples_alone};
use crate::arguments::VerifyArguments;
use crate::failure::Failure;
use crate::session::Session;
use stickslip::{RunDocument, RunScenario, VerificationDocument, sample_across};
use stickslip_tip::planar::{PlanarScenario, Trajectory};
use stickslip_verify::{Sample, TOLERANCES_ALLOWED, verify_across, verify_samples_across};

pub(super) fn of_document(
    session: &Session,
    run: RunDocument,
    whole: &RunScenario,
    arguments: &VerifyArguments,
) -> Result<(), Failure> {
    let damaged = |message: String| {
        let named = format!("RUN.json {}", arguments.run.display());
        Failure::input(named, format!("damaged: {message}"))
    };
    let RunScenario::Across(scenario) = whole else {
        return Err(damaged("the tip is held on its line".into()));
    };
    let along = &scenario.along;
    let trajectory = run.history.is_some().then(|| run.trajectory_across()).transpose();
    let trajectory = trajectory.map_err(|error| damaged(error.to_string()))?;
    let trajectory = trajectory.map(|(_, trajectory)| trajectory);
    let sampled = match &trajectory {
        Some(trajectory) => {
            is_of(along, (trajectory.start(), trajectory.end())).and_then(|()| samples(&run, along))
        }
        None => samples_alone(&run, along),
    };
    let sampled = sampled.map_err(damaged)?;
    let first = trajectory.as_ref().map(|of| (of.x0(of.start()), of.y0(of.start())));
    begins_as(along, first.map(|(x0, _)| x0), &sampled).map_err(damaged)?;
    begins_across(scenario, first.map(|(_, y0)| y0), &sampled).map_err(damaged)?;
    let job = job(session, &arguments.outlet)?;
    let verification = match &trajectory {
        Some(trajectory) => of_history(session, scenario, trajectory)?,
        None => of_samples(session, scenario, &sampled)?,
    };
    let (support, wider) = (along.support(), *along.model.wider());
    let summary = trajectory.as_ref().map(|trajectory| {
        let steps = trajectory.steps().iter().map(|step| step.along).collect();
        let along = stickslip_tip::Trajectory::under(wider, support.clone(), steps);
        let law = (&support, &wider);
        (along, move |i: usize, t: f64| sample_across(&trajectory.steps()[i], law, t))
    });
    let summary = summary.as_ref().map(|(along, sample)| Summary { along, sample });
    let differences = claims::of_document(session, &run, whole, summary)?;
    finish(session, run, job, verification, differences)
}

/// Comparison of the dense history of a run with its repetition.
pub(in crate::commands) fn of_history(
    session: &Session,
    scenario: &PlanarScenario,
    trajectory: &Trajectory,
) -> Result<VerificationDocument, Failure> {
    let found = repeated(session, |observe| verify_across(scenario, trajectory, observe))?;
    Ok((&found).into())
}

/// Comparison of samples in the order of time, at least one, with the repetition of their run.
fn of_samples(
    session: &Session,
    scenario: &PlanarScenario,
    samples: &[Sample],
) -> Result<VerificationDocument, Failure> {
    let until = samples.last().map_or(scenario.along.until, |last| last.t);
    let each = || samples.iter().copied();
    let found = repeated(session, |observe| verify_samples_across(scenario, each, until, observe))?;
    Ok((&found).into())
}

/// Whether the tip begins as far from its line as the parameters require.
fn begins_across(
    scenario: &PlanarScenario,
    first: Option<f64>,
    samples: &[Sample],
) -> Result<(), String> {
    let (start, wanted) = (scenario.along.start_time(), scenario.kick_across);
    let sample = samples.first().filter(|sample| sample.t <= start).and_then(|sample| sample.y0);
    let Some(found) = first.or(sample) else { return Ok(()) };
    let allowed = TOLERANCES_ALLOWED * scenario.along.tolerance + 1e-9 * (1.0 + wanted.abs());
    if (found - wanted).abs() <= allowed {
        return Ok(());
    }
    Err(format!("the motion begins at y0 = {found}, the run at kick_across = {wanted}"))
}
