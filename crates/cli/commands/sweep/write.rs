//! A sweep on its way out: JSON, columns, picture.

use crate::commands::figure::Figure;
use crate::failure::Failure;
use crate::files::npz::Npz;
use crate::files::output::{Output, OutputFormat};
use std::path::Path;
use stickslip_documents::{SweepDocument, SweepParameters, SweepPoint};
use stickslip_figures::judge_sweep;

/// Where it goes, known to be writable.
pub(super) struct Writer {
    format: OutputFormat,
    output: Output,
    figure: Option<Figure>,
}

/// A column of a table, and the name that heads it.
type Column = (&'static str, fn(&SweepPoint) -> Option<f64>);

const COLUMNS: [Column; 10] = [
    ("beta", |p| p.beta),
    ("r", |p| Some(p.r)),
    ("alpha", |p| p.alpha),
    ("critical_alpha", |p| p.critical_alpha),
    ("period", |p| p.period),
    ("wavelength", |p| p.wavelength),
    ("amplitude_x0", |p| p.amplitude_x0),
    ("amplitude_u", |p| p.amplitude_u),
    ("slips", |p| p.slips.map(|slips| slips as f64)),
    ("multiplier", |p| p.multiplier),
];

impl Writer {
    /// Finds out, before hours of work, whether it can go there, and reserves the place.
    pub(super) fn asked(
        output: &Path,
        plot: Option<&Path>,
        parameters: &SweepParameters,
    ) -> Result<Self, Failure> {
        if plot.is_some() {
            judge_sweep(parameters).map_err(|error| Failure::input("--plot", error))?;
        }
        Ok(Self {
            format: OutputFormat::of(output)?,
            output: Output::open("--output", output)?,
            figure: Figure::asked("--plot", plot)?,
        })
    }

    /// The file that it goes to; `None` for a pipe, say.
    pub(super) fn file(&self) -> Option<&Path> {
        self.output.file()
    }

    pub(super) fn write(self, document: &SweepDocument) -> Result<(), Failure> {
        match self.format {
            OutputFormat::Json => self.output.write_json(document),
            OutputFormat::Csv => self.output.write_bytes(csv(&document.points).as_bytes()),
            OutputFormat::Npz => self.output.write_bytes(&npz(&document.points)?),
        }?;
        match self.figure {
            Some(figure) => figure.draw(document),
            None => Ok(()),
        }
    }
}

/// An empty cell where there is no value.
fn csv(points: &[SweepPoint]) -> String {
    let names: Vec<&str> = COLUMNS.iter().map(|(name, _)| *name).collect();
    let row = |point: &SweepPoint| {
        let cell = |(_, value): &Column| value(point).map(|v| v.to_string()).unwrap_or_default();
        let cells: Vec<String> = COLUMNS.iter().map(cell).collect();
        let regime = point.regime.map(|regime| regime.to_string()).unwrap_or_default();
        let source = point.source.map(|source| source.to_string()).unwrap_or_default();
        format!("{},{regime},{source}\n", cells.join(","))
    };
    let heading = format!("{},regime,source\n", names.join(","));
    std::iter::once(heading).chain(points.iter().map(row)).collect()
}

/// NaN where there is no value; regimes by number, 0 steady, 1 stick-slip, 2 trapped, 3 transient.
fn npz(points: &[SweepPoint]) -> Result<Vec<u8>, Failure> {
    let mut npz = Npz::new();
    for (name, value) in COLUMNS {
        let column: Vec<f64> = points.iter().map(|p| value(p).unwrap_or(f64::NAN)).collect();
        npz.vector(name, &column)?;
    }
    let number = |p: &SweepPoint| p.regime.map_or(f64::NAN, |regime| f64::from(regime as u8));
    npz.vector("regime", &points.iter().map(number).collect::<Vec<_>>())?;
    npz.bytes()
}
