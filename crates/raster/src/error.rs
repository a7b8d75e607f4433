//! What no raster can be made of.

use crate::path::AreaLine;
use stickslip_tip::RunError;
use thiserror::Error;

/// Why a raster was refused or could not be finished.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RasterError {
    /// A pitch that is no distance.
    #[error(
        "the pitch must be a finite number above 0, and at least {least:.1e} for a footprint that reaches {reach:.3} across, not {pitch:?}"
    )]
    Pitch {
        /// As given.
        pitch: f64,
        /// Reach of the footprint across the lines.
        reach: f64,
        /// The smallest.
        least: f64,
    },
    /// A length that is no distance, or that no lattice holds.
    #[error(
        "the length of a line must be a finite number above 0 and at most {most:.1e}, not {length:?}"
    )]
    Length {
        /// As given.
        length: f64,
        /// The largest.
        most: f64,
    },
    /// None, or more than are kept.
    #[error("a raster has between 1 and {MOST_LINES} lines, not {0}")]
    Lines(usize),
    /// A line of an area that is none.
    #[error(
        "line {line} of the area: y must lie within ±1e9, start within ±{most:.1e}, and the length be above 0 and at most {most:.1e}, not {found:?}"
    )]
    AreaLine {
        /// Counted from 1.
        line: usize,
        /// As given.
        found: AreaLine,
        /// The longest.
        most: f64,
    },
    /// Lines too far apart in x for one lattice.
    #[error("the extent of the area in x is {extent:.3e}, at most {most:.1e} can be held")]
    Extent {
        /// From the smallest x to the largest.
        extent: f64,
        /// The largest.
        most: f64,
    },
    /// Too many lines to sum.
    #[error(
        "more than {most} lines of the area lie within {reach:.3} of each other, the reach of the footprint across"
    )]
    Crowded {
        /// Of the footprint across the lines.
        reach: f64,
        /// Lines within it.
        most: usize,
    },
    /// More than memory holds.
    #[error(
        "the grooves of {lines} lines over {extent:.3e} in x take {:.1} GB, and 1 GB is held at most: fewer or shorter lines will do",
        bytes / 1e9
    )]
    Memory {
        /// Lines with a y of their own.
        lines: usize,
        /// From the smallest x to the largest.
        extent: f64,
        /// What they take.
        bytes: f64,
    },
    /// A shape whose lines are all to be the same.
    #[error("an area is scanned one-way or zigzag: name a line as often as it is to be repeated")]
    RepeatedArea,
    /// Nothing that could be scanned with.
    #[error("a raster needs a spring: without one there is no support that goes along lines")]
    NoSpring,
    /// A footprint without reach.
    #[error("a raster needs a footprint that fades along the lines, as J0 does not")]
    NeverFades,
    /// The tip is not f(x,0).
    #[error("the tip function of the law is not the footprint's section y = 0")]
    Section,
    /// A line could not be run.
    #[error("line {line}: {error}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// Why.
        error: RunError,
    },
}

/// The most lines; their histories take some 20 kB each at 100 widths.
pub const MOST_LINES: usize = 1_000_000;
