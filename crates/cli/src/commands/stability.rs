//! `stickslip stability`.

mod raster;
mod walking;

use super::asking::context;
use super::job::{Job, judge_places};
use super::model::{indentation, law, tip};
use crate::arguments::StabilityArguments;
use crate::commands::in_units::scales;
use crate::failure::{Failure, Typed};
use stickslip::{Ask, Physical, Stability, StabilityDocument, Tip};

pub(crate) fn stability(arguments: &StabilityArguments) -> Result<(), Failure> {
    let read = [("--tip-file", arguments.model.tip.tip_file.as_deref())];
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    if arguments.model.wider.no_spring {
        return walking::stability(arguments);
    }
    if arguments.pitch.is_some() || arguments.path.is_some() {
        return raster::stability(arguments);
    }
    if let Some(width) = arguments.width_y {
        let message = "is of a raster: give --pitch D too, or leave the option out";
        return Err(Failure::input(format!("--width-y {}", Typed(width)), message));
    }
    let context = context();
    let question = question(arguments)?.resolved(&context)?;
    let tip_file = arguments.model.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, question.r)?;
    let job = Job::open::<StabilityDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    job.finish(question.answered(&context)?.in_units(scales.as_ref()))
}

fn question(arguments: &StabilityArguments) -> Result<Stability, Failure> {
    let model = &arguments.model;
    Ok(Stability {
        tip: Tip(tip(&model.tip)?),
        indentation: indentation(model)?,
        r: model.r,
        law: law(&model.wider),
        solve_for: arguments.solve_for,
        at_critical_point: false,
        roots: arguments.roots,
        re_above: arguments.re_above,
    })
}
