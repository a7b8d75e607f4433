//! What defines a run: from a scenario to its parameters in a document, and back.

use crate::{ModelParameters, Unusable};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_tip::{Force, MemoryChoice, Noise, Pulse, Scenario, Start, SupportPath};

/// Everything that defines a run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub struct RunParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub model: ModelParameters,
    /// Initial state.
    pub start: StartName,
    /// X: position of the tip at the start, in σ.
    pub start_position: f64,
    /// D: the tip starts at X - D, in σ.
    pub kick: f64,
    /// Motion of the support, where it has one of its own: R less where it starts, straight between the knots.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub support_path: Option<SupportPathParameters>,
    /// Velocity of the tip at the start, in kσ/Γ, where it was given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub start_velocity: Option<f64>,
    /// Noise added to the initial surface.
    pub noise: Option<NoiseParameters>,
    /// Profile added to the initial surface.
    pub initial_surface: Option<Profile>,
    /// Gaussian pulses of external force.
    pub pulses: Vec<PulseParameters>,
    /// Tabulated external force.
    pub force: Option<ForceTable>,
    /// Time at which the run was to end, in Γ/k.
    pub until: f64,
    /// Error of l asked for, in σ.
    pub tolerance: f64,
    /// Memory asked for.
    pub memory: MemoryName,
}

/// Heights uniform in [-amplitude, amplitude] on a grid, a cubic spline through them.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NoiseParameters {
    /// Largest height, 0 or above, in kσ²/a.
    pub amplitude: f64,
    /// Distance of the grid points, in σ.
    pub spacing: f64,
    /// Of the random numbers.
    pub seed: u64,
}

/// Knots of a path: straight between them.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SupportPathParameters {
    /// Times from the start of the run, ascending, in Γ/k.
    pub t: Vec<f64>,
    /// Displacements of the support from where it starts, in σ.
    #[serde(rename = "R")]
    pub displacement: Vec<f64>,
}

/// A height profile.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Profile {
    /// Positions, ascending, in σ.
    pub x: Vec<f64>,
    /// Heights there, in kσ²/a.
    pub u: Vec<f64>,
}

/// amplitude · exp(-(t-time)²/(2 width²)).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PulseParameters {
    /// Largest force, in kσ.
    pub amplitude: f64,
    /// When it is largest, in Γ/k.
    pub time: f64,
    /// Standard deviation in time, in Γ/k.
    pub width: f64,
}

/// External force against time.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ForceTable {
    /// Times, ascending, in Γ/k.
    pub t: Vec<f64>,
    /// Forces then, in kσ.
    pub force: Vec<f64>,
}

/// What the tip finds at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StartName {
    /// The steady state, as after an infinite past.
    Steady,
    /// A flat surface, the spring relaxed, the support above the tip.
    Flat,
}

/// How the past is remembered.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MemoryName {
    /// The cheapest: direct while few points lie within reach of the tip, then modes, or fft where no
    /// exponentials fit.
    Auto,
    /// A sum over the history within reach: the definition, slow for long histories.
    Direct,
    /// FFT convolution with the residence density: the same cost for any history.
    Fft,
    /// A sum of few exponentials, for tip functions that fade: a step costs the same for ever, and less
    /// than with fft.
    Modes,
}

impl RunParameters {
    /// Those of a scenario; the force is given as what it was made of, pulses and a table (t, force).
    pub fn of(
        scenario: &Scenario,
        alpha_above: Option<f64>,
        pulses: &[Pulse],
        force: Option<(Vec<f64>, Vec<f64>)>,
    ) -> Self {
        Self {
            model: ModelParameters::of(&scenario.model, alpha_above),
            start: scenario.start.into(),
            start_position: scenario.start_position,
            kick: scenario.kick,
            support_path: scenario.path.as_ref().map(Into::into),
            start_velocity: scenario.start_velocity,
            noise: scenario.noise.map(Into::into),
            initial_surface: scenario.profile.clone().map(|(x, u)| Profile { x, u }),
            pulses: pulses.iter().copied().map(Into::into).collect(),
            force: force.map(|(t, force)| ForceTable { t, force }),
            until: scenario.until,
            tolerance: scenario.tolerance,
            memory: scenario.memory.into(),
        }
    }

    /// The scenario that was run.
    ///
    /// # Errors
    /// No run can be that of these parameters.
    pub fn scenario(&self) -> Result<Scenario, Unusable> {
        let pulses = self.pulses.iter().map(Into::into).collect();
        let table = self.force.clone().map(|table| (table.t, table.force));
        let force = Force::new(pulses, table).map_err(Unusable::new)?;
        let scenario = Scenario {
            start: self.start.into(),
            start_position: self.start_position,
            kick: self.kick,
            path: self.support_path.as_ref().map(SupportPathParameters::path).transpose()?,
            start_velocity: self.start_velocity,
            noise: self.noise.as_ref().map(Into::into),
            profile: self.initial_surface.clone().map(|profile| (profile.x, profile.u)),
            force,
            tolerance: self.tolerance,
            memory: self.memory.into(),
            ..Scenario::new(self.model.model()?, self.until)
        };
        scenario.validate().map_err(Unusable::new)?;
        Ok(scenario)
    }
}

impl From<&SupportPath> for SupportPathParameters {
    fn from(path: &SupportPath) -> Self {
        let (t, displacement) = path.knots();
        Self { t: t.to_vec(), displacement: displacement.to_vec() }
    }
}

impl SupportPathParameters {
    fn path(&self) -> Result<SupportPath, Unusable> {
        SupportPath::new(self.t.clone(), self.displacement.clone()).map_err(Unusable::new)
    }
}

impl From<Pulse> for PulseParameters {
    fn from(pulse: Pulse) -> Self {
        Self { amplitude: pulse.amplitude, time: pulse.time, width: pulse.width }
    }
}

impl From<&PulseParameters> for Pulse {
    fn from(pulse: &PulseParameters) -> Self {
        Self { amplitude: pulse.amplitude, time: pulse.time, width: pulse.width }
    }
}

impl From<Noise> for NoiseParameters {
    fn from(noise: Noise) -> Self {
        Self { amplitude: noise.amplitude, spacing: noise.spacing, seed: noise.seed }
    }
}

impl From<&NoiseParameters> for Noise {
    fn from(noise: &NoiseParameters) -> Self {
        Self { amplitude: noise.amplitude, spacing: noise.spacing, seed: noise.seed }
    }
}

impl From<Start> for StartName {
    fn from(start: Start) -> Self {
        match start {
            Start::Steady => Self::Steady,
            Start::Flat => Self::Flat,
        }
    }
}

impl From<StartName> for Start {
    fn from(name: StartName) -> Self {
        match name {
            StartName::Steady => Self::Steady,
            StartName::Flat => Self::Flat,
        }
    }
}

impl From<MemoryChoice> for MemoryName {
    fn from(memory: MemoryChoice) -> Self {
        match memory {
            MemoryChoice::Auto => Self::Auto,
            MemoryChoice::Direct => Self::Direct,
            MemoryChoice::Fft => Self::Fft,
            MemoryChoice::Modes => Self::Modes,
        }
    }
}

impl From<MemoryName> for MemoryChoice {
    fn from(name: MemoryName) -> Self {
        match name {
            MemoryName::Auto => Self::Auto,
            MemoryName::Direct => Self::Direct,
            MemoryName::Fft => Self::Fft,
            MemoryName::Modes => Self::Modes,
        }
    }
}
