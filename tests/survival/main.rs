//! Runs that are killed, and runs that are long; `make survive` runs the ignored ones too.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[path = "../support/folder.rs"]
mod folder;
#[path = "../support/runs.rs"]
mod runs;

mod accepted_tips;
#[cfg(unix)]
mod flipped_bits;
#[cfg(unix)]
mod killed_runs;
#[cfg(unix)]
mod long_runs;
mod tips;
#[cfg(unix)]
mod two_writers;
