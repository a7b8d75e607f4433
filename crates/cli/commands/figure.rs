//! `--plot`: its format and its place judged before the work, drawn after it.

use crate::failure::Failure;
use crate::files::output::Output;
use crate::plot::{self, PlotFormat};
use std::path::Path;

/// A figure asked for.
#[derive(Debug)]
pub(super) struct Figure {
    format: PlotFormat,
    output: Output,
}

impl Figure {
    /// The figure that `option` named, if it did.
    pub(super) fn asked(option: &str, path: Option<&Path>) -> Result<Option<Self>, Failure> {
        let Some(path) = path else { return Ok(None) };
        let format = PlotFormat::of(path)
            .map_err(|error| Failure::input(format!("{option} {}", path.display()), error))?;
        Ok(Some(Self { format, output: Output::open(option, path)? }))
    }

    /// Writes an SVG document as what was asked for.
    pub(super) fn write(self, svg: &str) -> Result<(), Failure> {
        let bytes = plot::encode(svg, self.format)
            .map_err(|error| Failure::Run(format!("cannot draw: {error}")))?;
        self.output.write_bytes(&bytes)
    }
}
