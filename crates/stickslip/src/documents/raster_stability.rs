//! `stickslip/raster-stability`.

use crate::documents::table::{Column, Named, Tabular};
use crate::{Document, ModelParameters, PathName, Question};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_stability::{RasterCertificate, RasterCritical};

/// Linear stability of many scan lines beside each other. Lengths in σ.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterStabilityFound {
    /// Where a ripple first does not fade from line to line; null for a line that is repeated, where every α makes some
    /// ripple grow.
    pub critical: Option<RasterCriticalDocument>,
    /// Whether every ripple fades from line to line at the α of `parameters`; null where none was given.
    pub stable: Option<bool>,
    /// By how much ripples e^{iqx} change from line to line at the α of `parameters`; null where none was given.
    pub growth: Option<RasterGrowth>,
}

/// The document of that.
pub type RasterStabilityDocument = Document<RasterStabilityParameters>;

impl Question for RasterStabilityParameters {
    const FORMAT: &'static str = "stickslip/raster-stability";
    type Answer = RasterStabilityFound;
}

/// A raster, of which α need not be given.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct RasterStabilityParameters {
    /// Footprint, α and r; the α is the critical one where none was given.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// V in f(x,y) = f(x) exp(-y²/(2V²)), in σ; null where the tip has its own f(x,y).
    pub width_y: Option<f64>,
    /// How the support goes from one line to the next.
    pub path: PathName,
    /// Distance of the lines, in σ; null where all are the same.
    pub pitch: Option<f64>,
    /// X, the length of a line, in σ, which counts where the surface heals.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub length: Option<f64>,
    /// Whether α is the critical one, for want of another.
    pub at_critical_point: bool,
}

/// Where a ripple first does not fade.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterCriticalDocument {
    /// The smallest α of such a ripple.
    pub alpha: f64,
    /// r
    pub r: f64,
    /// Its wave number along the lines, in 1/σ.
    pub q: f64,
    /// κ, the phase from line to line over the pitch, in 1/σ; null on a zigzag, where it goes to and fro.
    pub kappa: Option<f64>,
    /// Between crests and scan axis, atan(q/|κ|), in degrees; null on a zigzag.
    pub crest_angle: Option<f64>,
    /// 2π/q, in σ.
    pub wavelength_x: f64,
    /// Phase from one line to the next, from -π to π; on a zigzag that from a way there to the way back after it.
    pub phase_per_line: f64,
    /// Evidence that it is the threshold; missing in documents of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub certificate: Option<RasterCertificateDocument>,
}

/// Evidence that no ripple grows below a threshold, and that one does above.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterCertificateDocument {
    /// Largest relative distance of a lower threshold that the search over all wave numbers and phases does not rule out.
    pub tolerance: f64,
    /// Cells of wave numbers and phases that the search went through.
    pub cells: usize,
    /// Relative distance from the threshold of the two α at which the waves of its q that grow were counted.
    pub margin: f64,
    /// Waves that grow below the threshold, on a zigzag pairs ±z; null where lines feel each other too little for a count.
    pub growing_below: Option<usize>,
    /// Waves that grow above it.
    pub growing_above: Option<usize>,
}

/// Growth of ripples over wave numbers along the lines.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RasterGrowth {
    /// Wave numbers, in 1/σ.
    pub q: Vec<f64>,
    /// |z|: one way, the factor from line to line that comes to be after many; of a repeated line, the factor by which
    /// its groove changes with another pass when it was passed once.
    pub factor: Vec<f64>,
    /// arg z, the phase from line to line.
    pub phase: Vec<f64>,
}

impl From<&RasterCritical> for RasterCriticalDocument {
    fn from(critical: &RasterCritical) -> Self {
        let RasterCritical { alpha, r, q, phase_per_line, kappa, crest_angle, .. } = *critical;
        let wavelength_x = critical.wavelength_x;
        let certificate = Some((&critical.certificate).into());
        Self { alpha, r, q, kappa, crest_angle, wavelength_x, phase_per_line, certificate }
    }
}

impl From<&RasterCertificate> for RasterCertificateDocument {
    fn from(certificate: &RasterCertificate) -> Self {
        let RasterCertificate { tolerance, cells, margin, growing_below, growing_above } =
            *certificate;
        Self { tolerance, cells, margin, growing_below, growing_above }
    }
}

impl Tabular for RasterStabilityFound {
    /// The growth over wave numbers; without α the critical ripple.
    fn columns(&self) -> Vec<Named<'_>> {
        if let Some(RasterGrowth { q, factor, phase }) = &self.growth {
            return vec![
                ("q", Column::of(q)),
                ("factor", Column::of(factor)),
                ("phase", Column::of(phase)),
            ];
        }
        let column = |of: fn(&RasterCriticalDocument) -> Option<f64>| {
            Column::from(self.critical.iter().map(of).collect::<Vec<Option<f64>>>())
        };
        vec![
            ("alpha", column(|at| Some(at.alpha))),
            ("q", column(|at| Some(at.q))),
            ("kappa", column(|at| at.kappa)),
            ("crest_angle", column(|at| at.crest_angle)),
            ("wavelength_x", column(|at| Some(at.wavelength_x))),
            ("phase_per_line", column(|at| Some(at.phase_per_line))),
        ]
    }
}
