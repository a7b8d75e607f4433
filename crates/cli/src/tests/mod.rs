//! Tests of the whole crate with random input.

mod fuzz;
mod fuzz_documents;
