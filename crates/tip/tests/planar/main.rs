//! A tip that gives way across the scan, held to a sum over its whole history and to linear theory.

#![allow(clippy::disallowed_methods, reason = "oracles are those of the C library")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[path = "../../../../tests/support/gauss.rs"]
mod gauss;

mod convergence;
mod footprints;
mod limits;
mod lines;
mod memories;
mod reference;
mod surfaces;
mod theory;
