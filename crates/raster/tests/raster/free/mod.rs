//! Rasters of a tip that is free to move across the lines.

mod lines;
mod reference;
