//! `stickslip stability --no-spring`.

use crate::arguments::StabilityArguments;
use crate::commands::asking::context;
use crate::commands::in_units::scales;
use crate::commands::job::Job;
use crate::commands::model::{refuse_endless_past, wide_model};
use crate::failure::{Failure, Typed};
use stickslip::{Ask, ModelParameters, Physical, SolveFor, Stability, Walking, WalkingDocument};

pub(super) fn stability(arguments: &StabilityArguments) -> Result<(), Failure> {
    refuse_what_is_dragged(arguments)?;
    refuse_endless_past(&arguments.model.tip, &arguments.model.wider)?;
    let model = ModelParameters::of(&wide_model(&arguments.model)?, None);
    let roots = arguments.roots.unwrap_or(Stability::DEFAULT_ROOTS);
    let context = context();
    let question = Walking { model, roots }.resolved(&context)?;
    let tip_file = arguments.model.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, None)?;
    let job = Job::open::<WalkingDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    job.finish(question.answered(&context)?.in_units(scales.as_ref()))
}

/// Options that only make sense behind a support.
fn refuse_what_is_dragged(arguments: &StabilityArguments) -> Result<(), Failure> {
    let given = [
        ("--pitch", arguments.pitch.is_some()),
        ("--path", arguments.path.is_some()),
        ("--width-y", arguments.width_y.is_some()),
        ("--solve-for r", arguments.solve_for == SolveFor::R),
    ];
    if let Some((option, _)) = given.into_iter().find(|(_, given)| *given) {
        let message = "is of a tip behind a support, and --no-spring leaves it none: leave one of the two out";
        return Err(Failure::input(option, message));
    }
    match arguments.re_above {
        None => Ok(()),
        Some(bound) => {
            let message = "of a walk a number of exponents is listed: give --roots N";
            Err(Failure::input(format!("--re-above {}", Typed(bound)), message))
        }
    }
}
