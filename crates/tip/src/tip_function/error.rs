//! Errors in a footprint.

use super::LARGEST;
use thiserror::Error;

/// Errors in a footprint.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TipFunctionError {
    /// No Gaussian, or none with an amplitude other than 0.
    #[error(
        "the tip function is zero everywhere: give at least one Gaussian with an amplitude other than 0"
    )]
    Zero,
    /// A Gaussian with a parameter that is not finite.
    #[error("Gaussian number {index}: amplitude, center and width must be finite numbers")]
    NotFinite {
        /// Number of the Gaussian, from 1.
        index: usize,
    },
    /// A Gaussian whose width is not positive.
    #[error("Gaussian number {index} has width {width}: a width must be above 0")]
    Width {
        /// Number of the Gaussian, from 1.
        index: usize,
        /// Width of the Gaussian.
        width: f64,
    },
    /// A Gaussian with parameters whose products are out of the range of f64.
    #[error(
        "Gaussian number {index}: amplitude and center may be at most {largest:e} in size, the width between {smallest:e} and {largest:e}",
        smallest = 1.0 / LARGEST, largest = LARGEST
    )]
    OutOfRange {
        /// Number of the Gaussian, from 1.
        index: usize,
    },
    /// A Gaussian off the origin without its mirror image, in a sum that must be even, or with f'(0) ≠ 0.
    #[error(
        "the tip function is not even: the Gaussian at center {center} lacks a twin of the same amplitude and width at {mirror}; a tip with two different sides, and of f(x,y) the part of each width across, must have its apex at x = 0, where f' = 0",
        mirror = -center
    )]
    NotEven {
        /// Center of the Gaussian without a mirror image.
        center: f64,
    },
    /// A two-dimensional Gaussian off the line y = 0 without its mirror image.
    #[error(
        "the tip function is not even in y: the Gaussian at center {center}, center_y {center_y} lacks a twin of the same amplitude and widths at center_y {mirror}"
    )]
    NotEvenAcross {
        /// x of the center of the Gaussian without a mirror image.
        center: f64,
        /// y of its center.
        center_y: f64,
        /// y of the missing mirror image.
        mirror: f64,
    },
    /// A table of f(x,y) that is not a full rectangular grid.
    #[error(
        "the table has {points} rows, no full grid of its {x} values of x and {y} values of y: give every x for every y, each once"
    )]
    TableGrid {
        /// Number of rows.
        points: usize,
        /// Number of distinct x.
        x: usize,
        /// Number of distinct y.
        y: usize,
    },
    /// The weight of the side lobes is not finite.
    #[error("beta is {0:?}: it must be a finite number")]
    Beta(f64),
    /// A table with too few or too many rows.
    #[error("the table has {found} rows: between {min} and {max} are needed")]
    TableLength {
        /// Number of rows.
        found: usize,
        /// Smallest number of rows.
        min: usize,
        /// Largest number of rows; reduce longer tables.
        max: usize,
    },
    /// A table entry that is not finite.
    #[error("row {row} of the table is not a pair of finite numbers")]
    TableNotFinite {
        /// Number of the row, from 1.
        row: usize,
    },
    /// A table whose x do not increase.
    #[error("row {row} of the table has x = {x}: x must increase from row to row")]
    TableUnsorted {
        /// Number of the row, from 1.
        row: usize,
        /// Value of x in this row.
        x: f64,
    },
    /// A table that does not begin at x = 0.
    #[error("the table starts at x = {0}: it must start at x = 0 (f is even, so x ≥ 0 is enough)")]
    TableStart(f64),
    /// A table whose last value is not small.
    #[error(
        "the table does not decay: its last value is {ratio:.1e} of its largest, and at most {most:.0e} is accepted; sample further out"
    )]
    TableDecay {
        /// |f at the last x| / max |f|.
        ratio: f64,
        /// Largest allowed ratio.
        most: f64,
    },
}
