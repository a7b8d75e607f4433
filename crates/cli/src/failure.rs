//! Errors of commands, with their exit statuses.

use std::fmt::Display;
use std::io;
use std::path::Path;
use thiserror::Error;

pub(crate) use stickslip::Typed;

/// The error of a command.
#[derive(Debug, Error)]
pub(crate) enum Failure {
    /// Invalid input: the message names the option and the value, and valid values. Status 2.
    #[error("{option}: {message}")]
    Input {
        /// The option with its value, such as `--tolerance 0`.
        option: String,
        /// The error and the remedy.
        message: String,
    },
    /// An error at run time. Status 1.
    #[error("{0}")]
    Run(String),
    /// An error of writing, after the work was done. Status 1.
    #[error("cannot write {target}: {error}")]
    Write {
        /// File name or "standard output".
        target: String,
        /// The error of the system.
        error: io::Error,
    },
    /// An error of writing, after which the result was saved elsewhere. Status 1.
    #[error("cannot write {target}: {error}; its intended content is in {kept}")]
    Elsewhere {
        /// File name.
        target: String,
        /// The error of the system.
        error: io::Error,
        /// Name of the temporary file with the result.
        kept: String,
    },
    /// A run that is correct but incomplete. Status 3.
    #[error("{0}")]
    CutOff(String),
    /// Stopped by a signal; the partial result was saved and can be resumed. Status 128 + signal.
    #[error("interrupted: {message}")]
    Unfinished {
        signal: u8,
        /// Progress, and the command to resume.
        message: String,
    },
    /// Stopped by a signal, after writing the partial result. Status 128 + signal.
    #[error("interrupted: the result contains the part computed so far")]
    Interrupted(u8),
    /// Stopped by a signal before there was a result. Status 128 + signal.
    #[error("interrupted: nothing was written")]
    Stopped(u8),
}

impl Failure {
    pub(crate) fn input(option: impl Into<String>, message: impl Display) -> Self {
        Self::Input { option: option.into(), message: message.to_string() }
    }

    /// An error at run time.
    pub(crate) fn run(error: impl Display) -> Self {
        Self::Run(error.to_string())
    }

    /// An error of writing a file.
    pub(crate) fn writing(path: &Path, error: io::Error) -> Self {
        Self::Write { target: path.display().to_string(), error }
    }

    /// A rejection of the file that an option names.
    pub(crate) fn file(option: &str, path: &Path, message: impl Display) -> Self {
        Self::input(format!("{option} {}", path.display()), message)
    }

    /// A rejection of a number as value of an option.
    pub(crate) fn number(option: &str, value: f64, message: impl Display) -> Self {
        Self::input(format!("{option} {}", Typed(value)), message)
    }

    /// The number, if it is finite and above 0.
    pub(crate) fn unless_positive(option: &str, value: f64) -> Result<f64, Self> {
        let judged = Some(value).filter(|value| value.is_finite() && *value > 0.0);
        judged.ok_or_else(|| Self::number(option, value, "must be a finite number above 0"))
    }

    /// Rejects the first of these options that is given.
    pub(crate) fn if_given(options: &[(&str, bool)], message: &str) -> Result<(), Self> {
        let given = options.iter().find(|(_, is_given)| *is_given);
        given.map_or(Ok(()), |(option, _)| Err(Self::input(*option, message)))
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

    /// Whether the error needs no message, because the reader closed its end of the pipe.
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
