//! Resume of a run from a checkpoint.

use super::checkpoint::{self, Checkpoints};
use super::integration::Integration;
use super::motion::Motion;
use super::record::Sink;
use super::write::{self, Target};
use super::{file, job, record};
use crate::arguments::RunArguments;
use crate::commands::fields::Fields;
use crate::failure::Failure;
use crate::files::distinct::distinct;
use crate::files::journal::journal_of;
use crate::files::paths::{folder_of, found_from, resolved};
use crate::files::place::Target as File;
use crate::files::stream::{Stream, part_of};
use crate::interrupt::Interrupt;
use crate::session::Session;
use std::path::{Path, PathBuf};
use stickslip::{CheckpointHead, Order, RunFormat, RunScenario};
use stickslip_outcome::{Watched, WatchedAcross};
use stickslip_tip::Scenario;

/// Resumes the run of a checkpoint.
pub(super) fn resume(
    session: &Session,
    path: &Path,
    arguments: &RunArguments,
) -> Result<(), Failure> {
    let named = |message: String| Failure::file("--resume", path, message);
    let checkpoint = file("--resume", path)?;
    let (mut head, state) = checkpoint::read(path)?;
    let before = folder_of(checkpoint.path()).join(&head.order.output);
    redirect(&mut head.order, checkpoint.path(), arguments)?;
    let parameters = &head.order.parameters;
    let scenario = parameters.prepared();
    let scenario = scenario.map_err(|error| named(error.to_string()))?;
    let place = Place { checkpoint, before, arguments };
    match &scenario {
        RunScenario::Along(scenario) => {
            let surface = scenario.initial_surface().map_err(|error| named(error.to_string()))?;
            let running = Watched::resumed(scenario, &surface, &state);
            let running = running.map_err(|error| named(error.to_string()))?;
            let (integrated, target) = resumed(session, &head, place, scenario, running)?;
            write::all(session, &head.order, integrated, target)
        }
        RunScenario::Across(scenario) => {
            let running = WatchedAcross::resumed(scenario, &state);
            let running = running.map_err(|error| named(error.to_string()))?;
            let (integrated, target) = resumed(session, &head, place, &scenario.along, running)?;
            write::all(session, &head.order, integrated, target)
        }
    }
}

/// The checkpoint of a run and the file that it wrote before.
struct Place<'a> {
    checkpoint: File,
    before: PathBuf,
    arguments: &'a RunArguments,
}

/// Integrates a resumed motion to the end of its scenario, and returns the run with its output.
fn resumed<R: Motion>(
    session: &Session,
    head: &CheckpointHead,
    Place { checkpoint, before, arguments }: Place<'_>,
    scenario: &Scenario,
    running: R,
) -> Result<(Integration<R>, Target), Failure> {
    let order = &head.order;
    judge(head, running.t(), scenario).map_err(|message| {
        let path = arguments.resume.as_deref().unwrap_or(checkpoint.path());
        Failure::file("--resume", path, message)
    })?;
    let interrupt = Interrupt::listen(session)?;
    let (target, record) = if order.format == RunFormat::Jsonl {
        let target = file("--output", &order.output)?;
        // The lines may be complete, under either name, or still in the part of the earlier one.
        let others = [target.path().to_path_buf(), part_of(&before), before];
        let stream = Stream::resume(target, head.written, &others)?;
        let mut record = record(order, scenario, Sink::Lines(stream));
        record.taken = head.samples;
        (Target::Lines(Fields::of_last_line(&arguments.fields.print)?), record)
    } else {
        let job = job(session, order, &order.output, order.plot.as_deref(), &arguments.fields)?;
        let mut record = record(order, scenario, Sink::Memory);
        record.resume(&journal_of(checkpoint.path()), head.written, running.t())?;
        (Target::Document(Box::new(job)), record)
    };
    let (t, until) = (running.t(), scenario.until);
    session.remark(format_args!(
        "stickslip: from t = {t} to {until}, into {}",
        order.output.display()
    ));
    let (start, every) = (scenario.start_time(), order.checkpoint_every.unwrap_or(f64::INFINITY));
    let checkpoints = Some(Checkpoints::new(checkpoint, order, start, every, t));
    let seconds = head.seconds;
    let mut integration = Integration { running, record, checkpoints, interrupt, seconds };
    if arguments.output.is_some() || arguments.plot.is_some() {
        // A later resume continues at the new places.
        integration.checkpoint()?;
    }
    Ok((integration.finish(session, scenario)?, target))
}

/// Redirects the outputs to the files given now, or to those in the checkpoint. The checkpoint may come from somebody
/// else: its files must be in its folder.
fn redirect(order: &mut Order, checkpoint: &Path, arguments: &RunArguments) -> Result<(), Failure> {
    let named = format!("--resume {}", checkpoint.display());
    let place = |option: &str, given: Option<&Path>, held: &Path| {
        match given {
        Some(path) => Ok(resolved(path)),
        None => found_from(folder_of(checkpoint), held).ok_or_else(|| {
            let held = held.display();
            let message = format!(
                "it would write {held}, which is not in its folder: confirm with {option} {held}, or give another \
                 {option}"
            );
            Failure::input(&named, message)
        }),
    }
    };
    order.output = place("--output", arguments.output.as_deref(), &order.output)?;
    let given = arguments.plot.as_deref();
    order.plot = match (given, order.plot.take()) {
        (_, Some(held)) => Some(place("--plot", given, &held)?),
        (Some(path), None) => {
            let message = "the run was started without a picture, and may lack the data for one";
            return Err(Failure::file("--plot", path, message));
        }
        (None, None) => None,
    };
    let written = [
        ("--resume", Some(checkpoint)),
        ("--output", Some(&*order.output)),
        ("--plot", order.plot.as_deref()),
    ];
    distinct(&written, &[])?;
    let is_other = arguments.output.as_deref().is_some_and(|path| is_of_other(path, order.format));
    if is_other {
        let message =
            "the run is written in another format, that of the checkpoint: give the same extension";
        return Err(Failure::file("--output", &order.output, message));
    }
    Ok(())
}

/// Whether the extension of a file name belongs to another format.
fn is_of_other(path: &Path, format: RunFormat) -> bool {
    let ending = path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase);
    let promised = match ending.as_deref() {
        Some("json") => RunFormat::Json,
        Some("csv") => RunFormat::Csv,
        Some("npz") => RunFormat::Npz,
        Some("jsonl") => RunFormat::Jsonl,
        _ => return false,
    };
    promised != format
}

/// Checks that time and samples in the first line agree with the state; a correct checksum only proves that the file
/// is unchanged.
fn judge(head: &CheckpointHead, t: f64, scenario: &Scenario) -> Result<(), &'static str> {
    if head.t.to_bits() != t.to_bits() {
        return Err("is damaged: its time differs from that of its state");
    }
    let span = (scenario.start_time(), scenario.until);
    if !head.order.samples.are_of(span, head.order.format != RunFormat::Jsonl) {
        return Err("is damaged: its samples do not match its run");
    }
    let (times, _) = head.order.samples.clone().in_order();
    let slack = 1e-9 * t.abs().max(1.0);
    let next_is_due = times.at(head.samples).is_some_and(|next| next < t - slack);
    let last = head.samples.checked_sub(1);
    let last_was_due = last.is_none_or(|last| times.at(last).is_some_and(|last| last < t + slack));
    if next_is_due || !last_was_due {
        return Err("is damaged: it lacks samples before its time");
    }
    Ok(())
}
