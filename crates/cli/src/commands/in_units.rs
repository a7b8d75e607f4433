//! Scales for results in nm, s and nN, from the options of an experiment or from a document.

use crate::arguments::InUnitsArguments;
use crate::failure::{Failure, Typed};
use crate::files::input::{TipFile, open, read_tip};
use crate::session::Session;
use serde::Deserialize;
use std::path::Path;
use stickslip::{
    DataFitted, EstimateDocument, Fit, FitDocument, FitImage, FitImageDocument, InUnits,
    KnownScales, MeasuredTipDocument, NumberFitted, UnitsDocument,
};
use stickslip_units::Unit;

/// Largest relative difference at which two values of r count as equal: typed numbers have about this precision.
const SAME: f64 = 1e-6;

/// The scales of the result; `None` if no physical units are requested. `tip_file` is that of the command, `r` the
/// velocity, if all results have the same.
pub(crate) fn scales(
    session: &Session,
    arguments: &InUnitsArguments,
    tip_file: Option<&Path>,
    r: Option<f64>,
) -> Result<Option<KnownScales>, Failure> {
    let (scales, origin) = with_origin(session, arguments, tip_file, r)?;
    origin.into_iter().for_each(|origin| session.remark(origin));
    Ok(scales)
}

/// The scales of a result computed from a document: those of the options, or else those of the document. `None` if there are
/// none, or if an image in metres needs a scale that the document lacks.
pub(crate) fn scales_of(
    session: &Session,
    arguments: &InUnitsArguments,
    document: Option<&InUnits>,
    r: f64,
    is_image_in_metres: bool,
) -> Result<Option<KnownScales>, Failure> {
    let typed = scales(session, arguments, None, Some(r))?;
    let Some(own) = document.map(|physical| physical.scales).filter(|_| typed.is_none()) else {
        return Ok(typed);
    };
    let own = sound(own, "the document")?;
    if is_image_in_metres && own.length.zip(own.height).is_none() {
        session.remark(
            "stickslip: the image is in σ and kσ²/a: the document does not have both in m. For metres give --sigma, \
             --stiffness and --slope-force",
        );
        return Ok(None);
    }
    Ok(Some(own))
}

/// The scales, and a remark on the origin of σ if it is that of a measured tip.
pub(crate) fn with_origin(
    session: &Session,
    arguments: &InUnitsArguments,
    tip_file: Option<&Path>,
    r: Option<f64>,
) -> Result<(Option<KnownScales>, Option<String>), Failure> {
    if let Some(path) = &arguments.units {
        return of_document(session, path).map(|scales| (Some(scales), None));
    }
    let given = Given::read(arguments)?;
    if given.is_empty() {
        return Ok((None, None));
    }
    let (given, origin) = given.with_width_of(session, tip_file)?;
    Ok((Some(given.scales(r)?), origin))
}

/// The unit of length and the unit of height in m, for an image; 1 without units.
pub(crate) fn in_metres(scales: Option<&KnownScales>) -> Result<(f64, f64, &'static str), Failure> {
    let Some(KnownScales { length, height, .. }) = scales else { return Ok((1.0, 1.0, "")) };
    match length.zip(*height) {
        Some((length, height)) => Ok((length, height, "m")),
        None => {
            let message = "an image in metres needs σ and kσ²/a: give --sigma, --stiffness and --slope-force, or a document of \
                           `stickslip units` to --units";
            Err(Failure::input("--output", message))
        }
    }
}

/// The values of the options, in SI units.
struct Given {
    sigma: Option<f64>,
    stiffness: Option<f64>,
    damping: Option<f64>,
    velocity: Option<f64>,
    slope_force: Option<f64>,
}

