//! `stickslip/run-lines`.

use crate::parameter::strictly;
use crate::{FORMAT_VERSION, Run, RunEnd, SampleLine, Software, SteadyState};
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
    #[serde(deserialize_with = "strictly")]
    pub parameters: Run,
    /// The steady motion at these parameters, whether or not it is stable; null without a spring.
    pub steady_state: Option<SteadyState>,
}

impl RunHead {
    /// Its `format`.
    pub const FORMAT: &'static str = "stickslip/run-lines";

    /// The first line of a run with these parameters.
    pub fn new(parameters: Run, steady_state: Option<SteadyState>) -> Self {
        Self {
            format: Self::FORMAT.into(),
            format_version: FORMAT_VERSION,
            software: Software::this(),
            parameters,
            steady_state,
        }
    }
}
