//! `stickslip/run-lines`.

use crate::parameter::strictly;
use crate::schema::JsonSchema;
use crate::{FORMAT_VERSION, Run, RunEnd, SampleLine, Software, SteadyState};
use serde::{Deserialize, Serialize};

/// A line of a run written during the run (`.jsonl`): the first defines the run, one follows for each sample, the
/// last contains the result. A file without a last line is incomplete.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged)]
pub enum RunLine {
    /// The first line: the definition of the run.
    Head(Box<RunHead>),
    /// A sample.
    Sample(SampleLine),
    /// The last line: the result.
    End(Box<RunEnd>),
}

impl RunLine {
    /// Appends the JSON of the line, without a line break, to a text.
    ///
    /// # Errors
    /// None but those of serde.
    pub fn append_to(&self, text: &mut Vec<u8>) -> serde_json::Result<()> {
        serde_json::to_writer(text, self)
    }
}

/// The definition of a run. Lengths in σ, times in Γ/k, forces in kσ, heights in kσ²/a.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RunHead {
    /// "stickslip/run-lines"
    pub format: String,
    /// Version of the format; 1.
    pub format_version: u32,
    /// The program that wrote the file.
    pub software: Software,
    /// Everything that defines the run.
    #[serde(deserialize_with = "strictly")]
    pub parameters: Run,
    /// The steady motion at these parameters, stable or not; null without a spring.
    pub steady_state: Option<SteadyState>,
}

impl RunHead {
    /// The value of the field `format`.
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
