//! What is said of where waves of a raster begin to grow.

/// How the tip goes from one line to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RasterPath {
    /// Every line in the same direction.
    OneWay,
    /// The way back is the next line.
    Zigzag,
}

/// What a wave of the tracks of a raster is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RasterKind {
    /// Crests across the lines or oblique, at 22.5° or more to them.
    Ripples,
    /// Crests nearly along the lines, which fall into the grooves of earlier ones: trenches along the scan, or pairs of lines.
    Bunching,
    /// Deviations across the lines of which each line's own groove is most of the cause.
    Snaking,
}

/// Where ripples begin to grow from line to line. Lengths in σ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RasterCritical {
    /// Whether it is ripples that grow there: always, unless the tip gives way across the lines.
    pub kind: RasterKind,
    /// The smallest α with a ripple that does not fade from line to line.
    pub alpha: f64,
    /// r
    pub r: f64,
    /// Its wave number along the lines.
    pub q: f64,
    /// Phase φ from one line to the next, between -π and π; on a zigzag that from a way there to the way back.
    pub phase_per_line: f64,
    /// φ/d, the wave number across the lines; `None` on a zigzag.
    pub kappa: Option<f64>,
    /// Between crests and scan lines, in degrees: atan(q/|κ|); `None` on a zigzag.
    pub crest_angle: Option<f64>,
    /// 2π/q; infinite where the tracks stay straight.
    pub wavelength_x: f64,
    /// What shows that it is the threshold.
    pub certificate: RasterCertificate,
}

/// Evidence that no ripple grows below the threshold, and that one does above.
///
/// Ripples that grow are the zeros of a determinant within the unit circle of w = 1/z (w² on a zigzag), counted by its turns
/// along the circle. The search over all wave numbers and phases ruled out zeros on the circle, and with them any growth, at
/// all α below the threshold by more than `tolerance`. It is floating-point arithmetic with bounds of what it leaves out,
/// not interval arithmetic.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RasterCertificate {
    /// By how much of itself a lower threshold could at most be lower.
    pub tolerance: f64,
    /// Cells of wave numbers and phases that the search went through.
    pub cells: usize,
    /// Distance from the threshold, as a part of it, of the two α at which waves of its q were counted.
    pub margin: f64,
    /// How many grow below; `None` where they could not be counted, for lines that hardly feel each other.
    pub growing_below: Option<usize>,
    /// How many grow above.
    pub growing_above: Option<usize>,
}
