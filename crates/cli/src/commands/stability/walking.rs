//! `stickslip stability --no-spring`.

use super::DEFAULT_ROOTS;
use crate::arguments::StabilityArguments;
use crate::commands::in_units::scales;
use crate::commands::job::Job;
use crate::commands::model::{refuse_endless_past, wide_model};
use crate::commands::roots::{failed, judge_count, remarks};
use crate::failure::{Failure, Typed};
use stickslip::{
    Document, ModelParameters, Physical, SolveFor, WalkDocument, WalkingDocument, WalkingFound,
    WalkingParameters,
};
use stickslip_stability::{StabilityError, Walk, walk, walking_alpha, walking_speeds};
use stickslip_tip::Model;

pub(super) fn stability(arguments: &StabilityArguments) -> Result<(), Failure> {
    refuse_what_is_dragged(arguments)?;
    refuse_endless_past(&arguments.model.tip, &arguments.model.wider)?;
    let model = wide_model(&arguments.model)?;
    let count = arguments.roots.unwrap_or(DEFAULT_ROOTS);
    judge_count("--roots", count)?;
    let tip_file = arguments.model.tip.tip_file.as_deref();
    let scales = scales(&arguments.in_units, tip_file, None)?;
    let job = Job::open::<WalkingDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    job.finish(document(&model, count)?.in_units(scales.as_ref()))
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

fn document(model: &Model, count: usize) -> Result<WalkingDocument, Failure> {
    let advice = "move --alpha a little";
    let speeds = walking_speeds(model).map_err(|error| failed(&error, advice))?;
    let found: Vec<Result<Walk, StabilityError>> =
        speeds.iter().map(|speed| walk(model, *speed, count)).collect();
    let mut said = vec![];
    for (speed, walk) in speeds.iter().zip(&found) {
        let name = format!("walk of speed {speed:.7}");
        match walk {
            Ok(walk) => said.extend(remarks(&walk.spectrum, Some(count), &name)),
            Err(error) => said.push(format!("{name}: {error}")),
        }
    }
    let walks = found.iter().flatten().map(WalkDocument::from).collect();
    let healing_time = model.wider().healing_time;
    let parameters = WalkingParameters { model: ModelParameters::of(model, None), roots: count };
    let walking_alpha = healing_time.map(|time| walking_alpha(model.tip(), time));
    Ok(Document::new(parameters, WalkingFound { walking_alpha, walks }, said))
}
