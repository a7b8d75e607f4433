//! From the command line to an order: the run and its outputs.

use super::checkpoint;
use super::disturbance::{disturbed, files_read};
use crate::arguments::{Format, HistoryName, RunArguments};
use crate::commands::ask::{refusal, refuse_unknown};
use crate::commands::job;
use crate::failure::Failure;
use crate::files::columns::read_surface_table;
use crate::files::distinct::{Named, distinct};
use crate::files::paths::resolved;
use crate::session::Session;
use serde_json::{Map, Value};
use std::path::Path;
use stickslip::{Order, Run, RunFormat, RunScenario, parameter};

/// The order of the arguments with these values of options, checked as a whole, and its scenario.
pub(super) fn order(
    session: &Session,
    arguments: &RunArguments,
    values: Map<String, Value>,
) -> Result<(Order, RunScenario), Failure> {
    let format = format(session, arguments)?;
    let RunArguments { options, disturbance, support_path, .. } = arguments;
    refuse_unknown::<Run, _>(options, &values, "a tip on its line, without --walker")?;
    let scales = options.scales(session, &arguments.in_units, &values)?;
    let files = files(arguments);
    let question: Run = parameter::question(values)?;
    let question = match &arguments.initial_surface_across {
        None => question,
        Some(path) => {
            let option = "--initial-surface-across";
            let table = read_surface_table(session, option, path, scales.as_ref())?;
            Run { initial_surface_across: Some(table), ..question }
        }
    };
    let disturbance = (disturbance, support_path.as_deref());
    let refused = |failure| refusal(failure, &options.tip, &files);
    let (question, scenario) = disturbed(session, question, disturbance, scales.as_ref(), refused)?;
    let span = scenario.span();
    let are_kept = format != RunFormat::Jsonl;
    let samples = question.sampling.times(span, "the run", are_kept)?;
    let every = checkpoint::interval(arguments.checkpoint_every, span)?;
    let order = Order {
        samples,
        parameters: question,
        output: resolved(arguments.output()),
        format,
        history: arguments.history == HistoryName::All,
        plot: arguments.plot.as_deref().map(resolved),
        verify: arguments.verify,
        scales,
        checkpoint_every: arguments.checkpoint.is_some().then_some(every),
    };
    Ok((judged(order, arguments)?, scenario))
}

/// Rejects options that exclude each other.
fn judged(order: Order, arguments: &RunArguments) -> Result<Order, Failure> {
    judge_files(arguments)?;
    if order.format != RunFormat::Jsonl {
        return Ok(order);
    }
    let needs = "needs the history, which a run written as .jsonl does not keep: write it to a .json, .csv or .npz";
    if let Some(path) = &arguments.plot {
        return Err(Failure::file("--plot", path, needs));
    }
    if order.scales.is_some() {
        let message = "apply to tables and documents, and .jsonl is written during the run: write it to a .json, .csv or .npz";
        return Err(Failure::input("--units, --sigma and the other scales", message));
    }
    if arguments.verify {
        let or = "or verify the lines afterwards, with `stickslip verify FILE.jsonl`";
        let message = format!("{needs}, {or}");
        return Err(Failure::input("--verify", message));
    }
    Ok(order)
}

/// The files that the command reads.
pub(super) fn files(arguments: &RunArguments) -> Vec<Named<'_>> {
    let RunArguments { options, disturbance, support_path, .. } = arguments;
    let [tip_file, parameters] = options.files();
    let read = files_read(tip_file.1, disturbance, support_path.as_deref());
    let across = ("--initial-surface-across", arguments.initial_surface_across.as_deref());
    [&read[..], &[across, parameters]].concat()
}

/// Checks that the files are different, and that a checkpoint can store their names.
pub(super) fn judge_files(arguments: &RunArguments) -> Result<(), Failure> {
    let written = [
        ("--output", Some(arguments.output())),
        ("--plot", arguments.plot.as_deref()),
        ("--checkpoint", arguments.checkpoint.as_deref()),
    ];
    distinct(&written, &files(arguments))?;
    let is_text = |path: &Path| resolved(path).to_str().is_some();
    let odd = written
        .into_iter()
        .find_map(|(option, path)| Some((option, path?)).filter(|n| !is_text(n.1)));
    match odd.filter(|_| arguments.checkpoint.is_some()) {
        None => Ok(()),
        Some((option, path)) => Err(Failure::file(
            option,
            path,
            "its name, or that of a folder, is not UTF-8, and a checkpoint contains it as text: choose another name",
        )),
    }
}

pub(super) fn format(session: &Session, arguments: &RunArguments) -> Result<RunFormat, Failure> {
    if let Some(format) = arguments.format {
        return Ok(format);
    }
    let extension = arguments.output().extension().and_then(|e| e.to_str());
    if extension.is_some_and(|e| e.eq_ignore_ascii_case("jsonl")) {
        return Ok(RunFormat::Jsonl);
    }
    Ok(match job::format(session, None, arguments.output(), ", .jsonl")? {
        Format::Json => RunFormat::Json,
        Format::Csv => RunFormat::Csv,
        Format::Npz => RunFormat::Npz,
        Format::Text => RunFormat::Text,
    })
}
