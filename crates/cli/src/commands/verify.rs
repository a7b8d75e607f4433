//! `stickslip verify`, and `stickslip run --verify`.

pub(in crate::commands) mod claims;
mod lines;
mod motion;

use super::job::{Job, on_standard_output};
use super::progress::Progress;
use crate::arguments::{Format, OutletArguments, VerifyArguments};
use crate::failure::Failure;
use crate::files::distinct::distinct;
use crate::files::input::read_run_from;
use crate::files::lines::{Written, open};
use crate::files::output::format_of;
use crate::interrupt::signal;
use crate::session::Session;
use motion::Motion;
use std::ops::ControlFlow;
use std::path::Path;
use stickslip::{
    ClaimDocument, LinesDocument, RunDocument, RunScenario, Unusable, VerificationDocument,
    VerifyDocument,
};
use stickslip_tip::Scenario;
use stickslip_tip::sorting::sort_by_number;
use stickslip_verify::{
    Sample, TOLERANCES_ALLOWED, Verification, VerificationError, verify_across, verify_samples,
    verify_samples_across,
};

pub(crate) fn verify(session: &Session, arguments: &VerifyArguments) -> Result<(), Failure> {
    let path = &arguments.run;
    let read = [("RUN", Some(&**path))];
    distinct(&[("--output", Some(&*arguments.outlet.output))], &read)?;
    match open(session, path).map_err(|error| Failure::file("RUN", path, error))? {
        Written::Document(reader) => of_document(session, read_run_from(reader, path)?, arguments),
        Written::Lines(file) => lines::verify(session, path, &file, &arguments.outlet),
    }
}

/// The output: JSON, or text; there are no columns.
fn job(session: &Session, outlet: &OutletArguments) -> Result<Job, Failure> {
    let format = match outlet.format {
        Some(format @ (Format::Json | Format::Text)) => format,
        Some(_) => return Err(Failure::input("--format", "must be json or text")),
        None if outlet.output == Path::new("-") => on_standard_output(session),
        None => match format_of(&outlet.output, "") {
            Ok(Format::Json) => Format::Json,
            _ => {
                let message = "must be .json, or - for standard output";
                return Err(Failure::file("--output", &outlet.output, message));
            }
        },
    };
    Job::of_format(session, VerifyDocument::FORMAT, format, &outlet.output, &outlet.fields, None)
}

fn of_document(
    session: &Session,
    run: RunDocument,
    arguments: &VerifyArguments,
) -> Result<(), Failure> {
    let damaged =
        |message: String| Failure::file("RUN.json", &arguments.run, format!("damaged: {message}"));
    let unusable = |error: Unusable| damaged(error.to_string());
    let whole = run.parameters.prepared();
    let whole = whole.map_err(|failure| damaged(failure.to_string()))?;
    let (scenario, memory) = (whole.along(), &run.work.memory);
    let motion = Motion::of(&run, &whole).map_err(unusable)?;
    let samples = match &motion {
        Some(motion) => is_of(scenario, motion.span()).and_then(|()| samples(&run, scenario)),
        None => samples_alone(&run, scenario),
    };
    let samples = samples.map_err(damaged)?;
    begins_as(&whole, motion.as_ref().map(Motion::first), &samples).map_err(damaged)?;
    let job = job(session, &arguments.outlet)?;
    let found = repeated(session, |observe| match (&whole, &motion) {
        (RunScenario::Along(scenario), Some(Motion::Along(motion))) => {
            stickslip_verify::verify(scenario, memory, motion, observe)
        }
        (RunScenario::Across(scenario), Some(Motion::Across(motion))) => {
            verify_across(scenario, motion, observe)
        }
        _ => {
            let until = samples.last().map_or(scenario.until, |last| last.t);
            of_samples(&whole, memory, || samples.iter().copied(), until, observe)
        }
    })?;
    let differences = claims::of_document(session, &run, &whole, motion.as_ref())?;
    finish(session, run, job, (&found).into(), differences)
}

