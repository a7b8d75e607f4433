//! `stickslip units`.

mod solve;

use super::model::tip;
use super::roots::failed;
use crate::arguments::UnitsArguments;
use crate::failure::Failure;
use crate::files::apart::apart;
use crate::files::output::{Output, OutputFormat};
use solve::Given;
use stickslip_documents::{CriticalUnits, FORMAT_VERSION, LagDocument, Software, UnitsDocument};
use stickslip_stability::{StabilityError, critical, critical_r, unstable_count};
use stickslip_tip::TipFunction;
use stickslip_units::Physical;

pub(crate) fn units(arguments: &UnitsArguments) -> Result<(), Failure> {
    let format = OutputFormat::of(&arguments.output)?;
    apart(
        &[("--output", Some(&*arguments.output))],
        &[("--tip-file", arguments.model.tip.tip_file.as_deref())],
    )?;
    if format == OutputFormat::Npz {
        let message = "there are no arrays to write: .json or .csv will do";
        return Err(Failure::input(format!("--output {}", arguments.output.display()), message));
    }
    let tip = tip(&arguments.model.tip)?;
    let given = Given::read(arguments, &tip)?;
    let physical = given.solved()?;
    let output = Output::open("--output", &arguments.output)?;

    let document = document(arguments, &tip, &given, &physical)?;
    match format {
        OutputFormat::Csv => output.write_bytes(csv(&document).as_bytes()),
        _ => output.write_json(&document),
    }
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
    let (at_r, at_alpha) = (critical(tip, model.r()), critical_r(tip, model.alpha()));
    let check = "check the units and prefixes of the quantities";
    let stable = unstable_count(&model).map_err(|error| match error {
        StabilityError::TooFarApart { .. } => {
            Failure::input("the quantities", format!("{error}; {check}"))
        }
        error => failed(&error, check),
    })? == 0;
    let scales = physical.scales();
    let (indentation, velocity) = (at_r.ok(), at_alpha.ok());
    let with = |alpha: f64, r: f64| physical.with_alpha_r(alpha, r);
    let why = |name: &str, error: Option<StabilityError>| error.map(|e| format!("{name}: {e}"));
    let remarks = why("critical indentation rate", at_r.err())
        .into_iter()
        .chain(why("critical velocity", at_alpha.err()));
    Ok(UnitsDocument {
        format: UnitsDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters: given.parameters(tip, arguments.model.alpha_above),
        alpha: model.alpha(),
        r: model.r(),
        physical: physical.into(),
        lag: LagDocument { metres: physical.lag(tip), dimensionless: model.steady_lag() },
        scales: scales.into(),
        critical: CriticalUnits {
            alpha: indentation.map(|at| at.alpha),
            indentation_rate: indentation.map(|at| with(at.alpha, at.r).indentation_rate),
            period: indentation.map(|at| at.period * scales.time),
            wavelength: indentation.map(|at| at.wavelength * scales.length),
            r: velocity.map(|at| at.r),
            velocity: velocity.map(|at| with(at.alpha, at.r).velocity),
        },
        stable,
        remarks: remarks.collect(),
    })
}

/// `quantity,value,unit`, an empty value where there is none.
fn csv(document: &UnitsDocument) -> String {
    let UnitsDocument { physical, lag, scales, critical, .. } = document;
    let rows = [
        ("damping", Some(physical.damping), "kg/s"),
        ("stiffness", Some(physical.stiffness), "N/m"),
        ("tip_width", Some(physical.tip_width), "m"),
        ("indentation_rate", Some(physical.indentation_rate), "m/s"),
        ("slope_force", Some(physical.slope_force), "N"),
        ("velocity", Some(physical.velocity), "m/s"),
        ("alpha", Some(document.alpha), "1"),
        ("r", Some(document.r), "1"),
        ("lag", Some(lag.metres), "m"),
        ("lag_dimensionless", Some(lag.dimensionless), "1"),
        ("length_scale", Some(scales.length), "m"),
        ("time_scale", Some(scales.time), "s"),
        ("height_scale", Some(scales.height), "m"),
        ("force_scale", Some(scales.force), "N"),
        ("critical_alpha", critical.alpha, "1"),
        ("critical_indentation_rate", critical.indentation_rate, "m/s"),
        ("critical_period", critical.period, "s"),
        ("critical_wavelength", critical.wavelength, "m"),
        ("critical_r", critical.r, "1"),
        ("critical_velocity", critical.velocity, "m/s"),
    ];
    let row = |(name, value, unit): (&str, Option<f64>, &str)| {
        let value = value.map(|v| format!("{v:e}")).unwrap_or_default();
        format!("{name},{value},{unit}\n")
    };
    std::iter::once("quantity,value,unit\n".to_owned()).chain(rows.map(row)).collect()
}
