//! Output of a run.

use super::integration::Integration;
use super::motion::Motion;
use super::record::{Record, Sink};
use crate::commands::fields::Fields;
use crate::commands::job::{self, Job};
use crate::commands::{summary, verify};
use crate::failure::Failure;
use crate::session::Session;
use std::path::Path;
use stickslip::{
    Array, InUnits, Moved, Named, Order, Physical, RunDocument, RunEnd, RunFormat, RunHead,
    RunLine, SteadyState, Tabular,
};
use stickslip_tip::{Scenario, stop};

/// The output of a run.
pub(super) enum Target {
    /// A document, written at the end.
    Document(Box<Job>),
    /// Lines, written by the record, and the fields of the last line to print.
    Lines(Fields),
}

/// Writes the first line, if the output is lines.
pub(super) fn head<S>(
    record: &mut Record<S>,
    order: &Order,
    scenario: &Scenario,
) -> Result<(), Failure> {
    match &mut record.sink {
        Sink::Lines(stream) => {
            let steady = SteadyState::of(&scenario.model);
            let head = RunHead::new(order.parameters.clone(), steady);
            stream.line(&RunLine::Head(Box::new(head)))
        }
        Sink::Memory | Sink::Journal(..) => Ok(()),
    }
}

/// Prints the remarks of a run whose document goes to standard output; beside a file they are printed with the result.
fn print_remarks(session: &Session, order: &Order, end: &RunEnd) {
    if order.output == Path::new("-") && order.format != RunFormat::Text && !session.has_host() {
        end.remarks.iter().for_each(|text| session.remark(format_args!("remark: {text}")));
    }
}

/// Writes the last line, and prints the summary and the requested fields.
fn finish_lines(
    session: &Session,
    order: &Order,
    sink: Sink,
    fields: &Fields,
    end: &RunEnd,
) -> Result<(), Failure> {
    let Sink::Lines(mut stream) = sink else { unreachable!("lines are written to a stream") };
    stream.line(&RunLine::End(Box::new(end.clone())))?;
    stream.finish()?;
    job::after(session, end, &summary::of_lines(end), fields, order.output != Path::new("-"))
}

/// Writes the document, or the last of the lines, and the figure.
pub(super) fn all<R: Motion>(
    session: &Session,
    order: &Order,
    integrated: Integration<R>,
    target: Target,
) -> Result<(), Failure> {
    let Integration { running, mut record, seconds, interrupt, .. } = integrated;
    let found = stop::with_flag(interrupt.flag(), || running.became(seconds));
    let end = RunEnd { interrupted: interrupt.signal().is_some(), ..found? };
    let signal = interrupt.signal().filter(|_| end.interrupted);
    print_remarks(session, order, &end);
    let interrupted = signal.map(Failure::Interrupted);
    let job = match target {
        Target::Document(job) => job,
        Target::Lines(fields) => {
            finish_lines(session, order, record.sink, &fields, &end)?;
            return interrupted.map_or(Ok(()), Err);
        }
    };
    let whole = record.whole();
    let samples = std::mem::take(&mut record.samples);
    let history = whole.as_ref().filter(|_| order.history).map(R::Step::history);
    let mut document = order.parameters.clone().document(samples, history, end.clone());
    if let Some(whole) = &whole {
        document.answer = R::Step::along_path(document.answer, whole);
    }
    let asked = whole.as_ref().filter(|_| order.verify && signal.is_none());
    // The result is written even if a signal ends its verification.
    let found = asked.map(|whole| running.verified(session, &end.work.memory, whole));
    let found = found.transpose();
    document.verification = found.as_ref().ok().cloned().flatten();
    // From here on nothing is computed that would be lost: a signal ends the program.
    let _keeps = interrupt.signal().is_some().then_some(interrupt);
    let mut document = document.in_units(order.scales.as_ref());
    let summary = summary::of_run(&document, &end).in_units(document.physical.as_ref());
    let reached = signal.map(|_| end.end);
    let figure = job.write_with(&document, &Written { document: &document, reached }, &summary)?;
    if let (Some(figure), Some(whole)) = (figure, &whole) {
        // Drawn from the history, whether or not it is written.
        document.history.get_or_insert_with(|| R::Step::history(whole));
        figure.draw(&document)?;
        document.history.take_if(|_| !order.history);
    }
    let tolerance = document.parameters.tolerance;
    session.give(|| summary.of(Box::new(document)));
    let failure = match found {
        Err(failure) => Some(failure),
        Ok(found) => found.and_then(|found| verify::broken(&found, tolerance)),
    };
    interrupted.or(failure).map_or(Ok(()), Err)
}

/// A run as a table. An incomplete one is marked as such, as a document is by `interrupted`.
struct Written<'a> {
    document: &'a RunDocument,
    /// Time at which a signal ended the run.
    reached: Option<f64>,
}

impl Tabular for Written<'_> {
    fn columns(&self) -> Vec<Named<'_>> {
        self.document.columns()
    }

    fn arrays(&self) -> Vec<(&'static str, Array<'_>)> {
        let mut arrays = self.document.arrays();
        let interrupted = self.reached.map(|t| ("interrupted", Array::vector(vec![t])));
        // Behind the samples.
        let place = self.columns().len();
        arrays.splice(place..place, interrupted);
        arrays
    }

    fn physical(&self) -> Option<&InUnits> {
        self.document.physical()
    }

    fn note(&self) -> Option<String> {
        let until = self.document.parameters.until;
        self.reached.map(|t| format!("interrupted at t = {t} of {until}"))
    }
}
