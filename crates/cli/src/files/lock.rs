//! Locks: one writer per file; a second process that opens the same output gets an error.
//!
//! The lock is advisory and ends with its process in all cases. It belongs to the name of the file, because the file
//! may not exist yet and is replaced when it is complete: an empty file among the system's temporary ones represents
//! it, and is removed with the lock. Output folders stay unchanged, even after a kill. Growing files are also locked
//! themselves, which other machines see if the file system supports that.

use std::fs::{self, File, OpenOptions, TryLockError};
use std::io::{self, ErrorKind};
use std::path::{Path, PathBuf};

/// The exclusive right to write a name, until this is dropped.
#[derive(Debug)]
pub(crate) struct Lock {
    /// The lock file; `None` if the system has no locks, or no place for them.
    held: Option<(PathBuf, File)>,
}

impl Lock {
    /// Locks the file or folder with this name, links resolved.
    ///
    /// # Errors
    /// `WouldBlock`: another process has the lock.
    pub(crate) fn of(target: &Path) -> io::Result<Self> {
        let place = std::env::temp_dir().join(name(target));
        loop {
            // Without file locks the output is written all the same: locks only coordinate runs of this program.
            let Ok(file) = open(&place) else { return Ok(Self { held: None }) };
            lock(&file)?;
            // Its last holder removes it: the one that was opened may have lost its name since.
            if stands_for(&place, &file) {
                return Ok(Self { held: Some((place, file)) });
            }
        }
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        if let Some((place, _)) = &self.held {
            fs::remove_file(place).ok();
        }
    }
}

/// Locks an open file, if the file system supports it.
///
/// # Errors
/// `WouldBlock`: another process has locked it.
pub(super) fn lock(file: &File) -> io::Result<()> {
    match file.try_lock() {
        Err(TryLockError::WouldBlock) => Err(ErrorKind::WouldBlock.into()),
        Ok(()) | Err(TryLockError::Error(_)) => Ok(()),
    }
}

/// The name of the lock file, the same for all processes on this machine.
fn name(target: &Path) -> String {
    let (folder, name) = (target.parent().unwrap_or(target), target.file_name());
    let [folder, name] = [folder.as_os_str(), name.unwrap_or_default()]
        .map(|part| crc32fast::hash(part.as_encoded_bytes()));
    format!("stickslip-{folder:08x}{name:08x}.lock")
}

/// Opens the lock file and creates it if necessary, without following links or waiting for pipes.
fn open(place: &Path) -> io::Result<File> {
    let mut new = OpenOptions::new();
    match new.write(true).create_new(true).open(place) {
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {
            // That of another user can be read at least, which suffices.
            super::special::not_followed(OpenOptions::new().read(true)).open(place)
        }
        other => other,
    }
}

/// Whether the open file still has this name.
#[cfg(unix)]
fn stands_for(place: &Path, file: &File) -> bool {
    use std::os::unix::fs::MetadataExt;
    let which = |data: io::Result<fs::Metadata>| data.map(|data| (data.dev(), data.ino())).ok();
    which(place.symlink_metadata()) == which(file.metadata())
}

/// Whether the open file still has this name; open files always keep theirs on this system.
#[cfg(not(unix))]
fn stands_for(place: &Path, _: &File) -> bool {
    place.exists()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_has_one_holder_at_a_time() {
        let folder = tempfile::tempdir().unwrap();
        let [a, b] = ["a.json", "b.json"].map(|name| folder.path().join(name));
        let first = Lock::of(&a).unwrap();
        assert_eq!(Lock::of(&a).unwrap_err().kind(), ErrorKind::WouldBlock);
        let _other = Lock::of(&b).unwrap();
        let (place, _) = first.held.as_ref().unwrap();
        let place = place.clone();
        assert!(place.exists());
        drop(first);
        assert!(!place.exists(), "nothing is left of it");
        Lock::of(&a).unwrap();
        assert_eq!(folder.path().read_dir().unwrap().count(), 0, "beside the target is nothing");
    }

    /// A lock file as a kill leaves it.
    #[test]
    fn the_lock_of_a_dead_process_is_taken_over() {
        let folder = tempfile::tempdir().unwrap();
        let target = folder.path().join("a.json");
        let place = std::env::temp_dir().join(name(&target));
        fs::write(&place, "").unwrap();
        drop(Lock::of(&target).unwrap());
        assert!(!place.exists());
    }

    #[cfg(unix)]
    #[test]
    fn a_planted_link_is_not_followed() {
        let folder = tempfile::tempdir().unwrap();
        let (target, precious) = (folder.path().join("a.json"), folder.path().join("precious"));
        let place = std::env::temp_dir().join(name(&target));
        std::os::unix::fs::symlink(&precious, &place).unwrap();
        drop(Lock::of(&target).unwrap());
        assert!(!precious.exists());
        fs::remove_file(&place).unwrap();
    }
}
