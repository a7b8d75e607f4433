//! `stickslip units`.

mod solve;

use super::job::{Job, format, judge_places};
use super::model::tip;
use crate::arguments::{Format, UnitsArguments};
use crate::failure::Failure;
use solve::Given;
use stickslip::exponents::failed;
use stickslip::{CriticalUnits, UnitsDocument};
use stickslip_stability::{StabilityError, critical, critical_r, unstable_count};
use stickslip_tip::{TipFunction, Wider};
use stickslip_units::Physical;

pub(crate) fn units(arguments: &UnitsArguments) -> Result<(), Failure> {
    let read = [("--tip-file", arguments.model.tip.tip_file.as_deref())];
    judge_places(&arguments.outlet, None, &read)?;
    if format(arguments.outlet.format, &arguments.outlet.output, "")? == Format::Npz {
        let message = "there are no arrays to write: take .json or .csv";
        let named = format!("--output {}", arguments.outlet.output.display());
        return Err(Failure::input(named, message));
    }
    let tip = tip(&arguments.model.tip)?;
    let given = Given::read(arguments, &tip)?;
    let physical = given.solved()?;
    let job = Job::open::<UnitsDocument>(&arguments.outlet, None)?;
    job.write(document(arguments, &tip, &given, &physical)?)
}

fn document(
    arguments: &UnitsArguments,
    tip: &TipFunction,
    given: &Given,
    physical: &Physical,
) -> Result<UnitsDocument, Failure> {
    let model = physical.model(tip.clone()).map_err(|error| {
        Failure::input("the quantities", format!("{error}; check their units and prefixes"))
    })?;
    let (at_r, at_alpha) = (
        critical(&Wider::default(), tip, model.r()),
        critical_r(&Wider::default(), tip, model.alpha()),
    );
    let check = "check the units and prefixes of the quantities";
    let stable = unstable_count(&model).map_err(|error| match error {
        StabilityError::TooFarApart { .. } => {
            Failure::input("the quantities", format!("{error}; {check}"))
        }
        error => failed(&error, check).into(),
    })? == 0;
    let scales = physical.scales();
    let (indentation, velocity) = (at_r.ok(), at_alpha.ok());
    let with = |alpha: f64, r: f64| physical.with_alpha_r(alpha, r);
    let why = |name: &str, error: Option<StabilityError>| error.map(|e| format!("{name}: {e}"));
    let remarks = why("critical indentation rate", at_r.err())
        .into_iter()
        .chain(why("critical velocity", at_alpha.err()));
    let critical = CriticalUnits {
        alpha: indentation.map(|at| at.alpha),
        indentation_rate: indentation.map(|at| with(at.alpha, at.r).indentation_rate),
        period: indentation.map(|at| at.period * scales.time),
        wavelength: indentation.map(|at| at.wavelength * scales.length),
        r: velocity.map(|at| at.r),
        velocity: velocity.map(|at| with(at.alpha, at.r).velocity),
    };
    let parameters = given.parameters(tip, arguments.model.alpha_above);
    Ok(UnitsDocument::new(parameters, physical, &model, critical, stable, remarks.collect()))
}