impl Given {
    fn read(arguments: &InUnitsArguments) -> Result<Self, Failure> {
        let InUnitsArguments { sigma, stiffness, damping, velocity, slope_force, .. } = arguments;
        Ok(Self {
            sigma: quantity("--sigma", sigma.as_deref(), Unit::Length)?,
            stiffness: quantity("--stiffness", stiffness.as_deref(), Unit::Stiffness)?,
            damping: quantity("--damping", damping.as_deref(), Unit::Damping)?,
            velocity: quantity("--velocity", velocity.as_deref(), Unit::Velocity)?,
            slope_force: quantity("--slope-force", slope_force.as_deref(), Unit::Force)?,
        })
    }

    fn is_empty(&self) -> bool {
        let Self { sigma, stiffness, damping, velocity, slope_force } = *self;
        [sigma, stiffness, damping, velocity, slope_force].iter().all(Option::is_none)
    }

    /// Adds the σ of a measured tip, with a remark.
    fn with_width_of(
        self,
        session: &Session,
        tip_file: Option<&Path>,
    ) -> Result<(Self, Option<String>), Failure> {
        let Some(path) = tip_file.filter(|_| self.sigma.is_none()) else { return Ok((self, None)) };
        let TipFile::Measured(measured) = read_tip(session, path)? else { return Ok((self, None)) };
        let origin = measured
            .sigma_metres
            .map(|sigma| format!("σ = {} nm, that of --tip-file {}", sigma * 1e9, path.display()));
        Ok((Self { sigma: measured.sigma_metres, ..self }, origin))
    }

    /// The scales of these options. Options that lack a companion or contradict each other are rejected.
    fn scales(&self, r: Option<f64>) -> Result<KnownScales, Failure> {
        let Self { sigma, stiffness, damping, velocity, slope_force } = *self;
        let by_friction = damping.zip(stiffness).map(|(damping, k)| damping / k);
        let by_velocity = velocity.zip(sigma).zip(r).map(|((v0, sigma), r)| r * sigma / v0);
        if let (Some(one), Some(other)) = (by_friction, by_velocity)
            && (one - other).abs() > SAME * one
        {
            let r = r.unwrap_or(f64::NAN) * one / other;
            let message = format!(
                "r = Γ v0/(kσ) is {} by these, and another r is given: leave one out",
                Typed(r)
            );
            return Err(Failure::input("--damping, --stiffness, --sigma, --velocity", message));
        }
        let force = stiffness.zip(sigma).map(|(k, sigma)| k * sigma);
        let height = force.zip(sigma).zip(slope_force).map(|((force, sigma), a)| force * sigma / a);
        let scales =
            KnownScales { length: sigma, time: by_friction.or(by_velocity), height, force };
        let unused = [
            (
                "--velocity",
                velocity.is_some() && scales.time.is_none(),
                "--sigma and one r; with several r give --damping and --stiffness in its place",
            ),
            ("--damping", damping.is_some() && scales.time.is_none(), "--stiffness"),
            ("--slope-force", slope_force.is_some() && height.is_none(), "--stiffness and --sigma"),
            (
                "--stiffness",
                stiffness.is_some() && scales.time.is_none() && force.is_none(),
                "--sigma",
            ),
        ];
        match unused.iter().find(|(_, is_unused, _)| *is_unused) {
            Some((option, _, needs)) => {
                Err(Failure::input(*option, format!("gives no scale alone: it needs {needs}")))
            }
            None => Ok(scales),
        }
    }
}

fn quantity(option: &str, text: Option<&str>, unit: Unit) -> Result<Option<f64>, Failure> {
    let Some(text) = text else { return Ok(None) };
    let named = || format!("{option} {text}");
    let value = unit.parse(text).map_err(|error| Failure::input(named(), error))?;
    if value > 0.0 {
        return Ok(Some(value));
    }
    Err(Failure::input(named(), "must be above 0"))
}

/// The fields of a document that may contain scales.
#[derive(Deserialize)]
struct Scaled {
    format: Option<String>,
    scales: Option<KnownScales>,
    sigma_metres: Option<f64>,
    physical: Option<WithScales>,
    parameters: Option<serde_json::Value>,
    numbers: Option<Vec<NumberFitted>>,
    data: Option<serde_json::Value>,
    height_gain: Option<f64>,
}

