//! `stickslip boundary`.

use super::figure::{Figure, undrawn};
use super::model::tip;
use super::progress::Progress;
use crate::arguments::BoundaryArguments;
use crate::failure::{Failure, Typed};
use crate::files::apart::apart;
use crate::files::npz::Npz;
use crate::files::output::{Output, OutputFormat};
use std::f64::consts::PI;
use stickslip_documents::{
    BoundaryDocument, BoundaryParameters, FORMAT_VERSION, OnsetColumns, Software, SpacingName,
};
use stickslip_figures::Size;
use stickslip_stability::{Boundary, Critical, StabilityError};
use stickslip_tip::TipFunction;

const MOST_POINTS: usize = 100_000;

pub(crate) fn boundary(arguments: &BoundaryArguments) -> Result<(), Failure> {
    let format = OutputFormat::of(&arguments.output)?;
    let written = [
        ("--output", Some(&*arguments.output)),
        ("--plot", arguments.plot.as_deref()),
        ("--plot-onset", arguments.plot_onset.as_deref()),
    ];
    apart(&written, &[("--tip-file", arguments.tip.tip_file.as_deref())])?;
    let tip = tip(&arguments.tip)?;
    let range = range(arguments)?;
    let points = arguments.points;
    if !(2..=MOST_POINTS).contains(&points) {
        let message = format!("2 to {MOST_POINTS} will do");
        return Err(Failure::input(format!("--points {points}"), message));
    }
    let output = Output::open("--output", &arguments.output)?;
    let plot = Figure::asked("--plot", arguments.plot.as_deref())?;
    let plot_onset = Figure::asked("--plot-onset", arguments.plot_onset.as_deref())?;

    let document = document(arguments, &tip, range)?;
    if let Some(figure) = plot {
        figure.draw(&document)?;
    }
    if let Some(figure) = plot_onset {
        let onset = stickslip_figures::onset_of(&document).map_err(|error| undrawn(&error))?;
        figure.write(&onset, &Size::default())?;
    }
    write(&document, format, output)
}

fn named(arguments: &BoundaryArguments) -> String {
    let typed: Vec<String> = arguments.r_range.iter().map(|r| Typed(*r).to_string()).collect();
    format!("--r-range {}", typed.join(","))
}

fn range(arguments: &BoundaryArguments) -> Result<[f64; 2], Failure> {
    match *arguments.r_range.as_slice() {
        [low, high] if low > 0.0 && low < high && high.is_finite() => Ok([low, high]),
        _ => {
            let advice = "needs two finite numbers LO,HI above 0, LO below HI, such as 0.05,3";
            Err(Failure::input(named(arguments), advice))
        }
    }
}

/// The r asked for, both ends exactly.
fn abscissas([low, high]: [f64; 2], points: usize, spacing: SpacingName) -> Vec<f64> {
    let last = points - 1;
    let between = |i: usize| {
        let part = i as f64 / last as f64;
        match spacing {
            SpacingName::Linear => low + part * (high - low),
            SpacingName::Logarithmic => low * (high / low).powf(part),
        }
    };
    (0..points).map(|i| if i == last { high } else { between(i) }).collect()
}

fn document(
    arguments: &BoundaryArguments,
    tip: &TipFunction,
    range: [f64; 2],
) -> Result<BoundaryDocument, Failure> {
    let refused = |error: StabilityError| Failure::input(named(arguments), error);
    let spacing =
        if arguments.logarithmic { SpacingName::Logarithmic } else { SpacingName::Linear };
    let boundary = Boundary::new(tip);
    let asked = abscissas(range, arguments.points, spacing);
    let mut progress = Progress::new(0.0, 2.0 * asked.len() as f64).at_every_call();
    let mut done = 0.0;
    let mut found = Vec::with_capacity(asked.len());
    for r in &asked {
        found.push(boundary.at(*r));
        done += 1.0;
        progress.reached(done);
    }
    let first_error = found.iter().find_map(|at| at.err());
    let along: Vec<Critical> = found.into_iter().filter_map(Result::ok).collect();
    if let (true, Some(error)) = (along.is_empty(), first_error) {
        return Err(refused(error));
    }
    let left_out = arguments.points - along.len();
    let branches = boundary.branches(range[0], range[1], arguments.points).map_err(refused)?;
    let mut onset = OnsetColumns::default();
    for at in &along {
        onset.push(tip, at);
        done += 1.0;
        progress.reached(done);
    }
    Ok(BoundaryDocument {
        format: BoundaryDocument::FORMAT.into(),
        format_version: FORMAT_VERSION,
        software: Software::this(),
        parameters: BoundaryParameters {
            tip: tip.into(),
            r_range: range,
            points: arguments.points,
            spacing,
        },
        wave_number: along.iter().map(|at| 2.0 * PI / at.wavelength).collect(),
        r: along.iter().map(|at| at.r).collect(),
        alpha: along.iter().map(|at| at.alpha).collect(),
        onset,
        branches: branches.into_iter().map(Into::into).collect(),
        remarks: first_error
            .map(|error| format!("{left_out} values of r are left out: {error}"))
            .into_iter()
            .collect(),
    })
}

/// Null as NaN, where a column of numbers must hold something.
fn numbers(column: &[Option<f64>]) -> Vec<f64> {
    column.iter().map(|value| value.unwrap_or(f64::NAN)).collect()
}

fn write(document: &BoundaryDocument, format: OutputFormat, output: Output) -> Result<(), Failure> {
    let BoundaryDocument { wave_number, r, alpha, onset, .. } = document;
    match format {
        OutputFormat::Json => output.write_json(document),
        OutputFormat::Csv => output.write_bytes(csv(document).as_bytes()),
        OutputFormat::Npz => {
            let mut npz = Npz::new();
            npz.vector("Omega", wave_number)?;
            npz.vector("r", r)?;
            npz.vector("alpha", alpha)?;
            npz.vector("amplitude_squared_slope", &numbers(&onset.amplitude_squared_slope))?;
            npz.vector("period_slope", &numbers(&onset.period_slope))?;
            npz.vector("lyapunov", &numbers(&onset.lyapunov))?;
            output.write_bytes(&npz.bytes()?)
        }
    }
}

/// An empty cell where there is no value.
fn csv(document: &BoundaryDocument) -> String {
    let BoundaryDocument { wave_number, r, alpha, onset, .. } = document;
    let cell = |value: Option<f64>| value.map(|v| v.to_string()).unwrap_or_default();
    let row = |i: usize| {
        let (amplitude, period) = (onset.amplitude_squared_slope[i], onset.period_slope[i]);
        let (amplitude, period, lyapunov) =
            (cell(amplitude), cell(period), cell(onset.lyapunov[i]));
        format!("{},{},{},{amplitude},{period},{lyapunov}\n", wave_number[i], r[i], alpha[i])
    };
    let heading = "Omega,r,alpha,amplitude_squared_slope,period_slope,lyapunov\n";
    std::iter::once(heading.to_owned()).chain((0..r.len()).map(row)).collect()
}
