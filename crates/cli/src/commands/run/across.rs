//! `stickslip run --stiffness-across`.

use super::{job, order};
use crate::arguments::RunArguments;
use crate::commands::ask::{context_cancelled_by, refusal};
use crate::commands::told;
use crate::failure::Failure;
use crate::host;
use crate::interrupt::Interrupt;
use crate::made::pictured;
use std::sync::Arc;
use stickslip::{Ask, Order, Physical};

/// The run, up to its end or to a signal.
pub(super) fn run(order: &Order, arguments: &RunArguments) -> Result<(), Failure> {
    let fields = &arguments.fields;
    let job = job(order, arguments.output(), arguments.plot.as_deref(), fields)?;
    let interrupt = Interrupt::listen()?;
    let context = context_cancelled_by(Arc::clone(interrupt.flag()));
    let found = order.parameters.clone().answered(&context);
    let signal = interrupt.signal();
    let mut document = match (found, signal) {
        (Err(_), Some(signal)) => return Err(Failure::Stopped(signal)),
        (Err(failure), None) => {
            return Err(refusal(failure, &arguments.options.tip, &order::files(arguments)));
        }
        (Ok(document), _) => document.in_units(order.scales.as_ref()),
    };
    document.history.take_if(|_| !order.history);
    let told = told::of_across(&document).in_units(document.physical.as_ref());
    let figure = job.write_told(&document, &told)?;
    let drawn = figure.map_or(Ok(()), |figure| figure.draw(&document));
    host::give(|| told.of(pictured(document)));
    drawn?;
    signal.map_or(Ok(()), |signal| Err(Failure::Interrupted(signal)))
}