#[derive(Deserialize)]
struct WithScales {
    scales: Option<KnownScales>,
}

/// The scales in a document.
pub(crate) fn of_document(session: &Session, path: &Path) -> Result<KnownScales, Failure> {
    let document: Scaled = serde_json::from_reader(open(session, "--units", path)?)
        .map_err(|error| Failure::file("--units", path, format!("no document: {error}")))?;
    let scales = match document.format.as_deref() {
        Some(UnitsDocument::FORMAT) => document.scales,
        Some(MeasuredTipDocument::FORMAT) => {
            let length = document.sigma_metres;
            length.map(|_| KnownScales { length, ..KnownScales::default() })
        }
        Some(FitDocument::FORMAT) => document.fitted(),
        Some(FitImageDocument::FORMAT) => document.fitted_image(),
        _ => document.physical.and_then(|physical| physical.scales),
    };
    let Some(scales) = scales else {
        let advice = "contains no scales: a document of `stickslip units` does, one of `tip` or `fit` from data with a \
                      unit, and any that was written with --units or --sigma";
        return Err(Failure::file("--units", path, advice));
    };
    sound(scales, &format!("--units {}", path.display()))
}

/// The scales, if they are above 0.
fn sound(scales: KnownScales, named: &str) -> Result<KnownScales, Failure> {
    let KnownScales { length, time, height, force } = scales;
    let is_scale = |scale: f64| scale.is_finite() && scale > 0.0;
    if [length, time, height, force].into_iter().flatten().all(is_scale) {
        return Ok(scales);
    }
    Err(Failure::input(named, "damaged: scales must be above 0"))
}

impl Scaled {
    /// Scales of a fit: σ is the fitted or fixed width; kσ²/a follows from the heights of ripples.
    fn fitted(self) -> Option<KnownScales> {
        let question: Fit = serde_json::from_value(self.parameters?).ok()?;
        let metres = Unit::Length.one(question.unit.as_deref()?)?;
        let fitted = self.numbers?.into_iter().find(|number| number.name == "width");
        let fitted =
            fitted.map(|NumberFitted { estimate: EstimateDocument { value, .. }, .. }| value);
        let sigma = fitted.or(question.known("width"))?;
        let data: Vec<DataFitted> = serde_json::from_value(self.data?).ok()?;
        let ripple = data.iter().find(|data| data.kind == "ripple");
        let height_metres = height_metres(metres, ripple.and_then(|data| data.y_unit.as_deref()));
        Some(of_ripples((metres, height_metres), sigma, ripple.and_then(|data| data.gain)))
    }

    /// Scales of a fit to an image: σ is given.
    fn fitted_image(self) -> Option<KnownScales> {
        let FitImage { unit, height_unit, width, .. } =
            serde_json::from_value(self.parameters?).ok()?;
        let metres = Unit::Length.one(unit.as_deref()?)?;
        let height_metres = height_metres(metres, height_unit.as_deref());
        Some(of_ripples((metres, height_metres), width?, self.height_gain))
    }
}

/// The unit of heights in m: by default that of lengths; `None` for a unit of another quantity, such as volts.
fn height_metres(metres: f64, unit: Option<&str>) -> Option<f64> {
    unit.map_or(Some(metres), |unit| Unit::Length.one(unit))
}

/// Scales from σ and k/a, by the units of lengths and of heights in m.
fn of_ripples(
    (metres, height_metres): (f64, Option<f64>),
    sigma: f64,
    gain: Option<f64>,
) -> KnownScales {
    let height = gain.zip(height_metres);
    KnownScales {
        length: Some(sigma * metres),
        height: height.map(|(gain, metres)| gain * sigma * sigma * metres),
        ..KnownScales::default()
    }
}
