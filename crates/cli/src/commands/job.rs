//! What every command has in common: where its result goes is judged before the work; after it, it is drawn, written
//! and told, the same way for all.

use super::fields::Fields;
use super::figure::Figure;
use super::told::Told;
use crate::arguments::{FieldArguments, Format, OutletArguments};
use crate::failure::Failure;
use crate::files::distinct::{Named, distinct};
use crate::files::output::{Output, OutputFormat};
use crate::files::table::{write_csv, write_npz};
use crate::host;
use crate::made::{pictured, plain};
use crate::message::remark_lines;
use crate::sign_of_life;
use schemars::JsonSchema;
use serde::Serialize;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use stickslip::Tabular;
use stickslip_figures::Drawn;

/// What a command makes: a document, its columns, its figure, and words for it.
pub(crate) trait Product: Serialize + JsonSchema + Tabular {
    /// What a person is told.
    fn told(&self) -> Told;
}

/// Refuses, before anything is read, to write over a file that the command reads, or twice to the same.
pub(crate) fn judge_places(
    outlet: &OutletArguments,
    plot: Option<&Path>,
    reads: &[Named],
) -> Result<(), Failure> {
    distinct(&[("--output", Some(&*outlet.output)), ("--plot", plot)], reads)
}

/// Where a result goes, known to be writable.
pub(crate) struct Job {
    output: Output,
    format: Format,
    figure: Option<Figure>,
    fields: Fields,
    is_file: bool,
    /// Whether what was found is said beside a file.
    is_told: bool,
}

impl Job {
    /// The place of a result of type `P`, which is drawn to `plot`.
    ///
    /// # Errors
    /// What cannot be written, or has no such format or field.
    pub(crate) fn open<P: Product>(
        outlet: &OutletArguments,
        plot: Option<&Path>,
    ) -> Result<Self, Failure> {
        let format = format(outlet.format, &outlet.output, "")?;
        Self::of_format::<P>(format, &outlet.output, &outlet.fields, plot)
    }

    /// The same for a command that knows the format.
    pub(crate) fn of_format<P: JsonSchema>(
        format: Format,
        output: &Path,
        fields: &FieldArguments,
        plot: Option<&Path>,
    ) -> Result<Self, Failure> {
        Ok(Self {
            format,
            fields: Fields::asked::<P>(&fields.print)?,
            is_file: output != Path::new("-"),
            is_told: output != Path::new("-"),
            figure: Figure::asked("--plot", plot)?,
            output: Output::open("--output", output)?,
        })
    }

    /// Where it goes, links resolved; `None` for what is no file.
    pub(crate) fn file(&self) -> Option<&Path> {
        self.output.file()
    }

    /// Says nothing beside a file: something else says what was found.
    #[must_use]
    pub(crate) fn silent_if(self, is_silent: bool) -> Self {
        Self { is_told: self.is_told && !is_silent, ..self }
    }

    /// Draws, writes and tells the result.
    pub(crate) fn finish<P: Product + Drawn + Clone + Send + Sync + 'static>(
        self,
        product: P,
    ) -> Result<(), Failure> {
        // The document first: a picture that fails costs no result.
        let told = product.told().in_units(product.physical());
        let figure = self.write_told(&product, &told)?;
        let drawn = figure.map_or(Ok(()), |figure| figure.draw(&product));
        host::give(|| told.of(pictured(product)));
        drawn
    }

    /// Writes and tells a result that is not drawn.
    pub(crate) fn write<P: Product + Clone + Send + Sync + 'static>(
        self,
        product: P,
    ) -> Result<(), Failure> {
        let told = product.told().in_units(product.physical());
        self.write_told(&product, &told)?;
        host::give(|| told.of(plain(product)));
        Ok(())
    }

    /// Writes a result and tells of it what is given; what remains is the figure.
    pub(crate) fn write_told<P: Serialize + Tabular>(
        self,
        product: &P,
        told: &Told,
    ) -> Result<Option<Figure>, Failure> {
        sign_of_life::end();
        // Fields take the place of the document, and a host takes it as it is.
        if self.is_file || (self.fields.is_empty() && !host::is_there()) {
            match self.format {
                Format::Json => self.output.write_json(product)?,
                Format::Csv => write_csv(product, self.output)?,
                Format::Npz => write_npz(product, self.output)?,
                Format::Text => self.output.write_bytes(told.text().as_bytes())?,
            }
        }
        after(product, told, &self.fields, self.is_told)?;
        Ok(self.figure)
    }

    /// Draws and tells a result of which these bytes are written.
    pub(crate) fn finish_bytes<P: Product + Drawn + Clone + Send + Sync + 'static>(
        mut self,
        bytes: &[u8],
        product: P,
    ) -> Result<(), Failure> {
        let figure = self.figure.take();
        let told = product.told().in_units(product.physical());
        self.output.write_bytes(bytes)?;
        after(&product, &told, &self.fields, self.is_told)?;
        let drawn = figure.map_or(Ok(()), |figure| figure.draw(&product));
        host::give(|| told.of(pictured(product)));
        drawn
    }
}

/// What follows the document: fields on standard output, and beside a file what was found.
pub(crate) fn after(
    product: &impl Serialize,
    told: &Told,
    fields: &Fields,
    is_told: bool,
) -> Result<(), Failure> {
    if !fields.is_empty() {
        let text = fields.of(product)?;
        let done = io::stdout().lock().write_all(text.as_bytes());
        done.map_err(|error| Failure::Write { target: "standard output".into(), error })?;
    }
    // A host has the result itself.
    if is_told && !host::is_there() {
        remark_lines(&told.in_short());
    }
    Ok(())
}

/// The format asked for, or that of the file's extension, `more` of which the command has itself.
pub(crate) fn format(asked: Option<Format>, output: &Path, more: &str) -> Result<Format, Failure> {
    if let Some(format) = asked {
        return Ok(format);
    }
    if output == Path::new("-") {
        return Ok(on_standard_output());
    }
    Ok(match OutputFormat::or_also(output, more)? {
        OutputFormat::Json => Format::Json,
        OutputFormat::Csv => Format::Csv,
        OutputFormat::Npz => Format::Npz,
    })
}

/// Text for a person, JSON for a program.
pub(crate) fn on_standard_output() -> Format {
    if io::stdout().is_terminal() && !host::is_there() { Format::Text } else { Format::Json }
}
