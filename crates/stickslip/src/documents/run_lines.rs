//! `stickslip/run-lines`.

use crate::{
    CreepDocument, DriftDocument, FORMAT_VERSION, OscillationDocument, RegimeName, RunParameters,
    Software, SteadyState, TransientDocument, WorkDocument,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use stickslip_outcome::Outcome;
use stickslip_tip::{Step, Support, Wider};

/// A line of a run written as it goes on (`.jsonl`): the first says what is run, one follows for each
/// sample, the last says what became of it. Without a last line the run did not come to an end.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum RunLine {
    /// The first line.
    Head(Box<RunHead>),
    /// A sample.
    Sample(SampleLine),
    /// The last line.
    End(Box<RunEnd>),
}

/// What is run. Lengths in σ, times in Γ/k, forces in kσ, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunHead {
    /// "stickslip/run-lines"
    pub format: String,
    /// 1
    pub format_version: u32,
    /// The program that wrote it.
    pub software: Software,
    /// Everything that defines the run.
    pub parameters: RunParameters,
    /// The steady motion at these parameters, whether or not it is stable; null without a spring.
    pub steady_state: Option<SteadyState>,
}

impl RunHead {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/run-lines";

    /// The first line of a run with these parameters.
    pub fn new(parameters: RunParameters, steady_state: Option<SteadyState>) -> Self {
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            parameters,
            steady_state,
        }
    }
}

/// l, x0 and x0' at one time.
#[derive(Debug, Clone, Copy, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SampleLine {
    /// Time, in Γ/k.
    pub t: f64,
    /// l = rt - r - x0, in σ; null for a support on a path of its own, or none.
    pub l: Option<f64>,
    /// R - x0, the extension of the spring, in σ; null without a spring.
    #[serde(default)]
    pub lag: Option<f64>,
    /// Position of the tip, in σ.
    pub x0: f64,
    /// x0', in kσ/Γ, one order less accurate than x0.
    pub velocity: f64,
    /// Height of the surface under the tip, in kσ²/a, where there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub height: Option<f64>,
    /// w, the rate of indentation relative to α, where there is a depth limit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub weight: Option<f64>,
}

impl SampleLine {
    /// Of a motion at a time within one of its steps.
    pub fn of(step: &Step, (support, wider): (&Support, &Wider), t: f64) -> Self {
        let height = step.height(t);
        Self {
            t,
            l: match support {
                Support::Moving(r) => Some(step.l(*r, t)),
                Support::Path(_) | Support::None => None,
            },
            lag: (*support != Support::None).then(|| step.lag(support, t)),
            x0: step.position(support, t),
            velocity: step.velocity(t),
            height,
            weight: height.map(|height| wider.weight(height)),
        }
    }
}

/// What became of the run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunEnd {
    /// Time reached, in Γ/k.
    pub end: f64,
    /// The kind of motion at the end of the run.
    pub regime: RegimeName,
    /// Period and amplitudes, where the regime is stick-slip.
    pub oscillation: Option<OscillationDocument>,
    /// The rate of creep, where the regime is trapped.
    #[serde(default)]
    pub creep: Option<CreepDocument>,
    /// The velocity, where the regime is drifting.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub drifting: Option<DriftDocument>,
    /// What it seems to go to, where the regime is transient.
    #[serde(default)]
    pub transient: Option<TransientDocument>,
    /// Where round-off, the start, the tolerance or a disturbance decides; empty if nothing does.
    #[serde(default)]
    pub remarks: Vec<String>,
    /// Whether a signal stopped the run before `until`.
    pub interrupted: bool,
    /// What it took.
    pub work: WorkDocument,
}

impl RunEnd {
    /// What became of a run that nobody stopped, at the time `end`.
    pub fn of(
        end: f64,
        outcome: Outcome,
        oscillation: Option<OscillationDocument>,
        work: WorkDocument,
    ) -> Self {
        Self {
            end,
            regime: outcome.regime.into(),
            oscillation,
            creep: outcome.creep.map(Into::into),
            drifting: outcome.drifting.map(Into::into),
            transient: outcome.prospect.map(Into::into),
            remarks: outcome.remarks.iter().map(ToString::to_string).collect(),
            interrupted: false,
            work,
        }
    }
}
