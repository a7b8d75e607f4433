//! Files of one command line that must be different.

use super::beside;
use super::paths::resolved;
use crate::failure::Failure;
use std::path::Path;

/// An option, and its file, if given.
pub(crate) type Named<'a> = (&'static str, Option<&'a Path>);

/// Endings of derived file names. No option may name such a file, whether or not the current command makes it.
const ENDINGS: [&str; 3] = [".part", ".partial", ".journal"];

/// Rejects an output that another option also writes or reads, or that is a derived file of another: one would
/// overwrite the other. Symbolic and hard links are resolved.
pub(crate) fn distinct(written: &[Named], read: &[Named]) -> Result<(), Failure> {
    let all: Vec<Named> = read.iter().chain(written).copied().collect();
    for (place, (option, path)) in written.iter().enumerate() {
        let Some(path) = path.filter(|path| is_file(path)) else { continue };
        let before = &all[..read.len() + place];
        if let Some((other, _)) = before.iter().find(|(_, other)| is(*other, path)) {
            let message = format!("is the file of {other}: give it a name of its own");
            return Err(Failure::file(option, path, message));
        }
        for ending in ENDINGS {
            let companion = beside::with(&resolved(path), ending);
            if let Some((other, Some(found))) = all.iter().find(|(_, other)| is(*other, &companion))
            {
                let message = format!(
                    "{} is reserved for data beside it, and the file of {other}: give one of them a name of its own",
                    found.display()
                );
                return Err(Failure::file(option, path, message));
            }
        }
    }
    Ok(())
}

fn is(other: Option<&Path>, path: &Path) -> bool {
    other.is_some_and(|other| resolved(other) == resolved(path) || is_linked(other, path))
}

/// Whether two paths are names of one file, as hard links are.
#[cfg(unix)]
fn is_linked(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let which = |path: &Path| {
        path.metadata().ok().filter(|m| m.is_file()).map(|data| (data.dev(), data.ino()))
    };
    which(a).is_some_and(|a| which(b) == Some(a))
}

#[cfg(not(unix))]
fn is_linked(_: &Path, _: &Path) -> bool {
    false
}

/// Whether a path is a file; streams, devices and pipes may be named twice.
fn is_file(path: &Path) -> bool {
    path != Path::new("-") && path.metadata().map_or(true, |m| m.is_file())
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn a_file_is_known_under_all_of_its_names() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("a"), "").unwrap();
        fs::create_dir(at("sub")).unwrap();
        let mut pairs = vec![("a", "a"), ("a", "sub/../a"), ("new", "sub/../new")];
        for ending in ENDINGS {
            pairs.push(match ending {
                ".part" => ("new", "new.part"),
                ".partial" => ("sub/../new", "new.partial"),
                _ => ("a", "a.journal"),
            });
        }
        if cfg!(unix) {
            fs::hard_link(at("a"), at("hard")).unwrap();
            fs::write(at("a.part"), "").unwrap();
            fs::hard_link(at("a.part"), at("hard part")).unwrap();
            #[cfg(unix)]
            std::os::unix::fs::symlink(at("a"), at("soft")).unwrap();
            pairs.extend([("hard", "a"), ("soft", "a"), ("soft", "hard"), ("soft", "a.part")]);
            pairs.push(("soft", "hard part"));
        }
        for (one, other) in pairs {
            let (one, other) = (at(one), at(other));
            let named = [("--one", Some(&*one)), ("--other", Some(&*other))];
            assert!(distinct(&named, &[]).is_err(), "{named:?}");
            assert!(distinct(&[named[1], named[0]], &[]).is_err(), "{named:?}");
            assert!(distinct(&named[..1], &named[1..]).is_err(), "{named:?}");
            assert!(distinct(&[], &named).is_ok());
        }
        let (one, other) = (at("a"), at("b"));
        assert!(
            distinct(&[("--one", Some(&one))], &[("--other", Some(&other)), ("-", None)]).is_ok()
        );
    }
}
