//! Output that grows line by line during the work.

use super::beside;
use super::journal::Journal;
use super::place::{Place, Target, place, refused};
use super::replace::{Permissions, sync_folder};
use crate::failure::Failure;
use std::fs::{self, File};
use std::io::{self, BufWriter, Stdout, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use stickslip::{Mark, RunLine};

/// Lines of output. A file grows as `FILE.part` and gets its name when it is complete: until then an older file of
/// that name remains, and no reader sees an incomplete one.
pub(crate) struct Stream {
    sink: Sink,
    line: Vec<u8>,
    flushed: Instant,
}

enum Sink {
    Stdout(BufWriter<Stdout>),
    Special(PathBuf, BufWriter<File>),
    Part(Part),
}

struct Part {
    journal: Journal,
    part: PathBuf,
    target: Target,
    /// Whether the part stays when the work fails, because a checkpoint can resume it.
    is_kept: bool,
}

/// Largest delay until written lines are visible to others.
const PATIENCE: Duration = Duration::from_secs(1);

/// Beginning of the first line.
const MAGIC: &[u8] = b"{\"format\":\"stickslip/run-lines\"";

/// The name of a growing file.
pub(crate) fn part_of(target: &Path) -> PathBuf {
    beside::with(target, ".part")
}

impl Stream {
    /// Opens the output (`-`: standard output) that `option` named.
    pub(crate) fn open(option: &str, path: &Path, is_kept: bool) -> Result<Self, Failure> {
        let sink = match place(option, path)? {
            Place::Stdout => Sink::Stdout(BufWriter::new(io::stdout())),
            Place::Special(file) => Sink::Special(path.into(), BufWriter::new(file)),
            Place::File(target) => {
                let part = part_of(target.path());
                let journal = Journal::create(&part, MAGIC, &Permissions::of(target.path()));
                let journal = journal.map_err(|error| refused(option, path, &error))?;
                Sink::Part(Part { journal, part, target, is_kept })
            }
        };
        Ok(Self::through(sink))
    }

    /// Resumes a file with the content of the mark: its part, or a copy of the beginning of another file, such as the
    /// final file of an interrupted run.
    pub(crate) fn resume(target: Target, mark: Mark, others: &[PathBuf]) -> Result<Self, Failure> {
        let part = part_of(target.path());
        let mut journal = Journal::resume(&part, MAGIC, mark);
        for other in others {
            let is_another = |error: &io::Error| error.kind() == io::ErrorKind::WouldBlock;
            if journal.is_ok() || journal.as_ref().is_err_and(is_another) {
                break;
            }
            if let Ok(file) = File::open(other) {
                journal = Journal::copy(&file, &part, MAGIC, mark);
            }
        }
        let journal = journal.map_err(|error| {
            if error.kind() == io::ErrorKind::WouldBlock {
                return refused("--output", target.path(), &error);
            }
            let names = [&part].into_iter().chain(others).map(|path| path.display().to_string());
            let files = names.collect::<Vec<_>>().join(" nor ");
            Failure::Run(format!("cannot continue the output, neither from {files}: {error}"))
        })?;
        Ok(Self::through(Sink::Part(Part { journal, part, target, is_kept: true })))
    }

    fn through(sink: Sink) -> Self {
        Self { sink, line: vec![], flushed: Instant::now() }
    }

    /// Whether the output can be truncated to a mark.
    pub(crate) fn is_file(&self) -> bool {
        matches!(self.sink, Sink::Part(_))
    }

    /// Keeps an incomplete file under the name of its part.
    pub(crate) fn keep_part(&mut self) -> Option<&Path> {
        let Sink::Part(part) = &mut self.sink else { return None };
        part.is_kept = true;
        Some(&part.part)
    }

    /// Writes a line of JSON.
    pub(crate) fn line(&mut self, line: &RunLine) -> Result<(), Failure> {
        self.line.clear();
        line.append_to(&mut self.line).map_err(Failure::run)?;
        self.line.push(b'\n');
        let out: &mut dyn Write = match &mut self.sink {
            Sink::Stdout(out) => out,
            Sink::Special(_, out) => out,
            Sink::Part(part) => &mut part.journal,
        };
        let mut done = out.write_all(&self.line);
        if done.is_ok() && self.flushed.elapsed() > PATIENCE {
            done = out.flush();
            self.flushed = Instant::now();
        }
        done.map_err(|error| self.failed(error))
    }

    /// Writes all lines to the disk and returns their mark.
    pub(crate) fn sync(&mut self) -> Result<Mark, Failure> {
        let done = match &mut self.sink {
            Sink::Part(part) => part.journal.sync(),
            Sink::Stdout(out) => out.flush().map(|()| Mark::default()),
            Sink::Special(_, out) => out.flush().map(|()| Mark::default()),
        };
        done.map_err(|error| self.failed(error))
    }

    /// Completes the file and gives it its name.
    pub(crate) fn finish(mut self) -> Result<(), Failure> {
        self.sync()?;
        let Sink::Part(part) = &mut self.sink else { return Ok(()) };
        let done = fs::rename(&part.part, part.target.path());
        if done.is_ok() {
            part.is_kept = true;
            sync_folder(part.target.path());
        }
        done.map_err(|error| self.failed(error))
    }

    fn failed(&self, error: io::Error) -> Failure {
        match &self.sink {
            Sink::Stdout(_) if error.kind() == io::ErrorKind::BrokenPipe => {
                Failure::Run("standard output was closed before the end: the rest is lost".into())
            }
            Sink::Stdout(_) => Failure::Write { target: "standard output".into(), error },
            Sink::Special(path, _) => Failure::writing(path, error),
            Sink::Part(part) => Failure::writing(&part.part, error),
        }
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        if !self.is_kept {
            // Nothing more can be done about a file that does not go away.
            fs::remove_file(&self.part).ok();
        }
    }
}
