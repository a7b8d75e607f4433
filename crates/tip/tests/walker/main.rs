//! What walkers are held to: direct sums of the gradient of J0 over the whole past (`reference`), the speed of theory, and
//! circular orbits whose radius and frequency come from quadrature of the equation of motion.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
#![allow(clippy::disallowed_methods, reason = "a reference may have the bits of its machine")]

#[path = "../../../../tests/support/gauss.rs"]
mod gauss;

mod orbits;
mod reference;
mod runs;
