//! `stickslip run`.

pub(crate) mod checkpoint;
pub(crate) mod disturbance;
mod integration;
pub(crate) mod many;
mod motion;
mod order;
mod record;
mod resume;
mod walker;
mod write;

use super::ask::refusal;
use super::fields::Fields;
use super::job::Job;
use crate::arguments::{FieldArguments, Format, RunArguments};
use crate::failure::Failure;
use crate::files::place::{Place, Target as File, place};
use crate::files::stream::Stream;
use crate::interrupt::Interrupt;
use crate::session::Session;
use checkpoint::Checkpoints;
use integration::Integration;
use motion::{Motion, Recorded};
use record::{Record, Sink};
use serde_json::Value;
use std::path::Path;
use stickslip::{Order, RunDocument, RunFormat, RunScenario};
use stickslip_outcome::{Watched, WatchedAcross};
use stickslip_tip::{RunError, Scenario};
use write::Target;

pub(crate) fn run(session: &Session, arguments: &RunArguments) -> Result<(), Failure> {
    match &arguments.resume {
        None => start(session, arguments),
        Some(path) => resume::resume(session, path, arguments),
    }
}

fn start(session: &Session, arguments: &RunArguments) -> Result<(), Failure> {
    let values = arguments.options.values(session)?;
    if values.get("walker") == Some(&Value::Bool(true)) {
        return walker::run(session, arguments, values);
    }
    let (order, scenario) = order::order(session, arguments, values)?;
    let refused = |failure| refusal(failure, &arguments.options.tip, &order::files(arguments));
    match &scenario {
        RunScenario::Along(scenario) => {
            let refused = |error: RunError| refused(order.parameters.refused(&error));
            let surface = scenario.initial_surface().map_err(refused)?;
            let running = Watched::new(scenario, &surface).map_err(refused)?;
            let (integrated, target) = integrated(session, arguments, &order, scenario, running)?;
            write::all(session, &order, integrated, target)
        }
        RunScenario::Across(scenario) => {
            let running = WatchedAcross::new(scenario);
            let running =
                running.map_err(|error| refused(order.parameters.refused_across(error)))?;
            let (integrated, target) =
                integrated(session, arguments, &order, &scenario.along, running)?;
            write::all(session, &order, integrated, target)
        }
    }
}

/// Integrates a motion from the start of its scenario to the end, and returns the run with its output.
fn integrated<R: Motion>(
    session: &Session,
    arguments: &RunArguments,
    order: &Order,
    scenario: &Scenario,
    running: R,
) -> Result<(Integration<R>, Target), Failure> {
    let interrupt = Interrupt::listen(session)?;
    // All places are judged before the work, so that it is not in vain.
    let checkpoint = arguments.checkpoint.as_deref();
    let checkpoint = checkpoint.map(|path| file("--checkpoint", path)).transpose()?;
    let checkpoint_path = checkpoint.as_ref().map(File::path);
    let (target, sink) = open::<R::Step>(session, arguments, order, checkpoint_path)?;

    let mut record = record(order, scenario, sink);
    write::head(&mut record, order, scenario)?;
    let start = scenario.start_time();
    let mut integration = Integration {
        running,
        record,
        checkpoints: checkpoint
            .zip(order.checkpoint_every)
            .map(|(file, every)| Checkpoints::new(file, order, start, every, start)),
        interrupt,
        seconds: 0.0,
    };
    integration.checkpoint()?;
    Ok((integration.finish(session, scenario)?, target))
}

/// A place that must be a file.
fn file(option: &str, path: &Path) -> Result<File, Failure> {
    match place(option, path)? {
        Place::File(file) => Ok(file),
        Place::Stdout | Place::Special(_) => {
            let message = "must be a file, which is replaced or extended";
            Err(Failure::file(option, path, message))
        }
    }
}

/// Opens the output of the run.
fn open<S: Recorded>(
    session: &Session,
    arguments: &RunArguments,
    order: &Order,
    checkpoint: Option<&Path>,
) -> Result<(Target, Sink), Failure> {
    let (output, fields) = (arguments.output(), &arguments.fields);
    if order.format == RunFormat::Jsonl {
        let fields = Fields::of_last_line(&fields.print)?;
        let stream = Stream::open("--output", output, checkpoint.is_some())?;
        if checkpoint.is_some() && !stream.is_file() {
            let message = "cannot be resumed from a checkpoint: lines written to a stream cannot be taken back; write them to a \
                 file";
            return Err(Failure::file("--output", output, message));
        }
        return Ok((Target::Lines(fields), Sink::Lines(stream)));
    }
    let job = job(session, order, output, arguments.plot.as_deref(), fields)?;
    let target = Target::Document(Box::new(job));
    let numbers = if keeps_history(order) { S::NUMBERS } else { S::SAMPLE_NUMBERS };
    let journal = |path| record::journal(path, numbers);
    Ok((target, checkpoint.map_or(Ok(Sink::Memory), journal)?))
}

/// The output of the document and the figure.
fn job(
    session: &Session,
    order: &Order,
    output: &Path,
    plot: Option<&Path>,
    fields: &FieldArguments,
) -> Result<Job, Failure> {
    Job::of_format(session, RunDocument::FORMAT, format_of(order.format), output, fields, plot)
}

fn format_of(format: RunFormat) -> Format {
    match format {
        RunFormat::Json | RunFormat::Jsonl => Format::Json,
        RunFormat::Csv => Format::Csv,
        RunFormat::Npz => Format::Npz,
        RunFormat::Text => Format::Text,
    }
}

fn record<S: Recorded>(order: &Order, scenario: &Scenario, sink: Sink) -> Record<S> {
    Record::new(scenario, order.samples.clone(), keeps_history(order), sink)
}

fn keeps_history(order: &Order) -> bool {
    let is_written = order.history && matches!(order.format, RunFormat::Json | RunFormat::Npz);
    // The text has the loops of a path, and the peaks of its rests.
    let is_summarised = order.format == RunFormat::Text && order.parameters.support_path.is_some();
    is_written || is_summarised || order.plot.is_some() || order.verify
}
