//! `stickslip plot`.

use super::figure::{Figure, undrawn};
use crate::arguments::PlotArguments;
use crate::failure::Failure;
use crate::files::distinct::distinct;
use crate::files::input::{open, read_document};
use std::path::Path;
use stickslip_documents::{BoundaryDocument, FigureDocument};
use stickslip_figures::{self as figures, FigureError, Size, View, Width};

pub(crate) fn plot(arguments: &PlotArguments) -> Result<(), Failure> {
    let size = size(arguments)?;
    let view = View {
        x_range: range("--x-range", arguments.x_range.as_deref())?,
        y_range: range("--y-range", arguments.y_range.as_deref())?,
    };
    let read = [("DOCUMENT.json", Some(&*arguments.document))];
    distinct(&[("--output", Some(&*arguments.output))], &read)?;
    let output = Figure::at("--output", &arguments.output)?;
    output.write(&figure(arguments, &view)?, &size)
}

fn figure(arguments: &PlotArguments, view: &View) -> Result<FigureDocument, Failure> {
    let option = "DOCUMENT.json";
    let path: &Path = &arguments.document;
    let named = || format!("{option} {}", path.display());
    let figure = if arguments.onset {
        let option = format!("--onset with {option}");
        figures::onset_of(&read_document::<BoundaryDocument>(
            &option,
            path,
            BoundaryDocument::FORMAT,
        )?)
    } else {
        let saved = figures::saved(open(option, path)?);
        figures::of(&*saved.map_err(|error| Failure::input(named(), error))?, view)
    };
    figure.map_err(|error| match error {
        FigureError::Damaged(_) | FigureError::Nothing(_) => Failure::input(named(), error),
        error => undrawn(&error),
    })
}

fn size(arguments: &PlotArguments) -> Result<Size, Failure> {
    let width = arguments.width.as_deref().map(|typed| {
        typed.parse::<Width>().map_err(|error| Failure::input(format!("--width {typed}"), error))
    });
    Size::new(width.transpose()?, arguments.dpi)
        .map_err(|error| Failure::input(format!("--dpi {}", arguments.dpi.unwrap_or(0.0)), error))
}

fn range(option: &str, typed: Option<&str>) -> Result<Option<[f64; 2]>, Failure> {
    let Some(typed) = typed else { return Ok(None) };
    let numbers = typed.split_once(':').and_then(|(low, high)| {
        let number = |text: &str| text.trim().parse::<f64>().ok().filter(|v| v.abs() < 1e100);
        Some([number(low)?, number(high)?])
    });
    match numbers {
        Some([low, high]) if low < high => Ok(Some([low, high])),
        _ => {
            let advice = "needs two finite numbers LO:HI with LO below HI, such as 400:420";
            Err(Failure::input(format!("{option} {typed}"), advice))
        }
    }
}
