//! `stickslip fit --image`.

use super::ask::{context, refusal, refuse_unknown};
use super::job::{Job, judge_places};
use super::tip::{ImageInUnits, in_unit, measured_image, metres};
use crate::arguments::{Either, FitArguments, Options, TipArguments};
use crate::failure::{Failure, Typed};
use crate::files::distinct::Named;
use crate::files::input::{TipFile, read_tip};
use crate::session::Session;
use serde_json::{Map, Value, json};
use std::path::Path;
use stickslip::{Ask, Fit, FitImage, FitImageDocument, parameter};

const OPTION: &str = "--image";
const RETRACE: &str = "--retrace-image";
const LATERAL: &str = "--lateral-image";

pub(super) fn fit_image(
    session: &Session,
    arguments: &FitArguments,
    path: &Path,
) -> Result<(), Failure> {
    let FitArguments { options, outlet, plot, .. } = arguments;
    let retrace = arguments.retrace_image.as_deref();
    let [tip, parameters] = options.files();
    let lateral = arguments.lateral_image.as_deref();
    let images: [Named; 3] = [(OPTION, Some(path)), (RETRACE, retrace), (LATERAL, lateral)];
    let files = [vec![tip, parameters], images.to_vec()].concat();
    judge_places(outlet, plot.as_deref(), &files)?;
    let question = question(session, arguments, path)?;
    let refused = |failure| refusal(failure, &options.tip, &files);
    let job = Job::open(session, FitImageDocument::FORMAT, outlet, plot.as_deref())?;
    job.finish(question.ask(&context(session)).map_err(refused)?)
}

/// The question of the options, with the image.
fn question(session: &Session, arguments: &FitArguments, path: &Path) -> Result<FitImage, Failure> {
    let options = without_width(arguments);
    let mut values = options.values(session)?;
    refuse_unknown::<FitImage, _>(&options, &values, OPTION)?;
    let given = values.get("unit").and_then(Value::as_str);
    let ImageInUnits { image, unit, z_unit: height_unit } =
        measured_image(session, OPTION, path, given)?;
    let beside = |option: &str, path: Option<&Path>| {
        let Some(path) = path else { return Ok(None) };
        let read = measured_image(session, option, path, given)?;
        if read.unit == unit {
            return Ok(Some(read));
        }
        let message = "its lengths have another unit than those of --image: save both images in the same unit";
        Err(Failure::file(option, path, message))
    };
    let retrace_image = beside(RETRACE, arguments.retrace_image.as_deref())?.map(|read| read.image);
    let lateral = beside(LATERAL, arguments.lateral_image.as_deref())?;
    let (lateral_image, lateral_unit) = lateral.map(|read| (read.image, read.z_unit)).unzip();
    let lateral_unit = lateral_unit.flatten();
    if let Some(gain) = arguments.force_gain {
        values.insert("force_gain".into(), json!(gain));
    }
    if let Some(width) = arguments.options.tip.width {
        values.insert("width".into(), json!(in_unit("--width", width, unit.as_deref())?));
        values.remove("width_interval");
    } else if !values.contains_key("width") {
        values.extend(width_of(session, &options.tip, unit.as_deref())?);
    }
    if let Some(pitch) = arguments.pitch {
        values.insert("pitch".into(), json!(in_unit("--pitch", pitch, unit.as_deref())?));
    }
    let question: FitImage = parameter::question(values)?;
    let source = path.display().to_string();
    Ok(FitImage {
        source,
        unit,
        height_unit,
        image,
        retrace_image,
        lateral_image,
        lateral_unit,
        ..question
    })
}

/// The options without --width, which here is σ of the data and not the width of a footprint.
pub(super) fn without_width(arguments: &FitArguments) -> Options<Either<Fit, FitImage>> {
    let mut options = arguments.options.clone();
    options.0.tip.width = None;
    options
}

/// σ of a measured tip and its interval, in the unit of the data, with a message.
fn width_of(
    session: &Session,
    tip: &TipArguments,
    unit: Option<&str>,
) -> Result<Map<String, Value>, Failure> {
    let mut values = Map::new();
    let (Some(path), Some(unit)) = (&tip.tip_file, unit) else { return Ok(values) };
    let TipFile::Measured(measured) = read_tip(session, path)? else { return Ok(values) };
    let Some(sigma) = measured.sigma_metres else { return Ok(values) };
    let factor = sigma / measured.sigma.value / metres(unit)?;
    let [width, low, high] = [Some(measured.sigma.value), measured.sigma.low, measured.sigma.high]
        .map(|v| Some(factor * v?));
    session.remark(format_args!(
        "σ = {} {unit}, that of --tip-file {}",
        Typed(width.unwrap_or(sigma)),
        path.display()
    ));
    values.insert("width".into(), json!(width));
    values.insert("width_interval".into(), json!(low.zip(high)));
    Ok(values)
}
