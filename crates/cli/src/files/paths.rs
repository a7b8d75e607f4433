//! Resolution of links in file and folder names; and relative paths in a file that may be moved with its folder or come
//! from somebody else: they are relative to that folder, and must stay within it.

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

/// The path relative to a folder, with links resolved; unchanged if it leads outside.
pub(crate) fn seen_from(folder: &Path, path: &Path) -> PathBuf {
    if path == Path::new("-") {
        return path.into();
    }
    let path = resolved(path);
    match folder.canonicalize() {
        Ok(folder) => path.strip_prefix(folder).map(Path::to_path_buf).unwrap_or(path),
        Err(_) => path,
    }
}

/// The absolute path of a path relative to a folder; `None` if it is outside of the folder, also through a link.
pub(crate) fn found_from(folder: &Path, path: &Path) -> Option<PathBuf> {
    if path == Path::new("-") {
        return Some(path.into());
    }
    let joined = folder.join(path);
    // A folder that is not there leads nowhere.
    folder_of(&joined).canonicalize().ok()?;
    let found = resolved(&joined);
    found.starts_with(folder.canonicalize().ok()?).then_some(found)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_moved_folder_has_what_it_had() {
        let place = tempfile::tempdir().unwrap();
        let place = place.path().canonicalize().unwrap();
        let [old, new] = ["old", "new"].map(|name| place.join(name));
        fs::create_dir_all(old.join("sub")).unwrap();
        for name in ["run.json", "sub/run.json"] {
            let seen = seen_from(&old, &old.join(name));
            assert_eq!(seen, Path::new(name));
            assert_eq!(found_from(&old, &seen), Some(old.join(name)));
        }
        fs::rename(&old, &new).unwrap();
        assert_eq!(found_from(&new, Path::new("sub/run.json")), Some(new.join("sub/run.json")));
        assert_eq!(seen_from(&new, &place.join("out.json")), place.join("out.json"));
    }

    #[test]
    fn what_leads_outside_is_not_found() {
        let place = tempfile::tempdir().unwrap();
        let folder = place.path().join("folder");
        fs::create_dir_all(folder.join("sub")).unwrap();
        fs::write(place.path().join("precious"), "").unwrap();
        let outside = place.path().join("precious");
        let mut paths = vec![outside.clone(), "../precious".into(), "sub/../../precious".into()];
        paths.push("none/../../precious".into());
        #[cfg(unix)]
        {
            std::os::unix::fs::symlink(&outside, folder.join("link")).unwrap();
            std::os::unix::fs::symlink(place.path(), folder.join("linked")).unwrap();
            paths.extend(["link".into(), "linked/precious".into(), "linked/new".into()]);
        }
        for path in paths {
            assert_eq!(found_from(&folder, &path), None, "{}", path.display());
        }
        assert!(found_from(&folder, Path::new("sub/../run.json")).is_some());
        assert!(found_from(&folder, Path::new("-")).is_some());
    }
}
