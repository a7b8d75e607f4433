//! `stickslip sweep`.

mod diagram;
mod grid;
mod journal;
mod merge;
mod point;

use super::figure::Figure;
use super::progress::Progress;
use crate::arguments::{SweepArguments, SweepCommand};
use crate::documents::{
    FORMAT_VERSION, ShardDocument, Software, SweepDocument, SweepParameters, SweepPoint,
};
use crate::failure::{Failure, Typed};
use crate::files::output::{Output, OutputFormat};
use crate::interrupt::Interrupt;
use grid::Grid;
use journal::Journal;
use rayon::prelude::*;
use std::sync::{Mutex, PoisonError};
use stickslip_tip::cycle::{CycleError, TOLERANCES};

pub(crate) fn sweep(arguments: &SweepArguments) -> Result<(), Failure> {
    if let Some(SweepCommand::Merge(merge)) = &arguments.command {
        return merge::merge(merge);
    }
    let format = format(&arguments.output)?;
    judge(arguments)?;
    let grid = Grid::asked(&arguments.grid)?;
    let parameters = grid.parameters(arguments.tolerance);
    if arguments.plot.is_some() {
        diagram::judge(&parameters)?;
    }
    let output = Output::open("--output", &arguments.output)?;
    let figure = Figure::asked("--plot", arguments.plot.as_deref())?;
    let shard = arguments.shard.map(|s| ShardDocument { index: s.index, of: s.of });
    let journal = Journal::open(&arguments.output, &parameters, shard)?;

    let (journal, signal) = work(arguments, &grid, journal)?;
    if let Some(signal) = signal {
        if let Some(place) = journal.place() {
            eprintln!(
                "stickslip: the points finished so far are in {place}; the same command goes on"
            );
        }
        return Err(Failure::Stopped(signal));
    }
    let document = document(parameters, shard, journal.points());
    if let Some(figure) = figure {
        figure.write(&diagram::draw(&document))?;
    }
    write(&document, format, output)?;
    journal.remove();
    Ok(())
}

fn format(path: &std::path::Path) -> Result<OutputFormat, Failure> {
    match OutputFormat::of(path)? {
        OutputFormat::Npz => Err(Failure::input(
            format!("--output {}", path.display()),
            "a sweep is written as .json or .csv",
        )),
        format => Ok(format),
    }
}

fn judge(arguments: &SweepArguments) -> Result<(), Failure> {
    let tolerance = arguments.tolerance;
    if !(TOLERANCES.0..=TOLERANCES.1).contains(&tolerance) {
        let error = CycleError::Tolerance(tolerance);
        return Err(Failure::input(format!("--tolerance {}", Typed(tolerance)), error));
    }
    if arguments.threads == Some(0) {
        return Err(Failure::input("--threads 0", "1 or more will do"));
    }
    Ok(())
}

/// Computes the points that the journal lacks, and the signal that stopped it.
fn work(
    arguments: &SweepArguments,
    grid: &Grid,
    journal: Journal,
) -> Result<(Journal, Option<u8>), Failure> {
    let failed =
        |what: &str, error: &dyn std::fmt::Display| Failure::Run(format!("{what}: {error}"));
    let interrupt =
        Interrupt::listen().map_err(|error| failed("cannot listen for signals", &error))?;
    let (index, of) = arguments.shard.map_or((1, 1), |s| (s.index, s.of));
    let mine = (0..grid.len()).skip(index - 1).step_by(of);
    let missing: Vec<usize> = mine.filter(|i| !journal.has(*i)).collect();
    let progress = Progress::new(0.0, missing.len() as f64).at_every_call();
    let state = Mutex::new((journal, progress, 0.0));
    let one = |&i: &usize| -> Result<(), Failure> {
        if interrupt.signal().is_some() {
            return Ok(());
        }
        let point = point::of(&grid.at(i), arguments.tolerance);
        let mut state = state.lock().unwrap_or_else(PoisonError::into_inner);
        let (journal, progress, done) = &mut *state;
        *done += 1.0;
        progress.reached(*done);
        journal.add(i, point)
    };
    let pool = rayon::ThreadPoolBuilder::new().num_threads(arguments.threads.unwrap_or(0));
    let pool = pool.build().map_err(|error| failed("cannot start threads", &error))?;
    // One by one: neighbours cost a millisecond or a hundred.
    pool.install(|| missing.par_iter().with_max_len(1).try_for_each(one))?;
    let (journal, ..) = state.into_inner().unwrap_or_else(PoisonError::into_inner);
    Ok((journal, interrupt.signal()))
}

fn document(
    parameters: SweepParameters,
    shard: Option<ShardDocument>,
    points: Vec<SweepPoint>,
) -> SweepDocument {
    SweepDocument {
        format: SweepDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters,
        shard,
        points,
    }
}

fn write(document: &SweepDocument, format: OutputFormat, output: Output) -> Result<(), Failure> {
    if format != OutputFormat::Csv {
        return output.write_json(document);
    }
    let mut text =
        String::from("beta,r,alpha,regime,period,amplitude_x0,amplitude_u,slips,multiplier\n");
    let cell = |value: Option<f64>| value.map_or(String::new(), |value| value.to_string());
    for point in &document.points {
        let cells = [
            cell(point.beta),
            point.r.to_string(),
            cell(point.alpha),
            point.regime.map_or(String::new(), |regime| regime.to_string()),
            cell(point.period),
            cell(point.amplitude_x0),
            cell(point.amplitude_u),
            point.slips.map_or(String::new(), |slips| slips.to_string()),
            cell(point.multiplier),
        ];
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    output.write_bytes(text.as_bytes())
}
