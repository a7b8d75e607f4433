//! `stickslip units`.

use super::ask::option;
use super::job::{Job, format, judge_places};
use crate::arguments::{Format, UnitsArguments};
use crate::failure::Failure;
use crate::files::input::{TipFile, read_tip};
use crate::session::Session;
use serde_json::json;
use stickslip::{Units, UnitsDocument, parameter};
use stickslip_units::Unit;

pub(crate) fn units(session: &Session, arguments: &UnitsArguments) -> Result<(), Failure> {
    let UnitsArguments { options, outlet, .. } = arguments;
    judge_places(outlet, None, &options.files())?;
    if format(session, outlet.format, &outlet.output, "")? == Format::Npz {
        let message = "there are no arrays to write: take .json or .csv";
        return Err(Failure::file("--output", &outlet.output, message));
    }
    let question = question(session, arguments)?;
    let job = Job::open(session, UnitsDocument::FORMAT, outlet, None)?;
    job.finish(question.answered().map_err(|failure| as_typed(failure, arguments))?)
}

/// The rejection of a quantity with its value as typed.
fn as_typed(failure: stickslip::Failure, arguments: &UnitsArguments) -> Failure {
    let stickslip::Failure::Refused(refused) = failure else { return failure.into() };
    let mut typed = quantities(arguments).into_iter();
    match typed.find_map(|(name, text, _)| text.filter(|_| refused.parameter == name)) {
        Some(text) => Failure::input(format!("{} {text}", option(&refused.parameter)), refused.why),
        None => refused.into(),
    }
}

/// Name, text if given, and unit of each quantity.
fn quantities(given: &UnitsArguments) -> [(&'static str, Option<&str>, Unit); 6] {
    [
        ("damping", given.damping.as_deref(), Unit::Damping),
        ("stiffness", given.stiffness.as_deref(), Unit::Stiffness),
        ("tip_width", given.tip_width.as_deref(), Unit::Length),
        ("indentation_rate", given.indentation_rate.as_deref(), Unit::Velocity),
        ("slope_force", given.slope_force.as_deref(), Unit::Force),
        ("velocity", given.velocity.as_deref(), Unit::Velocity),
    ]
}

/// The question of the options, with quantities in SI units.
fn question(session: &Session, arguments: &UnitsArguments) -> Result<Units, Failure> {
    let mut values = arguments.options.values(session)?;
    for (name, text, unit) in quantities(arguments) {
        let Some(text) = text else { continue };
        let named = || format!("{} {text}", option(name));
        let value = unit.parse(text).map_err(|error| Failure::input(named(), error))?;
        values.insert(name.into(), json!(value));
    }
    let question: Units = parameter::question(values)?;
    // A measured tip brings its σ along, unless α and r are to tell another.
    let numbers = usize::from(question.r.is_some())
        + usize::from(question.alpha.or(question.alpha_above).is_some());
    if question.tip_width.is_some() || question.left_out() <= numbers {
        return Ok(question);
    }
    Ok(Units { tip_width: sigma_of(session, arguments)?, ..question })
}

/// σ in m from a tip file that `stickslip tip` wrote for a profile with a unit.
fn sigma_of(session: &Session, arguments: &UnitsArguments) -> Result<Option<f64>, Failure> {
    let Some(path) = &arguments.options.tip.tip_file else { return Ok(None) };
    match read_tip(session, path)? {
        TipFile::Measured(measured) => Ok(measured.sigma_metres),
        _ => Ok(None),
    }
}
