//! A run on its way out.

use super::document;
use super::journey::Travelled;
use super::record::{Record, Sink};
use crate::commands::figure::Figure;
use crate::commands::verify;
use crate::failure::Failure;
use crate::files::npz::Npz;
use crate::files::output::Output;
use crate::message::say;
use std::path::Path;
use stickslip_documents::{Order, RunDocument, RunEnd, RunFormat, RunHead, to_its_digits};
use stickslip_tip::{InitialSurface, Scenario, Trajectory};

/// What the run is written to.
pub(super) enum Target {
    /// A document at the end.
    Document(Output),
    /// Lines, which the record has.
    Lines,
}

/// The first line, where lines are written.
pub(super) fn head(record: &mut Record, order: &Order, scenario: &Scenario) -> Result<(), Failure> {
    match &mut record.sink {
        Sink::Lines(stream) => {
            stream.line(&RunHead::new(order.parameters.clone(), (&scenario.model).into()))
        }
        Sink::Memory | Sink::Journal(..) => Ok(()),
    }
}

/// The whole document, or the last line; and the figure.
pub(super) fn all(
    order: &Order,
    scenario: &Scenario,
    initial: &InitialSurface,
    mut travelled: Travelled,
    target: Target,
    figure: Option<Figure>,
) -> Result<(), Failure> {
    let end = document::end(scenario, initial, &travelled)?;
    // Nobody reads it beside a document on standard output.
    let said = (order.output != Path::new("-")).then(|| summary(&end));
    end.remarks.iter().for_each(|remark| say(format_args!("remark: {remark}")));
    let reached = end.end;
    let steps = travelled.record.steps.take();
    let trajectory = steps.map(|steps| Trajectory::new(scenario.model.r(), steps));
    let (mut failure, mut verified) = (None, String::new());
    match target {
        Target::Lines => {
            let Sink::Lines(mut stream) = travelled.record.sink else {
                unreachable!("lines are written to a stream")
            };
            stream.line(&end)?;
            stream.finish()?;
        }
        Target::Document(output) => {
            let samples = &travelled.record.samples;
            let memory = end.work.memory.clone();
            let mut document = RunDocument::new(
                order.parameters.clone(),
                (&scenario.model).into(),
                samples,
                trajectory.as_ref().filter(|_| order.history).map(Into::into),
                end,
            );
            let asked = trajectory.as_ref().filter(|_| order.verify && travelled.signal.is_none());
            // What was computed is written even if a signal ends its verification.
            let found = asked.map(|t| verify::of_history(scenario, &memory, t)).transpose();
            document.verification = found.as_ref().ok().cloned().flatten();
            verified = document.verification.as_ref().map_or(String::new(), verify::kept);
            write(&document, order.format, output, travelled.signal.map(|_| reached))?;
            if let (Some(figure), Some(trajectory)) = (figure, &trajectory) {
                // Drawn from the history, whether or not it is written.
                document.history = Some(trajectory.into());
                figure.draw(&document)?;
            }
            failure = match found {
                Err(failure) => Some(failure),
                Ok(found) => found.and_then(|found| verify::broken(&found, scenario.tolerance)),
            };
        }
    }
    if let Some(said) = said {
        say(format_args!("{said}{verified}"));
    }
    let interrupted = travelled.signal.map(Failure::Interrupted);
    interrupted.or(failure).map_or(Ok(()), Err)
}

/// What holds less than was asked for says so, in every format: JSON by its `interrupted`.
fn write(
    document: &RunDocument,
    format: RunFormat,
    output: Output,
    interrupted: Option<f64>,
) -> Result<(), Failure> {
    let samples = &document.samples;
    let until = document.parameters.until;
    let remark = interrupted.map(|t| format!("interrupted at t = {t} of {until}"));
    match format {
        RunFormat::Json | RunFormat::Jsonl => output.write_json(document),
        RunFormat::Csv => output.with_remark(remark).write_csv(
            "t,l,x0,velocity",
            &[&samples.t, &samples.l, &samples.x0, &samples.velocity],
        ),
        RunFormat::Npz => {
            let mut npz = Npz::new();
            npz.vector("t", &samples.t)?;
            npz.vector("l", &samples.l)?;
            npz.vector("x0", &samples.x0)?;
            npz.vector("velocity", &samples.velocity)?;
            if let Some(t) = interrupted {
                npz.vector("interrupted", &[t])?;
            }
            if let Some(history) = &document.history {
                npz.vector("history_nodes", &history.nodes)?;
                npz.vector("history_weights", &history.weights)?;
                npz.vector("history_t", &history.t)?;
                npz.vector("history_extension", &history.extension)?;
                npz.matrix("history_displacement", &history.displacement)?;
            }
            output.write_bytes(&npz.bytes()?)
        }
    }
}

/// One line for a person who sent the run to a file.
fn summary(end: &RunEnd) -> String {
    let work = &end.work;
    let digits = |value: f64, error: Option<f64>| to_its_digits(value, error.unwrap_or(0.0));
    let motion = end.oscillation.as_ref().map(|o| {
        let period = digits(o.period, o.period_error);
        let amplitude = digits(o.amplitude_x0, o.amplitude_x0_error);
        format!(", period {period}, amplitude of x0 {amplitude}")
    });
    let prospect = end.transient.as_ref().and_then(|transient| {
        let time = transient.time.map_or(String::new(), |time| format!(" in about {time:.1e}"));
        transient.towards.map(|towards| format!(", towards {towards}{time}"))
    });
    format!(
        "{}{}: t = {} reached in {} steps with {}, {:.1} ms",
        end.regime,
        motion.or(prospect).unwrap_or_default(),
        end.end,
        work.steps,
        work.memory,
        1e3 * work.seconds
    )
}
