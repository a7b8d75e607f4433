//! `stickslip cycle`.

pub(super) mod start;

use super::asking::context;
use super::in_units::scales;
use super::job::{Job, judge_places};
use crate::arguments::CycleArguments;
use crate::failure::Failure;
use stickslip::{Ask, Cycle, CycleDocument, Physical};

pub(crate) fn cycle(arguments: &CycleArguments) -> Result<(), Failure> {
    let model = &arguments.start.model;
    // Another cycle may take the place of the one that it came from; the same one again would be for nothing.
    let is_another = model.r.or(model.alpha).or(model.alpha_above).is_some();
    let from = arguments.start.from.as_deref().filter(|_| !is_another);
    let tip_file = model.tip.tip_file.as_deref();
    judge_places(
        &arguments.outlet,
        arguments.plot.as_deref(),
        &[("--tip-file", tip_file), ("--from", from)],
    )?;
    let context = context();
    let question = Cycle { points: arguments.points, ..start::question(&arguments.start)? };
    let question = question.resolved(&context)?;
    let scales = scales(&arguments.in_units, tip_file, Some(question.r))?;
    let job = Job::open::<CycleDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    job.finish(question.answered(&context)?.in_units(scales.as_ref()))
}
