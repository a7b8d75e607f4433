//! `stickslip plot`.

#[cfg(feature = "animation")]
mod animation;

use super::figure::{Figure, drawing_failure};
use super::in_units::scales;
use crate::arguments::PlotArguments;
use crate::failure::Failure;
use crate::files::distinct::distinct;
use crate::files::input::{open, read_document};
use crate::session::Session;
use std::path::Path;
use stickslip::{BoundaryDocument, FigureDocument};
use stickslip_figures::{self as figures, AnimationFormat, FigureError, Size, View, Width};
use stickslip_saved::Document;
use stickslip_units::Unit;

const OPTION: &str = "DOCUMENT.json";

pub(crate) fn plot(session: &Session, arguments: &PlotArguments) -> Result<(), Failure> {
    if let Some(format) = AnimationFormat::of(&arguments.output) {
        return animate(session, arguments, format);
    }
    let of_animations = [
        ("--times", arguments.times.is_some()),
        ("--seconds", arguments.seconds.is_some()),
        ("--fps", arguments.fps.is_some()),
    ];
    let why = "belongs to an animation: name the output .gif, .webp or .apng, or leave it out";
    Failure::if_given(&of_animations, why)?;
    let size = size(arguments)?;
    let along_x = range("--x-range", arguments.x_range.as_deref())?;
    let along_y = range("--y-range", arguments.y_range.as_deref())?;
    let view = View {
        x_range: along_x.map(|(range, _)| range),
        y_range: along_y.map(|(range, _)| range),
        range_units: [along_x, along_y].map(|range| range.and_then(|(_, unit)| unit)),
        scales: None,
    };
    let units = ("--units", arguments.in_units.units.as_deref());
    let read = [(OPTION, Some(&*arguments.document)), units];
    distinct(&[("--output", Some(&*arguments.output))], &read)?;
    let output = Figure::at("--output", &arguments.output)?;
    output.write(&figure(session, arguments, &view)?, &size)
}

#[cfg(feature = "animation")]
fn animate(
    session: &Session,
    arguments: &PlotArguments,
    format: AnimationFormat,
) -> Result<(), Failure> {
    animation::write(session, arguments, format)
}

#[cfg(not(feature = "animation"))]
fn animate(_: &Session, arguments: &PlotArguments, _: AnimationFormat) -> Result<(), Failure> {
    let message = FigureError::Missing("animations", "animation");
    Err(Failure::file("--output", &arguments.output, message))
}

fn figure(
    session: &Session,
    arguments: &PlotArguments,
    view: &View,
) -> Result<FigureDocument, Failure> {
    let path: &Path = &arguments.document;
    let refused = |error| undrawn(path, &error);
    if arguments.onset {
        let option = format!("--onset with {OPTION}");
        let document: BoundaryDocument = read_document(session, &option, path)?;
        let view = View { scales: scales(session, &arguments.in_units, None, None)?, ..*view };
        return figures::onset_of(&document, &view).map_err(refused);
    }
    let document = read_drawn(session, path)?;
    // With the velocity of the support times need the single r of the document.
    let r = match &arguments.in_units.velocity {
        Some(_) => figures::of(document.drawn(), view).map_err(refused)?.one_r(),
        None => None,
    };
    let view = View { scales: scales(session, &arguments.in_units, None, r)?, ..*view };
    figures::of(document.drawn(), &view).map_err(refused)
}

fn read_drawn(session: &Session, path: &Path) -> Result<Box<dyn Document>, Failure> {
    stickslip_saved::drawn(open(session, OPTION, path)?)
        .map_err(|error| Failure::file(OPTION, path, error))
}

/// The error of a document that cannot be drawn.
fn undrawn(path: &Path, error: &FigureError) -> Failure {
    match error {
        FigureError::Damaged(_) | FigureError::Nothing(_) | FigureError::Still(_) => {
            Failure::file(OPTION, path, error)
        }
        error => drawing_failure(error),
    }
}

fn size(arguments: &PlotArguments) -> Result<Size, Failure> {
    Size::new(width(arguments)?, arguments.dpi)
        .map_err(|error| Failure::input(format!("--dpi {}", arguments.dpi.unwrap_or(0.0)), error))
}

fn width(arguments: &PlotArguments) -> Result<Option<Width>, Failure> {
    let width = arguments.width.as_deref().map(|typed| {
        typed.parse::<Width>().map_err(|error| Failure::input(format!("--width {typed}"), error))
    });
    width.transpose()
}

/// A range, and its unit if it was given with one.
type InUnit = ([f64; 2], Option<&'static str>);

fn range(option: &str, typed: Option<&str>) -> Result<Option<InUnit>, Failure> {
    const UNITS: [Option<(Unit, f64, &str)>; 6] = [
        None,
        Some((Unit::Length, 1e9, "nm")),
        Some((Unit::Time, 1.0, "s")),
        Some((Unit::Force, 1e9, "nN")),
        Some((Unit::Velocity, 1e9, "nm/s")),
        Some((Unit::Rate, 1.0, "1/s")),
    ];
    let Some(typed) = typed else { return Ok(None) };
    let number = |text: &str, unit: Option<(Unit, f64, &str)>| {
        let bare = text.trim().parse::<f64>().ok();
        let value = match unit {
            Some((unit, times, _)) if bare != Some(0.0) => {
                unit.parse(text).ok().map(|value| value * times)
            }
            _ => bare,
        };
        value.filter(|value| value.abs() < 1e100)
    };
    let numbers = typed.split_once(':').and_then(|(low, high)| {
        let in_unit =
            |unit| Some(([number(low, unit)?, number(high, unit)?], unit.map(|(.., name)| name)));
        UNITS.into_iter().find_map(in_unit)
    });
    match numbers {
        Some((range, unit)) if figures::can_be_drawn(range) => Ok(Some((range, unit))),
        Some(([low, high], _)) if low < high => {
            let advice = "the range is too narrow for an axis: HI must be above LO by 1e-12 of the larger of them, and by 1e-100";
            Err(Failure::input(format!("{option} {typed}"), advice))
        }
        _ => {
            let advice =
                "needs two finite numbers LO:HI with LO below HI, such as 400:420 or 3um:6um";
            Err(Failure::input(format!("{option} {typed}"), advice))
        }
    }
}
