//! Why a command failed, and the exit status that says so.

use std::fmt::Display;
use std::io;
use thiserror::Error;

/// A command that did not end as asked.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    /// Unusable input: names the option and the value, and says what would do. Status 2.
    #[error("{option}: {message}")]
    Input {
        /// As typed, such as `--tolerance 0`.
        option: String,
        /// What is wrong, and what would do.
        message: String,
    },
    /// What failed at run time. Status 1.
    #[error("{0}")]
    Run(String),
    /// Writing failed after the work was done. Status 1.
    #[error("cannot write {target}: {error}")]
    Write {
        /// File name or "standard output".
        target: String,
        /// Why.
        error: io::Error,
    },
    /// Stopped by a signal, after writing what there was. Status 128 + signal.
    #[error("interrupted: the result holds what was computed until then")]
    Interrupted(u8),
}

impl Failure {
    pub(crate) fn input(option: impl Into<String>, message: impl Display) -> Self {
        Self::Input { option: option.into(), message: message.to_string() }
    }

    pub(crate) fn status(&self) -> u8 {
        match self {
            Self::Input { .. } => 2,
            Self::Run(_) | Self::Write { .. } => 1,
            Self::Interrupted(signal) => 128 + signal,
        }
    }

    /// A reader that closed its end of the pipe has what it wanted.
    pub(crate) fn is_silent(&self) -> bool {
        matches!(self, Self::Write { error, .. } if error.kind() == io::ErrorKind::BrokenPipe)
    }
}
