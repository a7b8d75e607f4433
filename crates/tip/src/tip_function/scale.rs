//! The length that a footprint sets, by which others measure.

use super::TipFunction;

/// The band of a Gaussian of width 1: its transform exp(-k²/2) is below round-off beyond.
pub const BAND_OF_A_GAUSSIAN: f64 = 8.7;

/// So many widths of an f with this [band](TipFunction::band), in σ: of a Gaussian its own, of any other f that of a
/// Gaussian with the same band, about half of its narrowest hump.
#[must_use]
pub fn widths(n: f64, band: f64) -> f64 {
    n * BAND_OF_A_GAUSSIAN / band
}

impl TipFunction {
    /// So many of its [`widths`], in σ.
    #[must_use]
    pub fn widths(&self, n: f64) -> f64 {
        widths(n, self.band())
    }
}
