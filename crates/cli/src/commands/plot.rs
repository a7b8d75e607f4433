//! `stickslip plot`.

#[cfg(feature = "animation")]
mod animation;

use super::figure::{Figure, undrawn};
use super::in_units::scales;
use crate::arguments::PlotArguments;
use crate::failure::Failure;
use crate::files::distinct::distinct;
use crate::files::input::{open, read_document};
use std::path::Path;
use stickslip::{BoundaryDocument, FigureDocument};
use stickslip_figures::{self as figures, AnimationFormat, FigureError, Size, View, Width};

pub(crate) fn plot(arguments: &PlotArguments) -> Result<(), Failure> {
    if let Some(format) = AnimationFormat::of(&arguments.output) {
        return animate(arguments, format);
    }
    let of_animations = [
        ("--times", arguments.times.is_some()),
        ("--seconds", arguments.seconds.is_some()),
        ("--fps", arguments.fps.is_some()),
    ];
    if let Some((option, _)) = of_animations.into_iter().find(|(_, given)| *given) {
        let why = "belongs to an animation: name the output .gif, .webp or .apng, or leave it out";
        return Err(Failure::input(option, why));
    }
    let size = size(arguments)?;
    let view = View {
        x_range: range("--x-range", arguments.x_range.as_deref())?,
        y_range: range("--y-range", arguments.y_range.as_deref())?,
        scales: None,
    };
    let units = ("--units", arguments.in_units.units.as_deref());
    let read = [("DOCUMENT.json", Some(&*arguments.document)), units];
    distinct(&[("--output", Some(&*arguments.output))], &read)?;
    let output = Figure::at("--output", &arguments.output)?;
    output.write(&figure(arguments, &view)?, &size)
}

#[cfg(feature = "animation")]
fn animate(arguments: &PlotArguments, format: AnimationFormat) -> Result<(), Failure> {
    animation::write(arguments, format)
}

#[cfg(not(feature = "animation"))]
fn animate(arguments: &PlotArguments, _: AnimationFormat) -> Result<(), Failure> {
    let option = format!("--output {}", arguments.output.display());
    Err(Failure::input(option, FigureError::Missing("animations", "animation")))
}

fn figure(arguments: &PlotArguments, view: &View) -> Result<FigureDocument, Failure> {
    let option = "DOCUMENT.json";
    let path: &Path = &arguments.document;
    let named = || format!("{option} {}", path.display());
    let refused = |error: FigureError| match error {
        FigureError::Damaged(_) | FigureError::Nothing(_) => Failure::input(named(), error),
        error => undrawn(&error),
    };
    if arguments.onset {
        let option = format!("--onset with {option}");
        let document: BoundaryDocument = read_document(&option, path, BoundaryDocument::FORMAT)?;
        let view = View { scales: scales(&arguments.in_units, None, None)?, ..*view };
        return figures::onset_of(&document, &view).map_err(refused);
    }
    let document =
        figures::saved(open(option, path)?).map_err(|error| Failure::input(named(), error))?;
    // With the velocity of the support times need the one r of what is drawn.
    let r = match &arguments.in_units.velocity {
        Some(_) => figures::of(&*document, view).map_err(refused)?.one_r(),
        None => None,
    };
    let view = View { scales: scales(&arguments.in_units, None, r)?, ..*view };
    figures::of(&*document, &view).map_err(refused)
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

fn range(option: &str, typed: Option<&str>) -> Result<Option<[f64; 2]>, Failure> {
    let Some(typed) = typed else { return Ok(None) };
    let numbers = typed.split_once(':').and_then(|(low, high)| {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.abs() < 1e100);
        Some([number(low)?, number(high)?])
    });
    match numbers {
        Some(range) if figures::can_be_drawn(range) => Ok(Some(range)),
        Some([low, high]) if low < high => {
            let advice = "the range is too narrow for an axis: HI must be above LO by 1e-12 of the larger of them, and by 1e-100";
            Err(Failure::input(format!("{option} {typed}"), advice))
        }
        _ => {
            let advice = "needs two finite numbers LO:HI with LO below HI, such as 400:420";
            Err(Failure::input(format!("{option} {typed}"), advice))
        }
    }
}
