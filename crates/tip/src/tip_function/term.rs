//! One of the Gaussians that a footprint is a sum of.

/// A Gaussian is below 1e-17 of its peak beyond this many widths: exp(-8.8²/2) = 1.5e-17. The factor
/// x that a derivative brings keeps that below round-off too.
pub(super) const WIDTHS_OF_REACH: f64 = 8.8;

/// One term a exp(-(x-c)²/(2w²)). Lengths in units of σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gaussian {
    /// a
    pub amplitude: f64,
    /// c
    pub center: f64,
    /// w
    pub width: f64,
}
