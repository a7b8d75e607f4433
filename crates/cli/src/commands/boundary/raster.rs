//! `stickslip boundary --pitch-range`.

use super::{range, spacing};
use crate::arguments::{BoundaryArguments, Interval};
use crate::commands::asking::context;
use crate::commands::in_units::scales;
use crate::commands::job::Job;
use crate::commands::model::law;
use crate::failure::Failure;
use stickslip::{Ask, Physical, RasterBoundary, RasterBoundaryDocument, Tip};
use stickslip_tip::TipFunction;

pub(super) fn boundary(
    arguments: &BoundaryArguments,
    typed: &Interval,
    tip: TipFunction,
) -> Result<(), Failure> {
    let r = arguments.r.ok_or_else(|| Failure::input("--r", "give the support velocity, --r R"))?;
    let (pitch_range, points) = range("--pitch-range", typed, arguments.points)?;
    let context = context();
    let question = RasterBoundary {
        tip: Tip(tip),
        r,
        width_y: arguments.width_y,
        pitch_range,
        points,
        spacing: spacing(arguments),
        law: law(&arguments.wider),
        length: arguments.length,
    };
    let question = question.resolved(&context)?;
    let scales = scales(&arguments.in_units, arguments.tip.tip_file.as_deref(), Some(r))?;
    let job = Job::open::<RasterBoundaryDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    job.finish(question.answered(&context)?.in_units(scales.as_ref()))
}
