//! Threshold of the waves of a raster, with its certificate.

/// Order of the scan directions.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RasterPath {
    /// Every line in the same direction.
    OneWay,
    /// Trace and retrace are successive lines.
    Zigzag,
}

/// Kinds of waves of a raster.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RasterKind {
    /// Ripples: crests perpendicular or oblique to the lines, at an angle of 22.5° or more.
    Ripples,
    /// Bunching: crests nearly along the lines, which fall into the grooves of earlier ones. Trenches along the scan,
    /// or pairs of lines.
    Bunching,
    /// Snaking: deviations across the lines, mainly caused by the groove of each line itself.
    Snaking,
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
pub struct RasterCertificate {
    /// No other threshold is lower than this one by more than this fraction.
    pub tolerance: f64,
    /// Number of cells of wave numbers and phases examined.
    pub cells: usize,
    /// Relative distance from the threshold of the two α at which waves of its q were counted.
    pub margin: f64,
    /// Number of growing waves at the lower α; `None` if they cannot be counted, for lines that hardly affect each
    /// other.
    pub growing_below: Option<usize>,
    /// Number of growing waves at the higher α.
    pub growing_above: Option<usize>,
}
