//! `stickslip fit`.

use super::job::{Job, judge_places};
use super::model::tip;
use crate::arguments::{FitArguments, TipArguments};
use crate::failure::{Failure, Typed};
use crate::files::measured::{Measured, read_measured, unit_of};
use std::path::Path;
use stickslip_documents::TipName;
use stickslip_documents::{FitDocument, FitParameters, NumberHeld};
use stickslip_measurement::{
    Data, Fit, FitError, FitRequest, Name, Shape, Track, Values, fit as fitted,
};
use stickslip_stability::critical;
use stickslip_tip::TipFunction;
use stickslip_units::Unit;

pub(crate) fn fit(arguments: &FitArguments) -> Result<(), Failure> {
    let tip_file = arguments.tip.tip_file.as_deref();
    let mut read = vec![("--tip-file", tip_file)];
    read.extend(arguments.ripple.iter().map(|path| ("--ripple", Some(&**path))));
    read.extend(arguments.friction.iter().map(|path| ("--friction", Some(&**path))));
    read.push(("--onsets", arguments.onsets.as_deref()));
    read.push(("--wavelengths", arguments.wavelengths.as_deref()));
    judge_places(&arguments.outlet, arguments.plot.as_deref(), &read)?;
    let request = request(arguments)?;
    let (data, unit) = data(arguments)?;
    if data.is_empty() {
        let message = "give what was measured: one of these at least";
        return Err(Failure::input("--ripple, --friction, --onsets, --wavelengths", message));
    }
    let job = Job::open::<FitDocument>(&arguments.outlet, arguments.plot.as_deref())?;
    let given: Vec<Data> = data.iter().map(|(_, data)| data.clone()).collect();
    let found = fitted(&given, &request).map_err(|error| match error {
        FitError::NoStart | FitError::Stopped => Failure::Run(error.to_string()),
        error => Failure::input(named(&data), error),
    })?;
    let tip = fitted_tip(&request, &found)?;
    let critical_alpha = found.values.get(Name::R).and_then(|r| critical(&tip, r).ok());
    let held = Name::ALL.into_iter().filter_map(|name| {
        Some(NumberHeld { name: name.word().into(), value: request.known.get(name)? })
    });
    let parameters =
        FitParameters { tip: (&tip).into(), known: held.collect(), robust: arguments.robust, unit };
    job.finish(FitDocument::of(&found, parameters, &data, critical_alpha.map(|at| at.alpha)))
}

/// The files, as they were named.
fn named(data: &[(String, Data)]) -> String {
    data.iter().map(|(source, _)| source.as_str()).collect::<Vec<&str>>().join(", ")
}

fn fitted_tip(request: &FitRequest, found: &Fit) -> Result<TipFunction, Failure> {
    match &request.shape {
        Shape::Known(tip) => Ok(tip.clone()),
        Shape::Triple => {
            TipFunction::triple_gaussian(found.values.get(Name::Beta).unwrap_or(1.0), 1.0)
                .map_err(|error| Failure::Run(error.to_string()))
        }
    }
}

/// Names of `--free`.
const MORE: [(&str, Name); 4] = [
    ("beta", Name::Beta),
    ("depth-limit", Name::DepthLimit),
    ("healing-time", Name::HealingTime),
    ("inertia", Name::Inertia),
];

fn request(arguments: &FitArguments) -> Result<FitRequest, Failure> {
    let mut free = vec![];
    for word in &arguments.free {
        let found = MORE.iter().find(|(name, _)| name == word).map(|(_, name)| *name);
        free.push(found.ok_or_else(|| {
            let names = MORE.map(|(name, _)| name).join(", ");
            Failure::input(
                format!("--free {word}"),
                format!("{names} will do; α, r and σ are free unless given"),
            )
        })?);
    }
    let TipArguments { width, beta, tip: name, .. } = arguments.tip;
    let mut known = Values::default();
    for (option, name, value) in [
        ("--alpha", Name::Alpha, arguments.alpha),
        ("--r", Name::R, arguments.r),
        ("--width", Name::Width, width),
        ("--depth-limit", Name::DepthLimit, arguments.depth_limit),
        ("--healing-time", Name::HealingTime, arguments.healing_time),
        ("--inertia", Name::Inertia, arguments.inertia),
    ] {
        let Some(value) = value else { continue };
        if !(value.is_finite() && value > 0.0) {
            let message = "must be a finite number above 0";
            return Err(Failure::input(format!("{option} {}", Typed(value)), message));
        }
        known.set(name, value);
    }
    let is_triple =
        matches!(name, None | Some(TipName::TripleGaussian)) && arguments.tip.tip_file.is_none();
    let shape = if free.contains(&Name::Beta) {
        if !is_triple || beta.is_some() {
            let message =
                "is that of the triple Gaussian, and free: leave --beta, --tip and --tip-file out";
            return Err(Failure::input("--free beta", message));
        }
        Shape::Triple
    } else {
        Shape::Known(tip(&TipArguments { width: None, ..arguments.tip.clone() })?)
    };
    Ok(FitRequest { shape, known, free, robust: arguments.robust })
}

