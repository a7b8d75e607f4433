//! The common frame of all commands: the output is checked before the computation; after it, the result is drawn,
//! written and summarised.

use super::fields::Fields;
use super::figure::Figure;
use super::summary::Summary;
use crate::arguments::{FieldArguments, Format, OutletArguments};
use crate::failure::Failure;
use crate::files::distinct::{Named, distinct};
use crate::files::output::{Output, format_of};
use crate::files::table::{write_arrays, write_csv};
use crate::session::Session;
use crate::sign_of_life;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use stickslip::Tabular;
use stickslip_figures::Drawn;
use stickslip_saved::{Document, Saved, Writable};

/// The result of a command: a document with columns, a figure and a summary.
pub(crate) trait Product: Saved + Drawn {
    /// The summary for the user.
    fn summary(&self) -> Summary;
}

/// Rejects an output that is also an input of the command, or that is named twice.
pub(crate) fn judge_places(
    outlet: &OutletArguments,
    plot: Option<&Path>,
    reads: &[Named],
) -> Result<(), Failure> {
    distinct(&[("--output", Some(&*outlet.output)), ("--plot", plot)], reads)
}

/// The output of a command, known to be writable.
pub(crate) struct Job {
    session: Session,
    output: Output,
    format: Format,
    figure: Option<Figure>,
    fields: Fields,
    is_file: bool,
    /// Whether a summary is printed when the result goes to a file.
    has_summary: bool,
}

impl Job {
    /// The output for a document of this format, with its figure at `plot`.
    pub(crate) fn open(
        session: &Session,
        document: &str,
        outlet: &OutletArguments,
        plot: Option<&Path>,
    ) -> Result<Self, Failure> {
        let format = format(session, outlet.format, &outlet.output, "")?;
        Self::of_format(session, document, format, &outlet.output, &outlet.fields, plot)
    }

    /// The output in the given format, with its figure at `plot`.
    pub(crate) fn of_format(
        session: &Session,
        document: &str,
        format: Format,
        output: &Path,
        fields: &FieldArguments,
        plot: Option<&Path>,
    ) -> Result<Self, Failure> {
        Ok(Self {
            session: session.clone(),
            format,
            fields: Fields::of_document(document, &fields.print)?,
            is_file: output != Path::new("-"),
            has_summary: output != Path::new("-"),
            figure: Figure::of_option("--plot", plot)?,
            output: Output::open("--output", output)?,
        })
    }

    /// The output file, with links resolved; `None` for a stream or device.
    pub(crate) fn file(&self) -> Option<&Path> {
        self.output.file()
    }

    /// Sets the number of threads that write a large document.
    #[must_use]
    pub(crate) fn on_threads(self, threads: usize) -> Self {
        Self { output: self.output.on_threads(threads), ..self }
    }

    /// Suppresses the summary when the result goes to a file, because it is printed elsewhere.
    #[must_use]
    pub(crate) fn silent_if(self, is_silent: bool) -> Self {
        Self { has_summary: self.has_summary && !is_silent, ..self }
    }

    /// Draws and writes the result, and prints the summary.
    pub(crate) fn finish(self, product: impl Product) -> Result<(), Failure> {
        let summary = self.summary(&product);
        self.finish_with(Box::new(product), summary)
    }

    /// The summary if anyone sees it, else an empty one: a short command takes a thirtieth of its time for it.
    fn summary(&self, product: &impl Product) -> Summary {
        if self.has_summary || self.format == Format::Text || self.session.has_host() {
            product.summary().in_units(product.physical())
        } else {
            Summary::default()
        }
    }

    fn finish_with(self, document: Box<dyn Document>, summary: Summary) -> Result<(), Failure> {
        let session = self.session.clone();
        // The document first: a picture that fails costs no result.
        let figure = self.write_with(&*document, document.drawn(), &summary)?;
        let drawn = figure.map_or(Ok(()), |figure| figure.draw(document.drawn()));
        session.give(|| summary.of(document));
        drawn
    }

    /// Writes a result, as a document or as this table, and prints the summary; returns the figure still to be drawn.
    pub(crate) fn write_with(
        self,
        document: &dyn Writable,
        table: &dyn Tabular,
        summary: &Summary,
    ) -> Result<Option<Figure>, Failure> {
        sign_of_life::end();
        // Fields take the place of the document, and a host takes it as it is.
        if self.is_file || (self.fields.is_empty() && !self.session.has_host()) {
            match self.format {
                Format::Json => self.output.write_json(document)?,
                Format::Csv => write_csv(table, self.output)?,
                Format::Npz => write_arrays(table, self.output)?,
                Format::Text => self.output.write_bytes(summary.text().as_bytes())?,
            }
        }
        after(&self.session, document.serialized(), summary, &self.fields, self.has_summary)?;
        Ok(self.figure)
    }

    /// Draws a result that was already written as these bytes, and prints the summary.
    pub(crate) fn finish_bytes(
        mut self,
        bytes: &[u8],
        product: impl Product,
    ) -> Result<(), Failure> {
        let figure = self.figure.take();
        let summary = self.summary(&product);
        self.output.write_bytes(bytes)?;
        after(&self.session, product.serialized(), &summary, &self.fields, self.has_summary)?;
        let drawn = figure.map_or(Ok(()), |figure| figure.draw(&product));
        self.session.give(|| summary.of(Box::new(product)));
        drawn
    }
}

/// Output after the document: requested fields on standard output, or the summary if the result went to a file.
pub(crate) fn after(
    session: &Session,
    document: &dyn erased_serde::Serialize,
    summary: &Summary,
    fields: &Fields,
    has_summary: bool,
) -> Result<(), Failure> {
    if !fields.is_empty() {
        let text = fields.of(document)?;
        let done = io::stdout().lock().write_all(text.as_bytes());
        done.map_err(|error| Failure::Write { target: "standard output".into(), error })?;
    }
    // A host has the result itself.
    if has_summary && !session.has_host() {
        summary.in_short().lines().for_each(|line| session.remark(line));
    }
    Ok(())
}

/// The format requested, or that of the file's extension; `more` lists further extensions of the command.
pub(crate) fn format(
    session: &Session,
    asked: Option<Format>,
    output: &Path,
    more: &str,
) -> Result<Format, Failure> {
    if let Some(format) = asked {
        return Ok(format);
    }
    if output == Path::new("-") {
        return Ok(on_standard_output(session));
    }
    format_of(output, more)
}

/// The default format on standard output: text on a terminal, JSON otherwise.
pub(crate) fn on_standard_output(session: &Session) -> Format {
    if io::stdout().is_terminal() && !session.has_host() { Format::Text } else { Format::Json }
}
