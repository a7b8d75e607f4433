//! What a raster has written.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_raster::{Pattern, Regime};

/// Kinds of surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RasterRegimeName {
    /// No ripples, but for what fades from the edge at which lines begin.
    Steady,
    /// Crests, the same from line to line; on a zigzag from each to the next that goes the same way.
    Ripples,
    /// Crests broken into pits, lines still following each other.
    Pits,
    /// Neither.
    Disordered,
    /// On most lines the tip did not come out of the pit at their beginning.
    StuckAtTheEdge,
    /// Too few or too short lines to tell, or the same line over and over.
    Unknown,
}

/// A ripple e^{i(qx + κy)}.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PatternDocument {
    /// Wave number along the lines, in 1/σ.
    pub q: f64,
    /// Wave number κ across the lines, in 1/σ.
    pub kappa: f64,
    /// 2π/√(q² + κ²), in σ.
    pub wavelength: f64,
    /// Between crests and scan axis, atan(q/|κ|), in degrees.
    pub crest_angle: f64,
    /// How far each line is the one before, shifted: 1 where all shifts are the same.
    pub coherence: f64,
    /// The same of lines that go the same way, on a zigzag.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coherence_same_way: Option<f64>,
    /// Half peak-to-peak of the surface, in kσ²/a.
    pub amplitude: f64,
    /// Places where a crest begins or ends.
    pub defects: usize,
}

impl From<Pattern> for PatternDocument {
    fn from(found: Pattern) -> Self {
        let Pattern { q, kappa, wavelength, crest_angle, .. } = found;
        let Pattern { coherence, coherence_same_way, amplitude, defects, .. } = found;
        Self {
            q,
            kappa,
            wavelength,
            crest_angle,
            coherence,
            coherence_same_way,
            amplitude,
            defects,
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
            Self::Unknown => "no regime to be told",
        })
    }
}
