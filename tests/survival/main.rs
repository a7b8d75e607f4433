//! Runs that are killed, and runs that are long; `make survive` runs the ignored ones too.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[path = "../support/folder.rs"]
mod folder;
#[path = "../support/runs.rs"]
mod runs;

#[cfg(unix)]
mod accepted_tips;
#[cfg(target_os = "linux")]
mod extreme_arguments;
#[cfg(unix)]
mod flipped_bits;
#[cfg(unix)]
mod killed_runs;
#[cfg(unix)]
mod long_runs;
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
mod older_processors;
#[cfg(target_os = "linux")]
mod signals;
#[cfg(unix)]
mod tips;
#[cfg(unix)]
mod two_writers;
