//! `stickslip/run-lines`.

use super::{
    FORMAT_VERSION, OscillationDocument, RegimeName, RunParameters, Software, SteadyState,
    WorkDocument,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A line of a run written as it goes on (`.jsonl`): the first says what is run, one follows for each
/// sample, the last says what became of it. Without a last line the run did not come to an end.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub(crate) enum RunLine {
    /// The first line.
    Head(Box<RunHead>),
    /// A sample.
    Sample(SampleLine),
    /// The last line.
    End(RunEnd),
}

/// What is run. Lengths in σ, times in Γ/k, forces in kσ, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RunHead {
    /// "stickslip/run-lines"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// Everything that defines the run.
    pub(crate) parameters: RunParameters,
    /// The steady motion at these parameters, whether or not it is stable.
    pub(crate) steady_state: SteadyState,
}

impl RunHead {
    pub(crate) const FORMAT: &'static str = "stickslip/run-lines";

    pub(crate) fn new(parameters: RunParameters, steady_state: SteadyState) -> Self {
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
pub(crate) struct SampleLine {
    /// Time, in Γ/k.
    pub(crate) t: f64,
    /// l = rt - r - x0, in σ.
    pub(crate) l: f64,
    /// Position of the tip, in σ.
    pub(crate) x0: f64,
    /// x0', in kσ/Γ, one order less accurate than x0.
    pub(crate) velocity: f64,
}

/// What became of the run.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct RunEnd {
    /// Time reached, in Γ/k.
    pub(crate) end: f64,
    /// The kind of motion at the end of the run.
    pub(crate) regime: RegimeName,
    /// Period and amplitudes, where the regime is stick-slip.
    pub(crate) oscillation: Option<OscillationDocument>,
    /// Whether a signal stopped the run before `until`.
    pub(crate) interrupted: bool,
    /// What it took.
    pub(crate) work: WorkDocument,
}
