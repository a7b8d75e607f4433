//! What the fast sums are held to: the definition, summed directly, and what they may hold of memory.

mod accuracy;
mod common;
mod memory;
mod spectra;
mod window;
