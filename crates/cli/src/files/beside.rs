//! Derived file names: `FILE.part`, `FILE.partial`, `CHECKPOINT.journal`. A user may have files of such names, or
//! somebody may have planted them: only files that this program made are resumed or replaced, recognised by their
//! beginning, and links are not followed.

use super::lock::lock;
use super::replace::Permissions;
use super::special::not_followed;
use std::fs::{self, File, OpenOptions};
use std::io::{self, ErrorKind, Read, Seek};
use std::path::{Path, PathBuf};

/// The name with an ending appended.
pub(crate) fn with(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(ending);
    name.into()
}

/// Opens and locks a file made by this program, which begins with `magic` or is still empty; `None` if there is no
/// file.
///
/// # Errors
/// `WouldBlock`: another process has locked it. `AlreadyExists`: this program did not make it.
pub(crate) fn ours(path: &Path, magic: &[u8]) -> io::Result<Option<File>> {
    let mut file = match not_followed(OpenOptions::new().read(true).write(true)).open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
        Err(error) if error.kind() == ErrorKind::PermissionDenied => return Err(error),
        // A link, a folder, a pipe.
        Err(_) => return Err(foreign(path)),
    };
    if !file.metadata()?.is_file() {
        return Err(foreign(path));
    }
    lock(&file)?;
    let mut beginning = vec![];
    (&mut file).take(magic.len() as u64).read_to_end(&mut beginning)?;
    // A kill may have left its beginning alone.
    if !magic.starts_with(&beginning) {
        return Err(foreign(path));
    }
    file.rewind()?;
    Ok(Some(file))
}

/// Creates and locks a new file; an old one is replaced if this program made it.
pub(super) fn create(path: &Path, magic: &[u8], permissions: &Permissions) -> io::Result<File> {
    if let Some(old) = ours(path, magic)? {
        // The name goes, not the contents: they may have another name.
        fs::remove_file(path)?;
        drop(old);
    }
    let file = OpenOptions::new().read(true).write(true).create_new(true).open(path);
    let file = file.map_err(|error| match error.kind() {
        // Made by another process since.
        ErrorKind::AlreadyExists => ErrorKind::WouldBlock.into(),
        _ => error,
    })?;
    lock(&file)?;
    permissions.give_to(&file)?;
    Ok(file)
}

/// As [`create`], with the permissions of the file that the new one belongs to.
pub(crate) fn create_like(path: &Path, magic: &[u8], owner: &Path) -> io::Result<File> {
    create(path, magic, &Permissions::of(owner))
}

/// Number of names (hard links) of an open file: 0 once it was removed; where it has other names, it must not change.
#[cfg(unix)]
pub(crate) fn names(file: &File) -> io::Result<u64> {
    use std::os::unix::fs::MetadataExt;
    Ok(file.metadata()?.nlink())
}

#[cfg(not(unix))]
pub(crate) fn names(_: &File) -> io::Result<u64> {
    Ok(1)
}

fn foreign(path: &Path) -> io::Error {
    let message = format!("{} exists and was not written by stickslip: rename it", path.display());
    io::Error::new(ErrorKind::AlreadyExists, message)
}

#[cfg(test)]
mod tests {
    use super::*;

    const MAGIC: &[u8] = b"stickslip/test";

    fn made(path: &Path) -> io::Result<File> {
        create(path, MAGIC, &Permissions::default())
    }

    #[test]
    fn what_a_user_has_is_neither_replaced_nor_taken_up() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.jsonl.part");
        for contents in ["my own notes", "stickslip", "stickslip/test and more", ""] {
            fs::write(&path, contents).unwrap();
            let is_ours = MAGIC.starts_with(contents.as_bytes()) || contents.len() > MAGIC.len();
            assert_eq!(made(&path).is_ok(), is_ours, "{contents}");
            assert_eq!(
                fs::read(&path).unwrap() == contents.as_bytes(),
                !is_ours || contents.is_empty()
            );
        }
        fs::remove_file(&path).unwrap();
        fs::create_dir(&path).unwrap();
        assert_eq!(made(&path).unwrap_err().kind(), ErrorKind::AlreadyExists);
    }

    #[test]
    fn two_do_not_have_it_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.jsonl.part");
        let first = made(&path).unwrap();
        assert_eq!(made(&path).unwrap_err().kind(), ErrorKind::WouldBlock);
        drop(first);
        assert!(ours(&path, MAGIC).unwrap().is_some());
    }

    #[cfg(unix)]
    #[test]
    fn links_are_not_followed_and_other_names_keep_their_contents() {
        let folder = tempfile::tempdir().unwrap();
        let [path, precious] = ["run.jsonl.part", "precious"].map(|name| folder.path().join(name));
        fs::write(&precious, "stickslip/test, and all of my work").unwrap();
        let before = fs::read(&precious).unwrap();
        std::os::unix::fs::symlink(&precious, &path).unwrap();
        assert_eq!(made(&path).unwrap_err().kind(), ErrorKind::AlreadyExists);
        fs::remove_file(&path).unwrap();
        fs::hard_link(&precious, &path).unwrap();
        assert_eq!(names(&ours(&path, MAGIC).unwrap().unwrap()).unwrap(), 2);
        made(&path).unwrap();
        assert_eq!(fs::read(&precious).unwrap(), before);
    }
}
