//! Several runs at once, for a host.

use super::order;
use crate::arguments::RunArguments;
use crate::commands::ask::context;
use crate::commands::summary;
use crate::failure::Failure;
use crate::session::{Made, Session};
use std::path::Path;
use stickslip::{Order, Physical, RunDocument, RunEnd, ask_runs};

/// The order of one of several runs, which keeps nothing but its document.
pub(crate) fn order_of(session: &Session, arguments: &RunArguments) -> Result<Order, Failure> {
    let written = [
        ("--output", arguments.output() != Path::new("-")),
        ("--plot", arguments.plot.is_some()),
        ("--verify", arguments.verify),
        ("--checkpoint", arguments.checkpoint.is_some()),
        ("--resume", arguments.resume.is_some()),
    ];
    Failure::if_given(&written, "is not available for several runs at once")?;
    Ok(order::order(session, arguments, arguments.options.values(session)?)?.0)
}

/// Runs of all these orders, side by side where possible, in the same order.
pub(crate) fn runs(session: &Session, orders: Vec<Order>) -> Vec<Result<Made, Failure>> {
    let mut made: Vec<Option<Result<Made, Failure>>> = orders.iter().map(|_| None).collect();
    let questions = orders.iter().map(|order| order.parameters.clone()).collect();
    ask_runs(questions, &context(session), |number, answer| {
        made[number] = Some(answer.map(|run| summary(&orders[number], run)).map_err(Failure::from));
    });
    let missing = || Err(Failure::Run("the run was not made".into()));
    made.into_iter().map(|made| made.unwrap_or_else(missing)).collect()
}

fn summary(order: &Order, run: RunDocument) -> Made {
    let mut document = run.in_units(order.scales.as_ref());
    let summary = summary::of_run(&document, &RunEnd::from(&document));
    let summary = summary.in_units(document.physical.as_ref());
    document.history.take_if(|_| !order.history);
    summary.of(Box::new(document))
}
