//! Temporary files beside the files that they will replace. They are created when there is something to write, so
//! that a process killed during the computation leaves none. A process killed during writing leaves one, which the
//! next writer of the same file removes. A lock, which ends with its process, distinguishes the two cases.

use crate::session::locked;
use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use tempfile::{Builder, NamedTempFile};

/// Checks whether a folder accepts new files, and leaves none there.
pub(super) fn may_be_made_in(folder: &Path) -> io::Result<()> {
    // Without a name from the first, where the system has such files.
    tempfile::tempfile_in(folder).map(drop)
}

/// Unfinished files, removed when a signal ends the program.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(vec![]);

/// Removes unfinished files at the end of the program.
pub(crate) fn remove_unfinished() {
    for path in locked(&UNFINISHED).drain(..) {
        fs::remove_file(path).ok();
    }
}

/// An unfinished file; on drop it is removed unless it was renamed.
pub(super) struct Unfinished(PathBuf);

impl Unfinished {
    /// A new file in a folder, registered before a signal can end the program.
    fn new(prefix: &str, folder: &Path) -> io::Result<(NamedTempFile, Self)> {
        let mut unfinished = locked(&UNFINISHED);
        let file = new(prefix, folder)?;
        unfinished.push(file.path().into());
        let made = Self(file.path().into());
        Ok((file, made))
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        locked(&UNFINISHED).retain(|path| *path != self.0);
    }
}

/// A new locked file in the folder of a target.
pub(super) fn beside(target: &Path, folder: &Path) -> io::Result<(NamedTempFile, Unfinished)> {
    loop {
        let (file, unfinished) = Unfinished::new(&prefix(target), folder)?;
        // Some file systems have no locks; without them no program treats the file as abandoned.
        file.as_file().lock().ok();
        // Between its birth and its lock, it may have been.
        if file.path().exists() {
            return Ok((file, unfinished));
        }
    }
}

/// Writes a result that could not be written to its place among the system's temporary files, readable only by the
/// user, and returns the path.
pub(super) fn kept_elsewhere(
    target: &Path,
    write: &dyn Fn(&mut dyn Write) -> io::Result<()>,
) -> Option<PathBuf> {
    let name = target.file_name().unwrap_or_default();
    let short = if name.len() < 100 { name } else { OsStr::new("result") };
    let mut suffix = OsString::from("-");
    suffix.push(short);
    let mut file = Builder::new().prefix("stickslip-").suffix(&suffix).tempfile().ok()?;
    through(file.as_file_mut(), write).ok()?;
    file.as_file().sync_all().ok()?;
    file.keep().ok().map(|(_, path)| path)
}

/// Writes through a buffer.
pub(super) fn through(
    sink: impl Write,
    write: &dyn Fn(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut buffered = BufWriter::new(sink);
    write(&mut buffered)?;
    buffered.flush()
}

/// Prefix of temporary files for this target, short enough for any file system.
fn prefix(target: &Path) -> String {
    let name = target.file_name().unwrap_or_default().as_encoded_bytes();
    format!(".stickslip-{:08x}-", crc32fast::hash(name))
}

#[cfg(unix)]
fn new(prefix: &str, folder: &Path) -> io::Result<NamedTempFile> {
    use std::os::unix::fs::PermissionsExt;
    // As of any new file, limited by the umask.
    let permissions = fs::Permissions::from_mode(0o666);
    Builder::new().prefix(prefix).permissions(permissions).tempfile_in(folder)
}

#[cfg(not(unix))]
fn new(prefix: &str, folder: &Path) -> io::Result<NamedTempFile> {
    Builder::new().prefix(prefix).tempfile_in(folder)
}

/// Removes temporary files of ended processes for this target. Errors are ignored.
pub(super) fn remove_left_behind(target: &Path, folder: &Path) {
    let prefix = prefix(target);
    let is_ours = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().as_encoded_bytes();
        name.starts_with(prefix.as_bytes())
            && path.symlink_metadata().is_ok_and(|file| file.is_file())
    };
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for path in entries.map(|entry| entry.path()).filter(is_ours) {
        // Removed while it is locked here: its maker, if there still is one, looks for it after that.
        if let Ok(file) = File::open(&path)
            && file.try_lock().is_ok()
        {
            fs::remove_file(&path).ok();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let name =
            |entry: io::Result<fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
        folder.read_dir().unwrap().map(name).collect()
    }

    /// A temporary file without its lock, as a kill leaves it.
    fn left_behind(target: &Path, folder: &Path) -> PathBuf {
        let (file, path) = beside(target, folder).unwrap().0.keep().unwrap();
        drop(file);
        path
    }

    #[test]
    fn what_a_dead_process_left_goes_and_what_a_living_one_has_stays() {
        let folder = tempfile::tempdir().unwrap();
        let folder = folder.path();
        let (target, other) = (folder.join("run.json"), folder.join("other.json"));
        let dead = [left_behind(&target, folder), left_behind(&target, folder)];
        let (living, _unfinished) = beside(&target, folder).unwrap();
        let others = left_behind(&other, folder);
        let foreign = folder.join(".stickslip-a");
        fs::write(&foreign, "").unwrap();
        remove_left_behind(&target, folder);
        assert!(dead.iter().all(|path| !path.exists()), "{:?}", names(folder));
        for path in [living.path(), &others, &foreign] {
            assert!(path.exists(), "{}: {:?}", path.display(), names(folder));
        }
        living.persist(&target).unwrap();
        assert_eq!(names(folder).len(), 3);
    }

    #[test]
    fn to_look_whether_a_folder_takes_files_leaves_none() {
        let folder = tempfile::tempdir().unwrap();
        may_be_made_in(folder.path()).unwrap();
        assert_eq!(names(folder.path()), [""; 0]);
        assert!(may_be_made_in(&folder.path().join("none")).is_err());
    }

    /// A target with the longest name that a system allows can be written.
    #[test]
    fn a_long_name_has_a_short_temporary_one() {
        let long = PathBuf::from("x".repeat(250) + ".json");
        assert_eq!(prefix(&long).len(), prefix(Path::new("a.json")).len());
    }
}
