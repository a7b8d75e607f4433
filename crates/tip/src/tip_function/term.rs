//! A single Gaussian of a footprint.

/// A Gaussian is below 1e-17 of its peak beyond this many widths: exp(-8.8²/2) = 1.5e-17. Derivatives, which have
/// factors of x, are below round-off there too.
pub(super) const WIDTHS_OF_REACH: f64 = 8.8;

/// One term a exp(-(x-c)²/(2w²)). Lengths in units of σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaussian {
    /// Amplitude a.
    pub amplitude: f64,
    /// Center c.
    pub center: f64,
    /// Width w.
    pub width: f64,
}
