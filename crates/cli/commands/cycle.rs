//! `stickslip cycle`.

pub(super) mod start;

use super::figure::Figure;
use crate::arguments::CycleArguments;
use crate::failure::Failure;
use crate::files::apart::apart;
use crate::files::npz::Npz;
use crate::files::output::{Output, OutputFormat};
use crate::message::say;
use start::Start;
use std::path::Path;
use std::time::Instant;
use stickslip_documents::{
    CycleDocument, CycleParameters, CycleProfile, ModelParameters, to_its_digits,
};

/// More do not fit in a picture, nor are they needed in a table.
const MOST_POINTS: usize = 1_000_000;

pub(crate) fn cycle(arguments: &CycleArguments) -> Result<(), Failure> {
    let format = OutputFormat::of(&arguments.output)?;
    let model = &arguments.start.model;
    // Another cycle may take the place of the one that it came from; the same one again would be for nothing.
    let is_another = model.r.or(model.alpha).or(model.alpha_above).is_some();
    let from = arguments.start.from.as_deref().filter(|_| !is_another);
    apart(
        &[("--output", Some(&*arguments.output)), ("--plot", arguments.plot.as_deref())],
        &[("--tip-file", model.tip.tip_file.as_deref()), ("--from", from)],
    )?;
    let start = Start::asked(&arguments.start)?;
    if !(1..=MOST_POINTS).contains(&arguments.points) {
        let option = format!("--points {}", arguments.points);
        return Err(Failure::input(option, format!("1 to {MOST_POINTS} will do")));
    }
    let output = Output::open("--output", &arguments.output)?;
    let figure = Figure::asked("--plot", arguments.plot.as_deref())?;

    let started = Instant::now();
    let cycle = start.solve()?;
    let parameters = CycleParameters {
        model: ModelParameters::of(cycle.model(), arguments.start.model.alpha_above),
        tolerance: arguments.start.tolerance,
    };
    let seconds = started.elapsed().as_secs_f64();
    let document = CycleDocument::of(&cycle, parameters, arguments.points, seconds);
    if let Some(figure) = figure {
        figure.draw(&document)?;
    }
    write(&document, format, output)?;
    if arguments.output != Path::new("-") {
        say(summary(&document));
    }
    Ok(())
}

/// One line for a person who sent the cycle to a file.
fn summary(document: &CycleDocument) -> String {
    let stable = if document.stable { "stable" } else { "unstable" };
    let slips = match document.slips {
        1 => "one slip".into(),
        n => format!("{n} slips"),
    };
    let digits = |value: f64, error: Option<f64>| to_its_digits(value, error.unwrap_or(0.0));
    let period = digits(document.period, document.period_error);
    let amplitude = digits(document.amplitude_x0, document.amplitude_x0_error);
    format!("{stable} cycle of {slips}, period {period}, amplitude of x0 {amplitude}")
}

fn write(document: &CycleDocument, format: OutputFormat, output: Output) -> Result<(), Failure> {
    let CycleProfile { t, l, velocity } = &document.profile;
    match format {
        OutputFormat::Json => output.write_json(document),
        OutputFormat::Csv => output.write_csv("t,l,velocity", &[t, l, velocity]),
        OutputFormat::Npz => {
            let mut npz = Npz::new();
            npz.vector("t", t)?;
            npz.vector("l", l)?;
            npz.vector("velocity", velocity)?;
            output.write_bytes(&npz.bytes()?)
        }
    }
}
