//! Check of the outputs on the command line, before the computation.

use super::lock::Lock;
use super::paths::{folder_of, resolved};
use super::replace::{Permissions, replace};
use super::special::{self, is_special};
use super::temporary::may_be_made_in;
use crate::failure::Failure;
use std::fs::{File, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// The kind of an output.
#[derive(Debug)]
pub(crate) enum Place {
    Stdout,
    /// A device or a pipe, written to directly.
    Special(File),
    File(Target),
}

/// An existing writable file, or one that can be created; locked until this is dropped.
#[derive(Debug)]
pub(crate) struct Target {
    path: PathBuf,
    _lock: Lock,
}

impl Target {
    /// The path, with links resolved.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Writes the file in one operation.
    pub(crate) fn replace(
        &self,
        write: &dyn Fn(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        replace(&self.path, &Permissions::of(&self.path), write)
    }
}

/// Checks, before the computation, that the output that `option` named (`-`: standard output) can be written, and
/// locks it.
pub(crate) fn place(option: &str, path: &Path) -> Result<Place, Failure> {
    writable(path).map_err(|error| refused(option, path, &error))
}

/// Locks an existing folder, for a command that fills it.
pub(crate) fn folder(option: &str, path: &Path) -> Result<Lock, Failure> {
    Lock::of(&resolved(path)).map_err(|_| Failure::file(option, path, IN_USE))
}

/// The error if another process writes the file of this option, or if a user's file has a derived name; `None` for
/// any other error.
pub(crate) fn taken(option: &str, path: &Path, error: &io::Error) -> Option<Failure> {
    match error.kind() {
        ErrorKind::WouldBlock => Some(Failure::file(option, path, IN_USE)),
        // The file that is there, and is not ours, is named.
        ErrorKind::AlreadyExists => Some(Failure::file(option, path, error)),
        _ => None,
    }
}

pub(super) fn refused(option: &str, path: &Path, error: &io::Error) -> Failure {
    if let Some(taken) = taken(option, path, error) {
        return taken;
    }
    let advice = "choose a place that exists and can be written to";
    let said = match error.kind() {
        ErrorKind::NotFound if folder_of(path).is_dir() => "no file can be created there".into(),
        ErrorKind::NotFound => "there is no such folder".into(),
        ErrorKind::NotConnected => {
            let message = "nobody reads from this pipe: start its reader first";
            return Failure::file(option, path, message);
        }
        kind => kind.to_string(),
    };
    Failure::file(option, path, format!("{said}; {advice}"))
}

/// Message for an output locked by another process.
const IN_USE: &str = "is being written by another stickslip: wait until it has ended, or \
                                 choose another name";

fn writable(path: &Path) -> io::Result<Place> {
    if path == Path::new("-") {
        return Ok(Place::Stdout);
    }
    if is_special(path) {
        return special::open(path).map(Place::Special);
    }
    if path.is_dir() || path.as_os_str().as_encoded_bytes().ends_with(b"/") {
        return Err(ErrorKind::IsADirectory.into());
    }
    // A name that is too long, say, is no name that a file can get later.
    match path.symlink_metadata() {
        Err(error) if error.kind() != ErrorKind::NotFound => return Err(error),
        _ => {}
    }
    let path = resolved(path);
    if path.exists() {
        OpenOptions::new().write(true).open(&path)?;
    }
    may_be_made_in(folder_of(&path))?;
    let lock = Lock::of(&path)?;
    Ok(Place::File(Target { path, _lock: lock }))
}
