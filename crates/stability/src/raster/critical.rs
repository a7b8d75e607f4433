//! Threshold of the waves of a raster, with its certificate.

/// Order of the scan directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RasterPath {
    /// Every line in the same direction.
    OneWay,
    /// Trace and retrace are successive lines.
    Zigzag,
}

/// Kinds of waves of the scan lines of a raster.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema), schemars(rename = "RasterKindName"))]
pub enum RasterKind {
    /// Crests across the lines or oblique, at 22.5° or more to them.
    Ripples,
    /// Crests nearly along the lines: lines move into the grooves of earlier ones and form trenches along the scan, or
    /// pairs of lines.
    Bunching,
    /// Deviations across the lines, caused mainly by each line's own groove.
    Snaking,
}

impl RasterKind {
    /// The name in documents.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Ripples => "ripples",
            Self::Bunching => "bunching",
            Self::Snaking => "snaking",
        }
    }
}

/// The threshold above which waves grow from line to line. Lengths in σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RasterCritical {
    /// Kind of the wave: ripples, unless the tip is flexible across the lines.
    pub kind: RasterKind,
    /// The smallest α with a wave that does not decay from line to line.
    pub alpha: f64,
    /// The support velocity r.
    pub r: f64,
    /// Wave number q along the lines.
    pub q: f64,
    /// Phase φ from one line to the next, between -π and π; on a zigzag the phase from trace to retrace.
    pub phase_per_line: f64,
    /// φ/d, the wave number across the lines; `None` on a zigzag.
    pub kappa: Option<f64>,
    /// Angle between crests and scan lines, in degrees: atan(q/|κ|); `None` on a zigzag.
    pub crest_angle: Option<f64>,
    /// Wavelength 2π/q; infinite if the tracks stay straight.
    pub wavelength_x: f64,
    /// Evidence that this is the threshold.
    pub certificate: RasterCertificate,
}

/// Evidence that no ripple grows below the threshold, and that one grows above it.
///
/// Let a ripple grow by the factor z from line to line. Growing ripples are the zeros of a determinant within the unit
/// circle of w = 1/z (w² on a zigzag), counted by the change of its argument along the circle. The search over all wave
/// numbers and phases excludes zeros on the circle, and with them any growth, for all α below the threshold by more than
/// `tolerance`. It uses floating-point arithmetic with bounds of the truncation errors, not interval arithmetic.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(rename = "RasterCertificateDocument"))]
#[cfg_attr(
    feature = "schema",
    schemars(
        description = "Evidence that no ripple grows below a threshold, and that one grows above."
    )
)]
pub struct RasterCertificate {
    /// Relative tolerance of the search over all wave numbers and phases: it rules out a threshold lower by more than
    /// this.
    pub tolerance: f64,
    /// Number of cells of wave numbers and phases that the search examined.
    pub cells: usize,
    /// Relative distance from the threshold of the two values of α at which growing waves of this q were counted.
    pub margin: f64,
    /// Number of waves that grow below the threshold (pairs ±z for a zigzag); null if the lines interact too weakly
    /// for a count.
    pub growing_below: Option<usize>,
    /// Number of waves that grow above the threshold; null if `growing_below` is.
    pub growing_above: Option<usize>,
}
