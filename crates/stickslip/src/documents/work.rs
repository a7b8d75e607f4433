//! Cost of a run, and the steady motion at its parameters.

use crate::schema::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_tip::{Model, Work};

/// Steady motion.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SteadyState {
    /// l0 = α f(0)/r, in σ.
    pub l: f64,
    /// r + l0, the lag of the tip behind the support, in σ.
    pub lag: f64,
    /// Height far behind the tip, (25), in kσ²/a; null if ∫f is not finite.
    pub surface_behind: Option<f64>,
    /// u0, the height under the tip, in kσ²/a, if there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    /// w0, the rate of indentation relative to α, if there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
}

impl SteadyState {
    /// The steady motion of a model; `None` without a spring, or if the history integral diverges.
    pub fn of(model: &Model) -> Option<Self> {
        let there = model.wider().spring && model.steady_l().is_finite();
        there.then(|| Self::from(model))
    }
}

impl From<&Model> for SteadyState {
    fn from(model: &Model) -> Self {
        let behind = model.steady_surface_behind();
        let limited = model.wider().depth_limit;
        Self {
            l: model.steady_l(),
            lag: model.steady_lag(),
            surface_behind: behind.is_finite().then_some(behind),
            height: limited.map(|_| model.steady_height()),
            weight: limited.map(|_| model.steady_weight()),
        }
    }
}

/// Counts that depend on the input alone, and the time of the computation.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct WorkDocument {
    /// Memory in use at the end.
    pub memory: String,
    /// Reason for the choice of `memory`.
    pub memory_reason: String,
    /// Number of accepted steps.
    pub steps: u64,
    /// Number of steps repeated with a smaller length.
    pub rejected: u64,
    /// Number of Newton iterations in all steps.
    pub newton_iterations: u64,
    /// Number of Taylor expansions; each makes one or several steps without iteration.
    #[serde(default)]
    pub series: u64,
    /// Number of changes from Taylor steps to collocation.
    #[serde(default)]
    pub switches: u64,
    /// Time of the integration alone, in seconds: the only field that differs between identical runs.
    pub seconds: f64,
}

impl WorkDocument {
    /// The cost of a run, with its time in seconds, the name of its memory and the reason for that choice.
    pub fn of(work: &Work, (memory, memory_reason): (&str, String), seconds: f64) -> Self {
        Self {
            memory: memory.into(),
            memory_reason,
            steps: work.steps,
            rejected: work.rejected,
            newton_iterations: work.newton_iterations,
            series: work.series,
            switches: work.switches,
            seconds,
        }
    }
}
