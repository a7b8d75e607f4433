//! Errors of the program as exceptions of Python.

use pyo3::PyErr;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use std::fmt::Display;
use stickslip_cli::hosted::Refusal;

/// A ValueError for unusable input, a RuntimeError for a failure at run time, or a KeyboardInterrupt for cancelled work,
/// with the message of the program.
pub(crate) fn exception_of(refusal: Refusal) -> PyErr {
    match refusal {
        Refusal::Input(message) => PyValueError::new_err(message),
        Refusal::Run(message) => PyRuntimeError::new_err(message),
        Refusal::Stopped(message) => PyKeyboardInterrupt::new_err(message),
    }
}

/// A ValueError with this message.
pub(crate) fn unusable(message: impl Display) -> PyErr {
    PyValueError::new_err(message.to_string())
}
