//! A single Gaussian of a footprint.

/// A Gaussian is below 1e-17 of its peak beyond this many widths: exp(-8.8²/2) = 1.5e-17. Derivatives, which have
/// factors of x, are below round-off there too.
pub(super) const WIDTHS_OF_REACH: f64 = 8.8;

/// One Gaussian, a exp(-(x-c)²/(2w²)).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "GaussianDocument"))]
pub struct Gaussian {
    /// a, dimensionless.
    pub amplitude: f64,
    /// c, in σ
    pub center: f64,
    /// w, in σ
    pub width: f64,
}
