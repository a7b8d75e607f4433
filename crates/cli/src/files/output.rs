//! Output files: places are checked before the computation, and files get their names when complete.

use super::place::{Place, place};
use super::special::{is_special, stdout};
use super::temporary::kept_elsewhere;
use super::temporary::through;
use crate::arguments::Format;
use crate::failure::Failure;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use stickslip_saved::Writable;

/// The format of an output by its extension. For the error message, `more` names extensions that the command handles itself,
/// such as ", .gsf".
pub(crate) fn format_of(path: &Path, more: &str) -> Result<Format, Failure> {
    if path == Path::new("-") {
        return Ok(Format::Json);
    }
    match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("json") => Ok(Format::Json),
        Some("csv") => Ok(Format::Csv),
        Some("npz") => Ok(Format::Npz),
        _ if is_special(path) => Ok(Format::Json),
        _ => Err(Failure::file(
            "--output",
            path,
            format!(
                "the extension gives the format: it must be .json, .csv{more} or .npz, or - for JSON on \
                 standard output"
            ),
        )),
    }
}

/// A writable output, locked until this is dropped.
#[derive(Debug)]
pub(crate) struct Output {
    path: PathBuf,
    place: Place,
    threads: usize,
}

impl Output {
    /// Opens the output (`-`: standard output) that `option` named, and checks that it can be written.
    pub(crate) fn open(option: &str, path: &Path) -> Result<Self, Failure> {
        Ok(Self { path: path.into(), place: place(option, path)?, threads: 1 })
    }

    /// Sets the number of threads.
    pub(crate) fn on_threads(self, threads: usize) -> Self {
        Self { threads, ..self }
    }

    /// The output file, with links resolved; `None` for a stream or device.
    pub(crate) fn file(&self) -> Option<&Path> {
        match &self.place {
            Place::File(target) => Some(target.path()),
            Place::Stdout | Place::Special(_) => None,
        }
    }

    /// Writes the document as JSON, followed by a line break.
    pub(crate) fn write_json(self, document: &dyn Writable) -> Result<(), Failure> {
        let threads = self.threads;
        self.write_with(|out| {
            document.write(out, threads)?;
            out.write_all(b"\n")
        })
    }

    pub(crate) fn write_bytes(self, bytes: &[u8]) -> Result<(), Failure> {
        self.write_with(|out| out.write_all(bytes))
    }

    /// Writes the output of a function, through a buffer. If the file cannot be written, the result, which may have
    /// taken hours, is saved elsewhere.
    pub(crate) fn write_with(
        self,
        write: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        self.write_through(&write)
    }

    fn write_through(
        self,
        write: &dyn Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let (target, done) = match &self.place {
            Place::Stdout => {
                ("standard output".into(), stdout().and_then(|out| through(out, write)))
            }
            Place::Special(file) => (self.path.display().to_string(), through(file, write)),
            Place::File(target) => (self.path.display().to_string(), target.replace(write)),
        };
        let Err(error) = done else { return Ok(()) };
        match self.file().and_then(|path| kept_elsewhere(path, write)) {
            Some(kept) => {
                Err(Failure::Elsewhere { target, error, kept: kept.display().to_string() })
            }
            None => Err(Failure::Write { target, error }),
        }
    }
}
