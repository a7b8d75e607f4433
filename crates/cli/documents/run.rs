//! `stickslip/run`.

use super::{ModelParameters, Software, VerificationDocument};
use crate::arguments::{MemoryName, StartName};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_outcome::Regime;

/// A tip run. Lengths in σ, times in Γ/k, forces in kσ, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RunDocument {
    /// "stickslip/run"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// Everything that defines the run.
    pub(crate) parameters: RunParameters,
    /// The steady motion at these parameters, whether or not it is stable.
    pub(crate) steady_state: SteadyState,
    /// l, x0 and x0' at the times asked for.
    pub(crate) samples: Samples,
    /// The dense history; null where it was not asked for.
    pub(crate) history: Option<History>,
    /// The kind of motion at the end of the run.
    pub(crate) regime: RegimeName,
    /// Period and amplitudes, where the regime is stick-slip.
    pub(crate) oscillation: Option<OscillationDocument>,
    /// Whether a signal stopped the run before `until`.
    pub(crate) interrupted: bool,
    /// The run against a repetition, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(crate) verification: Option<VerificationDocument>,
    /// What it took.
    pub(crate) work: WorkDocument,
}

impl RunDocument {
    pub(crate) const FORMAT: &'static str = "stickslip/run";
}

/// Everything that defines a run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
pub(crate) struct RunParameters {
    /// Footprint, α and r.
    #[serde(flatten)]
    pub(crate) model: ModelParameters,
    /// Initial state.
    pub(crate) start: StartName,
    /// X: position of the tip at the start, in σ.
    pub(crate) start_position: f64,
    /// D: the tip starts at X - D, in σ.
    pub(crate) kick: f64,
    /// Noise added to the initial surface.
    pub(crate) noise: Option<NoiseParameters>,
    /// Profile added to the initial surface.
    pub(crate) initial_surface: Option<Profile>,
    /// Gaussian pulses of external force.
    pub(crate) pulses: Vec<PulseParameters>,
    /// Tabulated external force.
    pub(crate) force: Option<ForceTable>,
    /// Time at which the run was to end, in Γ/k.
    pub(crate) until: f64,
    /// Error of l asked for, in σ.
    pub(crate) tolerance: f64,
    /// Memory asked for.
    pub(crate) memory: MemoryName,
}

/// Heights uniform in [-amplitude, amplitude] on a grid, a cubic spline through them.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct NoiseParameters {
    /// Largest height, 0 or above, in kσ²/a.
    pub(crate) amplitude: f64,
    /// Distance of the grid points, in σ.
    pub(crate) spacing: f64,
    /// Of the random numbers.
    pub(crate) seed: u64,
}

/// A height profile.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Profile {
    /// Positions, ascending, in σ.
    pub(crate) x: Vec<f64>,
    /// Heights there, in kσ²/a.
    pub(crate) u: Vec<f64>,
}

/// amplitude · exp(-(t-time)²/(2 width²)).
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct PulseParameters {
    /// Largest force, in kσ.
    pub(crate) amplitude: f64,
    /// When it is largest, in Γ/k.
    pub(crate) time: f64,
    /// Standard deviation in time, in Γ/k.
    pub(crate) width: f64,
}

/// External force against time.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct ForceTable {
    /// Times, ascending, in Γ/k.
    pub(crate) t: Vec<f64>,
    /// Forces then, in kσ.
    pub(crate) force: Vec<f64>,
}

/// Steady motion.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct SteadyState {
    /// l0 = α f(0)/r, in σ.
    pub(crate) l: f64,
    /// r + l0, the distance by which the tip lags behind the support, in σ.
    pub(crate) lag: f64,
    /// Height far behind the tip, (25), in kσ²/a; null where ∫f is not finite.
    pub(crate) surface_behind: Option<f64>,
}

/// Columns of equal length.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Samples {
    /// Times, in Γ/k.
    pub(crate) t: Vec<f64>,
    /// l = rt - r - x0, in σ.
    pub(crate) l: Vec<f64>,
    /// Position of the tip, in σ.
    pub(crate) x0: Vec<f64>,
    /// x0', in kσ/Γ, the derivative of the dense history: one order less accurate than x0.
    pub(crate) velocity: Vec<f64>,
}

/// The accepted steps, each a polynomial: x0(t) at every t of the run.
///
/// In step i, from t[i] to t[i+1], x0(t) = r t[i] - extension[i] + p(τ), τ = (t - t[i])/(t[i+1] - t[i]),
/// where p is the polynomial through 0 at τ = 0 and displacement[i][j] at τ = nodes[j]. The tip's
/// residence, from which `surface` works, is the time weights[j] (t[i+1] - t[i]) spent at each of the
/// nodes.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct History {
    /// Collocation nodes (Radau IIA), as parts of a step.
    pub(crate) nodes: Vec<f64>,
    /// Quadrature weights of the nodes, as parts of a step.
    pub(crate) weights: Vec<f64>,
    /// Start of each step, and the end of the last, in Γ/k.
    pub(crate) t: Vec<f64>,
    /// rt - x0 at the start of each step, in σ.
    pub(crate) extension: Vec<f64>,
    /// x0 less its value at the start of the step, at the nodes, in σ.
    pub(crate) displacement: Vec<Vec<f64>>,
}

/// Kinds of motion.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum RegimeName {
    /// l stays at l0.
    Steady,
    /// A periodic motion that repeats itself.
    StickSlip,
    /// The tip creeps logarithmically in its own pit and will not come out.
    Trapped,
    /// None of these yet.
    Transient,
}

impl From<Regime> for RegimeName {
    fn from(regime: Regime) -> Self {
        match regime {
            Regime::Steady => Self::Steady,
            Regime::StickSlip => Self::StickSlip,
            Regime::Trapped => Self::Trapped,
            Regime::Transient => Self::Transient,
        }
    }
}

impl std::fmt::Display for RegimeName {
    fn fmt(&self, out: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        out.write_str(match self {
            Self::Steady => "steady",
            Self::StickSlip => "stick-slip",
            Self::Trapped => "trapped",
            Self::Transient => "transient",
        })
    }
}

/// The periodic motion at the end of the run. Amplitudes are half peak-to-peak.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct OscillationDocument {
    /// T, in Γ/k.
    pub(crate) period: f64,
    /// r times the period, in σ.
    pub(crate) wavelength: f64,
    /// Half peak-to-peak of l, that is of x0 less its steady advance, in σ.
    pub(crate) amplitude_x0: f64,
    /// Half peak-to-peak of the surface left behind, (35), in kσ²/a; null where less than one wavelength lies out
    /// of reach of the tip, or f never fades.
    pub(crate) amplitude_u: Option<f64>,
    /// Maxima of l in one period.
    pub(crate) slips: usize,
    /// Largest change of a maximum of l from one period to the next, over the amplitude.
    pub(crate) drift: f64,
}

/// Counts that depend on the input alone, and the time that it took.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct WorkDocument {
    /// Memory in use at the end.
    pub(crate) memory: String,
    /// Why that one.
    pub(crate) memory_reason: String,
    /// Accepted steps.
    pub(crate) steps: u64,
    /// Steps repeated with a smaller length.
    pub(crate) rejected: u64,
    /// Newton iterations in all steps.
    pub(crate) newton_iterations: u64,
    /// Time of the integration alone, in seconds: the one field that differs from run to run.
    pub(crate) seconds: f64,
}
