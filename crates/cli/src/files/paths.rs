//! Names of files, links and folders resolved.

use std::path::{Path, PathBuf};

/// The file itself where the name is a link; the same from wherever it is looked at.
pub(crate) fn resolved(path: &Path) -> PathBuf {
    if path == Path::new("-") {
        return path.into();
    }
    let through_folder = || {
        let folder = folder_of(path).canonicalize().ok()?;
        path.file_name().map(|name| folder.join(name))
    };
    let found = path.canonicalize().ok().or_else(through_folder);
    found.or_else(|| std::path::absolute(path).ok()).unwrap_or_else(|| path.into())
}

/// The folder of a file.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
