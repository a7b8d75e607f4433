//! What the memories are held to: the sum over the past that they stand for.

mod fft_bounded;
mod groove;
mod modes;