/// Data, each with the name of its file.
type Given = Vec<(String, Data)>;

/// What was measured, and the unit of lengths.
fn data(arguments: &FitArguments) -> Result<(Given, Option<String>), Failure> {
    let mut files = Files { unit: arguments.unit.clone() };
    let mut found = vec![];
    let mut give = |option: &str, path: &Path, data: Data| {
        found.push((format!("{option} {}", path.display()), data));
    };
    for path in &arguments.ripple {
        give("--ripple", path, files.ripple(path, arguments.height_gain)?);
    }
    for path in &arguments.friction {
        give("--friction", path, files.friction(path, arguments.force_gain)?);
    }
    if let Some(path) = &arguments.onsets {
        let [velocity, load] = taken("--onsets", path, read_measured("--onsets", path)?.columns)?;
        give("--onsets", path, Data::Onsets { velocity, load });
    }
    if let Some(path) = &arguments.wavelengths {
        let Measured { headings, columns } = read_measured("--wavelengths", path)?;
        files.unit_is_that_of(headings.get(2));
        let [velocity, load, wavelength] = taken("--wavelengths", path, columns)?;
        give("--wavelengths", path, Data::Wavelengths { velocity, load, wavelength });
    }
    Ok((found, files.unit))
}

/// Files of data, all in one unit of lengths.
struct Files {
    /// That asked for, or that of the first heading which has one.
    unit: Option<String>,
}

impl Files {
    fn unit_is_that_of(&mut self, heading: Option<&String>) {
        if self.unit.is_none() {
            self.unit = heading.and_then(|heading| unit_of(heading)).map(str::to_owned);
        }
    }

    fn ripple(&mut self, path: &Path, gain: Option<f64>) -> Result<Data, Failure> {
        let Measured { mut headings, mut columns } = read_measured("--ripple", path)?;
        // As `stickslip surface` writes it.
        let is_surface = |names: &[&str]| headings.iter().zip(names).all(|(a, b)| a == b);
        if columns.len() == 3
            && (is_surface(&["t", "x", "u"]) || is_surface(&["t_s", "x_nm", "u_nm"]))
        {
            headings.remove(0);
            columns.remove(0);
        }
        self.unit_is_that_of(headings.first());
        let [x, mut y] = taken("--ripple", path, columns)?;
        // Heights in the unit of the positions, of which a gain k/a is, where both are known.
        let metres = |heading: Option<&String>| {
            let unit = heading.and_then(|heading| unit_of(heading))?;
            Unit::Length.parse(&format!("1 {unit}")).ok()
        };
        if let Some((along, height)) = metres(headings.first()).zip(metres(headings.get(1))) {
            y.iter_mut().for_each(|y| *y *= height / along);
        }
        Ok(Data::Ripple(Track { x, y, gain }))
    }

    fn friction(&mut self, path: &Path, gain: Option<f64>) -> Result<Data, Failure> {
        let Measured { headings, columns } = read_measured("--friction", path)?;
        self.unit_is_that_of(headings.first());
        if columns.len() == 3 {
            let [x, y, back] = taken("--friction", path, columns)?;
            return Ok(Data::Loop(Track { x, y, gain }, back));
        }
        let [x, y] = taken("--friction", path, columns)?;
        Ok(Data::Friction(Track { x, y, gain }))
    }
}

/// Just so many columns.
fn taken<const N: usize>(
    option: &str,
    path: &Path,
    columns: Vec<Vec<f64>>,
) -> Result<[Vec<f64>; N], Failure> {
    columns.try_into().map_err(|columns: Vec<Vec<f64>>| {
        let message = format!("{} columns; {N} are needed", columns.len());
        Failure::input(format!("{option} {}", path.display()), message)
    })
}
