//! `stickslip verify`, and `stickslip run --verify`.

use super::progress::Progress;
use super::run::{document, parameters};
use crate::arguments::VerifyArguments;
use crate::documents::{
    FORMAT_VERSION, LargestDifferenceDocument, RunDocument, Software, VerificationDocument,
    VerifyDocument,
};
use crate::failure::Failure;
use crate::files::apart::apart;
use crate::files::input::read_run;
use crate::files::output::Output;
use crate::interrupt::Interrupt;
use std::ops::ControlFlow;
use stickslip_surface::{Claim, Difference, TOLERANCES_ALLOWED, Verification, VerificationError};
use stickslip_tip::{Scenario, Trajectory};

pub(crate) fn verify(arguments: &VerifyArguments) -> Result<(), Failure> {
    apart(&[("--output", Some(&*arguments.output))], &[("RUN.json", Some(&*arguments.run))])?;
    let run = read_run(&arguments.run)?;
    let damaged = |message: String| {
        Failure::input(
            format!("RUN.json {}", arguments.run.display()),
            format!("damaged: {message}"),
        )
    };
    let scenario = parameters::scenario(&run.parameters).map_err(damaged)?;
    let verification = if run.history.is_some() {
        let trajectory = document::trajectory(&run).map_err(damaged)?;
        is_of(&scenario, &trajectory).map_err(damaged)?;
        let output = Output::open("--output", &arguments.output)?;
        (of_history(&scenario, &run.work.memory, &trajectory)?, output)
    } else {
        let samples = samples(&run, &scenario).map_err(damaged)?;
        let until = samples.iter().map(|(t, _)| *t).fold(f64::NEG_INFINITY, f64::max);
        let output = Output::open("--output", &arguments.output)?;
        (repeated(&scenario, &run.work.memory, Claim::Samples(&samples, until))?, output)
    };
    let (verification, output) = verification;
    let failure = broken(&verification, scenario.tolerance);
    output.write_json(&VerifyDocument {
        format: VerifyDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters: run.parameters,
        verification,
    })?;
    failure.map_or(Ok(()), Err)
}

/// Whether the history begins and ends as the scenario does.
fn is_of(scenario: &Scenario, trajectory: &Trajectory) -> Result<(), String> {
    let (start, end) = (trajectory.start(), trajectory.end());
    let same = (start - scenario.start_time()).abs() <= 1e-9 * start.abs().max(1.0);
    if same && end <= scenario.until && end > start {
        return Ok(());
    }
    Err(format!(
        "history: it lasts from {start} to {end}, the run from {} to {}",
        scenario.start_time(),
        scenario.until
    ))
}

/// Times and l of the samples after the start.
fn samples(run: &RunDocument, scenario: &Scenario) -> Result<Vec<(f64, f64)>, String> {
    let (t, l) = (&run.samples.t, &run.samples.l);
    let span = scenario.start_time()..=scenario.until;
    if t.len() != l.len() || t.iter().any(|t| !span.contains(t)) {
        return Err("samples: t and l do not match each other, or the run".into());
    }
    let samples: Vec<_> = t.iter().copied().zip(l.iter().copied()).collect();
    match samples.iter().any(|(t, _)| *t > scenario.start_time()) {
        true => Ok(samples),
        false => Err("samples: there are none after the start, and no history".into()),
    }
}

/// The dense history of a run against its repetition.
pub(super) fn of_history(
    scenario: &Scenario,
    memory: &str,
    trajectory: &Trajectory,
) -> Result<VerificationDocument, Failure> {
    repeated(scenario, memory, Claim::History(trajectory))
}

fn repeated(
    scenario: &Scenario,
    memory: &str,
    claim: Claim,
) -> Result<VerificationDocument, Failure> {
    let interrupt = Interrupt::listen()
        .map_err(|error| Failure::Run(format!("cannot listen for signals: {error}")))?;
    let mut progress = Progress::new(0.0, 1.0);
    let found = stickslip_surface::verify(scenario, memory, claim, |part| {
        progress.reached(part);
        if interrupt.signal().is_some() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    });
    found.map(|verification| document(&verification)).map_err(|error| match error {
        VerificationError::Interrupted => {
            interrupt.signal().map_or(Failure::Run(error.to_string()), Failure::Stopped)
        }
        error => Failure::Run(error.to_string()),
    })
}

fn document(found: &Verification) -> VerificationDocument {
    let difference = |d: &Difference| LargestDifferenceDocument {
        largest: d.largest,
        at: d.at,
        allowed: d.allowed,
    };
    VerificationDocument {
        kept: found.is_kept(),
        memory: found.memory.into(),
        tolerance: found.tolerance,
        l: difference(&found.l),
        u: found.u.as_ref().map(difference),
        trusted_until: found.trusted_until,
        amplification: found.growth.amplification,
        lyapunov_exponent: found.growth.exponent,
    }
}

/// What is said after the summary of a run that keeps its promise; else nothing.
pub(super) fn kept(found: &VerificationDocument) -> String {
    if !found.kept {
        return String::new();
    }
    let (memory, largest, allowed) = (&found.memory, found.l.largest, found.l.allowed);
    format!("; verified with {memory}: l is off by {largest:.1e} at most, {allowed:.1e} is allowed")
}

/// What is said, and the exit status, where the promise is broken.
pub(super) fn broken(found: &VerificationDocument, tolerance: f64) -> Option<Failure> {
    if found.kept {
        return None;
    }
    let l = &found.l;
    let difference = match &found.u {
        Some(u) if l.largest <= l.allowed => {
            format!("u is off by {:.1e} at x = {}, {:.1e} is allowed", u.largest, u.at, u.allowed)
        }
        _ => format!(
            "l is off by {:.1e} at t = {}, {TOLERANCES_ALLOWED} tolerances of {tolerance:e} are allowed",
            l.largest, l.at
        ),
    };
    let until = found.trusted_until.map_or(String::new(), |t| format!("; trust it until t = {t}"));
    let growth = format!("the motion amplifies errors {:.1e} times", found.amplification);
    Some(Failure::Run(format!(
        "the tolerance is not kept: {difference}{until}; {growth}: ask for a smaller --tolerance"
    )))
}
