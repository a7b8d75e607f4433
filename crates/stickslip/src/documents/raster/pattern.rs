//! What a raster has written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Pattern, Regime};

/// Kinds of surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RasterRegimeName {
    /// No ripples, but for what fades from the edges at which lines begin.
    Steady,
    /// Crests, the same from line to line; on a zigzag from each to the next that goes the same way.
    Ripples,
    /// Crests broken into pits, lines still following each other.
    Pits,
    /// Neither.
    Disordered,
    /// On most lines the tip did not leave the pit at an end of them.
    StuckAtTheEdge,
    /// Too few or too short lines for a regime, or the same line over and over; `remarks` say what would be enough.
    Unknown,
}

/// The strongest ripple e^{i(qx + κy)}, the highest maximum of the power spectrum of the last half of the lines. Errors are
/// halves of 95 % intervals. Where these lines do not determine a number it is null, and `remarks` say why.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatternDocument {
    /// Wave number along the lines, in 1/σ; null where several waves are about as strong.
    pub q: Option<f64>,
    /// Wave number κ across the lines, in 1/σ; null as q, and at ±π/pitch, where its sign is undefined.
    pub kappa: Option<f64>,
    /// 2π/√(q² + κ²), in σ; null also where ripples still grow or fade from line to line.
    pub wavelength: Option<f64>,
    /// Error of the wavelength (95 %), in σ.
    #[serde(default)]
    pub wavelength_error: Option<f64>,
    /// Between crests and scan axis, atan(q/|κ|), in degrees.
    pub crest_angle: Option<f64>,
    /// Error of the crest angle (95 %), in degrees.
    #[serde(default)]
    pub crest_angle_error: Option<f64>,
    /// How far each line is the one before, shifted: 1 where all shifts are the same.
    pub coherence: f64,
    /// Error of the coherence (95 %).
    #[serde(default)]
    pub coherence_error: Option<f64>,
    /// The same of lines that go the same way, on a zigzag.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coherence_same_way: Option<f64>,
    /// Half peak-to-peak of the surface, in kσ²/a.
    pub amplitude: f64,
    /// Places where a crest begins or ends.
    pub defects: usize,
}

impl PatternDocument {
    /// Such as "4.57 ± 0.33 σ", and "46 ± 3°"; `None` where it is not known.
    #[must_use]
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

/// With as many places as give the error two digits.
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

impl From<Regime> for RasterRegimeName {
    fn from(regime: Regime) -> Self {
        match regime {
            Regime::Steady => Self::Steady,
            Regime::Ripples => Self::Ripples,
            Regime::Pits => Self::Pits,
            Regime::Disordered => Self::Disordered,
            Regime::StuckAtTheEdge => Self::StuckAtTheEdge,
            Regime::Unknown => Self::Unknown,
        }
    }
}

impl std::fmt::Display for RasterRegimeName {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Self::Steady => "steady",
            Self::Ripples => "ripples",
            Self::Pits => "pits",
            Self::Disordered => "disordered",
            Self::StuckAtTheEdge => "stuck at the edge",
            Self::Unknown => "regime unknown",
        })
    }
}
