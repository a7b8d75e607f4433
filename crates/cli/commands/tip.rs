//! `stickslip tip`.

use super::job::{Job, judge_places};
use crate::arguments::MeasuredTipArguments;
use crate::failure::{Failure, Typed};
use crate::files::gsf::read_gsf;
use crate::files::measured::{Measured, read_measured, unit_of};
use stickslip_documents::{MeasuredTipDocument, MeasuredTipParameters};
use stickslip_measurement::{Image, Profile, Request, TipError, tip};
use stickslip_units::Unit;

const OPTION: &str = "MEASURED.csv";
/// More take minutes and tell no more.
const MOST_RESAMPLES: usize = 100_000;

pub(crate) fn measured_tip(arguments: &MeasuredTipArguments) -> Result<(), Failure> {
    let read = [(OPTION, Some(&*arguments.measured))];
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    let named = || format!("{OPTION} {}", arguments.measured.display());
    let Given { profile, image, unit } = given(arguments)?;
    let metres = unit.as_deref().map(metres).transpose()?;
    let half = arguments.half || !arguments.both && arguments.centre.is_none() && profile.is_half();
    let request = Request {
        centre: if half { Some(0.0) } else { judged("--centre", arguments.centre, f64::MIN)? },
        sigma: sigma(arguments, metres)?,
        terms: arguments.terms,
        r: judged("--r", Some(arguments.r), 0.0)?.unwrap_or(1.0),
        resamples: arguments.resamples,
        seed: arguments.seed,
    };
    judge_counts(&request)?;
    let job = Job::open::<MeasuredTipDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let found = tip(&profile, &request).map_err(|error| match error {
        TipError::Stopped => Failure::Run(error.to_string()),
        TipError::NoOnset { r } => Failure::input(format!("--r {}", Typed(r)), error),
        error => Failure::input(named(), error),
    })?;
    let parameters = MeasuredTipParameters {
        source: arguments.measured.display().to_string(),
        unit,
        half,
        centre: arguments.centre,
        sigma: request.sigma,
        terms: request.terms,
        r: request.r,
        resamples: request.resamples,
        seed: request.seed,
    };
    let document = MeasuredTipDocument::of(&found, parameters, metres);
    let across = image.map(|image| image.across(&found)).transpose();
    let across = across.map_err(|error| Failure::input(named(), error))?;
    job.finish(match across {
        Some(across) => document.with_image(&across),
        None => document,
    })
}

/// What was measured.
struct Given {
    profile: Profile,
    /// Which the profile goes through the middle of.
    image: Option<Image>,
    /// Of the positions.
    unit: Option<String>,
}

fn given(arguments: &MeasuredTipArguments) -> Result<Given, Failure> {
    let path = &arguments.measured;
    let named = || format!("{OPTION} {}", path.display());
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gsf")) {
        let read = read_gsf(OPTION, path)?;
        let image = Image::new(read.x, read.y, read.rows);
        let image = image.map_err(|error| Failure::input(named(), error))?;
        let profile = image.profile().map_err(|error| Failure::input(named(), error))?;
        let unit = unit(arguments, read.in_nanometres.then_some("x_nm"))?;
        return Ok(Given { profile, image: Some(image), unit });
    }
    let Measured { headings, columns } = read_measured(OPTION, path)?;
    let [x, f] = <[Vec<f64>; 2]>::try_from(columns).map_err(|columns| {
        let message = "two columns are needed, positions and heights: cut out those two";
        Failure::input(named(), format!("{} columns; {message}", columns.len()))
    })?;
    let unit = unit(arguments, headings.first().map(String::as_str))?;
    let profile = Profile::new(x, f).map_err(|error| Failure::input(named(), error))?;
    Ok(Given { profile, image: None, unit })
}

/// Unit of the positions.
fn unit(
    arguments: &MeasuredTipArguments,
    heading: Option<&str>,
) -> Result<Option<String>, Failure> {
    if let Some(unit) = &arguments.unit {
        metres(unit)?;
        return Ok(Some(unit.clone()));
    }
    // A heading may have a word in brackets that is no unit of length.
    let found = heading.and_then(unit_of).filter(|unit| metres(unit).is_ok());
    Ok(found.map(str::to_owned))
}

fn metres(unit: &str) -> Result<f64, Failure> {
    let length = Unit::Length.parse(&format!("1{unit}"));
    length.map_err(|_| Failure::input(format!("--unit {unit}"), "m, mm, um, nm or pm will do"))
}

fn judged(option: &str, value: Option<f64>, above: f64) -> Result<Option<f64>, Failure> {
    let Some(value) = value else { return Ok(None) };
    if value.is_finite() && value > above {
        return Ok(Some(value));
    }
    let least = if above < 0.0 { "a finite number" } else { "a finite number above 0" };
    Err(Failure::input(format!("{option} {}", Typed(value)), format!("{least} will do")))
}

/// σ in the unit of the positions.
fn sigma(arguments: &MeasuredTipArguments, metres: Option<f64>) -> Result<Option<f64>, Failure> {
    let Some(text) = &arguments.sigma else { return Ok(None) };
    let option = format!("--sigma {text}");
    let value = match (text.trim().parse::<f64>(), metres) {
        (Ok(bare), _) => bare,
        (Err(_), Some(metres)) => {
            let length = Unit::Length.parse(text);
            length.map_err(|error| Failure::input(&option, error))? / metres
        }
        (Err(_), None) => {
            let message = "the unit of the positions is not known: say it with --unit";
            return Err(Failure::input(option, message));
        }
    };
    judged("--sigma", Some(value), 0.0)
        .map_err(|_| Failure::input(option, "a length above 0 will do, such as 30nm"))
}

fn judge_counts(request: &Request) -> Result<(), Failure> {
    if request.terms == Some(0) {
        return Err(Failure::input("--terms 0", "1 or more will do"));
    }
    if request.resamples > MOST_RESAMPLES {
        let option = format!("--resamples {}", request.resamples);
        return Err(Failure::input(option, format!("at most {MOST_RESAMPLES} will do")));
    }
    Ok(())
}
