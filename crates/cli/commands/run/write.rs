//! A run on its way out.

use super::document;
use super::journey::Travelled;
use super::record::{Record, Sink};
use crate::commands::fields::Fields;
use crate::commands::job::{self, Job};
use crate::commands::{told, verify};
use crate::failure::Failure;
use std::path::Path;
use stickslip_documents::{Order, RunDocument, RunHead};
use stickslip_tip::{InitialSurface, Scenario, Trajectory};

/// What the run is written to.
pub(super) enum Target {
    /// A document at the end.
    Document(Job),
    /// Lines, which the record has; and the fields to print of the last.
    Lines(Fields),
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
) -> Result<(), Failure> {
    let end = document::end(scenario, initial, &travelled)?;
    let steps = travelled.record.steps.take();
    let trajectory = steps.map(|steps| Trajectory::new(scenario.model.r(), steps));
    let mut failure = None;
    match target {
        Target::Lines(fields) => {
            let Sink::Lines(mut stream) = travelled.record.sink else {
                unreachable!("lines are written to a stream")
            };
            stream.line(&end)?;
            stream.finish()?;
            let told = told::of_lines(&end, &order.parameters.model);
            job::after(&end, &told, &fields, order.output != Path::new("-"))?;
        }
        Target::Document(job) => {
            let samples = &travelled.record.samples;
            let mut document = RunDocument::new(
                order.parameters.clone(),
                (&scenario.model).into(),
                samples,
                trajectory.as_ref().filter(|_| order.history).map(Into::into),
                end.clone(),
            );
            let asked = trajectory.as_ref().filter(|_| order.verify && travelled.signal.is_none());
            // What was computed is written even if a signal ends its verification.
            let found =
                asked.map(|t| verify::of_history(scenario, &end.work.memory, t)).transpose();
            document.verification = found.as_ref().ok().cloned().flatten();
            let told = told::of_run(&document, &end);
            let figure = job.write_told(&document, &told)?;
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
    let interrupted = travelled.signal.map(Failure::Interrupted);
    interrupted.or(failure).map_or(Ok(()), Err)
}
