//! What the memories are held to: the sum over the past that they stand for.

#![allow(clippy::disallowed_methods, reason = "oracles are those of the C library")]

mod fft_bounded;
mod groove;
mod modes;
mod side_by_side;
