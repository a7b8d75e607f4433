//! `stickslip run --stiffness-across`.

use super::integration::Integrated;
use super::write::{Target, Written, finish_lines, print_remarks};
use crate::arguments::RunArguments;
use crate::commands::ask::refusal;
use crate::commands::{summary, verify};
use crate::failure::Failure;
use crate::made::pictured;
use crate::session::Session;
use stickslip::{Order, Physical, RunEnd, became_across, history_across};
use stickslip_outcome::WatchedAcross;
use stickslip_tip::planar::{PlanarScenario, Trajectory};
use stickslip_tip::stop;

/// The run from its start.
pub(super) fn start(
    session: &Session,
    arguments: &RunArguments,
    order: &Order,
    scenario: &PlanarScenario,
) -> Result<(), Failure> {
    let running = WatchedAcross::new(scenario).map_err(|error| {
        let failure = order.parameters.refused_across(error);
        refusal(failure, &arguments.options.tip, &super::order::files(arguments))
    })?;
    let (integrated, target) =
        super::integrated(session, arguments, order, &scenario.along, running)?;
    write(session, order, scenario, integrated, target)
}

/// Writes the whole document, or the last line; and the figure.
pub(super) fn write(
    session: &Session,
    order: &Order,
    scenario: &PlanarScenario,
    mut integrated: Integrated<WatchedAcross>,
    target: Target,
) -> Result<(), Failure> {
    let end = end(scenario, &integrated)?;
    let signal = integrated.interrupt.signal().filter(|_| end.interrupted);
    print_remarks(session, order, &end);
    let mut failure = None;
    match target {
        Target::Lines(fields) => {
            finish_lines(session, order, integrated.record.sink, &fields, &end)?;
        }
        Target::Document(job) => {
            let (wider, support) = (*scenario.along.model.wider(), scenario.along.support());
            let steps = integrated.record.steps.take();
            let trajectory = steps.map(|steps| Trajectory::under(wider, support, steps));
            let history = trajectory.as_ref().map(|trajectory| history_across(trajectory, &wider));
            let reached = signal.map(|_| end.end);
            let samples = std::mem::take(&mut integrated.record.samples);
            let kept = history.clone().filter(|_| order.history);
            let mut document = order.parameters.clone().document(samples, kept, end);
            let asked = trajectory.as_ref().filter(|_| order.verify && signal.is_none());
            // What was computed is written even if a signal ends its verification.
            let found = asked.map(|t| verify::across::of_history(session, scenario, t)).transpose();
            document.verification = found.as_ref().ok().cloned().flatten();
            // From here on nothing is computed that would be lost: a signal ends the program.
            let interrupt = integrated.interrupt;
            let _keeps = interrupt.signal().is_some().then_some(interrupt);
            let mut document = document.in_units(order.scales.as_ref());
            let summary = summary::of_across(&document).in_units(document.physical.as_ref());
            let figure = job.write_with(&Written { document: &document, reached }, &summary)?;
            if let Some(figure) = figure {
                // Drawn from the history, whether or not it is written.
                document.history = history;
                figure.draw(&document)?;
                document.history.take_if(|_| !order.history);
            }
            session.give(|| summary.of(pictured(document)));
            failure = match found {
                Err(failure) => Some(failure),
                Ok(found) => {
                    found.and_then(|found| verify::broken(&found, scenario.along.tolerance))
                }
            };
        }
    }
    signal.map(Failure::Interrupted).or(failure).map_or(Ok(()), Err)
}

/// The result of the run.
fn end(
    scenario: &PlanarScenario,
    integrated: &Integrated<WatchedAcross>,
) -> Result<RunEnd, Failure> {
    let Integrated { running, seconds, interrupt, .. } = integrated;
    if running.last().is_none() {
        return Err(Failure::Run("the run has no steps".into()));
    }
    let became = || became_across(scenario, running, *seconds);
    let found = stop::where_asked_by(interrupt.flag(), became);
    let found = found.map_err(|error| Failure::Run(error.to_string()))?;
    Ok(RunEnd { interrupted: interrupt.signal().is_some(), ..found })
}
