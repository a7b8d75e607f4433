//! Verification of a run written as lines: the file is read twice, and not kept in memory.

use super::{claims, job, missed_message, of_samples, repeated};
use crate::arguments::OutletArguments;
use crate::failure::Failure;
use crate::files::lines::{Extent, Flaw, Lines};
use crate::session::Session;
use std::cell::RefCell;
use std::fs::File;
use std::ops::ControlFlow;
use std::path::Path;
use stickslip::{
    EndingName, LinesDocument, RunHead, RunScenario, SampleLine, VerificationDocument,
    VerifyDocument,
};
use stickslip_tip::{MemoryChoice, Running, Scenario};
use stickslip_verify::{ComparedSamples, Sample};

/// Number of the line with the first sample.
const FIRST: u64 = 2;

/// First all lines are checked, which takes seconds, so that damage and missing lines are found before the run is
/// repeated. Then they are compared, one by one, with the repetition.
pub(super) fn verify(
    session: &Session,
    path: &Path,
    file: &File,
    outlet: &OutletArguments,
) -> Result<(), Failure> {
    let named = format!("RUN.jsonl {}", path.display());
    let (head, surveyed, extent) = survey(file).map_err(|flaw| refused(flaw, &named))?;
    let scenario = surveyed.along();
    let until = until(scenario, &extent).map_err(|flaw| refused(flaw, &named))?;
    let job = job(session, outlet)?;
    let samples = Samples { file, number: extent.samples, flaw: RefCell::default() };
    let found = repeated(session, |observe| {
        let observe = |part| match *samples.flaw.borrow() {
            Some(_) => ControlFlow::Break(()),
            None => observe(part),
        };
        let memory = memory(scenario, &extent);
        of_samples(&surveyed, &memory, || samples.read(), until, observe)
    });
    if let Some(flaw) = samples.flaw.take() {
        return Err(refused(flaw, &named));
    }
    let found = found?;
    let lines = lines(&extent, until, found.samples.unwrap_or_default());
    let verification = VerificationDocument::from(&found);
    let end = (until, extent.end.as_ref());
    let differences = claims::of_lines(session, &surveyed, &head, samples.lines(), end)?;
    if let Some(flaw) = samples.flaw.take() {
        return Err(refused(flaw, &named));
    }
    let failure = failure(&verification, &lines, scenario, &named);
    let failure = match claims::report_differences(session, &differences) {
        None => failure,
        Some(said) => {
            let before = failure.map_or(String::new(), |failure| format!("{failure}; "));
            Some(Failure::Run(format!("{before}{named}: {said}")))
        }
    };
    let job = job.silent_if(failure.is_some());
    job.finish(VerifyDocument::new(head.parameters, verification, differences, Some(lines)))?;
    failure.map_or(Ok(()), Err)
}

/// The definition and the extent of the run.
fn survey(file: &File) -> Result<(RunHead, RunScenario, Extent), Flaw> {
    let mut lines = Lines::of(file)?;
    let head = lines.head()?;
    let damaged = |message: String| Flaw::Damaged(format!("line 1: {message}"));
    let surveyed = head.parameters.prepared();
    let surveyed = surveyed.map_err(|error| damaged(error.to_string()))?;
    let scenario = surveyed.along();
    let extent = lines.survey(&(scenario.start_time()..=scenario.until))?;
    Ok((head, surveyed, extent))
}

/// Time of the last sample.
fn until(scenario: &Scenario, extent: &Extent) -> Result<f64, Flaw> {
    let last = extent.last.filter(|last| *last > scenario.start_time());
    last.ok_or_else(|| match extent.end {
        Some(_) => Flaw::Damaged("it has no samples after the start of the run".into()),
        None => Flaw::NoSamples,
    })
}

/// The memory that was used. Incomplete lines do not contain the final choice of `auto`, which is modes whenever it
/// applies.
fn memory(scenario: &Scenario, extent: &Extent) -> String {
    if let Some(end) = &extent.end {
        return end.work.memory.clone();
    }
    let modes_apply = || {
        let scenario = Scenario { memory: MemoryChoice::Modes, ..scenario.clone() };
        let surface = scenario.initial_surface();
        surface.is_ok_and(|surface| Running::new(&scenario, &surface).is_ok())
    };
    match scenario.memory {
        MemoryChoice::Direct => "direct",
        MemoryChoice::Fft => "fft",
        MemoryChoice::Modes => "modes",
        MemoryChoice::Auto if modes_apply() => "modes",
        MemoryChoice::Auto => "fft",
    }
    .into()
}

/// Samples read from the file on request.
struct Samples<'a> {
    file: &'a File,
    number: u64,
    /// The reason why the last reading ended early.
    flaw: RefCell<Option<Flaw>>,
}

impl Samples<'_> {
    fn read(&self) -> impl Iterator<Item = Sample> {
        self.lines().map(|line| Sample {
            t: line.t,
            l: line.l.or(line.lag).unwrap_or(line.x0),
            x0: line.x0,
            y0: line.y0,
        })
    }

    fn lines(&self) -> impl Iterator<Item = SampleLine> {
        let failed = |flaw| self.flaw.replace(Some(flaw));
        let lines = Lines::of(self.file).and_then(|mut lines| lines.head().map(|_| lines));
        let mut lines = lines.map_err(failed).ok();
        (0..self.number).map_while(move |_| lines.as_mut()?.sample().map_err(failed).ok())
    }
}

fn lines(extent: &Extent, until: f64, compared: ComparedSamples) -> LinesDocument {
    LinesDocument {
        samples: compared.number,
        verified_until: until,
        ending: match &extent.end {
            None => EndingName::CutOff,
            Some(end) if end.interrupted => EndingName::Interrupted,
            Some(_) => EndingName::Complete,
        },
        line: FIRST + compared.worst,
        wrong: compared.wrong,
        first_wrong_line: compared.first_wrong.map(|first| FIRST + first),
    }
}

/// The advice for an incomplete run.
const REST: &str = "`stickslip run --resume CHECKPOINT` finishes a run that was started with --checkpoint; any other \
must be run again";

/// The message and the exit status for wrong lines, and for incomplete ones.
fn failure(
    found: &VerificationDocument,
    lines: &LinesDocument,
    scenario: &Scenario,
    named: &str,
) -> Option<Failure> {
    let LinesDocument { samples, verified_until, .. } = *lines;
    let is_cut_off = lines.ending == EndingName::CutOff;
    let cut_off =
        format!("cut off after {samples} samples, at t = {verified_until} of {}", scenario.until);
    match lines.first_wrong_line {
        None if is_cut_off => Some(Failure::CutOff(format!(
            "{named}: {cut_off}: until then the tolerance is kept; {REST}"
        ))),
        None => None,
        Some(_) => {
            let wrong = missed_message(found, scenario.tolerance, Some(lines))?;
            let also = if is_cut_off { format!("; it is {cut_off}") } else { String::new() };
            Some(Failure::Run(format!("{named}: {wrong}{also}")))
        }
    }
}

fn refused(flaw: Flaw, named: &str) -> Failure {
    let cut_off = |message: &str| Failure::CutOff(format!("{named}: {message}; {REST}"));
    match flaw {
        Flaw::NoHead => cut_off("cut off within its first line: there is nothing to verify"),
        Flaw::NoSamples => {
            cut_off("cut off before its first sample after the start: there is nothing to verify")
        }
        Flaw::Damaged(message) => Failure::input(named, message),
    }
}
