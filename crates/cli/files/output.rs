//! Results on their way out: their places are judged before the work, and take their names when complete.

use super::temporary::{beside, may_be_made_in, remove_left_behind};
use crate::failure::Failure;
use serde::Serialize;
use std::fs::{File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

/// What is written, by the extension of the file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum OutputFormat {
    Json,
    Csv,
    Npz,
}

impl OutputFormat {
    /// # Errors
    /// An extension that none of the formats has.
    pub(crate) fn of(path: &Path) -> Result<Self, Failure> {
        Self::or_also(path, "")
    }

    /// For a command that has an extension `more`, such as ", .gsf", which it has looked for itself.
    ///
    /// # Errors
    /// An extension that none of the formats has.
    pub(crate) fn or_also(path: &Path, more: &str) -> Result<Self, Failure> {
        if path == Path::new("-") {
            return Ok(Self::Json);
        }
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("json") => Ok(Self::Json),
            Some("csv") => Ok(Self::Csv),
            Some("npz") => Ok(Self::Npz),
            _ if is_special(path) => Ok(Self::Json),
            _ => Err(Failure::input(
                format!("--output {}", path.display()),
                format!(
                    "the extension says what is written: .json, .csv{more} or .npz will do, or - for JSON on \
                     standard output"
                ),
            )),
        }
    }
}

/// A place to write to, known to be writable.
#[derive(Debug)]
pub(crate) struct Output {
    path: PathBuf,
    sink: Sink,
}

#[derive(Debug)]
enum Sink {
    Stdout,
    /// A device or a pipe, written to as it is.
    Special(File),
    /// A file: written beside itself and renamed once it is complete. A reader never sees half a
    /// document, and a failure leaves what was there before.
    Named,
}

/// What a name on the command line stands for.
pub(crate) enum Place {
    Stdout,
    /// A device or a pipe.
    Special(File),
    /// A file that is there and can be written, or that may be made.
    File(PathBuf),
}

/// Finds out, before the work, whether the place that `option` named (`-`: standard output) can be
/// written.
pub(crate) fn place(option: &str, path: &Path) -> Result<Place, Failure> {
    writable(path).map_err(|error| refused(option, path, &error))
}

pub(super) fn refused(option: &str, path: &Path, error: &io::Error) -> Failure {
    let advice = "choose a place that exists and can be written to";
    let said = match error.kind() {
        io::ErrorKind::NotFound if folder_of(path).is_dir() => "no file can be made there".into(),
        io::ErrorKind::NotFound => "there is no such folder".into(),
        kind => kind.to_string(),
    };
    Failure::input(format!("{option} {}", path.display()), format!("{said}; {advice}"))
}

fn writable(path: &Path) -> io::Result<Place> {
    if path == Path::new("-") {
        return Ok(Place::Stdout);
    }
    if is_special(path) {
        return OpenOptions::new().write(true).open(path).map(Place::Special);
    }
    if path.is_dir() || path.as_os_str().as_encoded_bytes().ends_with(b"/") {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    // A name that is too long, say, is no name that a file can get later.
    match path.symlink_metadata() {
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    // The file itself where the name is a link.
    let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
    if path.exists() {
        OpenOptions::new().write(true).open(&path)?;
    }
    Ok(Place::File(path))
}

/// The folder of a file.
fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Puts on the disk that a file has got its name. Not every system can sync a folder: then the name is as
/// safe as that system makes it.
pub(super) fn sync_folder(path: &Path) {
    File::open(folder_of(path)).and_then(|folder| folder.sync_all()).ok();
}

/// Writes a file in one go: at any time its name stands for what was there before or for all of the new.
pub(crate) fn replace(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut new = path.as_os_str().to_owned();
    new.push(".new");
    let done = File::create(&new)
        .and_then(|file| through(&file, write).and_then(|()| file.sync_all()))
        .and_then(|()| std::fs::rename(&new, path));
    if done.is_err() {
        std::fs::remove_file(&new).ok();
    }
    sync_folder(path);
    done
}

impl Output {
    /// Finds the file (`-`: standard output) that `option` named, and whether it can be written.
    ///
    /// # Errors
    /// It cannot be written.
    pub(crate) fn open(option: &str, path: &Path) -> Result<Self, Failure> {
        let sink = match place(option, path)? {
            Place::Stdout => Sink::Stdout,
            Place::Special(file) => Sink::Special(file),
            Place::File(target) => {
                may_be_made_in(folder_of(&target))
                    .map_err(|error| refused(option, path, &error))?;
                return Ok(Self { path: target, sink: Sink::Named });
            }
        };
        Ok(Self { path: path.into(), sink })
    }

    /// Writes the document as JSON, with a line break at its end.
    pub(crate) fn write_json(self, document: &impl Serialize) -> Result<(), Failure> {
        self.write_with(|out| {
            serde_json::to_writer(&mut *out, document)?;
            out.write_all(b"\n")
        })
    }

    /// Writes bytes.
    pub(crate) fn write_bytes(self, bytes: &[u8]) -> Result<(), Failure> {
        self.write_with(|out| out.write_all(bytes))
    }

    /// Writes columns of equal length as CSV under their headings.
    pub(crate) fn write_csv(self, headings: &str, columns: &[&[f64]]) -> Result<(), Failure> {
        self.write_with(|out| {
            writeln!(out, "{headings}")?;
            let rows = columns.iter().map(|c| c.len()).min().unwrap_or(0);
            let mut line = String::new();
            for row in 0..rows {
                line.clear();
                for column in columns {
                    line.push_str(if line.is_empty() { "" } else { "," });
                    line.push_str(&column[row].to_string());
                }
                line.push('\n');
                out.write_all(line.as_bytes())?;
            }
            Ok(())
        })
    }

    /// Writes what the function writes, through a buffer.
    pub(crate) fn write_with(
        self,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let target = match self.sink {
            Sink::Stdout => "standard output".into(),
            _ => self.path.display().to_string(),
        };
        let done = match self.sink {
            Sink::Stdout => through(io::stdout().lock(), write),
            Sink::Special(file) => through(file, write),
            Sink::Named => named(&self.path, write),
        };
        done.map_err(|error| Failure::Write { target, error })
    }
}

/// Writes a file under a temporary name, and gives it its own.
fn named(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut file = beside(path, folder_of(path))?;
    through(file.as_file_mut(), write)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    sync_folder(path);
    remove_left_behind(path, folder_of(path));
    Ok(())
}

fn through(
    sink: impl Write,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut buffered = BufWriter::new(sink);
    write(&mut buffered)?;
    buffered.flush()
}

/// Whether the path is a device or a pipe, which must not be renamed over.
fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir())
}
