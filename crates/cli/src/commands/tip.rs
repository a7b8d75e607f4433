//! `stickslip tip`.

use super::ask::{context, refusal};
use super::job::{Job, judge_places};
use crate::arguments::{Length, MeasuredTipArguments};
use crate::failure::Failure;
use crate::files::measured::read_measured;
use crate::files::text::read_gsf;
use crate::session::Session;
use serde_json::{Map, Value, json};
use std::path::Path;
use stickslip::{
    Ask, Dimension, MeasuredImage, MeasuredProfile, MeasuredTip, MeasuredTipDocument, Refused,
    parameter,
};
use stickslip_tables::Heading;
use stickslip_units::Unit;

const OPTION: &str = "MEASURED.csv";

pub(crate) fn measured_tip(
    session: &Session,
    arguments: &MeasuredTipArguments,
) -> Result<(), Failure> {
    let MeasuredTipArguments { measured, options, both, centre, sigma, outlet, plot } = arguments;
    let [_, parameters] = options.files();
    judge_places(outlet, plot.as_deref(), &[(OPTION, Some(&**measured)), parameters])?;
    let mut values = options.values(session)?;
    let data = Data::read(session, measured, values.get("unit").and_then(Value::as_str))?;
    if *both {
        values.insert("half".into(), json!(false));
    }
    if let Some(centre) = *centre {
        let centre = in_unit("--centre", centre, data.unit.as_deref())?;
        values.insert("centre".into(), json!(centre));
    }
    if let Some(text) = sigma {
        values.insert("sigma".into(), json!(in_positions(text, data.unit.as_deref())?));
    }
    let question = data.question(values, measured)?;
    let refused = |failure| match failure {
        stickslip::Failure::Refused(refused)
            if matches!(&*refused.parameter, "profile" | "image") =>
        {
            Failure::file(OPTION, measured, refused.why)
        }
        other => refusal(other, &options.tip, &[]),
    };
    let job = Job::open(session, MeasuredTipDocument::FORMAT, outlet, plot.as_deref())?;
    job.finish(question.ask(&context(session)).map_err(refused)?)
}

/// The measured data.
struct Data {
    profile: MeasuredProfile,
    image: Option<MeasuredImage>,
    /// Unit of the positions.
    unit: Option<String>,
    height_unit: Option<String>,
}

impl Data {
    fn read(session: &Session, path: &Path, given: Option<&str>) -> Result<Self, Failure> {
        if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("gsf")) {
            let ImageInUnits { image, unit, z_unit } =
                measured_image(session, OPTION, path, given)?;
            let profile = MeasuredProfile::default();
            return Ok(Self { profile, image: Some(image), unit, height_unit: z_unit });
        }
        let sheet = read_measured(session, OPTION, path, &[2])?;
        let unit = unit((OPTION, path), given, &sheet.headings[0])?;
        let height_unit = sheet.headings[1].written_unit().map(str::to_owned);
        let [x, f] = [0, 1].map(|i| sheet.columns[i].clone());
        Ok(Self { profile: MeasuredProfile { x, f }, image: None, unit, height_unit })
    }

    /// The question about these data with the other parameters.
    fn question(self, values: Map<String, Value>, path: &Path) -> Result<MeasuredTip, Failure> {
        let Self { profile, image, unit, height_unit } = self;
        let source = path.display().to_string();
        let question: MeasuredTip = parameter::question(values)?;
        Ok(MeasuredTip { source, unit, height_unit, profile, image, ..question })
    }
}

/// An image with the units of its positions and of its heights.
pub(super) struct ImageInUnits {
    pub(super) image: MeasuredImage,
    pub(super) unit: Option<String>,
    pub(super) z_unit: Option<String>,
}

/// The image in a file.
pub(super) fn measured_image(
    session: &Session,
    option: &str,
    path: &Path,
    given: Option<&str>,
) -> Result<ImageInUnits, Failure> {
    let read = read_gsf(session, option, path)?;
    let heading = Heading::of(if read.in_nanometres { "x_nm" } else { "x" });
    let unit = unit((option, path), given, &heading)?;
    let image = MeasuredImage { x: read.x, y: read.y, rows: read.rows };
    Ok(ImageInUnits { image, unit, z_unit: read.z_unit })
}

/// Unit of the positions.
fn unit(
    (option, path): (&str, &Path),
    given: Option<&str>,
    heading: &Heading,
) -> Result<Option<String>, Failure> {
    let written = heading.unit(Unit::Length);
    let Some(unit) = given else {
        let written = written.map_err(|error| {
            let message = format!("{error}: give the unit of the positions by --unit");
            Failure::file(option, path, message)
        })?;
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
        _ => Ok(Some(unit.to_owned())),
    }
}

/// The value in m of a unit of the positions.
pub(super) fn metres(unit: &str) -> Result<f64, Failure> {
    Ok(Refused::metres("unit", unit)?)
}

/// A length in the unit of the data.
pub(super) fn in_unit(option: &str, length: Length, unit: Option<&str>) -> Result<f64, Failure> {
    match (length, unit) {
        (Length::Bare(number), _) if !number.is_finite() => {
            Err(Failure::number(option, number, "must be a finite number"))
        }
        (Length::Bare(number), _) => Ok(number),
        (Length::Metres(length), Some(unit)) => Ok(Dimension::rounded(length / metres(unit)?)),
        (Length::Metres(_), None) => {
            let message =
                "the unit of the data is not known: give it by --unit, or a number without a unit";
            Err(Failure::input(option, message))
        }
    }
}

/// The value of --sigma in the unit of the positions.
fn in_positions(text: &str, unit: Option<&str>) -> Result<f64, Failure> {
    let option = || format!("--sigma {text}");
    let in_sigma = text.trim().strip_suffix('σ').and_then(|number| number.trim().parse().ok());
    let value = match (in_sigma, unit) {
        (Some(number), None) => number,
        (Some(_), Some(_)) => {
            let message = "the positions have a unit: give σ in a unit of length, such as 30nm";
            return Err(Failure::input(option(), message));
        }
        (None, unit) => {
            let length = Unit::Length.parse(text);
            let length = length.map_err(|error| Failure::input(option(), error))?;
            let unknown = "the unit of the positions is not known: give it by --unit";
            length / metres(unit.ok_or_else(|| Failure::input(option(), unknown))?)?
        }
    };
    if value.is_finite() && value > 0.0 {
        return Ok(value);
    }
    Err(Failure::input(option(), "must be a length above 0, such as 30nm"))
}
