//! The program's refusals as Python's exceptions.

use pyo3::PyErr;
use pyo3::exceptions::{PyKeyboardInterrupt, PyRuntimeError, PyValueError};
use std::fmt::Display;
use stickslip_cli::hosted::Refusal;

/// Unusable input is a ValueError, what failed at run time a RuntimeError, with the program's own words.
pub(crate) fn raised(refusal: Refusal) -> PyErr {
    match refusal {
        Refusal::Input(said) => PyValueError::new_err(said),
        Refusal::Run(said) => PyRuntimeError::new_err(said),
        Refusal::Stopped(said) => PyKeyboardInterrupt::new_err(said),
    }
}

/// A ValueError of these words.
pub(crate) fn unusable(said: impl Display) -> PyErr {
    PyValueError::new_err(said.to_string())
}
