//! Errors of rasters.

use crate::path::AreaLine;
use stickslip_tip::RunError;
use stickslip_tip::planar::PlanarError;
use thiserror::Error;

/// The reason why a raster was rejected or could not be finished.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum RasterError {
    /// An invalid pitch.
    #[error(
        "the pitch must be a finite number above 0, and at least {least:.1e} for a footprint that reaches {reach:.3e} across, not {pitch:?}"
    )]
    Pitch {
        /// The value as given.
        pitch: f64,
        /// Reach of the footprint across the lines.
        reach: f64,
        /// The smallest valid pitch.
        least: f64,
    },
    /// A length that is invalid, or too large for a lattice.
    #[error(
        "the length of a line must be a finite number above 0 and at most {most:.1e}, not {length:?}"
    )]
    Length {
        /// The value as given.
        length: f64,
        /// The largest valid length.
        most: f64,
    },
    /// No lines, or too many.
    #[error("a raster has between 1 and {MOST_LINES} lines, not {0}")]
    Lines(usize),
    /// An invalid line of an area.
    #[error(
        "line {line} of the area: y must lie within ±1e9, start within ±{most:.1e}, and the length be above 0 and at most {most:.1e}, not {}, {} and {}",
        found.y, found.start, found.length
    )]
    AreaLine {
        /// Index of the line, from 1.
        line: usize,
        /// The value as given.
        found: AreaLine,
        /// The largest length.
        most: f64,
    },
    /// Lines too far apart in x for one lattice.
    #[error("the extent of the area in x is {extent:.3e}, at most {most:.1e} fits in memory")]
    Extent {
        /// Distance from the smallest x to the largest.
        extent: f64,
        /// The largest valid extent.
        most: f64,
    },
    /// Too many neighbouring lines.
    #[error(
        "more than {most} lines of the area lie within {reach:.3} of each other, which is the reach of the footprint across the scan"
    )]
    Crowded {
        /// Reach of the footprint across the lines.
        reach: f64,
        /// Largest number of lines within the reach.
        most: usize,
    },
    /// Grooves that exceed the memory limit.
    #[error(
        "the grooves of {lines} lines over {extent:.3e} in x take {:.1} GB, where at most 1 GB is used: take fewer or shorter lines",
        bytes / 1e9
    )]
    Memory {
        /// Number of lines with different y.
        lines: usize,
        /// Distance from the smallest x to the largest.
        extent: f64,
        /// Memory required, in bytes.
        bytes: f64,
    },
    /// An area of separate lines with the path `Repeat`, for which all lines coincide.
    #[error("an area is scanned one-way or zigzag: to repeat a line, list it several times")]
    RepeatedArea,
    /// A model without a spring, which cannot scan.
    #[error("a raster needs a spring: without one there is no support that moves along the lines")]
    NoSpring,
    /// A footprint without decay.
    #[error(
        "a raster needs a footprint that decays along the lines, which J0 and the cosine do not"
    )]
    NeverFades,
    /// The tip function of the model is not f(x,0).
    #[error("the tip function of the law is not the footprint's section y = 0")]
    Section,
    /// A line could not be run.
    #[error("line {line}: {error}")]
    Line {
        /// Index of the line, from 1.
        line: usize,
        /// The error of the run.
        error: RunError,
    },
    /// A line of a tip that is free to move across could not be run.
    #[error("line {line}: {error}")]
    Free {
        /// Index of the line, from 1.
        line: usize,
        /// The error of the run.
        error: PlanarError,
    },
}

impl RasterError {
    /// The error of a line, counted from 0, in two coordinates.
    pub(crate) fn of_free(n: usize, error: PlanarError) -> Self {
        match error {
            PlanarError::Along(error) => Self::Line { line: n + 1, error },
            error => Self::Free { line: n + 1, error },
        }
    }
}

/// Largest number of lines; the history of a line of 100 widths takes about 20 kB.
pub const MOST_LINES: usize = 1_000_000;
