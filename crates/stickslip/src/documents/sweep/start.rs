//! Parameters of sweeps whose points are runs.

use crate::StartName;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Runs from a given initial condition, instead of the motion that the tip settles into; parameters of it that vary
/// are among the axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepRunParameters {
    /// Time at which the runs end, in Γ/k.
    pub until: f64,
    /// Initial condition.
    pub start: StartName,
    /// Start position X, in σ.
    pub start_position: f64,
    /// Kick D, in σ.
    pub kick: f64,
    /// Start velocity V, in kσ/Γ, if given.
    pub start_velocity: Option<f64>,
    /// Amplitude of the noise, in kσ²/a, if given.
    pub noise: Option<f64>,
    /// Spacing of the grid of the noise, in σ, if given.
    pub noise_spacing: Option<f64>,
    /// Seed of the noise, if given.
    pub seed: Option<f64>,
}
