//! Rasters of a tip that is free to move across the lines.

mod limits;
mod lines;
mod patterns;
mod reference;
mod theory;
