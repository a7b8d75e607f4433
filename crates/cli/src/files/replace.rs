//! Atomic replacement of a file: at any time its name refers to the complete old or the complete new content.

use super::paths::folder_of;
use super::temporary::{beside, remove_left_behind, through};
use std::fs::{File, Metadata};
use std::io::{self, Write};
use std::path::Path;
use std::thread::{self, Scope, ScopedJoinHandle};

/// The permissions of a file, within the umask, and if possible its owner.
#[derive(Debug, Default)]
pub(super) struct Permissions(pub(super) Option<Metadata>);

impl Permissions {
    /// The permissions of the file at this place, if there is one.
    pub(super) fn of(path: &Path) -> Self {
        Self(path.metadata().ok())
    }

    /// Applies the permissions to a file, while it is still empty, so that no unauthorised process can read it.
    #[cfg(unix)]
    pub(super) fn give_to(&self, file: &File) -> io::Result<()> {
        use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
        let Some(old) = &self.0 else { return Ok(()) };
        let new = file.metadata()?;
        if (old.uid(), old.gid()) != (new.uid(), new.gid()) {
            // Only the superuser gives files away; a group may be shared.
            let group = || fchown(file, None, Some(old.gid()));
            fchown(file, Some(old.uid()), Some(old.gid())).or_else(|_| group()).ok();
        }
        let made = new.mode() & 0o666;
        let mut mode = old.mode() & (made | (made & 0o444) >> 2);
        if file.metadata()?.gid() != old.gid() {
            // Permissions of one group are not given to another.
            mode &= !0o070 | (mode & 0o007) << 3;
        }
        file.set_permissions(std::fs::Permissions::from_mode(mode))
    }

    #[cfg(not(unix))]
    pub(super) fn give_to(&self, _: &File) -> io::Result<()> {
        Ok(())
    }
}

/// Writes a file under a temporary name, syncs it, and renames it.
pub(super) fn replace(
    path: &Path,
    permissions: &Permissions,
    write: &dyn Fn(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let (file, _unfinished) = beside(path, folder_of(path))?;
    permissions.give_to(file.as_file())?;
    thread::scope(|scope| {
        let mut synced = Synced { file: file.as_file(), scope, since: 0, syncing: None };
        through(&mut synced, write)?;
        synced.wait()
    })?;
    file.as_file().sync_all()?;
    let old = old_contents(path);
    file.persist(path).map_err(|error| error.error)?;
    if let Some(old) = old {
        // Nobody waits for it. Without a thread it is closed here.
        thread::Builder::new().spawn(move || drop(old)).ok();
    }
    sync_folder(path);
    remove_left_behind(path, folder_of(path));
    Ok(())
}

/// A long file that is about to be replaced, if the system lets an open one be replaced. Its space is freed once it is
/// closed, which takes 7 ms for 25 MB.
fn old_contents(path: &Path) -> Option<File> {
    let is_long = || path.metadata().is_ok_and(|old| old.len() >= AHEAD as u64);
    if cfg!(unix) && is_long() { File::open(path).ok() } else { None }
}

/// Number of bytes after which a file is synced while more is written.
const AHEAD: usize = 4 << 20;

/// A file that is synced while it is written: at the end the disk would take a twentieth of the time of a large raster.
struct Synced<'scope, 'env> {
    file: &'env File,
    scope: &'scope Scope<'scope, 'env>,
    /// Number of bytes written since the last sync began.
    since: usize,
    syncing: Option<ScopedJoinHandle<'scope, io::Result<()>>>,
}

impl Synced<'_, '_> {
    /// Waits for the last sync.
    fn wait(&mut self) -> io::Result<()> {
        let last = self.syncing.take().map(ScopedJoinHandle::join);
        last.map_or(Ok(()), |done| {
            done.unwrap_or_else(|_| Err(io::Error::other("the sync failed")))
        })
    }
}

impl Write for Synced<'_, '_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut file = self.file;
        let count = file.write(bytes)?;
        self.since += count;
        let is_idle = self.syncing.as_ref().is_none_or(ScopedJoinHandle::is_finished);
        if self.since >= AHEAD && is_idle {
            self.wait()?;
            self.since = 0;
            // Without a thread all is synced at the end.
            self.syncing =
                thread::Builder::new().spawn_scoped(self.scope, || file.sync_data()).ok();
        }
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Syncs the folder after a rename. Systems that cannot sync a folder give their own guarantee.
pub(super) fn sync_folder(path: &Path) {
    File::open(folder_of(path)).and_then(|folder| folder.sync_all()).ok();
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    /// Synced more than once before its end.
    #[test]
    fn a_long_file_is_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("long");
        let line = [b"0123456789abcdef".repeat(64), b"\n".to_vec()].concat();
        let count = 3 * AHEAD / line.len();
        let write = |out: &mut dyn Write| (0..count).try_for_each(|_| out.write_all(&line));
        replace(&path, &Permissions::default(), &write).unwrap();
        assert!(fs::read(&path).unwrap() == line.repeat(count));
    }

    #[cfg(unix)]
    #[test]
    fn the_mode_of_a_file_outlives_its_contents() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.json");
        fs::write(&path, "").unwrap();
        let allowed = path.metadata().unwrap().permissions().mode();
        let mode = || path.metadata().unwrap().permissions().mode() & 0o777;
        for kept in [0o600, 0o400, 0o700, 0o644 & allowed] {
            fs::write(&path, "before").unwrap();
            fs::set_permissions(&path, fs::Permissions::from_mode(kept)).unwrap();
            replace(&path, &Permissions::of(&path), &|out| out.write_all(b"after")).unwrap();
            assert_eq!((fs::read(&path).unwrap(), mode()), (b"after".to_vec(), kept));
        }
    }
}
