//! Devices and pipes, and safe opening of files that may have been replaced by links or pipes.

use std::fs::{File, OpenOptions};
use std::io::{self, Write};
use std::path::Path;

/// Whether the path is a device or a pipe, which must not be replaced by a rename.
pub(super) fn is_special(path: &Path) -> bool {
    path.metadata().is_ok_and(|m| !m.is_file() && !m.is_dir())
}

/// Options that do not follow a link at the end of the name, and do not wait for the other end of a pipe.
#[cfg(unix)]
pub(super) fn not_followed(options: &mut OpenOptions) -> &mut OpenOptions {
    use std::os::unix::fs::OpenOptionsExt;
    options.custom_flags(libc::O_NOFOLLOW | libc::O_NONBLOCK)
}

#[cfg(not(unix))]
pub(super) fn not_followed(options: &mut OpenOptions) -> &mut OpenOptions {
    options
}

/// Standard output without the buffer of `io::Stdout`, which searches all that it is given for line breaks.
#[cfg(unix)]
pub(super) fn stdout() -> io::Result<File> {
    use std::os::fd::AsFd;
    io::stdout().flush()?;
    io::stdout().as_fd().try_clone_to_owned().map(File::from)
}

#[cfg(not(unix))]
pub(super) fn stdout() -> io::Result<io::StdoutLock<'static>> {
    Ok(io::stdout().lock())
}

/// Opens a device or pipe for writing. A pipe must have a reader soon.
///
/// # Errors
/// `NotConnected`: the pipe has no reader.
#[cfg(unix)]
pub(super) fn open(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::{FileTypeExt, OpenOptionsExt};
    use std::time::{Duration, Instant};
    /// Waiting time for the reader of a pipe that is started simultaneously.
    const PATIENCE: Duration = Duration::from_millis(600);
    let mut options = OpenOptions::new();
    options.write(true);
    if !path.metadata()?.file_type().is_fifo() {
        return options.open(path);
    }
    let started = Instant::now();
    loop {
        match options.clone().custom_flags(libc::O_NONBLOCK).open(path) {
            // With a reader at the other end it does not wait for one; and a write waits for room.
            Ok(_held) => return options.open(path),
            Err(error) if error.raw_os_error() == Some(libc::ENXIO) => {
                if started.elapsed() > PATIENCE {
                    return Err(io::ErrorKind::NotConnected.into());
                }
                std::thread::sleep(Duration::from_millis(5));
            }
            Err(error) => return Err(error),
        }
    }
}

#[cfg(not(unix))]
pub(super) fn open(path: &Path) -> io::Result<File> {
    OpenOptions::new().write(true).open(path)
}