/// Writes the result, and reports differences.
fn finish(
    session: &Session,
    run: RunDocument,
    job: Job,
    verification: VerificationDocument,
    differences: Vec<ClaimDocument>,
) -> Result<(), Failure> {
    let broken = missed_message(&verification, run.parameters.tolerance, None);
    let failure = failure_of(session, broken, &differences);
    let job = job.silent_if(failure.is_some());
    job.finish(VerifyDocument::new(run.parameters, verification, differences, None))?;
    failure.map_or(Ok(()), Err)
}

/// The error for a run that misses its tolerance, or that contains wrong values.
fn failure_of(
    session: &Session,
    broken: Option<String>,
    differences: &[ClaimDocument],
) -> Option<Failure> {
    let said: Vec<String> =
        broken.into_iter().chain(claims::report_differences(session, differences)).collect();
    (!said.is_empty()).then(|| Failure::Run(said.join("; ")))
}

/// Checks that the motion begins as the parameters require; otherwise a repetition is useless. `first` contains the first x0
/// and y0 of the history.
fn begins_as(
    whole: &RunScenario,
    first: Option<(f64, Option<f64>)>,
    samples: &[Sample],
) -> Result<(), String> {
    let scenario = whole.along();
    let sample = samples.first().filter(|sample| sample.t <= scenario.start_time());
    let first = first.or(sample.map(|sample| (sample.x0, sample.y0)));
    let wanted = scenario.start_position - scenario.kick;
    let along = first.map(|(x0, _)| ("x0", x0, "start_position - kick", wanted));
    let across = match whole {
        RunScenario::Along(_) => None,
        RunScenario::Across(scenario) => {
            first.and_then(|(_, y0)| y0).map(|y0| ("y0", y0, "kick_across", scenario.kick_across))
        }
    };
    for (name, found, start, wanted) in along.into_iter().chain(across) {
        let allowed = TOLERANCES_ALLOWED * scenario.tolerance + 1e-9 * (1.0 + wanted.abs());
        let is_there = (found - wanted).abs() <= allowed;
        if !is_there {
            return Err(format!(
                "the motion begins at {name} = {found}, the run at {start} = {wanted}"
            ));
        }
    }
    Ok(())
}

/// Checks that the history begins with the scenario, and does not end after it.
fn is_of(scenario: &Scenario, (start, end): (f64, f64)) -> Result<(), String> {
    let same = (start - scenario.start_time()).abs() <= 1e-9 * start.abs().max(1.0);
    if same && end <= scenario.until && end > start {
        return Ok(());
    }
    Err(format!(
        "history: from {start} to {end}, where the run is from {} to {}",
        scenario.start_time(),
        scenario.until
    ))
}

/// The samples in the order of time.
fn samples(run: &RunDocument, scenario: &Scenario) -> Result<Vec<Sample>, String> {
    let (t, x0) = (&run.samples.t, &run.samples.x0);
    let l = run.samples.l.as_ref().or(run.samples.lag.as_ref()).unwrap_or(x0);
    let span = scenario.start_time()..=scenario.until;
    if l.len() != t.len() || !run.samples.are_even() || t.iter().any(|t| !span.contains(t)) {
        return Err("samples: the columns do not match each other or the run".into());
    }
    let y0 = |i: usize| run.samples.y0.as_ref().map(|y0| y0[i]);
    let rows = t.iter().zip(l).zip(x0).enumerate();
    let sample = |(i, ((&t, &l), &x0))| Sample { t, l, x0, y0: y0(i) };
    let mut samples: Vec<_> = rows.map(sample).collect();
    sort_by_number(&mut samples, |item| item.t);
    Ok(samples)
}

/// The samples of a run without history; some must be after the start.
fn samples_alone(run: &RunDocument, scenario: &Scenario) -> Result<Vec<Sample>, String> {
    let samples = samples(run, scenario)?;
    match samples.last().is_some_and(|last| last.t > scenario.start_time()) {
        true => Ok(samples),
        false => Err("samples: there are none after the start, and no history".into()),
    }
}

