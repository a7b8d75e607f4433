//! `--plot`: its format and place are checked before the computation; the figure is drawn after it.

use crate::failure::Failure;
use crate::files::output::Output;
use std::path::Path;
use stickslip::FigureDocument;
use stickslip_figures::{self as figures, Drawn, FigureError, FigureFormat, Size, View};

/// A requested figure.
#[derive(Debug)]
pub(super) struct Figure {
    format: FigureFormat,
    output: Output,
}

impl Figure {
    /// The figure for `option`, if it was given.
    pub(super) fn of_option(option: &str, path: Option<&Path>) -> Result<Option<Self>, Failure> {
        path.map(|path| Self::at(option, path)).transpose()
    }

    /// The figure with that file name.
    pub(super) fn at(option: &str, path: &Path) -> Result<Self, Failure> {
        let format = FigureFormat::of(path).map_err(|error| Failure::file(option, path, error))?;
        Ok(Self { format, output: Output::open(option, path)? })
    }

    /// Draws a document as `stickslip plot` does.
    pub(super) fn draw(self, document: &dyn Drawn) -> Result<(), Failure> {
        let figure = figures::of(document, &View::default()).map_err(|e| drawing_failure(&e))?;
        self.write(&figure, &Size::default())
    }

    /// Writes a figure in the requested format.
    pub(super) fn write(self, figure: &FigureDocument, size: &Size) -> Result<(), Failure> {
        let bytes = figures::draw(figure, self.format, size).map_err(|e| drawing_failure(&e))?;
        self.output.write_bytes(&bytes)
    }
}

/// The error of a figure that failed after the computation.
pub(super) fn drawing_failure(error: &FigureError) -> Failure {
    Failure::Run(format!("cannot draw: {error}"))
}
