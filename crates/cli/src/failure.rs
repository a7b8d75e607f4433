//! Why a command failed, and the exit status that says so.

use std::fmt::Display;
use std::io;
use thiserror::Error;

pub(crate) use stickslip::Typed;

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
    /// The same, but what was to be written is kept in another place. Status 1.
    #[error("cannot write {target}: {error}; what it was to hold is in {kept}")]
    Elsewhere {
        /// File name.
        target: String,
        /// Why.
        error: io::Error,
        /// A file among the system's temporary ones.
        kept: String,
    },
    /// A run of which the end is missing, and nothing else is wrong. Status 3.
    #[error("{0}")]
    CutOff(String),
    /// Stopped by a signal, what there was kept to go on from. Status 128 + signal.
    #[error("interrupted: {message}")]
    Unfinished {
        /// The signal.
        signal: u8,
        /// How far it came, and how to go on.
        message: String,
    },
    /// Stopped by a signal, after writing what there was. Status 128 + signal.
    #[error("interrupted: the result holds what was computed until then")]
    Interrupted(u8),
    /// Stopped by a signal before there was a result. Status 128 + signal.
    #[error("interrupted: nothing was written")]
    Stopped(u8),
}

impl Failure {
    pub(crate) fn input(option: impl Into<String>, message: impl Display) -> Self {
        Self::Input { option: option.into(), message: message.to_string() }
    }

    pub(crate) fn status(&self) -> u8 {
        match self {
            Self::Input { .. } => 2,
            Self::Run(_) | Self::Write { .. } | Self::Elsewhere { .. } => 1,
            Self::CutOff(_) => 3,
            Self::Interrupted(signal) | Self::Stopped(signal) | Self::Unfinished { signal, .. } => {
                128 + signal
            }
        }
    }

    /// A reader that closed its end of the pipe has what it wanted.
    pub(crate) fn is_silent(&self) -> bool {
        matches!(self, Self::Write { error, .. } if error.kind() == io::ErrorKind::BrokenPipe)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_is_shown_as_one_would_type_it() {
        let shown: Vec<String> = [0.5, 16.037597660116063, 2000.0, 1e-20, -1e300, f64::NAN]
            .map(|number| Typed(number).to_string())
            .into();
        assert_eq!(shown, ["0.5", "16.037597660116063", "2000", "1e-20", "-1e300", "NaN"]);
    }
}
