//! What the libraries compute, judged by closed forms, references and each other.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[path = "../support/acceptance.rs"]
mod acceptance;

mod closed_forms;
mod continuation;
mod convergence;
mod corrections;
mod cycles;
mod documents;
mod examples;
mod free_ripple_images;
mod grids_converge;
mod memories_agree;
mod planes_on_grids;
mod properties;
mod questions;
mod raster_documents;
mod rasters_on_grids;
mod regimes;
mod ripple_images;
mod same_bits;
mod scaling_laws;
mod stability_against_runs;
mod surfaces;
mod sweep_question;
mod three_dimensions;
mod tolerance_ladder;
mod units;
mod wider_images;
mod wider_ladder;
mod wider_law;
mod wider_stability_against_runs;
