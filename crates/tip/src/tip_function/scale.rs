//! The unit of length of a footprint.

use super::TipFunction;

/// Bandwidth of a Gaussian of width 1: beyond it the transform exp(-k²/2) is below round-off.
pub const BAND_OF_A_GAUSSIAN: f64 = 8.7;

/// Length of n widths of an f with this [band](TipFunction::band), in σ. The width of f is that of a Gaussian with the
/// same bandwidth, about half of the narrowest hump of f.
pub fn widths(n: f64, band: f64) -> f64 {
    n * BAND_OF_A_GAUSSIAN / band
}

impl TipFunction {
    /// Length of n [`widths`] of this footprint, in σ.
    pub fn widths(&self, n: f64) -> f64 {
        widths(n, self.band())
    }
}
