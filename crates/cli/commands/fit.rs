//! `stickslip fit`.

use super::job::{Job, judge_places};
use super::model::tip;
use crate::arguments::{FitArguments, TipArguments, TipName};
use crate::failure::{Failure, Typed};
use crate::files::measured::{Measured, read_measured, unit_of};
use std::path::Path;
use stickslip_documents::{FitDocument, FitParameters, NumberHeld};
use stickslip_measurement::{
    Data, Fit, FitError, FitRequest, Name, Shape, Track, Values, fit as fitted,
};
use stickslip_stability::critical;
use stickslip_tip::TipFunction;

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
    let mut unit = arguments.unit.clone();
    let mut found = vec![];
    let mut read = |option: &str, path: &Path, counts: &[usize], of_length: usize| {
        let Measured { mut headings, mut columns } = read_measured(option, path)?;
        // As `stickslip surface` writes it.
        if option == "--ripple" && headings == ["t", "x", "u"] {
            headings.remove(0);
            columns.remove(0);
        }
        if !counts.contains(&columns.len()) {
            let wanted: Vec<String> = counts.iter().map(usize::to_string).collect();
            let message = format!("{} columns; {} are needed", columns.len(), wanted.join(" or "));
            return Err(Failure::input(format!("{option} {}", path.display()), message));
        }
        if unit.is_none() {
            unit = headings.get(of_length).and_then(|h| unit_of(h)).map(str::to_owned);
        }
        Ok(columns.into_iter())
    };
    let source = |option: &str, path: &Path| format!("{option} {}", path.display());
    let mut next = Vec::new;
    for path in &arguments.ripple {
        let mut columns = read("--ripple", path, &[2], 0)?;
        let mut column = || columns.next().unwrap_or_else(&mut next);
        let track = Track { x: column(), y: column(), gain: arguments.height_gain };
        found.push((source("--ripple", path), Data::Ripple(track)));
    }
    for path in &arguments.friction {
        let mut columns = read("--friction", path, &[2, 3], 0)?;
        let mut column = || columns.next().unwrap_or_else(&mut next);
        let track = Track { x: column(), y: column(), gain: arguments.force_gain };
        let data = match columns.next() {
            Some(back) => Data::Loop(track, back),
            None => Data::Friction(track),
        };
        found.push((source("--friction", path), data));
    }
    if let Some(path) = &arguments.onsets {
        let mut columns = read("--onsets", path, &[2], usize::MAX)?;
        let mut column = || columns.next().unwrap_or_else(&mut next);
        let data = Data::Onsets { velocity: column(), load: column() };
        found.push((source("--onsets", path), data));
    }
    if let Some(path) = &arguments.wavelengths {
        let mut columns = read("--wavelengths", path, &[3], 2)?;
        let mut column = || columns.next().unwrap_or_else(&mut next);
        let data = Data::Wavelengths { velocity: column(), load: column(), wavelength: column() };
        found.push((source("--wavelengths", path), data));
    }
    Ok((found, unit))
}
