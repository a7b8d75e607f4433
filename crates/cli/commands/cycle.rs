//! `stickslip cycle`.

pub(super) mod start;

use super::in_units::scales;
use super::job::{Job, judge_places};
use crate::arguments::CycleArguments;
use crate::failure::Failure;
use start::Start;
use std::time::Instant;
use stickslip_documents::{CycleDocument, CycleParameters, ModelParameters, Physical};

/// More do not fit in a picture, nor are they needed in a table.
const MOST_POINTS: usize = 1_000_000;

pub(crate) fn cycle(arguments: &CycleArguments) -> Result<(), Failure> {
    let model = &arguments.start.model;
    // Another cycle may take the place of the one that it came from; the same one again would be for nothing.
    let is_another = model.r.or(model.alpha).or(model.alpha_above).is_some();
    let from = arguments.start.from.as_deref().filter(|_| !is_another);
    let read = [("--tip-file", model.tip.tip_file.as_deref()), ("--from", from)];
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    let start = Start::asked(&arguments.start)?;
    let tip_file = model.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, Some(start.model().r()))?;
    if !(1..=MOST_POINTS).contains(&arguments.points) {
        let option = format!("--points {}", arguments.points);
        return Err(Failure::input(option, format!("1 to {MOST_POINTS} will do")));
    }
    let job = Job::open::<CycleDocument>(&arguments.outlet, arguments.plot.as_deref())?;

    let started = Instant::now();
    let cycle = start.solve()?;
    let parameters = CycleParameters {
        model: ModelParameters::of(cycle.model(), arguments.start.model.alpha_above),
        tolerance: arguments.start.tolerance,
    };
    let seconds = started.elapsed().as_secs_f64();
    let document = CycleDocument::of(&cycle, parameters, arguments.points, seconds);
    job.finish(document.in_units(scales.as_ref()))
}
