//! `stickslip continue`.

use super::ask::{answer_until_signal, context_cancelled_by, refusal};
use super::cycle::{read_cycle, values};
use super::in_units::scales;
use super::job::{Job, judge_places};
use crate::arguments::ContinueArguments;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::session::Session;
use std::sync::Arc;
use stickslip::{Ask, Continue, ContinueDocument, Unusable, parameter};

pub(crate) fn follow(session: &Session, arguments: &ContinueArguments) -> Result<(), Failure> {
    let ContinueArguments { options, from, answer: place } = arguments;
    let [tip_file, parameters] = options.files();
    let read = [tip_file, parameters, ("--from", from.as_deref())];
    judge_places(&place.outlet, place.plot.as_deref(), &read)?;
    let start = from.as_deref().map(|path| read_cycle(session, path)).transpose()?;
    let mut question: Continue = parameter::question(values(session, options, start.as_ref())?)?;
    if let Some((path, document)) = &start {
        let unusable = |error: Unusable| Failure::file("--from", path, error);
        question = question.beginning_with(document).map_err(unusable)?;
    }
    let interrupt = Interrupt::listen(session)?;
    let context = context_cancelled_by(session, Arc::clone(interrupt.flag()));
    let refused = |failure| refusal(failure, &options.tip, &[]);
    let question = question.resolved(&context).map_err(refused)?;
    let scales = scales(session, &place.in_units, tip_file.1, question.support_velocity())?;
    let job = Job::open(session, ContinueDocument::FORMAT, &place.outlet, place.plot.as_deref())?;
    answer_until_signal(question, &context, interrupt, (job, scales.as_ref()), refused)
}
