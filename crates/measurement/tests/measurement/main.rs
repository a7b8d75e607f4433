//! What measurement is held to: profiles drawn from known footprints, ripples carved by the full equations.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

mod asymmetric_tips;
mod carved;
mod explained;
mod fitted_ripples;
mod freed_numbers;
mod friction_loops;
mod judged_tables;
mod measured_images;
mod measured_tips;
mod noise;
mod noisy_table;
mod ripple_images;
