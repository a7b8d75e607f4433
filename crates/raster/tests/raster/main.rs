//! What rasters are held to: the full equations (`definition`), and linear theory.

#[path = "../../../../tests/support/gauss.rs"]
mod gauss;

mod against_linear_theory;
mod by_definition;
mod definition;
mod free;
mod patterns;
mod resolved;
mod threads;
mod wider_linear_theory;
