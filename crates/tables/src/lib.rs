//! Tables and images as people and instruments write them, and NumPy archives.
//!
//! [`Table`] reads text in any usual encoding, with any separator and decimal mark; [`Heading`] finds the unit of a
//! column. [`parse_gsf`] reads images of scanning probe microscopy, [`gsf()`] writes them, [`write_npz`] writes arrays.
//!
//! Files, standard input and limits of size are the program's: here are bytes and text. What only hands on is compiled
//! without optimisation there, and these functions, which look at each character of 64 MB, in full here.

mod decode;
mod dialect;
mod gsf;
mod heading;
mod npz;
mod sheet;

pub use decode::decoded;
pub use gsf::{Frame, Image, gsf, header, parse_gsf, pixels};
pub use heading::Heading;
pub use npz::{NamedArray, write_npz};
pub use sheet::{Sheet, Table};
