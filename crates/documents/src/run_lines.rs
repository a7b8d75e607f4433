//! `stickslip/run-lines`.

use crate::{
    CreepDocument, FORMAT_VERSION, OscillationDocument, RegimeName, RunParameters, Software,
    SteadyState, TransientDocument, WorkDocument,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

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
    /// The steady motion at these parameters, whether or not it is stable.
    pub steady_state: SteadyState,
}

impl RunHead {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/run-lines";

    /// The first line of a run with these parameters.
    pub fn new(parameters: RunParameters, steady_state: SteadyState) -> Self {
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
    /// l = rt - r - x0, in σ.
    pub l: f64,
    /// Position of the tip, in σ.
    pub x0: f64,
    /// x0', in kσ/Γ, one order less accurate than x0.
    pub velocity: f64,
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
