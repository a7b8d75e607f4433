//! Points of a sweep that are runs.

use crate::StartName;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Runs from a start of their own, in place of what the tip settles into; what of it varies is among the axes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepRunParameters {
    /// Time at which they end, in Γ/k.
    pub until: f64,
    /// What the tip finds.
    pub start: StartName,
    /// X, in σ.
    pub start_position: f64,
    /// D, in σ.
    pub kick: f64,
    /// V, in kσ/Γ, where it was given.
    pub start_velocity: Option<f64>,
    /// Amplitude of the noise, in kσ²/a, where it was given.
    pub noise: Option<f64>,
    /// Spacing of its grid, in σ, where it was given.
    pub noise_spacing: Option<f64>,
    /// Its seed, where it was given.
    pub seed: Option<f64>,
}
