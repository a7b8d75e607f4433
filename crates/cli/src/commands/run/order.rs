//! From the command line to an order: what is run, and what is written of it.

use super::super::model::wide_model;
use super::checkpoint;
use super::disturbance::{Disturbance, files_read, warn_of_idle};
use super::limits::within_range;
use super::samples::sample_times;
use crate::arguments::{DisturbanceArguments, Format, HistoryName, RunArguments, StartArguments};
use crate::commands::in_units::scales;
use crate::commands::job;
use crate::failure::{Failure, Typed};
use crate::files::distinct::distinct;
use crate::files::paths::resolved;
use std::path::Path;
use stickslip::{Order, RunFormat, RunParameters};
use stickslip_tip::{RunError, Scenario};

/// What is asked for, judged as a whole.
pub(super) fn order(arguments: &RunArguments) -> Result<Order, Failure> {
    let format = format(arguments)?;
    let tip_file = arguments.model.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, arguments.model.r)?;
    let disturbance = Disturbance::of(&arguments.disturbance, scales.as_ref())?;
    let scenario = scenario(arguments, &disturbance)?;
    within_range(&arguments.model, &scenario)?;
    scenario
        .validate()
        .map_err(|error| explain(&error, &arguments.start, &arguments.disturbance))?;
    let span = (scenario.start_time(), scenario.until);
    warn_of_idle(&arguments.disturbance, &disturbance, span);
    let are_kept = format != RunFormat::Jsonl;
    let every = checkpoint::interval(arguments.checkpoint_every, span)?;
    let Disturbance { pulses, table, .. } = disturbance;
    let order = Order {
        samples: sample_times(&arguments.sampling, span, "the run", are_kept)?,
        parameters: RunParameters::of(&scenario, arguments.model.alpha_above, &pulses, table),
        output: resolved(arguments.output()),
        format,
        history: arguments.history == HistoryName::All,
        plot: arguments.plot.as_deref().map(resolved),
        verify: arguments.verify,
        scales,
        checkpoint_every: arguments.checkpoint.is_some().then_some(every),
    };
    judged(order, arguments)
}

/// What does not go together.
fn judged(order: Order, arguments: &RunArguments) -> Result<Order, Failure> {
    files(arguments)?;
    if order.format != RunFormat::Jsonl {
        return Ok(order);
    }
    let plot = arguments.plot.as_deref().map(|path| format!("--plot {}", path.display()));
    if let Some(option) = plot {
        return Err(Failure::input(
            option,
            "needs the history, which a run written as lines does not keep: write it to a .json, .csv or .npz",
        ));
    }
    if order.scales.is_some() {
        return Err(Failure::input(
            "--units, --sigma and what goes with it",
            "are of tables and documents, and lines are written as the run goes on: write it to a .json, .csv or .npz",
        ));
    }
    if arguments.verify {
        return Err(Failure::input(
            "--verify",
            "needs the history, which a run written as lines does not keep: write it to a .json, .csv or .npz, \
             or verify the lines when they are there, with `stickslip verify FILE.jsonl`",
        ));
    }
    Ok(order)
}

/// Whether each file has a name of its own, which a checkpoint, if there is one, can hold.
fn files(arguments: &RunArguments) -> Result<(), Failure> {
    let written = [
        ("--output", Some(arguments.output())),
        ("--plot", arguments.plot.as_deref()),
        ("--checkpoint", arguments.checkpoint.as_deref()),
    ];
    distinct(&written, &files_read(&arguments.model, &arguments.disturbance))?;
    let is_text = |path: &Path| resolved(path).to_str().is_some();
    let odd = written
        .into_iter()
        .find_map(|(option, path)| Some((option, path?)).filter(|n| !is_text(n.1)));
    match odd.filter(|_| arguments.checkpoint.is_some()) {
        None => Ok(()),
        Some((option, path)) => Err(Failure::input(
            format!("{option} {}", path.display()),
            "its name, or that of a folder, is not UTF-8, and a checkpoint holds text: choose another name",
        )),
    }
}

fn format(arguments: &RunArguments) -> Result<RunFormat, Failure> {
    if let Some(format) = arguments.format {
        return Ok(format);
    }
    let extension = arguments.output().extension().and_then(|e| e.to_str());
    if extension.is_some_and(|e| e.eq_ignore_ascii_case("jsonl")) {
        return Ok(RunFormat::Jsonl);
    }
    Ok(match job::format(None, arguments.output(), ", .jsonl")? {
        Format::Json => RunFormat::Json,
        Format::Csv => RunFormat::Csv,
        Format::Npz => RunFormat::Npz,
        Format::Text => RunFormat::Text,
    })
}

fn scenario(arguments: &RunArguments, disturbance: &Disturbance) -> Result<Scenario, Failure> {
    let until = arguments.until.ok_or_else(|| {
        Failure::input("--until", "the end of the run is missing: give --until T")
    })?;
    Ok(Scenario {
        tolerance: arguments.tolerance,
        memory: arguments.memory.into(),
        ..disturbance.scenario(&arguments.start, wide_model(&arguments.model)?, until)?
    })
}

/// Names the option that an error of the library is about.
pub(crate) fn explain(
    error: &RunError,
    start: &StartArguments,
    disturbance: &DisturbanceArguments,
) -> Failure {
    let option = match error {
        RunError::TooFar { .. } if start.start_position.abs() > 1e3 => {
            format!("--start-position {}", start.start_position)
        }
        RunError::Profile(_) => {
            let path = disturbance.initial_surface.as_deref().unwrap_or(Path::new(""));
            format!("--initial-surface {}", path.display())
        }
        _ => match option_at_fault(error) {
            Some(option) => option,
            None => return Failure::Run(error.to_string()),
        },
    };
    Failure::input(option, error)
}

/// The option that an error is about, as far as the error itself tells; `None` for a failure at run time.
pub(crate) fn option_at_fault(error: &RunError) -> Option<String> {
    Some(match error {
        RunError::StartPosition(x) => format!("--start-position {}", Typed(*x)),
        RunError::Kick(kick) => format!("--kick {}", Typed(*kick)),
        RunError::Until { until, .. } => format!("--until {}", Typed(*until)),
        RunError::Tolerance(tolerance) | RunError::TooFar { tolerance, .. } => {
            format!("--tolerance {}", Typed(*tolerance))
        }
        RunError::Noise { noise, .. } => {
            format!("--noise {} --noise-spacing {}", Typed(noise.amplitude), Typed(noise.spacing))
        }
        RunError::Modes(_) => "--memory modes".into(),
        RunError::Profile(_) => "--initial-surface".into(),
        RunError::StartVelocity(v) => format!("--start-velocity {}", Typed(*v)),
        RunError::Path(_) | RunError::PathWithoutSpring | RunError::PathEnds { .. } => {
            "--support-path".into()
        }
        RunError::NoSteadyStart(_) => "--start steady".into(),
        RunError::Integration(_) | RunError::HistoryTooLong { .. } | RunError::State(_) => {
            return None;
        }
    })
}
