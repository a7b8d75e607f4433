//! `stickslip run`.

pub(crate) mod checkpoint;
pub(crate) mod disturbance;
mod document;
mod journey;
pub(crate) mod limits;
mod order;
mod record;
pub(crate) mod samples;
mod write;

pub(crate) use disturbance::parse_pulses;
pub(crate) use order::{explain, option_at_fault};

use super::figure::Figure;
use crate::arguments::RunArguments;
use crate::failure::Failure;
use crate::files::apart::resting_place;
use crate::files::output::{Output, Place, place};
use crate::files::stream::Stream;
use checkpoint::Checkpoints;
use journey::Journey;
use record::{Record, Sink};
use std::path::{Path, PathBuf};
use stickslip_documents::RunFormat;
use stickslip_documents::{Order, Unusable};
use stickslip_outcome::Watched;
use stickslip_tip::{RunError, Scenario};
use write::Target;

pub(crate) fn run(arguments: &RunArguments) -> Result<(), Failure> {
    match &arguments.resume {
        None => start(arguments),
        Some(path) => resume(path),
    }
}

fn start(arguments: &RunArguments) -> Result<(), Failure> {
    let order = order::order(arguments)?;
    let said = |error: Unusable| Failure::input("the run", error);
    let explained = |error: RunError| explain(&error, &arguments.start, &arguments.disturbance);
    let scenario = order.parameters.scenario().map_err(said)?;
    let surface = scenario.initial_surface().map_err(explained)?;
    let running = Watched::new(&scenario, &surface).map_err(explained)?;
    // All places are judged before the work, so that it is not in vain.
    let checkpoint = arguments.checkpoint.as_deref().map(checkpoint_place).transpose()?;
    let (target, sink) = open(&arguments.output, &order, checkpoint.as_deref())?;
    let figure = Figure::asked("--plot", arguments.plot.as_deref())?;

    let mut record = record(&order, &scenario, sink);
    write::head(&mut record, &order, &scenario)?;
    let start = scenario.start_time();
    let mut journey = Journey {
        running,
        record,
        checkpoints: checkpoint
            .zip(order.checkpoint_every)
            .map(|(path, every)| Checkpoints::new(&path, &order, start, every, start)),
        seconds: 0.0,
    };
    journey.checkpoint()?;
    let travelled = journey.travel(&scenario)?;
    write::all(&order, &scenario, &surface, travelled, target, figure)
}

/// Goes on where a checkpoint was made.
fn resume(path: &Path) -> Result<(), Failure> {
    let named = |message: String| Failure::input(format!("--resume {}", path.display()), message);
    let (head, state) = checkpoint::read(path)?;
    let order = head.order;
    let scenario = order.parameters.scenario().map_err(|error| named(error.to_string()))?;
    let surface = scenario.initial_surface().map_err(|error| named(error.to_string()))?;
    let running = Watched::resumed(&scenario, &surface, &state);
    let running = running.map_err(|error| named(error.to_string()))?;
    let figure = Figure::asked("--plot", order.plot.as_deref())?;
    let (target, record) = if order.format == RunFormat::Jsonl {
        let stream = Stream::resume(&order.output, head.written)?;
        let mut record = record(&order, &scenario, Sink::Lines(stream));
        record.taken = head.samples;
        (Target::Lines, record)
    } else {
        let output = Output::open("--output", &order.output)?;
        let mut record = record(&order, &scenario, Sink::Memory);
        record.resume(&checkpoint::journal_of(path), head.written)?;
        (Target::Document(output), record)
    };
    let (start, every) = (scenario.start_time(), order.checkpoint_every.unwrap_or(f64::INFINITY));
    let checkpoints = Some(Checkpoints::new(path, &order, start, every, head.t));
    let journey = Journey { running, record, checkpoints, seconds: head.seconds };
    let travelled = journey.travel(&scenario)?;
    write::all(&order, &scenario, &surface, travelled, target, figure)
}

/// The file that a checkpoint goes to.
fn checkpoint_place(path: &Path) -> Result<PathBuf, Failure> {
    // Its folder must take new files.
    drop(Output::open("--checkpoint", path)?);
    match place("--checkpoint", path)? {
        Place::File(path) => Ok(resting_place(&path)),
        Place::Stdout | Place::Special(_) => Err(Failure::input(
            format!("--checkpoint {}", path.display()),
            "must be a file, which is replaced by each checkpoint",
        )),
    }
}

/// Opens what the run is written to.
fn open(
    output: &Path,
    order: &Order,
    checkpoint: Option<&Path>,
) -> Result<(Target, Sink), Failure> {
    if order.format == RunFormat::Jsonl {
        let stream = Stream::open("--output", output, checkpoint.is_some())?;
        if checkpoint.is_some() && !stream.is_file() {
            return Err(Failure::input(
                format!("--output {}", output.display()),
                "cannot be gone on with from a checkpoint: lines that have left cannot be taken back; write \
                 them to a file",
            ));
        }
        return Ok((Target::Lines, Sink::Lines(stream)));
    }
    let target = Target::Document(Output::open("--output", output)?);
    Ok((target, checkpoint.map_or(Ok(Sink::Memory), record::journal)?))
}

fn record(order: &Order, scenario: &Scenario, sink: Sink) -> Record {
    let is_written = order.history && matches!(order.format, RunFormat::Json | RunFormat::Npz);
    let keeps_history = is_written || order.plot.is_some() || order.verify;
    Record::new(scenario.model.r(), order.samples.clone(), keeps_history, sink)
}
