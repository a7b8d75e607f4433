//! Further axes of a sweep, besides footprint, r and α.

use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};

/// A parameter, named by its option, with its values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AxisDocument {
    /// The parameter.
    pub name: AxisName,
    /// Values of the parameter, in its own unit.
    pub values: Vec<f64>,
}

/// Parameters that may vary, by the names of their options.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum AxisName {
    /// Depth limit b of (61), in kσ²/a.
    DepthLimit,
    /// Healing time T, in Γ/k.
    HealingTime,
    /// Inertia M, in Γ²/k.
    Inertia,
    /// Start position X, in σ.
    StartPosition,
    /// Kick D, in σ.
    Kick,
    /// Start velocity V, in kσ/Γ.
    StartVelocity,
    /// Amplitude of the noise on the initial surface, in kσ²/a.
    Noise,
    /// Spacing of the grid of the noise, in σ.
    NoiseSpacing,
    /// Seed of the noise.
    Seed,
}

impl AxisName {
    /// The name of the column, that of the option with underscores; and the label, with its unit.
    fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::DepthLimit => ("depth_limit", "depth limit b (kσ²/a)"),
            Self::HealingTime => ("healing_time", "healing time T (Γ/k)"),
            Self::Inertia => ("inertia", "inertia M (Γ²/k)"),
            Self::StartPosition => ("start_position", "start position (σ)"),
            Self::Kick => ("kick", "kick (σ)"),
            Self::StartVelocity => ("start_velocity", "start velocity (kσ/Γ)"),
            Self::Noise => ("noise", "noise (kσ²/a)"),
            Self::NoiseSpacing => ("noise_spacing", "spacing of the noise (σ)"),
            Self::Seed => ("seed", "seed"),
        }
    }

    /// The name of the column.
    pub fn column(self) -> &'static str {
        self.names().0
    }

    /// The label, with its unit.
    pub fn label(self) -> &'static str {
        self.names().1
    }
}
