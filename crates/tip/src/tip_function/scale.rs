//! The unit of length of a footprint.

use super::TipFunction;

/// Bandwidth of a Gaussian of width 1: beyond it the transform exp(-k²/2) is below round-off.
pub const BAND_OF_A_GAUSSIAN: f64 = 8.7;

/// Length of n widths of an f with this [band](TipFunction::band), in σ. The width of a Gaussian is its own. For any
/// other f it is the width of a Gaussian with the same band, about half of its narrowest hump.
pub fn widths(n: f64, band: f64) -> f64 {
    n * BAND_OF_A_GAUSSIAN / band
}

impl TipFunction {
    /// Length of n of its [`widths`], in σ.
    pub fn widths(&self, n: f64) -> f64 {
        widths(n, self.band())
    }
}
