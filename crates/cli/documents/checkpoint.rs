//! `stickslip/checkpoint`.

use super::{FORMAT_VERSION, RunParameters, Software};
use crate::arguments::RunFormat;
use crate::files::journal::Mark;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// The first line of a checkpoint: what is run, and how far it is.
///
/// After the line come `words` 64-bit words in little-endian order, the state of the computation, and the
/// CRC-32 (IEEE) of all before it, also in little-endian order.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct CheckpointHead {
    /// "stickslip/checkpoint"
    pub(crate) format: String,
    /// 1
    pub(crate) format_version: u32,
    /// The program that wrote it.
    pub(crate) software: Software,
    /// What was asked for.
    pub(crate) order: Order,
    /// Time reached, in Γ/k.
    pub(crate) t: f64,
    /// Samples taken.
    pub(crate) samples: u64,
    /// What is written of the output (`.jsonl`), or kept for it beside the checkpoint.
    pub(crate) written: Mark,
    /// Spent on the integration, in seconds.
    pub(crate) seconds: f64,
    /// Words of the state.
    pub(crate) words: u64,
}

/// All that a run command asks for, but where its checkpoints are.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(crate) struct Order {
    /// Everything that defines the run.
    pub(crate) parameters: RunParameters,
    /// When samples are taken.
    pub(crate) samples: Times,
    /// File to write, `-` for standard output.
    pub(crate) output: PathBuf,
    /// What is written.
    pub(crate) format: RunFormat,
    /// Whether the document holds the dense history.
    pub(crate) history: bool,
    /// Figure to draw.
    pub(crate) plot: Option<PathBuf>,
    /// Whether the run is repeated to verify it.
    pub(crate) verify: bool,
    /// Time between two checkpoints, in Γ/k, if any are made.
    pub(crate) checkpoint_every: Option<f64>,
}

/// The times at which a motion is sampled.
#[derive(Debug, Clone, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, deny_unknown_fields)]
pub(crate) enum Times {
    /// start, start + every, … `intervals` times, and not beyond end.
    Every {
        /// The first, in Γ/k.
        start: f64,
        /// From one to the next, in Γ/k.
        every: f64,
        /// None is beyond this time, in Γ/k.
        end: f64,
        /// Samples but the first.
        intervals: u64,
    },
    /// As given.
    At(Vec<f64>),
}

impl CheckpointHead {
    pub(crate) const FORMAT: &'static str = "stickslip/checkpoint";

    /// The beginning of every one.
    pub(crate) fn is_of_this_program(&self) -> bool {
        self.format == Self::FORMAT
            && self.format_version == FORMAT_VERSION
            && self.software.version == Software::this().version
    }
}
