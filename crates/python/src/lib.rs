//! The native module of the Python package `stickslip`: the commands of the program, executed in this process.
//!
//! Arguments are the options of the program, so that defaults, error messages and results equal those of a shell. The result is a
//! [`Document`](document::Document) in Rust's memory; Python reads single fields of it.

mod descriptions;
mod document;
mod failed;
mod fields;
mod motion;
mod samples;
mod value;
mod work;

use pyo3::prelude::*;

/// `stickslip._native`.
#[pymodule]
mod _native {
    #[pymodule_export]
    use super::descriptions::{commands, options};
    #[pymodule_export]
    use super::document::Document;
    #[pymodule_export]
    use super::work::{call, call_runs, load, read};
}
