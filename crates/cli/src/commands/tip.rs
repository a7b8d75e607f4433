//! `stickslip tip`.

use super::job::{Job, judge_places};
use crate::arguments::MeasuredTipArguments;
use crate::failure::{Failure, Typed};
use crate::files::gsf::read_gsf;
use crate::files::heading::Heading;
use crate::files::measured::{one_of, read_measured};
use stickslip::{Document, MeasuredTipDocument, MeasuredTipFound, MeasuredTipParameters};
use stickslip_measurement::{Image, Profile, Request, TipError, tip};
use stickslip_units::Unit;

const OPTION: &str = "MEASURED.csv";
/// Largest number of resampled profiles.
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
    let document: MeasuredTipDocument =
        Document::new(parameters, MeasuredTipFound::of(&found, metres), found.remarks());
    let across = image.map(|image| image.across(&found)).transpose();
    let across = across.map_err(|error| Failure::input(named(), error))?;
    job.finish(match across {
        Some(across) => document.with_image(&across),
        None => document,
    })
}

/// The measured data.
struct Given {
    profile: Profile,
    /// The image whose middle row is the profile.
    image: Option<Image>,
    /// Unit of the positions.
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
        let unit = unit(arguments, &Heading::of(if read.in_nanometres { "x_nm" } else { "x" }))?;
        return Ok(Given { profile, image: Some(image), unit });
    }
    let sheet = read_measured(OPTION, path, &[2])?;
    let unit = unit(arguments, &sheet.headings[0])?;
    let [x, f] = [0, 1].map(|i| sheet.columns[i].clone());
    let profile = Profile::new(x, f).map_err(|error| Failure::input(named(), error))?;
    Ok(Given { profile, image: None, unit })
}

/// Unit of the positions.
fn unit(arguments: &MeasuredTipArguments, heading: &Heading) -> Result<Option<String>, Failure> {
    let written = heading.unit(Unit::Length);
    let Some(unit) = &arguments.unit else {
        let named = format!("{OPTION} {}", arguments.measured.display());
        let advice = "give the unit of the positions by --unit";
        let written =
            written.map_err(|error| Failure::input(named, format!("{error}: {advice}")))?;
        return Ok(written.map(|(unit, _)| unit.to_owned()));
    };
    let one = metres(unit)?;
    match written {
        Ok(Some((_, other))) if other.to_bits() != one.to_bits() => {
            let message = format!(
                "the heading `{}` has another unit: leave --unit out, or correct the heading",
                heading.text()
            );
            Err(Failure::input(format!("--unit {unit}"), message))
        }
        _ => Ok(Some(unit.clone())),
    }
}

fn metres(unit: &str) -> Result<f64, Failure> {
    one_of(Unit::Length, "--unit", unit)
}

fn judged(option: &str, value: Option<f64>, above: f64) -> Result<Option<f64>, Failure> {
    let Some(value) = value else { return Ok(None) };
    if value.is_finite() && value > above {
        return Ok(Some(value));
    }
    let least = if above < 0.0 { "a finite number" } else { "a finite number above 0" };
    Err(Failure::input(format!("{option} {}", Typed(value)), format!("{least} will do")))
}

/// σ in the unit of the positions, or 1 if these are in σ.
fn sigma(arguments: &MeasuredTipArguments, metres: Option<f64>) -> Result<Option<f64>, Failure> {
    let Some(text) = &arguments.sigma else { return Ok(None) };
    let option = format!("--sigma {text}");
    let in_sigma = text.trim().strip_suffix('σ').and_then(|number| number.trim().parse().ok());
    let value = match (in_sigma, metres) {
        (Some(number), None) => number,
        (Some(_), Some(_)) => {
            let message = "the positions have a unit: give σ in a unit of length, such as 30nm";
            return Err(Failure::input(option, message));
        }
        (None, metres) => {
            let length = Unit::Length.parse(text);
            let length = length.map_err(|error| Failure::input(&option, error))?;
            let unknown = "the unit of the positions is not known: give it by --unit";
            length / metres.ok_or_else(|| Failure::input(&option, unknown))?
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
