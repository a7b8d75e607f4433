//! The native half of the Python package `stickslip`: the program's commands run in this process, as the shell runs
//! them. What is asked for are the program's options, so that numbers, defaults, refusals and words are its own; what
//! comes back is a [`Document`](document::Document) in Rust's memory, of which Python sees what it asks for.

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
