//! Resolution of links in file and folder names.

use std::path::{Path, PathBuf};

/// The absolute path of a file, with links resolved.
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