/// Comparison of samples with a repetition of their run, which had this memory. There must be a sample; all are in the order
/// of time.
fn of_samples<I: Iterator<Item = Sample>>(
    whole: &RunScenario,
    memory: &str,
    each: impl Fn() -> I,
    until: f64,
    observe: impl FnMut(f64) -> ControlFlow<()>,
) -> Result<Verification, VerificationError> {
    match whole {
        RunScenario::Along(scenario) => verify_samples(scenario, memory, each, until, observe),
        RunScenario::Across(scenario) => verify_samples_across(scenario, each, until, observe),
    }
}

/// Repeats the run with progress, until it is finished or interrupted.
pub(super) fn repeated(
    session: &Session,
    work: impl FnOnce(&mut dyn FnMut(f64) -> ControlFlow<()>) -> Result<Verification, VerificationError>,
) -> Result<Verification, Failure> {
    let mut progress = Progress::new(session, 0.0, 1.0);
    let found = work(&mut |part| {
        progress.reached(part);
        if signal(session).is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    });
    found.map_err(|error| match error {
        VerificationError::Interrupted => {
            signal(session).map_or(Failure::run(error), Failure::Stopped)
        }
        error => Failure::run(error),
    })
}

/// The message after the summary of a run that meets its tolerance; may be empty.
pub(in crate::commands) fn kept(found: &VerificationDocument) -> String {
    if !found.kept {
        return String::new();
    }
    let (memory, largest, allowed) = (&found.memory, found.l.largest, found.l.allowed);
    let across =
        found.y0.as_ref().map_or(String::new(), |y0| format!(", y0 by {:.1e}", y0.largest));
    format!(
        "; verified with {memory}: l is off by {largest:.1e} at most{across}, {allowed:.1e} is allowed"
    )
}

/// The message and the exit status for a run that misses its tolerance.
pub(super) fn broken(found: &VerificationDocument, tolerance: f64) -> Option<Failure> {
    missed_message(found, tolerance, None).map(Failure::Run)
}

/// The message for a run that misses its tolerance; for lines, with their numbers.
fn missed_message(
    found: &VerificationDocument,
    tolerance: f64,
    lines: Option<&LinesDocument>,
) -> Option<String> {
    if found.kept {
        return None;
    }
    let (l, y0) = (&found.l, found.y0.as_ref());
    let y0 =
        y0.filter(|y0| (y0.largest.is_nan() || y0.largest > y0.allowed) && l.largest <= l.allowed);
    let worst = y0.unwrap_or(l);
    let difference = match &found.u {
        Some(u) if l.largest <= l.allowed => {
            format!("u is off by {:.1e} at x = {}, {:.1e} is allowed", u.largest, u.at, u.allowed)
        }
        _ => {
            // Of a history, l alone; samples say x0 too.
            let what = match y0 {
                Some(_) => "y0",
                None if found.u.is_some() => "l",
                None => "l or x0",
            };
            let on_line = lines.map_or(String::new(), |lines| format!(", line {}", lines.line));
            format!(
                "{what} is off by {:.1e} at t = {}{on_line}, {TOLERANCES_ALLOWED} tolerances of {tolerance:e} are allowed",
                worst.largest, worst.at
            )
        }
    };
    let from = |t: f64| match lines {
        Some(LinesDocument { first_wrong_line: Some(line), wrong, samples, .. }) => {
            format!(
                "; it is correct until t = {t}, line {line} ({wrong} of {samples} samples are wrong)"
            )
        }
        _ => format!("; it is correct until t = {t}"),
    };
    let until = found.trusted_until.map_or(String::new(), from);
    let growth = format!("the motion amplifies errors {:.1e} times", found.amplification);
    Some(format!(
        "the tolerance is not met: {difference}{until}; {growth}: give a smaller --tolerance"
    ))
}
