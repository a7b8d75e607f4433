//! What a sweep varies beside footprint, r and α.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A parameter by its option, and its values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisDocument {
    /// Which one.
    pub name: AxisName,
    /// Its values, in its own unit.
    pub values: Vec<f64>,
}

/// Parameters that may vary, by the names of their options.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum AxisName {
    /// b of (61), in kσ²/a.
    DepthLimit,
    /// T, in Γ/k.
    HealingTime,
    /// M, in Γ²/k.
    Inertia,
    /// X, in σ.
    StartPosition,
    /// D, in σ.
    Kick,
    /// V, in kσ/Γ.
    StartVelocity,
    /// Amplitude of the noise on the initial surface, in kσ²/a.
    Noise,
    /// Of the grid of the noise, in σ.
    NoiseSpacing,
    /// Of the noise.
    Seed,
}

impl AxisName {
    /// Its option without hyphens, as a column is named.
    pub fn column(self) -> &'static str {
        match self {
            Self::DepthLimit => "depth_limit",
            Self::HealingTime => "healing_time",
            Self::Inertia => "inertia",
            Self::StartPosition => "start_position",
            Self::Kick => "kick",
            Self::StartVelocity => "start_velocity",
            Self::Noise => "noise",
            Self::NoiseSpacing => "noise_spacing",
            Self::Seed => "seed",
        }
    }

    /// Its label with its unit.
    pub fn label(self) -> &'static str {
        match self {
            Self::DepthLimit => "depth limit b (kσ²/a)",
            Self::HealingTime => "healing time T (Γ/k)",
            Self::Inertia => "inertia M (Γ²/k)",
            Self::StartPosition => "start position (σ)",
            Self::Kick => "kick (σ)",
            Self::StartVelocity => "start velocity (kσ/Γ)",
            Self::Noise => "noise (kσ²/a)",
            Self::NoiseSpacing => "spacing of the noise (σ)",
            Self::Seed => "seed",
        }
    }
}
