//! The pattern of a raster.

use crate::schema::JsonSchema;
use crate::twins::twins;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Pattern, Regime};

/// Regimes of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RasterRegimeName {
    /// No ripples, except those that decay from the edges at which lines begin.
    Steady,
    /// Crests that repeat from line to line; on a zigzag from each line to the next one in the same direction.
    Ripples,
    /// Lines that fell into grooves of earlier lines, if the tip is free to move across: trenches along the scan, or
    /// pairs of lines.
    Bunched,
    /// Crests broken into pits; neighbouring lines are still correlated.
    Pits,
    /// Neither ripples nor pits.
    Disordered,
    /// On most lines the tip did not leave the pit at one end.
    StuckAtTheEdge,
    /// Too few or too short lines for a regime, or one line scanned repeatedly; `remarks` state how many lines would
    /// be sufficient.
    Unknown,
}

/// The strongest ripple e^{i(qx + κy)}, the highest maximum of the power spectrum of the last half of the lines.
/// Errors are halves of 95 % intervals. A number that these lines do not determine is null, with the reason in
/// `remarks`.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatternDocument {
    /// Wave number along the lines, in 1/σ, 0 for trenches along the scan; null if several waves have about the same power.
    pub q: Option<f64>,
    /// Wave number κ across the lines, in 1/σ; null if q is, and at ±π/pitch, where its sign is undefined.
    pub kappa: Option<f64>,
    /// 2π/√(q² + κ²), in σ; null also if ripples still grow or decay from line to line.
    pub wavelength: Option<f64>,
    /// Error of the wavelength (95 %), in σ.
    #[serde(default)]
    pub wavelength_error: Option<f64>,
    /// Angle between crests and scan axis, atan(q/|κ|), in degrees.
    pub crest_angle: Option<f64>,
    /// Error of the crest angle (95 %), in degrees.
    #[serde(default)]
    pub crest_angle_error: Option<f64>,
    /// Correlation of each line with the one before, shifted by the same distance for all lines; at most 1.
    pub coherence: f64,
    /// Error of the coherence (95 %).
    #[serde(default)]
    pub coherence_error: Option<f64>,
    /// Coherence of successive lines in the same direction, on a zigzag.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coherence_same_way: Option<f64>,
    /// Half peak-to-peak of the surface, in kσ²/a.
    pub amplitude: f64,
    /// Number of places at which a crest begins or ends.
    pub defects: usize,
}

impl PatternDocument {
    /// Wavelength and crest angle, such as "4.57 ± 0.33 σ" and "46 ± 3°"; `None` if unknown.
    pub fn in_words(&self) -> [Option<String>; 2] {
        let of = |value: Option<f64>, error: Option<f64>, unit: &str| {
            let value = value?;
            Some(match error.filter(|error| *error > 0.0) {
                Some(error) => format!("{}{unit}", with_error(value, error)),
                None => format!("{value:.3}{unit}"),
            })
        };
        [
            of(self.wavelength, self.wavelength_error, " σ"),
            of(self.crest_angle, self.crest_angle_error, "°"),
        ]
    }
}

/// A value with its error, rounded so that the error has two digits.
fn with_error(value: f64, error: f64) -> String {
    let places = (1.0 - error.log10().floor()).clamp(0.0, 6.0) as usize;
    format!("{value:.places$} ± {error:.places$}")
}

impl From<Pattern> for PatternDocument {
    fn from(found: Pattern) -> Self {
        Self {
            q: found.q,
            kappa: found.kappa,
            wavelength: found.wavelength,
            wavelength_error: found.wavelength_error,
            crest_angle: found.crest_angle,
            crest_angle_error: found.crest_angle_error,
            coherence: found.coherence,
            coherence_error: Some(found.coherence_error),
            coherence_same_way: found.coherence_same_way,
            amplitude: found.amplitude,
            defects: found.defects,
        }
    }
}

twins!(
    Regime => RasterRegimeName:
    Steady | Ripples | Bunched | Pits | Disordered | StuckAtTheEdge | Unknown
);

impl std::fmt::Display for RasterRegimeName {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Self::Steady => "steady",
            Self::Ripples => "ripples",
            Self::Bunched => "bunched",
            Self::Pits => "pits",
            Self::Disordered => "disordered",
            Self::StuckAtTheEdge => "stuck at the edge",
            Self::Unknown => "regime unknown",
        })
    }
}
