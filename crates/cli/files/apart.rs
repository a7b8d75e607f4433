//! Files of one command line that must not be the same.

use super::place::resolved;
use crate::failure::Failure;
use std::path::Path;

/// An option, and the file that it names, if it was given.
pub(crate) type Named<'a> = (&'static str, Option<&'a Path>);

/// Refuses a file to be written that another option writes too, or reads: the later would put an end to
/// the earlier.
///
/// # Errors
/// Names the option, and the one that it collides with.
pub(crate) fn apart(written: &[Named], read: &[Named]) -> Result<(), Failure> {
    for (place, (option, path)) in written.iter().enumerate() {
        let Some(path) = path.filter(|path| is_file(path)) else { continue };
        let others = read.iter().chain(&written[..place]);
        let same =
            |(_, other): &&Named| other.is_some_and(|other| resolved(other) == resolved(path));
        if let Some((other, _)) = others.into_iter().find(same) {
            let message = format!("is the file of {other}: give it a name of its own");
            return Err(Failure::input(format!("{option} {}", path.display()), message));
        }
    }
    Ok(())
}

/// Neither a standard stream nor a device or a pipe, which may well be named twice.
fn is_file(path: &Path) -> bool {
    path != Path::new("-") && path.metadata().map_or(true, |m| m.is_file())
}
